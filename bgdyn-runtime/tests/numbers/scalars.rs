//! Tests the scalar trait for `f64`, `f32` and double-doubles.

use crate::exact::cases;
use bgdyn_runtime::nalgebra::SVector;
use bgdyn_runtime::{Argument, Cause, Dd, Look, Scalar, Singular};
use proptest::prelude::*;

/// The scalars of the generic checks.
trait Word: Scalar<Mask = bool, Refused = Option<usize>> {
    fn get(self) -> f64;
}

impl Word for f64 {
    fn get(self) -> f64 {
        self
    }
}

impl Word for f32 {
    fn get(self) -> f64 {
        f64::from(self)
    }
}

impl Word for Dd {
    fn get(self) -> f64 {
        self.to_f64()
    }
}

/// The error of a sine and cosine of the sum of `angles` and `offset`, compared with double-double.
fn sum_error<T: Word>(angles: &[T], offset: (f64, f64)) -> f64 {
    let wide: Vec<Dd> = angles
        .iter()
        .map(|angle| Dd::from_f64(angle.get()))
        .collect();
    let (s, c) = T::sin_cos_sum(angles, offset);
    let (sin, cos) = Dd::sin_cos_sum(&wide, offset);
    let distance = |x: T, reference: Dd| (Dd::from_f64(x.get()) - reference).abs().to_f64();
    distance(s, sin).max(distance(c, cos))
}

proptest! {
    #![proptest_config(cases(5000))]

    #[test]
    fn sine_of_a_sum_in_f64(
        a in -1e12..1e12, b in -1e12..1e12, c in -4.0..4.0, scale in 0..13_i32, offset in -4.0..4.0
    ) {
        let scale = 10_f64.powi(-scale);
        let (a, b): (f64, f64) = (a * scale, b * scale);
        for angles in [&[a][..], &[a, c], &[a, b], &[a, b, c], &[a, c, -a], &[a, b, c, -a, -b]] {
            for offset in [(0.0, 0.0), (offset, offset * 5e-17), (std::f64::consts::FRAC_PI_2, 6.123233995736766e-17)] {
                let error = sum_error(angles, offset);
                prop_assert!(error <= 0.9 * f64::EPSILON, "{angles:?} {offset:?} {error:e}");
            }
        }
    }

    #[test]
    fn sine_of_a_sum_in_f32(
        a in -1e7..1e7_f32, b in -1e7..1e7_f32, c in -4.0..4.0_f32, scale in 0..13_i32, offset in -4.0..4.0
    ) {
        let scale = 10_f32.powi(-scale);
        let (a, b): (f32, f32) = (a * scale, b * scale);
        for angles in [&[a][..], &[a, c], &[a, b], &[a, b, c], &[a, c, -a], &[a, b, c, -a, -b]] {
            for offset in [(0.0, 0.0), (offset, offset * 5e-17)] {
                let error = sum_error(angles, offset);
                prop_assert!(error <= 2.0 * f64::from(f32::EPSILON), "{angles:?} {offset:?} {error:e}");
            }
        }
    }
}

/// Accuracy that a rounded sum would lose.
#[test]
fn a_sum_of_large_angles_keeps_its_small_ones() {
    let (s, _) = f64::sin_cos_sum(&[1e12, 1e-9, -1e12], (0.0, 0.0));
    assert!((s - 1e-9).abs() < 1e-24);
    assert_ne!((1e12 + 1e-9) - 1e12, 1e-9);
    let (s, _) = f64::sin_cos_sum(&[std::f64::consts::PI], (0.0, 1.2246467991473532e-16));
    assert!(s.abs() < 1e-31, "{s:e}");
    // A tail that is too large for its series.
    assert!(sum_error(&[1e12, 5e-5, 1e12], (0.0, 0.0)) < 2.0 * f64::EPSILON);
    assert!(sum_error(&[1e7_f32, 0.3, 1e7], (0.0, 0.0)) < 2.0 * f64::from(f32::EPSILON));
    assert!(
        f64::sin_cos_sum(&[f64::INFINITY, 1.0], (0.0, 0.0))
            .0
            .is_nan()
    );
    assert!(f64::sin_cos_sum(&[f64::NAN, 1.0], (0.0, 0.0)).1.is_nan());
}

