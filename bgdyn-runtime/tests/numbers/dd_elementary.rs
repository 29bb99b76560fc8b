//! Elementary functions of double-doubles against arbitrary precision.

use crate::exact::{BITS, Exact, cases, distance, exact as ex, operand, relative};
use bgdyn_runtime::{Dd, Scalar};
use dashu_float::DBig;
use proptest::prelude::*;

/// 2⁻¹⁰⁶.
const UNIT: f64 = f64::EPSILON * f64::EPSILON / 4.0;

/// Returns the larger error of sine and cosine, as a multiple of 2⁻¹⁰⁶.
fn angle_error((s, c): (Dd, Dd), (sin, cos): &(Exact, Exact)) -> f64 {
    distance(s, sin, UNIT).max(distance(c, cos, UNIT))
}

proptest! {
    #![proptest_config(cases(300))]

    #[test]
    fn sine_and_cosine(x in operand(-5..54)) {
        let reference = ex(x).sin_cos();
        prop_assert!(angle_error(x.sin_cos(), &reference) <= 4.0, "{x:?}");
    }

    #[test]
    fn sine_of_small_angles_is_relatively_accurate(x in operand(-200..-1)) {
        prop_assert!(relative(x.sin_cos().0, &ex(x).sin()) <= 4.0, "{x:?}");
    }

    /// Angles at which the sine or the cosine almost vanishes.
    #[test]
    fn near_multiples_of_a_quarter_turn(quarters in -4000..4000_i32, off in operand(-100..-10)) {
        let x = Dd::FRAC_PI_2 * Dd::from_f64(f64::from(quarters)) + off;
        let (sin, cos) = ex(x).sin_cos();
        let (s, c) = x.sin_cos();
        prop_assert!(relative(s, &sin) <= 4.0 && relative(c, &cos) <= 8.0, "{x:?}");
    }

    #[test]
    fn sum_of_angles(
        a in operand(0..51), b in operand(0..51), c in operand(-10..10), offset in operand(-2..3)
    ) {
        // The last one almost cancels the others.
        let angles = [a, b, c, -(a + b)];
        let sum = ex(a) + ex(b) + ex(c) - ex(a + b) + ex(offset);
        let sines = Dd::sin_cos_sum(&angles, (offset.hi(), offset.lo()));
        prop_assert!(angle_error(sines, &sum.sin_cos()) <= 4.0, "{angles:?} {offset:?}");
    }

    #[test]
    fn sum_of_tiny_angles(a in operand(-200..-30), b in operand(-200..-30)) {
        let sum = ex(a) + ex(b);
        let (s, c) = Dd::sin_cos_sum(&[a, b], (0.0, 0.0));
        prop_assert!(relative(s, &sum.sin()) <= 8.0 && relative(c, &sum.cos()) <= 4.0);
    }

    #[test]
    fn exponential(x in operand(-120..9)) {
        prop_assert!(relative(x.exp(), &ex(x).exp()) <= 4.0, "{x:?}");
    }

    #[test]
    fn logarithm(x in operand(-1000..1023)) {
        let x = x.abs();
        prop_assert!(relative(x.ln(), &ex(x).ln()) <= 4.0, "{x:?}");
    }

    #[test]
    fn logarithm_near_one(off in operand(-106..-1)) {
        let x = Dd::ONE + off;
        let reference = ex(x).ln();
        prop_assert!(x == Dd::ONE || relative(x.ln(), &reference) <= 8.0, "{x:?}");
    }

    #[test]
    fn hyperbolic_tangent(x in operand(-120..7)) {
        prop_assert!(relative(x.tanh(), &ex(x).tanh()) <= 8.0, "{x:?}");
    }
}

/// Returns the angle with enough bits for all the whole turns of the largest `f64`, and for the remaining
/// fraction.
fn wide(angle: Exact) -> Exact {
    angle.with_precision(2600).value()
}

#[test]
fn sine_and_cosine_of_large_angles() {
    let given = [1e6, 1e12, 1e15, 1e22, 1e100, f64::MAX];
    // The `f64` with the smallest relative distance from a multiple of π/2 (Kahan).
    let kahan = 6381956970095103.0 * 2_f64.powi(797);
    // Exponents that use all digits of 1/2π.
    let ladder = (30..1024).step_by(32).map(|n| 1.2345 * 2_f64.powi(n));
    for x in given.into_iter().chain([kahan]).chain(ladder) {
        for lo in [0.0, 0.3, -0.4] {
            let x = Dd::new(x, lo * x * 2_f64.powi(-53));
            for x in [x, -x] {
                let error = angle_error(x.sin_cos(), &wide(ex(x)).sin_cos());
                assert!(error <= 4.0, "{x:?}: {error}");
            }
        }
    }
}

