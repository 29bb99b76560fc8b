//! Tests the coordinates of spherical, floating and planar joints, at random places of a fixed seed.
//!
//! References are computed otherwise: a series in 400 bits, the exponential of a 4×4 matrix, differences
//! in double-double.

#[cfg(feature = "num-dual")]
mod dual;
#[path = "../exact/mod.rs"]
mod exact;
mod geometry;
mod joint;
#[cfg(feature = "wide")]
mod lanes;
// That of the generator, whose crate depends on this one.
#[path = "../../src/random.rs"]
#[allow(dead_code)]
mod random;
mod ratios;

use std::f64::consts::PI;

use bgdyn_runtime::Dd;
use bgdyn_runtime::manifold::functions::sine_ratio;
use bgdyn_runtime::manifold::{floating, planar, quaternion_of, rotation, spherical};
use bgdyn_runtime::nalgebra::{Matrix3, SMatrix};
use joint::{
    Floating, Joint, MOST, Most, Planar, Spherical, Word, array, displacement, distance, draw,
};
use random::Random;

/// From the longest to the shortest turn.
fn angles(random: &mut Random) -> Vec<f64> {
    let mut all = vec![PI - 1e-3, -(PI - 1e-3), 3.0, 1e-12, 1e-9, 1e-6, 1e-3, 0.0];
    all.extend((0..12).map(|_| (PI - 1e-3) * random.signed()));
    all
}

fn round_trip<J: Joint, T: Word>(name: &'static str, limit: f64) {
    let mut most = Most(name, 0.0);
    let mut random = Random(3);
    for _ in 0..100 {
        for angle in angles(&mut random) {
            let q = J::sample(&draw::<T>(&mut random, J::NV));
            let d = displacement::<J, T>(&mut random, angle);
            let found = J::difference(&J::integrate(&q, &d), &q);
            most.see(distance(&found, &d), limit, (&q, &d));
        }
    }
}

#[test]
fn difference_is_the_inverse_of_integrate() {
    round_trip::<Spherical, f64>("spherical, round trip in f64", 2e-15);
    round_trip::<Floating, f64>("floating, round trip in f64", 4e-15);
    round_trip::<Planar, f64>("planar, round trip in f64", 4e-15);
    round_trip::<Spherical, Dd>("spherical, round trip in Dd", 5e-31);
    round_trip::<Floating, Dd>("floating, round trip in Dd", 5e-31);
    round_trip::<Planar, Dd>("planar, round trip in Dd", 5e-31);
    round_trip::<Spherical, f32>("spherical, round trip in f32", 1e-6);
    round_trip::<Floating, f32>("floating, round trip in f32", 2e-6);
    round_trip::<Planar, f32>("planar, round trip in f32", 2e-6);
}

/// From the neutral place nothing is lost by subtraction: tiny displacements keep their digits.
fn tiny<J: Joint, T: Word>() {
    let mut random = Random(4);
    for power in 1..100 {
        let scale = T::from_f64(0.5_f64.powi(power));
        let d: Vec<T> = displacement::<J, T>(&mut random, 1.0);
        let d: Vec<T> = d.iter().map(|&x| x * scale).collect();
        let neutral = J::neutral();
        let found = J::difference(&J::integrate(&neutral, &d), &neutral);
        let limit = 8.0 * T::EPSILON * scale.get();
        assert!(distance(&found, &d) <= limit, "{found:?} {d:?}");
    }
}

#[test]
fn tiny_displacements_keep_their_digits() {
    tiny::<Spherical, f64>();
    tiny::<Floating, f64>();
    tiny::<Planar, f64>();
    tiny::<Spherical, Dd>();
    tiny::<Floating, Dd>();
    tiny::<Planar, Dd>();
    tiny::<Floating, f32>();
}

/// Full turns count; the twist grows by the ratio of arc and chord.
#[test]
fn planar_angles_are_not_wrapped() {
    let mut random = Random(5);
    for _ in 0..2000 {
        let q = planar::sample(std::array::from_fn(|_| random.unit()));
        let d = [random.signed(), random.signed(), 40.0 * random.signed()];
        let found = planar::difference(planar::integrate(q, d), q);
        let limit = 2e-14 / sine_ratio(0.5 * d[2]).abs().min(1.0);
        assert!(distance(&found, &d) <= limit, "{found:?} {d:?}");
    }
    let turns = 6.0 * PI;
    let [x, y, angle] = planar::difference([1.0, 2.0, turns], [1.0, 2.0, 0.0]);
    assert_eq!([x, y, angle], [0.0, 0.0, turns]);
}