fn comparisons<T: Word>() {
    let t = <T as Scalar>::from_f64;
    let nan = t(f64::NAN);
    assert_eq!((t(1.0).min(t(2.0)), t(1.0).max(t(2.0))), (t(1.0), t(2.0)));
    assert_eq!((t(2.0).min(t(1.0)), t(2.0).max(t(1.0))), (t(1.0), t(2.0)));
    for (a, b) in [(nan, t(1.0)), (t(1.0), nan), (nan, nan)] {
        assert!(Scalar::min(a, b).get().is_nan() && Scalar::max(a, b).get().is_nan());
        assert!(!a.less(b) && !b.less(a));
    }
    assert!(t(1.0).less(t(2.0)) && !t(2.0).less(t(1.0)) && !t(1.0).less(t(1.0)));
    assert_eq!(
        [-3.0, -0.0, 0.0, 5.0].map(|x| t(x).sign().get()),
        [-1.0, 0.0, 0.0, 1.0]
    );
    assert!(nan.sign().get().is_nan());
    assert_eq!(
        (
            T::select(true, t(1.0), t(2.0)),
            T::select(false, t(1.0), t(2.0))
        ),
        (t(1.0), t(2.0))
    );
    assert_eq!(t(2.0).mul_add(t(3.0), t(1.0)), t(7.0));
    assert_eq!(Scalar::abs(t(-2.0)), t(2.0));
    assert_eq!(Scalar::sqrt(t(9.0)), t(3.0));
}

#[test]
fn comparisons_of_all() {
    comparisons::<f64>();
    comparisons::<f32>();
    comparisons::<Dd>();
}

/// Returns whether a pivot is accepted; checks that the pivot is returned.
fn accepted<T: Word>(pivot: f64, magnitude: f64) -> bool {
    let mut refused = T::none_refused();
    let t = <T as Scalar>::from_f64;
    let back = t(pivot).checked_pivot(t(magnitude), 4, &mut refused);
    assert!(pivot.is_nan() || back == t(pivot));
    assert!(refused.is_none_or(|joint| joint == 4));
    refused.is_none()
}

/// `least`: the smallest pivot that is accepted for terms of size 1.
fn pivots<T: Word>(least: f64) {
    assert!(accepted::<T>(1.0, 1.0));
    for bad in [0.0, -0.0, -1.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        assert!(!accepted::<T>(bad, 1.0), "{bad}");
        assert!(!accepted::<T>(bad, 0.0), "{bad}");
    }
    assert!(!accepted::<T>(1.0, f64::NAN));
    assert!(!accepted::<T>(1.0, f64::INFINITY));
    assert!(accepted::<T>(2_f64.powi(-100), 0.0));
    assert!(accepted::<T>(1.1 * least, 1.0));
    assert!(!accepted::<T>(0.9 * least, 1.0));
    assert!(!accepted::<T>(1.0, 1.1 / least));
}

#[test]
fn pivots_of_all() {
    pivots::<f64>(64.0 * f64::EPSILON);
    pivots::<f32>(64.0 * f64::from(f32::EPSILON));
    pivots::<Dd>(2_f64.powi(-104));
    // A correct pivot of this size cannot be distinguished from rounding of terms of size 1, except in
    // double-double.
    assert!(!accepted::<f64>(2_f64.powi(-100), 1.0));
    assert!(!accepted::<f32>(2_f64.powi(-100), 1.0));
    assert!(accepted::<Dd>(2_f64.powi(-100), 1.0));
}

#[test]
fn the_first_refused_joint_is_named() {
    static NAMES: [&str; 2] = ["hip", "knee"];
    let mut refused = f64::none_refused();
    let accelerations = SVector::<f64, 2>::new(1.0, 2.0);
    assert_eq!(
        f64::finish(accelerations, refused, &NAMES, |_| ()),
        Ok(accelerations)
    );
    let _ = 0.0.checked_pivot(1.0, 1, &mut refused);
    let _ = (-1.0).checked_pivot(1.0, 0, &mut refused);
    let _ = 1.0.checked_pivot(1.0, 0, &mut refused);
    let singular = Singular::new(1, &["hip", "knee"]);
    assert_eq!(
        f64::finish(accelerations, refused, &NAMES, |_| ()),
        Err(singular)
    );
    let wide = SVector::<Dd, 2>::new(Dd::ONE, Dd::PI);
    assert_eq!(Dd::finish(wide, Some(1), &NAMES, |_| ()), Err(singular));
    assert!(singular.to_string().contains("`knee` (number 1)"));
    let shown = format!("{singular:?}");
    let wanted = "Singular { joint: 1, name: \"knee\", cause: no inertia left to accelerate }";
    assert_eq!(shown, wanted);
}