/// Digits from another library than the one for the other tests: mpmath, 60 digits.
#[test]
fn published_digits() {
    let digits = |text: &str| -> Exact {
        let number: DBig = text.parse().unwrap();
        number
            .with_precision(100)
            .value()
            .with_base_and_precision::<2>(BITS)
            .value()
            .with_rounding()
    };
    let (s, c) = Dd::from_f64(1e22).sin_cos();
    let sin = digits("-0.852200849767188801772705893753029368261762150410043656256509");
    let cos = digits("0.523214785395138945497594473384709492140919972439387953527211");
    assert!(angle_error((s, c), &(sin, cos)) <= 4.0);
    let e = digits("2.71828182845904523536028747135266249775724709369995957496697");
    assert!(relative(Dd::ONE.exp(), &e) <= 4.0);
    let ln_10 = digits("2.30258509299404568401799145468436420760110148862877297603333");
    assert!(relative(Dd::from_f64(10.0).ln(), &ln_10) <= 4.0);
}

#[test]
fn sums_that_cancel_are_exact() {
    let a = Dd::new(1e12, 3e-5);
    let (s, c) = Dd::sin_cos_sum(&[a, Dd::from_f64(0.25), -a], (-0.25, 0.0));
    assert_eq!((s, c), (Dd::ZERO, Dd::ONE));
    let (s, _) = Dd::sin_cos_sum(&[a, -a], (1e-40, 0.0));
    assert!((s - Dd::from_f64(1e-40)).abs() < Dd::from_f64(1e-70));
    let sines = Dd::sin_cos_sum(&[], (0.5, 1e-20));
    assert!(angle_error(sines, &ex(Dd::new(0.5, 1e-20)).sin_cos()) <= 4.0);
    // A plain sum in double-doubles loses 1e-20 here.
    let (s, _) = Dd::sin_cos_sum(&[a, Dd::from_f64(1e-25), -a], (0.0, 0.0));
    assert!((s - Dd::from_f64(1e-25)).abs() < Dd::from_f64(1e-55));
}

#[test]
fn special_values() {
    let dd = Dd::from_f64;
    for x in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let (s, c) = dd(x).sin_cos();
        assert!(s.is_nan() && c.is_nan());
        let (s, c) = Dd::sin_cos_sum(&[dd(1.0), dd(x)], (1.0, 0.0));
        assert!(s.is_nan() && c.is_nan());
    }
    assert!(
        Dd::sin_cos_sum(&[dd(f64::MAX); 3], (0.0, 0.0))
            .0
            .is_finite()
    );
    assert_eq!(dd(0.0).sin_cos(), (Dd::ZERO, Dd::ONE));
    assert!(dd(-0.0).sin_cos().0.hi().is_sign_negative());
    assert_eq!(dd(0.0).exp(), Dd::ONE);
    assert_eq!(dd(f64::INFINITY).exp(), Dd::INFINITY);
    assert_eq!(dd(f64::NEG_INFINITY).exp(), Dd::ZERO);
    assert_eq!(dd(709.9).exp(), Dd::INFINITY);
    assert_eq!(dd(-745.0).exp().hi(), 5e-324);
    assert!((dd(709.78).exp().hi() / 709.78_f64.exp() - 1.0).abs() < 1e-15);
    assert!(dd(f64::NAN).exp().is_nan());
    assert_eq!(dd(0.0).ln(), -Dd::INFINITY);
    assert_eq!(dd(f64::INFINITY).ln(), Dd::INFINITY);
    assert_eq!(Dd::ONE.ln(), Dd::ZERO);
    assert!(dd(-1.0).ln().is_nan() && dd(f64::NAN).ln().is_nan());
    assert_eq!(dd(5e-324).ln().hi(), 5e-324_f64.ln());
    assert_eq!(dd(f64::INFINITY).tanh(), Dd::ONE);
    assert_eq!(dd(-1e300).tanh(), -Dd::ONE);
    assert_eq!(dd(0.0).tanh(), Dd::ZERO);
    assert!(dd(f64::NAN).tanh().is_nan());
    assert!(dd(-1.0).sqrt().is_nan());
    assert_eq!(dd(f64::INFINITY).sqrt(), Dd::INFINITY);
}
