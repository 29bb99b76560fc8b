//! Tests the coordinates of spherical, floating and planar joints, at random places of a fixed seed.
//!
//! References are computed otherwise: a series in 400 bits, the exponential of a 4×4 matrix, differences
//! in double-double.

mod exact;
// That of the generator, whose crate depends on this one.
#[path = "../../bgdyn-codegen/src/random.rs"]
#[allow(dead_code)]
mod random;

use std::f64::consts::PI;

use bgdyn_runtime::manifold::functions::{Sines, arc_ratio, sine_ratio};
use bgdyn_runtime::manifold::{floating, planar, quaternion_of, rotation, spherical};
use bgdyn_runtime::nalgebra::{Matrix3, SMatrix};
#[cfg(feature = "num-dual")]
use bgdyn_runtime::num_dual::{Dual2, Dual64};
#[cfg(feature = "wide")]
use bgdyn_runtime::wide::{f32x8, f64x4};
use bgdyn_runtime::{Dd, Scalar};
use exact::{Exact, exact, size, word};
use random::Random;

/// Length of the longest arrays.
const MOST: usize = 7;

/// The three joints by one interface. Vectors are slices.
trait Joint {
    const NQ: usize;
    const NV: usize;
    /// Index of the first angular velocity.
    const TURN: usize;
    fn position_rates<T: Scalar>(q: &[T], v: &[T]) -> Vec<T>;
    fn integrate<T: Scalar>(q: &[T], d: &[T]) -> Vec<T>;
    fn difference<T: Scalar>(q1: &[T], q0: &[T]) -> Vec<T>;
    fn normalize<T: Scalar>(q: &[T]) -> Vec<T>;
    fn neutral<T: Scalar>() -> Vec<T>;
    fn sample<T: Scalar>(u: &[T]) -> Vec<T>;
}

struct Spherical;
struct Floating;
struct Planar;

macro_rules! joint {
    ($($joint:ident, $module:ident, $nq:literal, $nv:literal, $turn:literal;)*) => {$(
        impl Joint for $joint {
            const NQ: usize = $nq;
            const NV: usize = $nv;
            const TURN: usize = $turn;
            fn position_rates<T: Scalar>(q: &[T], v: &[T]) -> Vec<T> {
                $module::position_rates::<T>(array(q), array(v)).to_vec()
            }
            fn integrate<T: Scalar>(q: &[T], d: &[T]) -> Vec<T> {
                $module::integrate::<T>(array(q), array(d)).to_vec()
            }
            fn difference<T: Scalar>(q1: &[T], q0: &[T]) -> Vec<T> {
                $module::difference::<T>(array(q1), array(q0)).to_vec()
            }
            fn normalize<T: Scalar>(q: &[T]) -> Vec<T> {
                $module::normalize::<T>(array(q)).to_vec()
            }
            fn neutral<T: Scalar>() -> Vec<T> {
                $module::neutral::<T>().to_vec()
            }
            fn sample<T: Scalar>(u: &[T]) -> Vec<T> {
                $module::sample::<T>(array(u)).to_vec()
            }
        }
    )*};
}

joint! {
    Spherical, spherical, 4, 3, 0;
    Floating, floating, 7, 6, 3;
    Planar, planar, 3, 3, 2;
}

fn array<T: Scalar, const N: usize>(x: &[T]) -> [T; N] {
    x.try_into().unwrap()
}

/// A scalar with a name for its precision.
trait Word: Scalar<Mask = bool> {
    const EPSILON: f64;
    fn get(self) -> f64;
    /// A number in [0, 1) with noise in all its digits.
    fn unit(random: &mut Random) -> Self;

    fn signed(random: &mut Random) -> Self {
        let u = Self::unit(random);
        u + u - Self::from_f64(1.0)
    }
}

impl Word for f64 {
    const EPSILON: f64 = f64::EPSILON;
    fn get(self) -> f64 {
        self
    }
    fn unit(random: &mut Random) -> f64 {
        random.unit()
    }
}

impl Word for f32 {
    const EPSILON: f64 = f32::EPSILON as f64;
    fn get(self) -> f64 {
        f64::from(self)
    }
    fn unit(random: &mut Random) -> f32 {
        (random.unit() as f32).min(0.999_999_9)
    }
}

