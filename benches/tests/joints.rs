//! Bodies, joints and states of mechanisms with joints of several velocities, as the compared programs get
//! them.

use std::path::Path;

use benches::body::{bodies, joint_names};
use benches::joints::joint_kinds;
use benches::states::{JointKind, STATES, states_of};
use bgdyn_codegen::mechanism::Mechanism;

fn golden(name: &str) -> Mechanism {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/golden/joints");
    benches::read(&folder.join(name)).expect("a spec")
}

#[test]
fn a_floating_joint_is_one_body() {
    let quadrotor = golden("quadrotor_arm.yaml");
    let names: Vec<&str> = joint_names(&quadrotor).collect();
    assert_eq!(names, ["free", "shoulder", "elbow"]);
    let kinds = joint_kinds(&quadrotor).expect("peers have these joints");
    assert_eq!(
        kinds,
        [JointKind::Floats, JointKind::Turns, JointKind::Turns]
    );
    let bodies = bodies(&quadrotor);
    let parents: Vec<Option<usize>> = bodies.iter().map(|b| b.parent).collect();
    assert_eq!(parents, [None, Some(0), Some(1)]);
    let masses: Vec<f64> = bodies.iter().map(|b| b.mass).collect();
    assert_eq!(masses, [1.6, 0.32, 0.21]);
}

#[test]
fn states_of_a_floating_joint_have_unit_quaternions() {
    let states = states_of(&[JointKind::Slides, JointKind::Floats, JointKind::Turns]);
    assert_eq!(states.len(), STATES);
    for state in &states {
        assert_eq!((state.q.len(), state.v.len()), (9, 8));
        assert_eq!((state.a.len(), state.tau.len()), (8, 8));
        let length = state.q[4..8].iter().map(|x| x * x).sum::<f64>();
        assert!((length - 1.0).abs() < 1e-15 * 4.0, "{length}");
        assert!(state.q[..4].iter().all(|x| x.abs() <= 0.3));
    }
}

#[test]
fn other_joints_are_refused_by_name() {
    let refused = |name: &str| joint_kinds(&golden(name)).expect_err("not for peers");
    let message = refused("spherical_chain3.yaml");
    assert!(message.contains("spherical"), "{message}");
    let message = refused("mimic_gripper.yaml");
    assert!(message.contains("follows others"), "{message}");
}