#[test]
fn normalize_gives_length_one() {
    let mut random = Random(8);
    for k in 0..2000 {
        let q: [f64; MOST] = std::array::from_fn(|_| random.signed() * 10_f64.powi(k % 7 - 3));
        let [px, py, pz, x, y, z, w] = q;
        let unit = spherical::normalize([x, y, z, w]);
        let square = unit.iter().map(|x| x * x).sum::<f64>();
        assert!((square - 1.0).abs() <= 4.0 * f64::EPSILON);
        let length = (x * x + y * y + z * z + w * w).sqrt();
        let direction = [x, y, z, w].map(|x| x / length);
        assert!(distance(&unit, &direction) <= f64::EPSILON);
        let [a, b, c, d] = unit;
        assert_eq!(floating::normalize(q), [px, py, pz, a, b, c, d]);
        assert_eq!(planar::normalize([px, py, pz]), [px, py, pz]);
    }
    assert_eq!(spherical::normalize([0.0; 4]), [0.0; 4]);
    assert_eq!(
        floating::normalize([2.0, 3.0, 4.0, 0.0, 0.0, 0.0, 0.0])[..4],
        [2.0, 3.0, 4.0, 0.0]
    );
    assert_eq!(spherical::neutral::<f64>(), [0.0, 0.0, 0.0, 1.0]);
    assert_eq!(
        floating::neutral::<f64>(),
        [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]
    );
    assert_eq!(planar::neutral::<f64>(), [0.0; 3]);
}

fn negated(q: [f64; 7]) -> [f64; 7] {
    let [px, py, pz, x, y, z, w] = q;
    [px, py, pz, -x, -y, -z, -w]
}

#[test]
fn both_signs_of_a_quaternion_are_one_place() {
    let mut random = Random(9);
    for _ in 0..500 {
        let [a, b] = [(); 2].map(|()| floating::sample(std::array::from_fn(|_| random.unit())));
        let d = floating::difference(a, b);
        assert_eq!(floating::difference(negated(a), b), d);
        assert_eq!(floating::difference(a, negated(b)), d);
        assert_eq!(floating::difference(negated(a), negated(b)), d);
        let [_, _, _, x, y, z] = d;
        assert!((x * x + y * y + z * z).sqrt() <= PI + 1e-15);
        // Equal places: exactly no difference.
        assert_eq!(floating::difference(a, a), [0.0; 6]);
        assert_eq!(floating::difference(a, negated(a)), [0.0; 6]);
    }
}

#[test]
fn half_turns_have_a_finite_difference() {
    let mut random = Random(10);
    for k in 0..1000 {
        let noise = std::array::from_fn(|_| random.signed());
        let axis: [f64; 3] = match k {
            0 => [1.0, 0.0, 0.0],
            1 => [0.0, -1.0, 0.0],
            2 => [0.0, 0.0, 1.0],
            _ => noise,
        };
        for w in [0.0, -0.0, 1e-300, -1e-300, 1e-17, -1e-17] {
            let [x, y, z] = axis;
            let [x, y, z, w] = spherical::normalize([x, y, z, w]);
            let q1 = [0.3, 0.7, -0.2, x, y, z, w];
            let d = floating::difference(q1, floating::neutral());
            let [_, _, _, rx, ry, rz] = d;
            let length = (rx * rx + ry * ry + rz * rz).sqrt();
            assert!((length - PI).abs() <= 2e-15, "{d:?}");
            let [px, py, pz, x, y, z, w] = floating::integrate(floating::neutral(), d);
            let sign = if x * q1[3] + y * q1[4] + z * q1[5] < 0.0 {
                -1.0
            } else {
                1.0
            };
            let found = [px, py, pz, sign * x, sign * y, sign * z, sign * w];
            assert!(distance(&found, &q1) <= 2e-15, "{q1:?} {found:?}");
        }
    }
}

