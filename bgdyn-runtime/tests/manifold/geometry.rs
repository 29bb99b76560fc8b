//! `integrate` against the exponential of a 4×4 matrix, and the rates of coordinates against differences of
//! it, in double-double.

use bgdyn_runtime::Dd;
use bgdyn_runtime::nalgebra::SMatrix;

use crate::joint::{Floating, Joint, Most, Planar, Spherical, displacement, distance, draw, wide};
use crate::random::Random;

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
            2e-30,
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
