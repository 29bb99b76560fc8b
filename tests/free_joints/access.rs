//! Typed access to joints with several velocities: ranges in q and v, poses and rotations of nalgebra.

use bgdyn::nalgebra::{Isometry3, SVector, UnitQuaternion, Vector3};
use bgdyn::runtime::{Dd, Dynamics, Scalar};

use crate::any_length::{self, AnyLength};
use crate::quadrotor_arm::{self, QuadrotorArm};
use crate::spherical_chain3::{self, SphericalChain3};

/// Returns evenly distributed positions from numbers in 0 … 1.
fn position<T: Scalar, R: Dynamics<T, NQ, NV>, const NQ: usize, const NV: usize>(
    robot: &R,
    seed: f64,
) -> SVector<T, NQ> {
    let number = |k: usize| (seed + 0.618_034 * (k as f64 + 1.0)).fract();
    robot.sample(&SVector::from_fn(|k, _| T::from_f64(number(k))))
}

/// The tool's pose is that of the floating joint, then two turns about y.
#[test]
fn the_pose_of_a_floating_joint_is_that_of_its_link() {
    let robot = QuadrotorArm::default();
    for seed in [0.1, 0.37, 0.83] {
        let q = position(&robot, seed);
        let turn = |[x, z]: [f64; 2], angle: f64| {
            Isometry3::new(Vector3::new(x, 0.0, z), Vector3::y() * angle)
        };
        let tool = QuadrotorArm::free_pose(&q)
            * turn([0.03, -0.06], q[7])
            * turn([0.22, 0.0], q[8])
            * turn([0.2, 0.01], 0.0);
        let found = robot.pose_tool(&q);
        let point = Vector3::new(0.3, -0.2, 0.7);
        let by_matrix = found.rotation * point + found.translation;
        let moved = tool.rotation * point + tool.translation.vector;
        assert!((moved - by_matrix).norm() < 1e-14, "{moved} {by_matrix}");
    }
}

#[test]
fn a_pose_that_was_set_is_read() {
    let angle = Vector3::new(0.4, -1.1, 0.6);
    let pose = Isometry3::new(Vector3::new(1.0, -2.0, 0.5), angle);
    let mut q = position(&QuadrotorArm::default(), 0.2);
    let before = q;
    QuadrotorArm::set_free_pose(&mut q, &pose);
    assert_eq!(QuadrotorArm::free_pose(&q), pose);
    let range = quadrotor_arm::FREE_Q;
    for k in (0..q.len()).filter(|k| !range.contains(k)) {
        assert_eq!(q[k], before[k], "another joint, position {k}");
    }
    let rotation = UnitQuaternion::from_scaled_axis(angle);
    let mut q = position(&SphericalChain3::default(), 0.7);
    SphericalChain3::set_ball2_rotation(&mut q, &rotation);
    assert_eq!(SphericalChain3::ball2_rotation(&q), rotation);
    assert_eq!(
        q.fixed_rows::<4>(spherical_chain3::BALL2_Q.start),
        rotation.coords
    );
}

#[test]
fn ranges_name_the_positions_and_velocities_of_the_joint() {
    for (k, p) in quadrotor_arm::FREE_Q.enumerate() {
        let ends = ["x", "y", "z", "qx", "qy", "qz", "qw"];
        assert_eq!(
            quadrotor_arm::POSITION_NAMES[p],
            format!("free_{}", ends[k])
        );
    }
    for (k, v) in quadrotor_arm::FREE_V.enumerate() {
        let ends = ["x", "y", "z", "rx", "ry", "rz"];
        assert_eq!(quadrotor_arm::JOINT_NAMES[v], format!("free_{}", ends[k]));
    }
}

/// Other scalars, and quaternions of any length, which are read as unit quaternions.
#[test]
fn every_scalar_has_poses() {
    let robot = QuadrotorArm::<Dd>::default();
    let q = position(&robot, 0.5);
    let pose = QuadrotorArm::<Dd>::free_pose(&q);
    assert_eq!(pose.translation.vector, q.fixed_rows::<3>(0));
    let robot = AnyLength::<f32>::default();
    let mut q = position(&robot, 0.5);
    let before = AnyLength::<f32>::hook_rotation(&q);
    for k in any_length::HOOK_Q {
        q[k] *= 3.0;
    }
    let after = AnyLength::<f32>::hook_rotation(&q);
    assert!((after.coords - before.coords).norm() < 1e-6);
    assert!((after.coords.norm() - 1.0).abs() < 1e-6);
}
