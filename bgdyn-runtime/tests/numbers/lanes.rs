//! Lane k of every result equals the scalar's result for lane k, bit for bit.

use crate::random::Random;
use bgdyn_runtime::nalgebra::{SVector, Vector2};
use bgdyn_runtime::wide::{f32x4, f32x8, f32x16, f64x2, f64x4, f64x8};
use bgdyn_runtime::{Argument, Cause, Scalar, Singular};

/// Numbers for the tests.
trait Numbers {
    fn number(&mut self) -> f64;
}

impl Numbers for Random {
    /// Numbers of every size, and the special ones.
    fn number(&mut self) -> f64 {
        const SPECIAL: [f64; 16] = [
            0.0,
            -0.0,
            1.0,
            -1.0,
            f64::NAN,
            f64::INFINITY,
            f64::NEG_INFINITY,
            f64::MIN_POSITIVE,
            5e-324,
            1e-45,
            f64::MAX,
            1e300,
            std::f64::consts::FRAC_PI_2,
            std::f64::consts::PI,
            1e22,
            -1e-40,
        ];
        let unit = self.signed();
        match self.word() % 8 {
            0 => SPECIAL[(self.word() % 16) as usize],
            1 => f64::from_bits(self.word()),
            2 => unit * 1e12,
            3 => unit * 1e-9,
            4 => (unit * 20.0).round() * std::f64::consts::FRAC_PI_2,
            _ => unit * 10.0,
        }
    }
}

macro_rules! lanes_equal {
    ($($test:ident: $lanes:ident, $float:ident, $n:literal;)*) => {$(
        #[test]
        fn $test() {
            type Lanes = $lanes;
            type Array = [$float; $n];
            let mut random = Random(7);
            let mut draw = || -> Array { std::array::from_fn(|_| random.number() as $float) };
            let same = |what: &str, found: Lanes, wanted: Array, inputs: &[Array]| {
                for (k, (x, y)) in found.to_array().iter().zip(wanted).enumerate() {
                    let both_nan = x.is_nan() && y.is_nan();
                    assert!(
                        both_nan || x.to_bits() == y.to_bits(),
                        "{what}, lane {k}: {x:e} and {y:e} of {inputs:?}"
                    );
                }
            };
            for _ in 0..4_000 {
                let (a, b, c) = (draw(), draw(), draw());
                let (x, y, z) = (Lanes::new(a), Lanes::new(b), Lanes::new(c));
                let each = |f: fn($float) -> $float| a.map(f);
                let pair = |f: fn($float, $float) -> $float| {
                    std::array::from_fn::<$float, $n, _>(|k| f(a[k], b[k]))
                };
                same("+", x + y, pair(|a, b| a + b), &[a, b]);
                same("-", x - y, pair(|a, b| a - b), &[a, b]);
                same("*", x * y, pair(|a, b| a * b), &[a, b]);
                same("/", x / y, pair(|a, b| a / b), &[a, b]);
                same("neg", -x, each(|a| -a), &[a]);
                same("sqrt", Scalar::sqrt(x), each(Scalar::sqrt), &[a]);
                same("exp", Scalar::exp(x), each(Scalar::exp), &[a]);
                same("ln", Scalar::ln(x), each(Scalar::ln), &[a]);
                same("tanh", Scalar::tanh(x), each(Scalar::tanh), &[a]);
                same("abs", Scalar::abs(x), each(Scalar::abs), &[a]);
                same("sign", Scalar::sign(x), each(Scalar::sign), &[a]);
                same("min", Scalar::min(x, y), pair(Scalar::min), &[a, b]);
                same("max", Scalar::max(x, y), pair(Scalar::max), &[a, b]);
                same(
                    "less, select",
                    Scalar::select(x.less(y), x, z),
                    std::array::from_fn(|k| if a[k] < b[k] { a[k] } else { c[k] }),
                    &[a, b, c],
                );
                if cfg!(not(any(target_feature = "fma", target_arch = "aarch64"))) {
                    same(
                        "multiply-add",
                        Scalar::mul_add(x, y, z),
                        std::array::from_fn(|k| Scalar::mul_add(a[k], b[k], c[k])),
                        &[a, b, c],
                    );
                }
                let (s, c) = Scalar::sin_cos(x);
                same("sin", s, each(|a| a.sin_cos_of().0), &[a]);
                same("cos", c, each(|a| a.sin_cos_of().1), &[a]);
                for offset in [(0.0, 0.0), (0.1, 5.551115123125783e-18)] {
                    let (s, c) = Lanes::sin_cos_sum(&[x, y, z], offset);
                    let (a, b, z) = (a, b, z.to_array());
                    let of = |k: usize| $float::sin_cos_sum(&[a[k], b[k], z[k]], offset);
                    same("sin of sum", s, std::array::from_fn(|k| of(k).0), &[a, b, z]);
                    same("cos of sum", c, std::array::from_fn(|k| of(k).1), &[a, b, z]);
                }
                let (mut refused, mut each_refused) = (Lanes::none_refused(), [None; $n]);
                for (joint, (value, magnitude)) in [(x, y), (y, x), (z, x)].into_iter().enumerate() {
                    let pivot = value.checked_pivot(magnitude, joint, &mut refused);
                    let (value, magnitude) = (value.to_array(), magnitude.to_array());
                    let of = |k: usize| {
                        value[k].checked_pivot(magnitude[k], joint, &mut each_refused[k])
                    };
                    same("pivot", pivot, std::array::from_fn(of), &[value, magnitude]);
                }
                let result = Lanes::finish(SVector::from([x, y]), refused, &["first", "second"], |_| ());
                let (values, joints) = match result {
                    Ok(values) => (values, [None; $n]),
                    Err(error) => (error.accelerations, error.errors.map(|e| e.map(|e| e.joint()))),
                };
                assert_eq!(joints, each_refused);
                let zeroed = |a: Array| std::array::from_fn(|k| if joints[k].is_none() { a[k] } else { 0.0 });
                same("acceleration", values[0], zeroed(a), &[a]);
                same("acceleration", values[1], zeroed(b), &[b]);
            }
        }
    )*};
}

