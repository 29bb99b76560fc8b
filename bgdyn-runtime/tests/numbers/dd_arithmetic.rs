//! Sums, products, quotients and square roots of double-doubles against exact arithmetic.

use std::cmp::Ordering;

use crate::exact::{assert_normal, cases, exact as ex, operand, relative};
use bgdyn_runtime::Dd;
use proptest::prelude::*;

fn dd(x: f64) -> Dd {
    Dd::from_f64(x)
}

proptest! {
    #![proptest_config(cases(5000))]

    #[test]
    fn sum_of_any_sizes(a in operand(-300..300), b in operand(-300..300)) {
        for (sum, reference) in [(a + b, ex(a) + ex(b)), (a - b, ex(a) - ex(b))] {
            assert_normal(sum);
            prop_assert!(relative(sum, &reference) <= 4.0, "{a:?} ± {b:?}");
        }
    }

    #[test]
    fn sum_of_like_sizes(a in operand(-3..3), b in operand(-3..3)) {
        for (sum, reference) in [(a + b, ex(a) + ex(b)), (a - b, ex(a) - ex(b))] {
            prop_assert!(relative(sum, &reference) <= 4.0, "{a:?} ± {b:?}");
        }
    }

    /// All except the last bits cancel.
    #[test]
    fn sum_that_cancels(a in operand(-3..3), ulps in -4..4_i32, lo in -1.0..1.0) {
        let hi = f64::from_bits((a.hi().to_bits() as i64 + i64::from(ulps)) as u64);
        let b = Dd::new(hi, lo * hi * 2_f64.powi(-53));
        prop_assert!(relative(a - b, &(ex(a) - ex(b))) <= 4.0, "{a:?} - {b:?}");
    }

    #[test]
    fn product(a in operand(-400..400), b in operand(-400..400)) {
        let product = a * b;
        assert_normal(product);
        prop_assert!(relative(product, &(ex(a) * ex(b))) <= 4.0, "{a:?} * {b:?}");
    }

    /// A factor is too large to be split, or the low word is too small.
    #[test]
    fn product_of_extremes(a in operand(900..1023), b in operand(-1000..-3)) {
        let reference = ex(a) * ex(b);
        prop_assert!(relative(a * b, &reference) <= 4.0, "{a:?} * {b:?}");
    }

    #[test]
    fn quotient(a in operand(-400..400), b in operand(-400..400)) {
        let quotient = a / b;
        assert_normal(quotient);
        prop_assert!(relative(quotient, &(ex(a) / ex(b))) <= 4.0, "{a:?} / {b:?}");
    }

    #[test]
    fn quotient_of_extremes(a in operand(-960..1023), b in operand(900..1023)) {
        // Only if the quotient's low word does not underflow.
        if a.hi().abs().log2() - b.hi().abs().log2() > -900.0 {
            prop_assert!(relative(a / b, &(ex(a) / ex(b))) <= 4.0, "{a:?} / {b:?}");
        }
        if a.hi().abs().log2() - b.hi().abs().log2() > -1000.0 && a.hi().abs() > 1e-300 {
            prop_assert!(relative(b / a, &(ex(b) / ex(a))) <= 4.0 || (b / a).hi().is_infinite());
        }
    }

    #[test]
    fn square_root(a in operand(-960..1023)) {
        let a = a.abs();
        assert_normal(a.sqrt());
        prop_assert!(relative(a.sqrt(), &ex(a).sqrt()) <= 4.0, "sqrt {a:?}");
    }

    /// `new` adds any two words exactly.
    #[test]
    fn new_is_exact(hi in operand(-300..300), lo in operand(-300..300)) {
        let sum = Dd::new(hi.hi(), lo.hi());
        assert_normal(sum);
        if (hi.hi() / lo.hi()).abs().log2().abs() < 300.0 {
            prop_assert_eq!(ex(sum), crate::exact::word(hi.hi()) + crate::exact::word(lo.hi()));
        }
    }

    /// Infinities and NaN are preserved, and finite numbers of any size never give NaN.
    #[test]
    fn specials(a in special(), b in special()) {
        let (x, y) = (a.hi(), b.hi());
        let larger = x.abs().max(y.abs());
        for (result, word, size) in [
            (a + b, x + y, larger),
            (a - b, x - y, larger),
            (a * b, x * y, x * y),
            (a / b, x / y, x / y),
        ] {
            prop_assert_eq!(result.is_nan(), word.is_nan(), "{:?} {:?} {:?}", a, b, result);
            prop_assert!(!result.lo().is_nan(), "{:?} {:?} {:?}", a, b, result);
            if !(word.is_finite() && x.is_finite() && y.is_finite()) {
                prop_assert!(word.is_nan() || result == dd(word), "{a:?} {b:?} {result:?}");
            } else {
                let distance = (result.hi() - word).abs();
                prop_assert!(distance <= 1e-15 * size.abs() + 1e-323, "{a:?} {b:?} {result:?}");
            }
        }
        prop_assert_eq!(a.sqrt().is_nan(), x.sqrt().is_nan());
        prop_assert!(!a.sqrt().lo().is_nan());
    }
}

