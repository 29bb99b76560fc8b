//! Sine and cosine of `f64` and `f32` against double-double: errors in units of the last place.

use crate::random::Random;
use bgdyn_runtime::{Dd, Scalar};

/// `f64` or `f32`.
pub(crate) trait Float: Scalar {
    /// Binary digits.
    const DIGITS: i32;
    /// The largest angle that takes the branch-free path.
    const LIMIT: f64;
    /// The least normal number's exponent.
    const LEAST: i32;
    fn of(x: f64) -> Self;
    fn wide(self) -> f64;
    /// Returns the number that is `steps` numbers away.
    fn beside(self, steps: i32) -> Self;
}

macro_rules! float {
    ($float:ident, $int:ident, $digits:literal, $limit:literal, $least:literal) => {
        impl Float for $float {
            const DIGITS: i32 = $digits;
            const LIMIT: f64 = $limit;
            const LEAST: i32 = $least;
            fn of(x: f64) -> Self {
                x as $float
            }
            fn wide(self) -> f64 {
                f64::from(self)
            }
            fn beside(self, steps: i32) -> Self {
                $float::from_bits(self.to_bits().wrapping_add_signed($int::from(steps)))
            }
        }
    };
}
float!(f64, i64, 53, 1e5, -1022);
float!(f32, i32, 24, 1e4, -126);

/// Returns the distance of `found` from `exact`, in units of the last place of `exact`.
pub(crate) fn units<T: Float>(found: T, exact: Dd) -> f64 {
    let exponent = libm::ilogb(exact.hi()).max(T::LEAST);
    let off = (Dd::from(found.wide()) - exact).hi();
    libm::scalbn(off.abs(), T::DIGITS - 1 - exponent)
}

/// Returns the larger error of sine and cosine of x.
fn error<T: Float>(x: T) -> f64 {
    let (s, c) = x.sin_cos();
    let (sin, cos) = Dd::from(x.wide()).sin_cos();
    units(s, sin).max(units(c, cos))
}

/// Returns the largest error over arguments of `count` draws, and its argument.
fn worst<T: Float>(count: u64, mut draw: impl FnMut() -> f64) -> (f64, f64) {
    let mut found = (0.0, 0.0);
    for _ in 0..count {
        let x = T::of(draw());
        let e = error(x);
        // NaN is worse than any error.
        if e.is_nan() || e > found.0 {
            found = (e, x.wide());
        }
    }
    found
}

/// Measures uniform angles, angles of all sizes, and those next to every multiple of a quarter turn.
fn measure<T: Float>(count: u64, seed: u64) {
    let mut random = Random(seed);
    let check = |what: &str, (units, x): (f64, f64)| {
        println!("{what}: {units:.4} units at {x:e}");
        assert!(units < 1.0, "{what}: {units} units at {x:e}");
    };
    let (mut a, mut b, mut c) = (
        Random(random.word()),
        Random(random.word()),
        Random(random.word()),
    );
    check(
        "|x| <= π",
        worst::<T>(count, || a.signed() * core::f64::consts::PI),
    );
    check("to the limit", worst::<T>(count, || b.signed() * T::LIMIT));
    let sizes = worst::<T>(count, || {
        let sign = c.signed();
        libm::copysign(libm::exp2(c.signed() * 50.0), sign)
    });
    check("of all sizes to 1e15", sizes);
    let quarters = (T::LIMIT * core::f64::consts::FRAC_2_PI) as i32;
    let (mut n, mut step) = (1, -3);
    let near = worst::<T>(u64::from(quarters as u32) * 5, || {
        step += 1;
        if step > 2 {
            (n, step) = (n + 1, -2);
        }
        T::of(f64::from(n) * core::f64::consts::FRAC_PI_2)
            .beside(step)
            .wide()
    });
    check("next to quarter turns", near);
}

#[test]
fn errors_of_f64() {
    measure::<f64>(200_000, 1);
}

#[test]
fn errors_of_f32() {
    measure::<f32>(200_000, 2);
}