/// The trait's sine and cosine, not the standard library's.
trait SinCosOf: Scalar {
    fn sin_cos_of(self) -> (Self, Self) {
        Scalar::sin_cos(self)
    }
}

impl SinCosOf for f64 {}
impl SinCosOf for f32 {}

lanes_equal! {
    two_lanes_in_double_precision: f64x2, f64, 2;
    four_lanes_in_double_precision: f64x4, f64, 4;
    eight_lanes_in_double_precision: f64x8, f64, 8;
    four_lanes_in_single_precision: f32x4, f32, 4;
    eight_lanes_in_single_precision: f32x8, f32, 8;
    sixteen_lanes_in_single_precision: f32x16, f32, 16;
}

#[test]
fn constants_are_rounded_like_the_scalars() {
    let x = 0.1 + 1e-17;
    assert_eq!(f64x4::from_f64(x).to_array(), [f64::from_f64(x); 4]);
    assert_eq!(f32x8::from_f64(x).to_array(), [f32::from_f64(x); 8]);
    assert_eq!(
        f64x4::from_parts(0.1, 1e-18).to_array(),
        [f64::from_parts(0.1, 1e-18); 4]
    );
}

#[test]
fn an_error_says_which_lanes_failed_and_where() {
    let one = f64x4::splat(1.0);
    let mut refused = f64x4::none_refused();
    let _ = f64x4::new([1.0, 0.0, 2.0, 3.0]).checked_pivot(one, 1, &mut refused);
    let _ = f64x4::new([1.0, 0.0, f64::NAN, 3.0]).checked_pivot(one, 0, &mut refused);
    let error = f64x4::finish(
        Vector2::new(one, one + one),
        refused,
        &["shoulder", "elbow"],
        |_| (),
    )
    .unwrap_err();
    assert_eq!(
        error.errors.map(|e| e.map(|e| e.joint())),
        [None, Some(1), Some(0), None]
    );
    assert_eq!(error.accelerations[1].to_array(), [2.0, 0.0, 0.0, 2.0]);
    assert_eq!(error.lane(0), None);
    assert_eq!(error.lane(4), None);
    let failed: Vec<(usize, Singular)> = error.failed().collect();
    assert_eq!(
        failed,
        [
            (1, Singular::new(1, &["shoulder", "elbow"])),
            (2, Singular::new(0, &["shoulder", "elbow"])),
        ]
    );
    let text = error.to_string();
    assert!(
        text.starts_with("lane 1: singular mass matrix: joint `elbow` (number 1)"),
        "{text}"
    );
    assert!(
        text.contains("; lane 2: singular mass matrix: joint `shoulder`"),
        "{text}"
    );
}

/// As for one number: an overflow of the sum does not refuse the accelerations, and a failed lane does not
/// affect the others.
#[test]
fn accelerations_are_refused_one_by_one() {
    let names = &["shoulder", "elbow"];
    let refused = f64x4::none_refused();
    let large = f64x4::splat(f64::MAX);
    let fine = Vector2::new(large, f64x4::new([f64::MAX, 1.0, -1.0, 0.0]));
    assert_eq!(f64x4::finish(fine, refused, names, |_| ()), Ok(fine));
    let wild = Vector2::new(
        large,
        f64x4::new([f64::MAX, f64::NAN, f64::NEG_INFINITY, 0.0]),
    );
    let error = f64x4::finish(wild, refused, names, |_| ()).unwrap_err();
    assert_eq!(
        error.errors.map(|e| e.map(|e| e.joint())),
        [None, Some(1), Some(1), None]
    );
    assert_eq!(
        error.accelerations[0].to_array(),
        [f64::MAX, 0.0, 0.0, f64::MAX]
    );
}

/// Each lane has its own cause.
#[test]
fn arguments_that_are_no_numbers_are_named_lane_by_lane() {
    static NAMES: [&str; 2] = ["shoulder", "elbow"];
    let one = f64x4::splat(1.0);
    let mut refused = f64x4::none_refused();
    let _ = f64x4::new([1.0, 0.0, f64::NAN, 3.0]).checked_pivot(one, 1, &mut refused);
    let accelerations = Vector2::new(one, f64x4::new([1.0, 1.0, 1.0, f64::INFINITY]));
    let (wild, large) = (f64x4::new([1.0, 1.0, f64::NAN, 1.0]), f64x4::splat(1e300));
    let error = f64x4::finish(accelerations, refused, &NAMES, |look| {
        look(Argument::Q, &NAMES, &[large, wild]);
        look(Argument::Tau, &NAMES, &[wild, large]);
    });
    let error = error.unwrap_err();
    assert_eq!(error.lane(0), None);
    assert_eq!(
        error.lane(1),
        Some(Singular::new(1, &["shoulder", "elbow"]))
    );
    let causes = [2, 3].map(|lane| error.lane(lane).map(|alone| alone.cause()));
    let q = Cause::Argument {
        argument: Argument::Q,
        index: 1,
    };
    assert_eq!(causes, [Some(q), Some(Cause::NotFinite)]);
}