impl Word for Dd {
    const EPSILON: f64 = f64::EPSILON * f64::EPSILON;
    fn get(self) -> f64 {
        self.to_f64()
    }
    fn unit(random: &mut Random) -> Dd {
        let hi = random.unit() * 0.999;
        Dd::new(hi, hi * random.signed() * 1e-17)
    }
}

fn draw<T: Word>(random: &mut Random, count: usize) -> Vec<T> {
    (0..count).map(|_| T::unit(random)).collect()
}

/// Displacements with a turn by `angle` and a linear part of about a metre.
fn displacement<J: Joint, T: Word>(random: &mut Random, angle: f64) -> Vec<T> {
    let mut d: Vec<T> = (0..J::NV).map(|_| T::signed(random)).collect();
    let turn = &mut d[J::TURN..];
    let square = turn.iter().fold(T::from_f64(0.0), |sum, &x| sum + x * x);
    let scale = T::from_f64(angle) / square.sqrt();
    turn.iter_mut().for_each(|x| *x = *x * scale);
    d
}

fn wide<T: Word>(x: &[T]) -> Vec<Dd> {
    x.iter().map(|x| Dd::from_f64(x.get())).collect()
}

/// The largest distance of two vectors.
fn distance<T: Word>(a: &[T], b: &[T]) -> f64 {
    assert_eq!(a.len(), b.len());
    let each = a.iter().zip(b).map(|(&a, &b)| (a - b).get().abs());
    each.fold(0.0, |most, x| {
        assert!(x.is_finite(), "{a:?} {b:?}");
        f64::max(most, x)
    })
}

