//! Laws of mechanics on compiled code, at random states of every robot.

use bgdyn::Dynamics;
use bgdyn::nalgebra::{SMatrix, SVector};
use bgdyn_codegen::random::Random;

use crate::robots::for_each_robot;

/// A vector of numbers in (−size, size).
pub(crate) fn vector<const N: usize>(random: &mut Random, size: f64) -> SVector<f64, N> {
    SVector::from_fn(|_, _| size * random.signed())
}

fn obeys<M: Dynamics<f64, N, N>, const N: usize>(
    robot: &str,
    model: &M,
    joints: &[&'static str; N],
) {
    assert_eq!(model.joint_names(), joints);
    let mut random = Random(17);
    for _ in 0..50 {
        let (q, v, a) = (
            vector(&mut random, 3.0),
            vector(&mut random, 2.0),
            vector(&mut random, 2.0),
        );
        let mass = model.mass_matrix(&q);
        let bias = model.bias(&q, &v);
        let tau = model.inverse_dynamics(&q, &v, &a);
        let size = mass.amax() * a.amax() * N as f64 + bias.amax() + 1e-3;
        let near = |what: &str, x: f64, y: f64, size: f64| {
            assert!(
                (x - y).abs() <= 1e-13 * size,
                "{robot}: {what}: {x} and {y}"
            );
        };
        let sum: SVector<f64, N> = mass * a + bias;
        near(
            "M a + bias = inverse dynamics",
            (sum - tau).amax(),
            0.0,
            size,
        );
        let kinetic = model.kinetic_energy(&q, &v);
        near(
            "½ vᵀ M v = T",
            v.dot(&(mass * v)) / 2.0,
            kinetic,
            kinetic.max(1e-3),
        );
        let at_rest = model.bias(&q, &SVector::zeros());
        near(
            "bias at rest = gravity",
            (at_rest - model.gravity(&q)).amax(),
            0.0,
            size,
        );
        let x: SVector<f64, N> = vector(&mut random, 1.0);
        assert!(x.dot(&(mass * x)) > 0.0, "{robot}: M is positive definite");
        undoes(robot, model, (&q, &v, &a), &mass);
    }
}

/// Checks that forward dynamics is the inverse of inverse dynamics, to 8 n eps ‖M⁻¹‖ (‖M‖ ‖a‖ + ‖h‖).
fn undoes<M: Dynamics<f64, N, N>, const N: usize>(
    robot: &str,
    model: &M,
    (q, v, a): (&SVector<f64, N>, &SVector<f64, N>, &SVector<f64, N>),
    mass: &SMatrix<f64, N, N>,
) {
    let tau = model.inverse_dynamics(q, v, a);
    let back = model.forward_dynamics(q, v, &tau).expect("M is regular");
    let dynamic = nalgebra::DMatrix::from_fn(N, N, |i, j| mass[(i, j)]);
    let values = dynamic.singular_values();
    let size = (values.max() * a.norm() + model.bias(q, v).norm()) / values.min();
    let error = (back - a).norm();
    assert!(
        error <= 8.0 * N as f64 * f64::EPSILON * size,
        "{robot}: {error} of {size}"
    );
}

#[test]
fn every_robot() {
    for_each_robot!(obeys);
}