#[test]
fn constants_keep_both_words_where_there_is_room() {
    let (hi, lo) = (0.1, 1e-18);
    assert_eq!(<Dd as Scalar>::from_parts(hi, lo), Dd::new(hi, lo));
    assert_eq!(Dd::new(hi, lo).lo(), lo);
    assert_eq!(<f64 as Scalar>::from_parts(hi, lo), hi);
    assert_eq!(<f32 as Scalar>::from_parts(hi, lo), 0.1_f32);
}

/// Accelerations that are not finite are an error that names the joint of the first one.
#[test]
fn nothing_but_finite_accelerations() {
    use bgdyn_runtime::nalgebra::Vector2;
    static NAMES: [&str; 2] = ["first", "second"];
    for wild in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let error = f64::finish(Vector2::new(1.0, wild), None, &NAMES, |_| ()).unwrap_err();
        assert_eq!((error.joint(), error.name()), (1, "second"));
        assert_eq!(error.cause(), Cause::NotFinite);
    }
    assert!(f64::finish(Vector2::new(1.0, -2e300), None, &NAMES, |_| ()).is_ok());
}

/// Accelerations are checked by their sum: an overflow of the sum does not refuse them.
#[test]
fn accelerations_are_refused_one_by_one() {
    static NAMES: [&str; 2] = ["hip", "knee"];
    let found = |x: f64, y: f64| {
        let refused = f64::finish(SVector::<f64, 2>::new(x, y), None, &NAMES, |_| ());
        refused.map_err(|singular| singular.joint())
    };
    assert_eq!(found(f64::MAX, f64::MAX), Ok(SVector::from([f64::MAX; 2])));
    assert_eq!(found(f64::INFINITY, f64::NEG_INFINITY), Err(0));
    assert_eq!(found(1.0, f64::NAN), Err(1));
    let none = SVector::<f64, 0>::zeros();
    assert_eq!(f64::finish(none, None, &[], |_| ()), Ok(none));
}

/// The argument that is NaN or infinite is named, whatever error was found first; without one the cause
/// does not change.
fn explained<T: Scalar<Singular<2> = Singular, Refused = Option<usize>>>(
    accelerations: [f64; 2],
    refused: Option<usize>,
    error: Singular,
) {
    static NAMES: [&str; 2] = ["hip", "knee"];
    let found = |q: [f64; 2], t: f64| {
        let (q, t) = (q.map(T::from_f64), T::from_f64(t));
        let show = |look: &mut Look<'_, T>| {
            look(Argument::Q, &NAMES, &q);
            look(Argument::Time, &["t"], &[t]);
        };
        let accelerations = SVector::from(accelerations.map(T::from_f64));
        T::finish(accelerations, refused, &NAMES, show).expect_err("a failure")
    };
    let cause = |argument, index| Cause::Argument { argument, index };
    for wild in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        assert_eq!(found([1.0, wild], 0.0).cause(), cause(Argument::Q, 1));
        assert_eq!(found([wild, wild], wild).cause(), cause(Argument::Q, 0));
        assert_eq!(found([1.0, 2.0], wild).cause(), cause(Argument::Time, 0));
    }
    assert_eq!(found([1.0, 2.0], 3.0), error);
    let shown = found([1.0, f64::NAN], 0.0).to_string();
    let wanted = "no accelerations: component 1 (`knee`) of argument `q` is NaN or infinite";
    assert_eq!(shown, wanted);
    let shown = found([1.0, 2.0], f64::NAN).to_string();
    assert_eq!(shown, "no accelerations: argument `t` is NaN or infinite");
}

#[test]
fn arguments_that_are_no_numbers_are_named() {
    let pivot = Singular::new(1, &["hip", "knee"]);
    static NAMES: [&str; 2] = ["hip", "knee"];
    let wild = [f64::NAN, 1.0];
    let overflow = f64::finish(SVector::from(wild), None, &NAMES, |_| ()).unwrap_err();
    for (accelerations, refused, error) in [([1.0; 2], Some(1), pivot), (wild, None, overflow)] {
        explained::<f64>(accelerations, refused, error);
        explained::<f32>(accelerations, refused, error);
        explained::<Dd>(accelerations, refused, error);
    }
    assert_eq!(
        overflow.to_string(),
        "no accelerations: joint `hip` (number 0) has an acceleration that is not finite"
    );
}