#[test]
fn a_nan_in_a_quaternion_reaches_the_results() {
    let q = floating::sample([0.1, 0.2, 0.3, 0.4, 0.5, 0.6]);
    for k in 3..7 {
        let mut wild: [f64; 7] = q;
        wild[k] = f64::NAN;
        let turn: [f64; 4] = array(&wild[3..]);
        assert!(spherical::normalize(turn).iter().all(|x| x.is_nan()));
        assert!(
            floating::integrate(wild, [0.1; 6])
                .iter()
                .all(|x| x.is_nan())
        );
        assert!(floating::difference(q, wild).iter().all(|x| x.is_nan()));
        assert!(
            floating::difference(wild, q)[3..]
                .iter()
                .all(|x| x.is_nan())
        );
    }
    let mut wild = rotation(array(&q[3..]));
    for k in 0..9 {
        let entry = std::mem::replace(&mut wild[k], f64::NAN);
        assert!(quaternion_of(&wild).iter().all(|x| x.is_nan()));
        wild[k] = entry;
    }
}

fn matrices<T: Word>(name: &'static str) {
    let mut most = Most(name, 0.0);
    let mut random = Random(11);
    for k in 0..4000 {
        let [x, y, z, w]: [T; 4] = std::array::from_fn(|_| T::signed(&mut random));
        let small = T::from_f64(0.5_f64.powi(k % 60));
        let q = spherical::normalize(match k % 4 {
            0 => [x, y, z, w],
            1 => [x, y, z, T::from_f64(0.0)],
            2 => [x, y, z, w * small],
            _ => [x * small, y * small, z * small, w],
        });
        let found = quaternion_of(&rotation(q));
        assert!(found[3].get() >= 0.0);
        let dot = (0..4).fold(T::from_f64(0.0), |sum, k| sum + q[k] * found[k]);
        let sign = T::from_f64(dot.get().signum());
        let found = found.map(|x| sign * x);
        most.see(distance(&found, &q), 4.0 * T::EPSILON, q);
    }
}

#[test]
fn a_quaternion_survives_its_matrix() {
    matrices::<f64>("quaternion of a matrix in f64");
    matrices::<Dd>("quaternion of a matrix in Dd");
    matrices::<f32>("quaternion of a matrix in f32");
    // Exactly half turns about the axes.
    for k in 0..3 {
        let half = Matrix3::from_fn(|i, j| f64::from(i == j) * if i == k { 1.0 } else { -1.0 });
        let found = quaternion_of(&half).map(f64::abs);
        assert_eq!(found, std::array::from_fn(|i| f64::from(i == k)));
    }
}

/// First and second moments of evenly distributed places.
#[test]
fn samples_are_evenly_distributed() {
    let mut random = Random(12);
    let count = 40_000;
    let (mut mean, mut squares) = (Matrix3::<f64>::zeros(), Matrix3::<f64>::zeros());
    let mut products = SMatrix::<f64, 4, 4>::zeros();
    let mut plane = [[0.0_f64; 3]; 4];
    for _ in 0..count {
        let q = floating::sample(std::array::from_fn(|_| random.unit()));
        let turn: [f64; 4] = array(&q[3..]);
        let length = turn.iter().map(|x| x * x).sum::<f64>();
        assert!((length - 1.0).abs() <= 4.0 * f64::EPSILON);
        mean += rotation(turn);
        squares += rotation(turn).map(|x| x * x);
        products += SMatrix::<f64, 4, 4>::from_fn(|i, j| turn[i] * turn[j]);
        let flat = planar::sample(std::array::from_fn(|_| random.unit()));
        let both = [q[0], q[1], q[2]]
            .into_iter()
            .chain([flat[0], flat[1], flat[2] / PI]);
        for (k, x) in both.enumerate() {
            assert!((-1.0..1.0).contains(&x));
            plane[0][k % 3] += x;
            plane[1][k % 3] += x * x;
            plane[2][k % 3] = plane[2][k % 3].min(x);
            plane[3][k % 3] = plane[3][k % 3].max(x);
        }
    }
    let count = f64::from(count);
    let near = |x: f64, wanted: f64| assert!((x / count - wanted).abs() < 0.015, "{x}");
    mean.iter().for_each(|&x| near(x, 0.0));
    squares.iter().for_each(|&x| near(x, 1.0 / 3.0));
    for (k, &x) in products.iter().enumerate() {
        near(x, if k % 5 == 0 { 0.25 } else { 0.0 });
    }
    let [sums, squares, least, largest] = plane;
    sums.iter().for_each(|&x| near(0.5 * x, 0.0));
    squares.iter().for_each(|&x| near(0.5 * x, 1.0 / 3.0));
    assert!(least.iter().all(|&x| x < -0.99) && largest.iter().all(|&x| x > 0.99));
    assert_eq!(planar::sample([0.0; 3]), [-1.0, -1.0, -PI]);
}