/// A hundred million arguments.
#[test]
#[ignore = "five minutes, part of .ci/long"]
fn errors_of_f64_over_many() {
    measure::<f64>(34_000_000, 3);
}

/// Every `f32`, against double precision if that is accurate enough.
#[test]
#[ignore = "five minutes, part of .ci/long"]
fn errors_of_every_f32() {
    let mut found = (0.0, 0.0_f32);
    for bits in 0..f32::INFINITY.to_bits() {
        let x = f32::from_bits(bits);
        let (s, c) = Scalar::sin_cos(x);
        let (sin, cos) = libm::sincos(f64::from(x));
        let e = units(s, Dd::from(sin)).max(units(c, Dd::from(cos)));
        // NaN is worse than any error.
        if e.is_nan() || e > found.0 {
            found = (e, x);
        }
    }
    println!("every f32: {:.4} units at {:e}", found.0, found.1);
    assert!(found.0 < 1.0, "{} units at {:e}", found.0, found.1);
}

/// Sums of two, which have a shorter code path, and of three: of all sizes, with cancellation, and close
/// to a multiple of a quarter turn.
fn sums<T: Float>(seed: u64) {
    let mut random = Random(seed);
    let mut found = (0.0, [0.0; 3]);
    for round in 0..60_000 {
        let size = libm::exp2(random.signed() * 12.0);
        let [a, b] = [0, 1].map(|_| T::of(random.signed() * size));
        let hi = random.signed() * 3.0;
        // In two rounds of three the sum differs from a multiple of a quarter turn, often 0, by a few
        // units in the last place of the angle.
        let turns = match round % 4 {
            0 => 0.0,
            _ => (random.signed() * 1000.0).round(),
        };
        let other = if round % 2 == 0 { hi } else { b.wide() };
        let near = T::of(turns * core::f64::consts::FRAC_PI_2 - other).beside((round % 7) - 3);
        let a = if round % 3 == 0 { a } else { near };
        let lo = hi * random.signed() * 2_f64.powi(-54);
        let cases: [(&[T], (f64, f64)); 3] =
            [(&[a], (hi, lo)), (&[a, b], (0.0, 0.0)), (&[a, b], (hi, lo))];
        for (angles, offset) in cases {
            let wide: Vec<Dd> = angles.iter().map(|x| Dd::from(x.wide())).collect();
            let (sin, cos) = Dd::sin_cos_sum(&wide, offset);
            let (s, c) = T::sin_cos_sum(angles, offset);
            // A sum with an offset is computed in two words; a sine close to a multiple of a quarter turn
            // shows the difference.
            let largest = wide.iter().fold(hi.abs(), |l, x| l.max(x.hi().abs()));
            let is_close = round % 3 != 0 && turns != 0.0;
            let words = match is_close && offset != (0.0, 0.0) {
                true => libm::scalbn(largest, 3 - 2 * T::DIGITS),
                false => 0.0,
            };
            let [s, c] = [(s, sin), (c, cos)].map(|(x, exact)| {
                let off = (Dd::from(x.wide()) - exact).hi().abs();
                if off < words { 0.0 } else { units(x, exact) }
            });
            let e = s.max(c);
            if e.is_nan() || e > found.0 {
                found = (e, [a.wide(), b.wide(), hi]);
            }
        }
    }
    println!("sums: {:.4} units at {:?}", found.0, found.1);
    assert!(found.0 < 1.0, "{} units at {:?}", found.0, found.1);
}

#[test]
fn errors_of_sums() {
    sums::<f64>(8);
    sums::<f32>(9);
}

