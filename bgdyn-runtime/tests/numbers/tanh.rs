//! Hyperbolic tangent of `f64` and `f32` against double-double: errors in units of the last place.

use crate::random::Random;
use crate::sine::{Float, units};
use bgdyn_runtime::{Dd, Scalar};

/// Returns the largest error over arguments of `count` draws, and its argument.
fn worst<T: Float>(count: u64, mut draw: impl FnMut() -> f64) -> (f64, f64) {
    let mut found = (0.0, 0.0);
    for _ in 0..count {
        let x = T::of(draw());
        let e = units(x.tanh(), Dd::from(x.wide()).tanh());
        // NaN is worse than any error.
        if e.is_nan() || e > found.0 {
            found = (e, x.wide());
        }
    }
    found
}

/// Measures arguments of all sizes, those up to the bound, and those next to multiples of ln(2)/4, where n changes.
fn measure<T: Float>(count: u64, seed: u64) {
    let check = |what: &str, (units, x): (f64, f64)| {
        println!("{what}: {units:.4} units at {x:e}");
        assert!(units < 2.0, "{what}: {units} units at {x:e}");
    };
    let mut random = Random(seed);
    check("up to 20", worst::<T>(count, || 20.0 * random.signed()));
    check("up to 1", worst::<T>(count, || random.signed()));
    let least = f64::from(T::LEAST + T::DIGITS);
    check(
        "of all sizes",
        worst::<T>(count, || {
            let exponent = 0.5 * (least + 5.0) + 0.5 * (least - 5.0) * random.signed();
            random.signed().signum() * exponent.exp2()
        }),
    );
    check(
        "where n changes",
        worst::<T>(count, || {
            let n = 1.0 + (60.0 * random.signed().abs()).floor();
            let near = T::of(0.25 * n * core::f64::consts::LN_2);
            near.beside((8.0 * random.signed()) as i32).wide()
        }),
    );
}

#[test]
fn errors_are_below_two_units() {
    measure::<f64>(100_000, 3);
    measure::<f32>(100_000, 4);
}

#[test]
fn limits_signs_and_nan() {
    for x in [0.0_f64, 5e-324, 1e-300, 1e-9] {
        assert_eq!(Scalar::tanh(x).to_bits(), x.to_bits());
        assert_eq!(Scalar::tanh(-x).to_bits(), (-x).to_bits());
    }
    for x in [19.1, 20.0, 1e300, f64::INFINITY] {
        assert_eq!((Scalar::tanh(x), Scalar::tanh(-x)), (1.0, -1.0));
    }
    assert!(Scalar::tanh(f64::NAN).is_nan());
    for x in [0.0_f32, 1e-45, 1e-30, 1e-5] {
        assert_eq!(Scalar::tanh(x).to_bits(), x.to_bits());
        assert_eq!(Scalar::tanh(-x).to_bits(), (-x).to_bits());
    }
    for x in [9.1_f32, 10.0, 1e30, f32::INFINITY] {
        assert_eq!((Scalar::tanh(x), Scalar::tanh(-x)), (1.0, -1.0));
    }
    assert!(Scalar::tanh(f32::NAN).is_nan());
}