fn special() -> impl Strategy<Value = Dd> {
    let max = f64::MAX;
    prop_oneof![
        proptest::sample::select(vec![
            dd(0.0),
            dd(-0.0),
            dd(f64::INFINITY),
            dd(f64::NEG_INFINITY),
            dd(f64::NAN),
            dd(max),
            dd(-max),
            Dd::new(max, max * 2_f64.powi(-55)),
            Dd::new(-max, max * 2_f64.powi(-55)),
            dd(f64::MIN_POSITIVE),
            dd(-5e-324),
            dd(2e-323),
            dd(1.0),
            Dd::new(1.0, 1e-17),
        ]),
        operand(-1022..1023),
        operand(1018..1023),
        operand(-1022..-960),
    ]
}

#[test]
fn largest_numbers_stay_finite() {
    let max = dd(f64::MAX);
    assert_eq!(max * Dd::ONE, max);
    assert_eq!(max / Dd::ONE, max);
    assert_eq!(max - max, Dd::ZERO);
    assert_eq!(max + dd(1.0) - max, dd(1.0));
    assert_eq!(max / max, Dd::ONE);
    assert_eq!((max + max).hi(), f64::INFINITY);
    assert_eq!((max * dd(2.0)).hi(), f64::INFINITY);
    assert_eq!((max.sqrt() * max.sqrt()).hi(), f64::MAX);
    assert_eq!(Dd::new(f64::MAX, f64::MAX * 2_f64.powi(-60)).hi(), f64::MAX);
    assert_eq!(Dd::new(f64::INFINITY, -1.0), Dd::INFINITY);
    assert!(Dd::new(f64::INFINITY, f64::NEG_INFINITY).is_nan());
}

#[test]
fn smallest_numbers_are_off_by_one_of_them_at_most() {
    let tiny = dd(5e-324);
    assert_eq!(tiny / tiny, Dd::ONE);
    assert_eq!(tiny * dd(2_f64.powi(1000)) / dd(2_f64.powi(1000)), tiny);
    assert_eq!((dd(1e-200) * dd(1e-200)), Dd::ZERO);
    assert_eq!((dd(1e-160) * dd(1e-160)).hi(), 1e-160 * 1e-160);
    assert_eq!(tiny.sqrt(), dd(2_f64.powi(-537)));
}

#[test]
fn order_looks_at_both_words() {
    let (a, b) = (Dd::new(1.0, 1e-20), Dd::new(1.0, 2e-20));
    assert_eq!(a.partial_cmp(&b), Some(Ordering::Less));
    assert_eq!(b.partial_cmp(&a), Some(Ordering::Greater));
    assert_eq!(a.partial_cmp(&a), Some(Ordering::Equal));
    assert!(a != b && Dd::ONE < a && -a > -b);
    assert_eq!((a.min(b), a.max(b)), (a, b));
    assert_eq!((b.min(a), b.max(a)), (a, b));
    assert_eq!((-b).abs(), b);
    assert_eq!(dd(-0.0), Dd::ZERO);
    assert_eq!(dd(f64::NAN).partial_cmp(&a), None);
    assert_ne!(dd(f64::NAN), dd(f64::NAN));
    assert_eq!(Dd::default(), Dd::ZERO);
}

#[test]
fn assigning_operators_are_the_operators() {
    let (a, b) = (Dd::new(3.0, 1e-17), Dd::new(7.0, -3e-17));
    let mut x = a;
    x += b;
    assert_eq!(x, a + b);
    x -= a;
    assert_eq!(x, a + b - a);
    x *= b;
    assert_eq!(x, (a + b - a) * b);
    x /= a;
    assert_eq!(x, (a + b - a) * b / a);
    assert_eq!(Dd::from(2.5), dd(2.5));
}

#[test]
fn constants() {
    let pi = crate::exact::Exact::pi(crate::exact::BITS);
    assert!(relative(Dd::PI, &pi) <= 0.5);
    assert!(relative(Dd::FRAC_PI_2, &(pi / crate::exact::word(2.0))) <= 0.5);
    assert_eq!(Dd::EPSILON.hi(), 2_f64.powi(-104));
}
