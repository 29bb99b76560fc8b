//! Arbitrary-precision numbers as references for the tests, and random operands.
#![allow(dead_code)] // every test file uses its part of it

use bgdyn_runtime::Dd;
use dashu_float::FBig;
use dashu_float::round::mode::HalfEven;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

/// A binary number with [`BITS`] bits, or more if stated.
pub(crate) type Exact = FBig<HalfEven, 2>;

/// Precision of the references.
pub(crate) const BITS: usize = 400;

pub(crate) fn word(x: f64) -> Exact {
    Exact::try_from(x).unwrap().with_precision(BITS).value()
}

pub(crate) fn exact(x: Dd) -> Exact {
    word(x.hi()) + word(x.lo())
}

pub(crate) fn size(x: Exact) -> Exact {
    if x < Exact::ZERO { -x } else { x }
}

/// The distance of `x` from `reference`, as a multiple of `unit`.
pub(crate) fn distance(x: Dd, reference: &Exact, unit: f64) -> f64 {
    assert!(x.is_finite(), "{x:?} instead of {reference}");
    (size(exact(x) - reference) / word(unit)).to_f64().value()
}

/// The relative error of `x`, as a multiple of 2⁻¹⁰⁶.
pub(crate) fn relative(x: Dd, reference: &Exact) -> f64 {
    let error = size(exact(x) - reference);
    if error == Exact::ZERO {
        return 0.0;
    }
    (error / size(reference.clone()) / word(2_f64.powi(-106)))
        .to_f64()
        .value()
}

/// Checks that a number is the sum of two words that do not overlap.
pub(crate) fn assert_normal(x: Dd) {
    assert_eq!(x.hi() + x.lo(), x.hi(), "{x:?} is not normalised");
}

/// The same cases on every run.
pub(crate) fn cases(cases: u32) -> ProptestConfig {
    ProptestConfig {
        cases,
        rng_seed: RngSeed::Fixed(0x5eed),
        failure_persistence: None,
        ..ProptestConfig::default()
    }
}

/// Returns double-doubles with a `hi` of 2^`exponents` or twice that, and a `lo` of any smaller size,
/// mostly of the largest possible size.
pub(crate) fn operand(exponents: core::ops::Range<i32>) -> impl Strategy<Value = Dd> {
    let lo = prop_oneof![
        6 => (-1.0..1.0).boxed(),
        1 => Just(1.0).boxed(),
        1 => Just(0.0).boxed(),
        1 => Just(1e-9).boxed(),
    ];
    let hi = prop_oneof![8 => 1.0..2.0, 1 => Just(1.0), 1 => Just(2.0 - f64::EPSILON)];
    (any::<bool>(), hi, exponents, lo).prop_map(|(negative, hi, exponent, lo)| {
        let sign = if negative { -1.0 } else { 1.0 };
        let hi: f64 = sign * hi * 2_f64.powi(exponent);
        Dd::new(hi, lo * hi * 2_f64.powi(-53))
    })
}
