//! Bundles, compiled: their parts are the results of the methods by themselves, in every scalar.

use bgdyn::nalgebra::{SVector, vector};
use bgdyn::runtime::wide::f64x4;
use bgdyn::runtime::{Dd, Scalar};

bgdyn::bgdyn!(
    "panda.yaml",
    methods = [
        mass_matrix, bias, forward_dynamics, pose_tool, jacobian_world_tool, jacobian_dot_v_world_tool
    ],
    bundle control =
        [mass_matrix, bias, pose_tool, jacobian_world_tool, jacobian_dot_v_world_tool],
    bundle simulated = [forward_dynamics, kinetic_energy],
);

use panda::Panda;

use crate::counted::{Counted, executed};

fn state<T: Scalar>() -> [SVector<T, 7>; 3] {
    let q = vector![0.3, -0.8, 1.2, -1.9, 0.5, 2.2, -0.7];
    let v = vector![0.9, -0.4, 0.2, 1.3, -1.1, 0.6, 2.0];
    let tau = vector![12.0, -30.0, 4.0, 21.0, -2.0, 1.5, -0.3];
    [q, v, tau].map(|x| x.map(T::from_f64))
}

/// Fails unless two lists of numbers agree to `roundings` of the largest.
fn agree<T: Scalar>(what: &str, found: &[T], expected: &[T], rounding: f64) {
    let zero = T::from_f64(0.0);
    let size = expected.iter().fold(zero, |most, x| most.max(x.abs()));
    assert_eq!(found.len(), expected.len());
    for (&found, &expected) in found.iter().zip(expected) {
        let room = size * T::from_f64(rounding) - (found - expected).abs();
        let mut refused = T::none_refused();
        // Positive, or zero.
        (room + size * T::from_f64(rounding * 1e-3)).checked_pivot(zero, 0, &mut refused);
        let fits = T::succeeded(&vector![zero], refused);
        assert!(fits, "{what}: {found:?} for {expected:?}");
    }
}

fn check<T: Scalar>(rounding: f64) {
    let (robot, [q, v, _]) = (Panda::<T>::default(), state::<T>());
    let all = robot.control(&q, &v);
    agree(
        "M",
        all.mass_matrix.as_slice(),
        robot.mass_matrix(&q).as_slice(),
        rounding,
    );
    agree(
        "h",
        all.bias.as_slice(),
        robot.bias(&q, &v).as_slice(),
        rounding,
    );
    let pose = robot.pose_tool(&q);
    agree(
        "R",
        all.pose_tool.rotation.as_slice(),
        pose.rotation.as_slice(),
        rounding,
    );
    agree(
        "p",
        all.pose_tool.translation.as_slice(),
        pose.translation.as_slice(),
        rounding,
    );
    let jacobian = robot.jacobian_world_tool(&q);
    agree(
        "J",
        all.jacobian_world_tool.as_slice(),
        jacobian.as_slice(),
        rounding,
    );
    let rate = robot.jacobian_dot_v_world_tool(&q, &v);
    agree(
        "J̇ v",
        all.jacobian_dot_v_world_tool.as_slice(),
        rate.as_slice(),
        rounding,
    );
}

#[test]
fn parts_are_the_methods_by_themselves() {
    check::<f64>(1e-14);
    check::<f32>(1e-5);
    // The constants of generated code are `f64` numbers, and other ones in a bundle.
    check::<Dd>(1e-16);
}

#[test]
fn lanes_are_single_states() {
    let [q, v, tau] = state::<f64>();
    let apart = [0.0, 0.1, -0.4, 2.0];
    let lanes = |x: &SVector<f64, 7>| x.map(|x| f64x4::from(apart.map(|d| x + d)));
    let robot = Panda::<f64>::default();
    let together = Panda::<f64x4>::default();
    let control = together.control(&lanes(&q), &lanes(&v));
    let simulated = together.simulated(&lanes(&q), &lanes(&v), &lanes(&tau));
    let simulated = simulated.expect("no lane is singular");
    for (lane, d) in apart.into_iter().enumerate() {
        let [q, v, tau] = [q, v, tau].map(|x| x.add_scalar(d));
        let one = robot.control(&q, &v);
        let lane_of = |x: &f64x4| x.to_array()[lane];
        assert_eq!(control.bias.map(|x| lane_of(&x)), one.bias);
        assert_eq!(control.mass_matrix.map(|x| lane_of(&x)), one.mass_matrix);
        let one = robot.simulated(&q, &v, &tau).expect("no singular state");
        assert_eq!(
            simulated.forward_dynamics.map(|x| lane_of(&x)),
            one.forward_dynamics
        );
        assert_eq!(lane_of(&simulated.kinetic_energy), one.kinetic_energy);
    }
}

#[test]
fn an_error_names_the_argument() {
    let [q, v, mut tau] = state::<f64>();
    tau[4] = f64::NAN;
    let robot = Panda::<f64>::default();
    let alone = robot.forward_dynamics(&q, &v, &tau).expect_err("NaN");
    let bundled = robot.simulated(&q, &v, &tau).expect_err("NaN");
    assert_eq!(bundled.to_string(), alone.to_string());
    assert!(alone.to_string().contains("joint5"), "{alone}");
}

#[test]
fn a_bundle_executes_what_is_counted() {
    let robot = Panda::<Counted>::default();
    let [q, v, tau] = state::<f64>().map(|x| x.map(Counted));
    let runs = [
        ("control", executed(|| robot.control(&q, &v))),
        ("simulated", executed(|| robot.simulated(&q, &v, &tau))),
    ];
    let count = panda::OPERATIONS.len();
    assert_eq!(panda::OPERATIONS[count - 2..], runs);
}
