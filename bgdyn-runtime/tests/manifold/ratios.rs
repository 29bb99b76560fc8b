//! The ratios of sines and angles, against series in 400 bits.

use std::f64::consts::PI;

use bgdyn_runtime::Dd;
use bgdyn_runtime::manifold::functions::{Sines, arc_ratio, sine_ratio};

use crate::exact::{Exact, exact, size, word};
use crate::joint::{Most, Word};
use crate::random::Random;

/// cos x, sin(x)/x, (1 − cos x)/x², (x − sin x)/x³ by their power series in 400 bits.
fn series(square: &Exact) -> [Exact; 4] {
    std::array::from_fn(|n| {
        let mut factor = (1..=n).fold(word(1.0), |f, k| f / word(k as f64));
        let mut sum = word(0.0);
        for k in 0..60 {
            sum += factor.clone();
            let next = (n + 2 * k) as f64;
            factor = -factor * square / word((next + 1.0) * (next + 2.0));
        }
        sum
    })
}

/// The relative error, or the absolute one for values below `floor`.
fn error(found: Dd, wanted: &Exact, floor: f64) -> f64 {
    let scale = size(wanted.clone()).to_f64().value().max(floor);
    size(exact(found) - wanted).to_f64().value() / scale
}

fn ratios<T: Word>(name: &'static str, to_dd: impl Fn(T) -> Dd) {
    let mut most = [Most(name, 0.0), Most("from 2 rad on", 0.0)];
    let mut random = Random(1);
    for k in 0..1500 {
        let square = match k {
            0 => T::from_f64(0.0),
            1 => T::from_f64(4.0),
            2 => T::from_f64(4.0 * (1.0 - f64::EPSILON)),
            _ if k < 500 => T::unit(&mut random) * T::from_f64(0.5_f64.powi(k % 200)),
            _ if k < 700 => T::from_f64(4.0) + T::signed(&mut random) * T::from_f64(1e-3),
            _ => T::unit(&mut random) * T::from_f64(100.0),
        };
        let wanted = series(&exact(to_dd(square)));
        let found = Sines::of_square(square);
        let found = [found.cosine, found.sine, found.versine, found.excess];
        // The root of larger squares is rounded: absolute errors, and they grow with the angle.
        let angle = square.get().sqrt();
        let (floors, limit) = if angle < 2.0 {
            ([1.0, 0.0, 0.0, 0.0], 3.0)
        } else {
            ([1.0, 0.3, 0.1, 0.0], 3.0 + angle)
        };
        for ((found, wanted), floor) in found.into_iter().zip(&wanted).zip(floors) {
            let error = error(to_dd(found), wanted, floor) / T::EPSILON;
            most[usize::from(angle >= 2.0)].see(error, limit, square);
        }
        let angle = T::signed(&mut random) * T::from_f64(0.9_f64.powi(k % 500) * 10.0);
        let [_, wanted, ..] = series(&(exact(to_dd(angle)) * exact(to_dd(angle))));
        let error = error(to_dd(sine_ratio(angle)), &wanted, 0.0) / T::EPSILON;
        most[0].see(error, 3.0, angle);
    }
}

#[test]
fn ratios_equal_their_series() {
    ratios::<f64>("ratios in f64", Dd::from_f64);
    ratios::<Dd>("ratios in Dd", |x| x);
}

#[test]
fn an_arc_is_that_of_its_sine_and_cosine() {
    let mut random = Random(2);
    let mut most = [Most("arc in f64", 0.0), Most("arc in Dd", 0.0)];
    for k in 0..4000 {
        let angle = Dd::unit(&mut random) * Dd::FRAC_PI_2 * Dd::from_f64(0.99_f64.powi(k / 2));
        let (s, c) = angle.sin_cos();
        let wanted = angle / s;
        let [in_f64, in_dd] = &mut most;
        let found = Dd::from_f64(arc_ratio((s * s).to_f64(), c.to_f64()));
        in_f64.see(
            ((found - wanted) / wanted).get().abs(),
            4.0 * f64::EPSILON,
            k,
        );
        let found = arc_ratio(s * s, c);
        in_dd.see(((found - wanted) / wanted).get().abs(), 1e-31, k);
    }
    assert_eq!(arc_ratio(0.0, 1.0), 1.0);
    assert!((arc_ratio(1.0, 0.0) - PI / 2.0).abs() < 4e-16);
}