/// Sums far beyond the limit of the branch-free path: of two angles, exact for any remainder; of three
/// terms, except for |q|·eps².
fn large_sums<T: Float>(seed: u64) {
    let mut random = Random(seed);
    for round in 0..40_000 {
        let size = libm::exp2(33.0 + random.signed() * 20.0);
        let [a, b, c] = [0, 1, 2].map(|_| T::of(random.signed() * size));
        // In one round of two the angles almost cancel.
        let b = if round % 2 == 0 {
            b
        } else {
            T::of(random.signed() * 3.0 - a.wide())
        };
        for angles in [&[a, b][..], &[a, b, c]] {
            let wide: Vec<Dd> = angles.iter().map(|x| Dd::from(x.wide())).collect();
            let (sin, cos) = Dd::sin_cos_sum(&wide, (0.0, 0.0));
            let (s, c) = T::sin_cos_sum(angles, (0.0, 0.0));
            let largest = size * (angles.len() - 2) as f64;
            let words = libm::scalbn(largest, 3 - 2 * T::DIGITS);
            for (x, exact) in [(s, sin), (c, cos)] {
                let off = (Dd::from(x.wide()) - exact).hi().abs();
                // One unit, and the rounding of the sum.
                let unit = off / units(x, exact).max(f64::MIN_POSITIVE);
                assert!(
                    off <= unit + words,
                    "{} units at {:?}",
                    units(x, exact),
                    angles.iter().map(|x| x.wide()).collect::<Vec<_>>()
                );
            }
        }
    }
}

#[test]
fn errors_of_large_sums() {
    large_sums::<f64>(10);
    large_sums::<f32>(11);
}

/// NaN and infinity have no sine; the sine of a small angle is the angle.
#[test]
fn ends_of_the_range() {
    for x in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let (s, c) = Scalar::sin_cos(x);
        assert!(s.is_nan() && c.is_nan());
        let (s, c) = Scalar::sin_cos(x as f32);
        assert!(s.is_nan() && c.is_nan());
    }
    for x in [0.0, 5e-324, 1e-310, 1e-200, 1e-9] {
        assert_eq!(Scalar::sin_cos(x), (x, 1.0));
        assert_eq!(Scalar::sin_cos(-x), (-x, 1.0));
    }
    for x in [f64::MAX, 1e300, 1e22, 100_000.000_000_1] {
        assert!(error(x) < 1.0 && error(-x) < 1.0);
    }
    for x in [f32::MAX, 1e30, 1e20, 10_000.1] {
        assert!(error(x) < 1.0 && error(-x) < 1.0);
    }
}

/// All angles of a call together have the results of separate calls, for any number, with large angles and
/// NaN among them.
#[test]
fn at_once_as_alone() {
    fn same<T: Float, const K: usize>(random: &mut Random) {
        for round in 0..200 {
            let angles: [T; K] = core::array::from_fn(|k| {
                let size = if (round + k) % 37 == 0 { 1e9 } else { 10.0 };
                T::of(
                    random.signed()
                        * if round == 199 && k == 0 {
                            f64::NAN
                        } else {
                            size
                        },
                )
            });
            let other = T::of(random.signed());
            let offset = (core::f64::consts::FRAC_PI_4, 3.061_616_997_868_383e-17);
            let pairs = angles.map(|a| [a, other]);
            let plain = T::sin_cos_all(
                angles.each_ref().map(core::slice::from_ref),
                [(0.0, 0.0); K],
            );
            let sums = T::sin_cos_all(pairs.each_ref().map(|p| &p[..]), [offset; K]);
            for k in 0..K {
                let bits = |(s, c): (T, T)| (s.wide().to_bits(), c.wide().to_bits());
                let alone = T::sin_cos_sum(&pairs[k], offset);
                assert_eq!(bits(plain[k]), bits(angles[k].sin_cos()), "{:?}", angles[k]);
                assert_eq!(bits(sums[k]), bits(alone), "{:?}", pairs[k]);
            }
        }
    }
    fn counts<T: Float>(random: &mut Random) {
        same::<T, 1>(random);
        same::<T, 2>(random);
        same::<T, 3>(random);
        same::<T, 4>(random);
        same::<T, 5>(random);
        same::<T, 6>(random);
        same::<T, 7>(random);
        same::<T, 8>(random);
        same::<T, 9>(random);
        same::<T, 11>(random);
        same::<T, 13>(random);
        same::<T, 16>(random);
        same::<T, 17>(random);
    }
    counts::<f64>(&mut Random(5));
    counts::<f32>(&mut Random(6));
}
