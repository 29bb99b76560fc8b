//! Rotation and inertia helpers.

use crate::exact::cases;
use bgdyn_runtime::nalgebra::{Matrix3, Vector3};
use bgdyn_runtime::{Dd, inertia, rotation};
use proptest::prelude::*;

const HALF_PI: f64 = std::f64::consts::FRAC_PI_2;

fn vector() -> impl Strategy<Value = Vector3<f64>> {
    [-2.0..2.0, -2.0..2.0, -2.0..2.0].prop_map(Vector3::from)
}

/// Point masses, kg and m: a body whose inertia can be summed by definition.
fn body() -> impl Strategy<Value = Vec<(f64, Vector3<f64>)>> {
    proptest::collection::vec((0.1..2.0, vector()), 4..7)
}

/// ∫ (r·r 1 − r rᵀ) dm about `origin`, written out.
fn inertia_about(body: &[(f64, Vector3<f64>)], origin: &Vector3<f64>) -> Matrix3<f64> {
    body.iter().fold(Matrix3::zeros(), |sum, (mass, point)| {
        let r = point - origin;
        sum + *mass * (r.dot(&r) * Matrix3::identity() - r * r.transpose())
    })
}

fn close(a: &Matrix3<f64>, b: &Matrix3<f64>, tolerance: f64) -> bool {
    (a - b).abs().max() <= tolerance
}

proptest! {
    #![proptest_config(cases(500))]

    #[test]
    fn roll_pitch_yaw_is_three_turns(roll in -4.0..4.0, pitch in -4.0..4.0, yaw in -4.0..4.0) {
        let product = rotation::about_z(yaw) * rotation::about_y(pitch) * rotation::about_x(roll);
        prop_assert!(close(&rotation::rpy(roll, pitch, yaw), &product, 1e-15));
        prop_assert!(close(&(product * product.transpose()), &Matrix3::identity(), 2e-15));
        prop_assert!((product.determinant() - 1.0).abs() < 2e-15);
    }

    #[test]
    fn skew_is_the_cross_product(v in vector(), x in vector(), s in vector()) {
        prop_assert!((rotation::skew(&v) * x - v.cross(&x)).norm() < 1e-14);
        prop_assert_eq!(rotation::unskew(&rotation::skew(&v)), v);
        // A symmetric part has no influence.
        let symmetric = s * s.transpose();
        prop_assert!((rotation::unskew(&(rotation::skew(&v) + symmetric)) - v).norm() < 1e-14);
    }

    #[test]
    fn inertia_moves_to_another_point(body in body()) {
        let mass: f64 = body.iter().map(|(mass, _)| mass).sum();
        let com = body.iter().map(|(mass, point)| *mass * point).sum::<Vector3<f64>>() / mass;
        let moved = inertia::about_origin(&inertia_about(&body, &com), mass, &com);
        prop_assert!(close(&moved, &inertia_about(&body, &Vector3::zeros()), 1e-12));
        prop_assert_eq!(moved, moved.transpose());
    }

    #[test]
    fn inertia_turns_with_the_body(body in body(), roll in -4.0..4.0, pitch in -4.0..4.0, yaw in -4.0..4.0) {
        let r = rotation::rpy(roll, pitch, yaw);
        let turned: Vec<_> = body.iter().map(|(mass, point)| (*mass, r * point)).collect();
        let origin = Vector3::zeros();
        let rotated = inertia::rotate(&inertia_about(&body, &origin), &r);
        prop_assert!(close(&rotated, &inertia_about(&turned, &origin), 1e-12));
        prop_assert_eq!(rotated, rotated.transpose());
    }

    #[test]
    fn pseudo_inertia_is_the_second_moment_of_mass(body in body()) {
        let j = inertia_about(&body, &Vector3::zeros());
        let moments: Matrix3<f64> = body.iter().map(|(mass, r)| *mass * r * r.transpose()).sum();
        prop_assert!(close(&inertia::pseudo_inertia(&j), &moments, 1e-12));
        prop_assert!(close(&inertia::from_pseudo_inertia(&moments), &j, 1e-12));
    }
}

/// The directions of rotations: x forward, y left, z up.
#[test]
fn quarter_turns_are_right_handed() {
    let turned = |r: Matrix3<f64>, v: [f64; 3]| (r * Vector3::from(v)).map(|x| x.round()).into();
    let turned: [[f64; 3]; 4] = [
        turned(rotation::about_x(HALF_PI), [0.0, 1.0, 0.0]),
        turned(rotation::about_y(HALF_PI), [0.0, 0.0, 1.0]),
        turned(rotation::about_z(HALF_PI), [1.0, 0.0, 0.0]),
        // First roll, then yaw: left becomes up and does not change by the yaw.
        turned(rotation::rpy(HALF_PI, 0.0, HALF_PI), [0.0, 1.0, 0.0]),
    ];
    assert_eq!(
        turned,
        [
            [0.0, 0.0, 1.0],
            [1.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
            [0.0, 0.0, 1.0]
        ]
    );
}

#[test]
fn steiners_term_of_a_known_offset() {
    let expected = Matrix3::new(26.0, -4.0, -6.0, -4.0, 20.0, -12.0, -6.0, -12.0, 10.0);
    assert_eq!(
        inertia::parallel_axis(2.0, &Vector3::new(1.0, 2.0, 3.0)),
        expected
    );
}

/// The helpers work in every scalar; in double-double they are accurate to its digits.
#[test]
fn helpers_in_double_double() {
    let dd = Dd::from_f64;
    let r = rotation::rpy(dd(0.1), dd(-0.7), dd(2.0));
    let j = Matrix3::new(3.0, -0.1, 0.2, -0.1, 2.0, 0.3, 0.2, 0.3, 4.0).map(dd);
    let transposed = r.transpose();
    let back = inertia::rotate(&inertia::rotate(&j, &r), &transposed);
    for (a, b) in back.iter().zip(j.iter()) {
        assert!((*a - *b).abs() < dd(1e-30));
    }
    let com = Vector3::new(dd(0.1), dd(0.2), dd(-0.3));
    let moved = inertia::about_origin(&j, dd(2.0), &com);
    let round = inertia::from_pseudo_inertia(&inertia::pseudo_inertia(&moved));
    for (a, b) in round.iter().zip(moved.iter()) {
        assert!((*a - *b).abs() < dd(1e-30));
    }
    assert_eq!(rotation::unskew(&rotation::skew(&com)), com);
}