/// The largest error of a measure over many cases; printed with `--nocapture`.
struct Most(&'static str, f64);

impl Most {
    fn see(&mut self, error: f64, limit: f64, of: impl std::fmt::Debug) {
        self.1 = f64::max(self.1, error);
        assert!(error <= limit, "{}: {error:e} of {of:?}", self.0);
    }
}

impl Drop for Most {
    fn drop(&mut self) {
        println!("{}: {:e}", self.0, self.1);
    }
}

/// cos x, sin(x)/x, (1 − cos x)/x², (x − sin x)/x³ by their power series in 400 bits.
fn series(square: &Exact) -> [Exact; 4] {
    std::array::from_fn(|n| {
        let mut factor = (1..=n).fold(word(1.0), |f, k| f / word(k as f64));
        let mut sum = word(0.0);
        for k in 0..100 {
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
    let mut most = Most(name, 0.0);
    let mut random = Random(1);
    for k in 0..4000 {
        let square = match k {
            0 => T::from_f64(0.0),
            1 => T::from_f64(4.0),
            2 => T::from_f64(4.0 * (1.0 - f64::EPSILON)),
            _ if k < 1000 => T::unit(&mut random) * T::from_f64(0.5_f64.powi(k % 200)),
            _ if k < 1500 => T::from_f64(4.0) + T::signed(&mut random) * T::from_f64(1e-3),
            _ => T::unit(&mut random) * T::from_f64(100.0),
        };
        let wanted = series(&exact(to_dd(square)));
        let found = Sines::of_square(square);
        let found = [found.cosine, found.sine, found.versine, found.excess];
        // Zeros of the cosine, the sine and 1 − cos have an absolute error.
        let floors = [1.0, 0.3, 0.1, 0.0];
        for ((found, wanted), floor) in found.into_iter().zip(&wanted).zip(floors) {
            most.see(error(to_dd(found), wanted, floor), 8.0 * T::EPSILON, square);
        }
        let angle = T::signed(&mut random) * T::from_f64(0.9_f64.powi(k % 500) * 10.0);
        let [_, wanted, ..] = series(&(exact(to_dd(angle)) * exact(to_dd(angle))));
        let found = to_dd(sine_ratio(angle));
        most.see(error(found, &wanted, 0.3), 8.0 * T::EPSILON, angle);
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
    round_trip::<Spherical, Dd>("spherical, round trip in Dd", 1e-30);
    round_trip::<Floating, Dd>("floating, round trip in Dd", 1e-30);
    round_trip::<Planar, Dd>("planar, round trip in Dd", 1e-30);
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

type Matrix4 = SMatrix<Dd, 4, 4>;

fn times(a: &Matrix4, b: &Matrix4) -> Matrix4 {
    Matrix4::from_fn(|i, j| (0..4).fold(Dd::ZERO, |sum, k| sum + a[(i, k)] * b[(k, j)]))
}

fn one() -> Matrix4 {
    Matrix4::from_fn(|i, j| Dd::from_f64(f64::from(i == j)))
}

/// The exponential of a matrix: power series of a 64th of it, then six squarings.
fn exponential(a: &Matrix4) -> Matrix4 {
    let small = a.map(|x| x * Dd::from_f64(1.0 / 64.0));
    let sum = (1..30).rev().fold(one(), |sum, n| {
        let scale = Dd::ONE / Dd::from_f64(f64::from(n));
        let next = times(&small, &sum).map(|x| x * scale);
        one().zip_map(&next, |a, b| a + b)
    });
    (0..6).fold(sum, |power, _| times(&power, &power))
}

/// The matrix of a twist: linear and angular part.
fn twist<J: Joint>(d: &[Dd]) -> Matrix4 {
    let o = Dd::ZERO;
    let ([x, y, z], [a, b, c]) = match *d {
        [x, y, c] if J::TURN == 2 => ([x, y, o], [o, o, c]),
        [a, b, c] => ([o; 3], [a, b, c]),
        [x, y, z, a, b, c] => ([x, y, z], [a, b, c]),
        _ => panic!(),
    };
    let rows = [[o, -c, b, x], [c, o, -a, y], [-b, a, o, z], [o; 4]];
    Matrix4::from_fn(|i, j| rows[i][j])
}

/// The pose of the coordinates, with the rotation by the sandwich product of quaternions.
fn pose<J: Joint>(q: &[Dd]) -> Matrix4 {
    let o = Dd::ZERO;
    let half = Dd::from_f64(0.5);
    let (p, [x, y, z, w]) = match *q {
        [x, y, angle] => {
            let (s, c) = (angle * half).sin_cos();
            ([x, y, o], [o, o, s, c])
        }
        [x, y, z, w] => ([o; 3], [x, y, z, w]),
        [px, py, pz, x, y, z, w] => ([px, py, pz], [x, y, z, w]),
        _ => panic!(),
    };
    // q∘e∘q* = L(q) R(q*) e.
    let left = [[w, -z, y, x], [z, w, -x, y], [-y, x, w, z], [-x, -y, -z, w]];
    let right = [[w, -z, y, -x], [z, w, -x, -y], [-y, x, w, -z], [x, y, z, w]];
    let product = times(
        &Matrix4::from_fn(|i, j| left[i][j]),
        &Matrix4::from_fn(|i, j| right[i][j]),
    );
    Matrix4::from_fn(|i, j| match (i < 3, j < 3) {
        (true, true) => product[(i, j)],
        (true, false) => p[i],
        (false, _) => Dd::from_f64(f64::from(j == 3)),
    })
}

fn exponential_of_a_matrix<J: Joint>(name: &'static str) {
    let mut most = [Most(name, 0.0), Most("in f64", 0.0)];
    let mut random = Random(6);
    for k in 0..300 {
        let angle = match k % 3 {
            0 => 9.0 * random.signed(),
            1 => 4.0 + 1e-3 * random.signed(),
            _ => 0.5_f64.powi(k / 3),
        };
        let q = J::sample(&draw::<Dd>(&mut random, J::NV));
        let d = displacement::<J, Dd>(&mut random, angle);
        let wanted = times(&pose::<J>(&q), &exponential(&twist::<J>(&d)));
        let found = pose::<J>(&J::integrate(&q, &d));
        let [in_dd, in_f64] = &mut most;
        in_dd.see(
            distance(found.as_slice(), wanted.as_slice()),
            2e-29,
            (&q, &d),
        );
        let round = |x: &[Dd]| x.iter().map(|x| x.to_f64()).collect::<Vec<f64>>();
        let (q, d) = (round(&q), round(&d));
        let found = pose::<J>(&wide(&J::integrate(&q, &d)));
        in_f64.see(
            distance(found.as_slice(), wanted.as_slice()),
            4e-15,
            (&q, &d),
        );
    }
}

#[test]
fn integrate_is_the_exponential_of_a_matrix() {
    exponential_of_a_matrix::<Spherical>("spherical against a matrix exponential");
    exponential_of_a_matrix::<Floating>("floating against a matrix exponential");
    exponential_of_a_matrix::<Planar>("planar against a matrix exponential");
}

fn rates<J: Joint>(name: &'static str) {
    let mut most = Most(name, 0.0);
    let mut random = Random(7);
    for _ in 0..300 {
        let q = J::sample(&draw::<Dd>(&mut random, J::NV));
        let v = displacement::<J, Dd>(&mut random, 2.0);
        let h = Dd::from_f64(1e-9);
        let moved = |h: Dd| J::integrate(&q, &v.iter().map(|&v| h * v).collect::<Vec<Dd>>());
        let pairs = moved(h).into_iter().zip(moved(-h));
        let wanted: Vec<Dd> = pairs.map(|(a, b)| (a - b) / (h + h)).collect();
        most.see(
            distance(&J::position_rates(&q, &v), &wanted),
            1e-17,
            (&q, &v),
        );
    }
}

#[test]
fn position_rates_are_differences_of_integrate() {
    rates::<Spherical>("spherical, rates");
    rates::<Floating>("floating, rates");
    rates::<Planar>("planar, rates");
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

#[cfg(feature = "wide")]
macro_rules! lanes {
    ($test:ident: $lanes:ident, $float:ident, $n:literal) => {
        #[test]
        fn $test() {
            fn check<J: Joint>(name: &'static str) {
                let mut most = Most(name, 0.0);
                let mut random = Random(13);
                for _ in 0..500 {
                    // Lanes on both sides of every selection.
                    let each: [[Vec<$float>; 3]; $n] = std::array::from_fn(|lane| {
                        let angle = [0.0, 1e-9, 2.0, 5.0][lane % 4] * random.unit();
                        let q = J::sample(&draw::<$float>(&mut random, J::NV));
                        let other = J::sample(&draw::<$float>(&mut random, J::NV));
                        [q, other, displacement::<J, $float>(&mut random, angle)]
                    });
                    let [q, other, d] = std::array::from_fn(|which| {
                        let component =
                            |k: usize| $lanes::new(each.each_ref().map(|a| a[which][k]));
                        (0..each[0][which].len())
                            .map(component)
                            .collect::<Vec<$lanes>>()
                    });
                    let mut near =
                        |found: Vec<$lanes>, scalar: &dyn Fn(&[Vec<$float>; 3]) -> Vec<$float>| {
                            for (lane, inputs) in each.iter().enumerate() {
                                let found: Vec<_> =
                                    found.iter().map(|x| x.to_array()[lane]).collect();
                                let error = distance(&found, &scalar(inputs));
                                most.see(error, 20.0 * f64::from($float::EPSILON), inputs);
                            }
                        };
                    near(J::integrate(&q, &d), &|[q, _, d]| J::integrate(q, d));
                    near(J::difference(&J::integrate(&q, &d), &q), &|[q, _, d]| {
                        J::difference(&J::integrate(q, d), q)
                    });
                    near(J::position_rates(&q, &d), &|[q, _, d]| {
                        J::position_rates(q, d)
                    });
                    near(J::normalize(&other), &|[_, other, _]| J::normalize(other));
                }
            }
            check::<Spherical>(concat!("spherical, ", stringify!($lanes)));
            check::<Floating>(concat!("floating, ", stringify!($lanes)));
            check::<Planar>(concat!("planar, ", stringify!($lanes)));
            // Rows of the largest component differ by lane.
            let mut random = Random(14);
            let each: [[$float; 4]; $n] = std::array::from_fn(|_| {
                spherical::sample(std::array::from_fn(|_| $float::unit(&mut random)))
            });
            let q = std::array::from_fn(|k| $lanes::new(each.map(|q| q[k])));
            let found = quaternion_of(&rotation(q));
            for (lane, q) in each.into_iter().enumerate() {
                let found = found.map(|x| x.to_array()[lane]);
                let wanted = quaternion_of(&rotation(q));
                assert!(distance(&found, &wanted) <= 4.0 * f64::from($float::EPSILON));
            }
        }
    };
}

#[cfg(feature = "wide")]
lanes!(lanes_equal_the_scalar_in_double_precision: f64x4, f64, 4);
#[cfg(feature = "wide")]
lanes!(lanes_equal_the_scalar_in_single_precision: f32x8, f32, 8);

/// First and second derivatives along `direction` by dual numbers and by differences in double-double.
#[cfg(feature = "num-dual")]
fn derivatives(
    most: &mut Most,
    at: &[f64],
    direction: &[f64],
    dual: impl Fn(&[Dual64]) -> Vec<Dual64>,
    second: impl Fn(&[Dual2<f64>]) -> Vec<Dual2<f64>>,
    reference: impl Fn(&[Dd]) -> Vec<Dd>,
) {
    let seeds = || at.iter().zip(direction);
    let first = dual(
        &seeds()
            .map(|(&x, &e)| Dual64::new(x, e))
            .collect::<Vec<_>>(),
    );
    let both = second(
        &seeds()
            .map(|(&x, &e)| Dual2::new(x, e, 0.0))
            .collect::<Vec<_>>(),
    );
    let h = Dd::from_f64(1e-8);
    let moved = |h: Dd| {
        let x = |(&x, &e): (&f64, &f64)| Dd::from_f64(x) + h * Dd::from_f64(e);
        reference(&seeds().map(x).collect::<Vec<_>>())
    };
    let (up, here, down) = (moved(h), moved(Dd::ZERO), moved(-h));
    for k in 0..here.len() {
        let slope = ((up[k] - down[k]) / (h + h)).to_f64();
        let bend = ((up[k] - here[k] - (here[k] - down[k])) / (h * h)).to_f64();
        let errors = [first[k].eps - slope, both[k].v1 - slope, both[k].v2 - bend];
        for error in errors {
            most.see(error.abs(), 2e-13, (at, direction, k, slope, bend));
        }
    }
}

#[cfg(feature = "num-dual")]
fn dual<J: Joint>(name: &'static str) {
    let mut random = Random(15);
    let mut most = Most(name, 0.0);
    for angle in [
        0.0, 0.0, 1e-12, 1e-5, 0.3, 1.0, 2.0, 3.0, 3.14, 3.999, 4.001, 5.0,
    ] {
        for _ in 0..10 {
            let q = J::sample(&draw::<f64>(&mut random, J::NV));
            let d = displacement::<J, f64>(&mut random, angle);
            let at = [q.clone(), d.clone()].concat();
            let direction: Vec<f64> = (0..at.len()).map(|_| random.signed()).collect();
            // By q and d together.
            fn whole<J: Joint, T: Scalar>(x: &[T]) -> Vec<T> {
                let (q, d) = x.split_at(J::NQ);
                J::integrate(q, d)
            }
            derivatives(
                &mut most,
                &at,
                &direction,
                whole::<J, Dual64>,
                whole::<J, Dual2<f64>>,
                whole::<J, Dd>,
            );
            if angle <= 3.0 {
                fn back<J: Joint, T: Scalar>(x: &[T]) -> Vec<T> {
                    let (q0, q1) = x.split_at(J::NQ);
                    J::difference(q1, q0)
                }
                let at = [q.clone(), J::integrate(&q, &d)].concat();
                let direction: Vec<f64> = (0..at.len()).map(|_| random.signed()).collect();
                derivatives(
                    &mut most,
                    &at,
                    &direction,
                    back::<J, Dual64>,
                    back::<J, Dual2<f64>>,
                    back::<J, Dd>,
                );
            }
        }
    }
}

#[cfg(feature = "num-dual")]
#[test]
fn derivatives_by_dual_numbers_are_differences() {
    dual::<Spherical>("spherical, derivatives");
    dual::<Floating>("floating, derivatives");
    dual::<Planar>("planar, derivatives");
}
