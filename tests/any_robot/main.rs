//! Tests one controller, generic over the traits, on two different robots in two scalars; that the traits
//! equal the modules' own methods; and that the feature `serde` needs no dependency of the caller.

mod controller;

use core::marker::PhantomData;

use bgdyn::nalgebra::{RealField, SMatrix, SVector};
use bgdyn::runtime::{Limits, Pose};
use bgdyn::{Coriolis, Derivatives, Description, Dynamics, Frame, Kinematics, Scalar};
use controller::ToPose;

bgdyn::bgdyn!("specs/scara.yaml", frames = [tool], derivatives = true);
bgdyn::bgdyn!("specs/puma560.yaml", frames = [flange]);
bgdyn::bgdyn!("tests/ui/pass/robots/lift.yaml", methods = [gravity]);
bgdyn::bgdyn!("tests/ui/pass/swing.scene.yaml");
bgdyn::bgdyn!("tests/any_robot/labels.yaml", methods = [gravity]);

/// Returns the final state of a run under the controller, and the largest ratio of a joint's effort to its
/// limit.
fn run<F: Frame, T: Scalar + RealField, M, const N: usize>(
    model: &M,
    [from, to]: [[f64; N]; 2],
) -> (SVector<T, N>, SVector<T, 6>, f64)
where
    M: Dynamics<T, N, N> + Kinematics<F, T, N, N> + Description<N>,
    T::Singular<N>: core::fmt::Debug,
    f64: From<T>,
{
    let number = <T as Scalar>::from_f64;
    let controller = ToPose::<F, T> {
        stiffness: number(100.0),
        barrier: number(400.0),
        frame: PhantomData,
    };
    let target = model.pose(&SVector::from(to).map(number));
    let (mut q, mut v) = (SVector::from(from).map(number), SVector::zeros());
    let (step, mut share) = (number(1e-3), 0.0_f64);
    for _ in 0..4000 {
        let tau = controller.efforts(model, &target, &q, &v);
        let a = model.forward_dynamics(&q, &v, &tau).expect("regular");
        v += a * step;
        q = model.integrate(&q, &(v * step));
        for (
            j,
            Limits {
                lower,
                upper,
                effort,
                ..
            },
        ) in M::JOINT_LIMITS.iter().enumerate()
        {
            share = share.max(f64::from(tau[j]).abs() / effort);
            let (at, name) = (f64::from(q[j]), M::JOINT_NAMES[j]);
            assert!(at > lower - 1e-6 && at < upper + 1e-6, "{name} at {at}");
        }
    }
    (q, model.pose(&q).error_to(&target), share)
}

/// Inside the ranges of the joints the frame reaches its target; outside, a joint stops at the end of its
/// range.
fn arrives<F: Frame, T: Scalar + RealField, M, const N: usize>(
    model: &M,
    ways: [[f64; N]; 2],
    beyond: ([[f64; N]; 2], usize),
    tolerance: f64,
) where
    M: Dynamics<T, N, N> + Kinematics<F, T, N, N> + Description<N>,
    f64: From<T>,
{
    let (_, error, share) = run::<F, T, M, N>(model, ways);
    let left = f64::from(error.amax());
    assert!(left < tolerance, "{}: {left:e} left", F::NAME);
    assert!(share > 0.02 && share <= 1.0 + 1e-6, "{share} of an effort");
    let (ways, joint) = beyond;
    let (q, error, _) = run::<F, T, M, N>(model, ways);
    let end = M::JOINT_LIMITS[joint].upper;
    assert!(ways[1][joint] > end, "the target is beyond the range");
    assert!(
        (f64::from(q[joint]) - end).abs() < 1e-3,
        "{} of {end}",
        q[joint]
    );
    assert!(f64::from(error.amax()) > 1e-2, "{error}");
}

fn scara_arrives<T: Scalar + RealField>(tolerance: f64)
where
    f64: From<T>,
{
    let ways = [[0.2, 0.8, 0.05, -0.3], [0.7, 1.3, 0.15, 0.9]];
    let low = [[0.2, 0.8, 0.15, -0.3], [0.4, 0.9, 0.25, 0.0]];
    let model = scara::Scara::<T>::default();
    arrives::<scara::frames::Tool, T, _, 4>(&model, ways, (low, 2), tolerance);
}

fn puma_arrives<T: Scalar + RealField>(tolerance: f64)
where
    f64: From<T>,
{
    let ways = [
        [0.2, 0.7, -1.0, 0.3, 0.8, 0.1],
        [0.5, 0.4, -0.7, 0.1, 1.1, -0.4],
    ];
    let turned = [
        [2.6, 0.7, -1.0, 0.3, 0.8, 0.1],
        [2.95, 0.7, -1.0, 0.3, 0.8, 0.1],
    ];
    let model = puma560::Puma560::<T>::default();
    arrives::<puma560::frames::Flange, T, _, 6>(&model, ways, (turned, 0), tolerance);
}

#[test]
fn one_controller_moves_a_scara() {
    scara_arrives::<f64>(1e-9);
    scara_arrives::<f32>(1e-4);
}

#[test]
fn one_controller_moves_a_puma() {
    puma_arrives::<f64>(1e-9);
    puma_arrives::<f32>(1e-4);
}

/// Returns all results of a model through the traits, in one row of numbers.
fn through_traits<F: Frame, M, const N: usize>(model: &M, x: [SVector<f64, N>; 3]) -> Vec<f64>
where
    M: Kinematics<F, f64, N, N> + Coriolis<f64, N, N> + Derivatives<f64, N, N>,
{
    let [q, v, a] = x;
    let Pose {
        rotation,
        translation,
    } = model.pose(&q);
    let slopes = model.inverse_dynamics_derivatives(&q, &v, &a);
    let forward = model
        .forward_dynamics_derivatives(&q, &v, &a)
        .expect("regular");
    let squares = [model.coriolis_matrix(&q, &v)]
        .into_iter()
        .chain(slopes)
        .chain(forward);
    let numbers = squares.flat_map(|m: SMatrix<f64, N, N>| m.iter().copied().collect::<Vec<_>>());
    numbers
        .chain(rotation.iter().copied())
        .chain(translation.iter().copied())
        .chain(model.velocity(&q, &v).iter().copied())
        .chain(model.jacobian_world(&q).iter().copied())
        .chain(model.jacobian_dot_v_world(&q, &v).iter().copied())
        .collect()
}

#[test]
fn the_traits_are_the_methods() {
    let arm = scara::Scara::<f64>::default();
    let [q, v, a] = [
        [0.3, -0.5, 0.1, 0.4],
        [1.0, 2.0, -0.5, 0.7],
        [0.2, 0.1, 3.0, -1.0],
    ]
    .map(SVector::from);
    let found = through_traits::<scara::frames::Tool, _, 4>(&arm, [q, v, a]);
    let mut wanted: Vec<f64> = arm.coriolis_matrix(&q, &v).iter().copied().collect();
    arm.inverse_dynamics_derivatives(&q, &v, &a)
        .iter()
        .for_each(|m| wanted.extend(m.iter()));
    let forward = arm
        .forward_dynamics_derivatives(&q, &v, &a)
        .expect("regular");
    forward.iter().for_each(|m| wanted.extend(m.iter()));
    wanted.extend(arm.pose_tool(&q).rotation.iter());
    wanted.extend(arm.pose_tool(&q).translation.iter());
    wanted.extend(arm.velocity_tool(&q, &v).iter());
    wanted.extend(arm.jacobian_world_tool(&q).iter());
    wanted.extend(arm.jacobian_dot_v_world_tool(&q, &v).iter());
    assert_eq!(found, wanted);
}

/// The derivative of the pose error is the twist of the Jacobian.
#[test]
fn the_error_of_a_pose_shrinks_as_the_frame_moves() {
    let arm = puma560::Puma560::<f64>::default();
    let q = SVector::from([0.2, 0.7, -1.0, 0.3, 0.8, 0.1]);
    let v = SVector::from([0.5, -0.3, 0.2, 0.9, -0.4, 0.6]);
    let h = 1e-4;
    let error = arm
        .pose_flange(&(q - v * h))
        .error_to(&arm.pose_flange(&(q + v * h)));
    let left = error / (2.0 * h) - arm.jacobian_world_flange(&q) * v;
    assert!(left.amax() < 1e-6, "{left}");
}

fn labels<M: Description<N>, const N: usize>(_: &M) -> [&'static str; N] {
    M::JOINT_LABELS
}

#[test]
fn joints_keep_the_names_that_they_have_elsewhere() {
    let wanted = ["LHipYaw \"links\"", "knee", "Fuß 2"];
    assert_eq!(labels(&labels::Labels::<f64>::default()), wanted);
    assert_eq!(labels::JOINT_LABELS, wanted);
    assert_eq!(labels::JOINT_NAMES, ["hip", "knee", "foot"]);
}

#[test]
fn structs_are_read_and_written_by_serde() {
    let loaded = lift::Lift { load: 4.5 };
    let text = serde_json::to_string(&loaded).expect("written");
    assert_eq!(text, r#"{"load":4.5}"#);
    assert_eq!(
        serde_json::from_str::<lift::Lift>(&text).expect("read"),
        loaded
    );
    assert!(serde_json::from_str::<lift::Lift>(r#"{"laod":4.5}"#).is_err());
    let single: lift::Lift<f32> = serde_json::from_str(&text).expect("f32");
    assert_eq!(single.load, 4.5);

    let state = swing::State {
        elbow: 0.25,
        ..swing::State::default()
    };
    let text = serde_json::to_string(&state).expect("written");
    assert_eq!(
        serde_json::from_str::<swing::State>(&text).expect("read"),
        state
    );
    for name in swing::STATE_NAMES {
        assert!(text.contains(&format!("\"{name}\":")), "{text}");
    }
    let input = swing::Input {
        shoulder: 2.0,
        ..swing::Input::default()
    };
    let text = serde_json::to_string(&input).expect("written");
    assert_eq!(
        serde_json::from_str::<swing::Input>(&text).expect("read"),
        input
    );
    let model = scara::Scara::<f64>::default();
    assert_eq!(serde_json::to_string(&model).expect("written"), "{}");
    let limits = serde_json::to_string(&scara::JOINT_LIMITS).expect("written");
    let read: [Limits; scara::NV] = serde_json::from_str(&limits).expect("read");
    assert_eq!(read, scara::JOINT_LIMITS);
}
