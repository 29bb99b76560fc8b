//! Only what is asked for is there, under the names asked for.
#![deny(warnings, clippy::all)]

use bgdyn::nalgebra::Vector2;

bgdyn::bgdyn!("arm.yaml", module = left, visibility = pub(crate), methods = [dynamics], frames = []);
bgdyn::bgdyn!("arm.yaml", module = right, visibility = pub(self), frames = [forearm], methods = [gravity, pose_upper_arm]);
bgdyn::bgdyn!("arm.yaml", derivatives = true);
bgdyn::bgdyn!("arm.yaml", module = fine, prefer = "accuracy", methods = [gravity]);
bgdyn::bgdyn!("arm.yaml", module = cheap, prefer = "operations", methods = [gravity]);

mod inner {
    bgdyn::bgdyn!("arm.yaml", visibility = pub(in crate::inner), methods = [coriolis_matrix,],);

    pub fn names() -> Vec<&'static str> {
        arm::OPERATIONS.iter().map(|(name, _)| *name).collect()
    }
}

fn main() {
    let q = Vector2::new(0.3, -0.4);
    let (l, r) = (left::Arm::<f64>::default(), right::Arm::<f64>::default());
    assert_eq!(l.gravity(&q), r.gravity(&q));
    assert_ne!(r.pose_upper_arm(&q), r.pose_forearm(&q));
    let (f, c) = (fine::Arm::<f64>::default(), cheap::Arm::<f64>::default());
    assert!((f.gravity(&q) - c.gravity(&q)).norm() < 1e-12);
    let names = |table: &[(&'static str, bgdyn::runtime::Operations)]| -> Vec<&'static str> {
        table.iter().map(|(name, _)| *name).collect()
    };
    assert_eq!(
        names(&left::OPERATIONS),
        [
            "inverse_dynamics",
            "mass_matrix",
            "bias",
            "gravity",
            "forward_dynamics",
            "kinetic_energy",
            "potential_energy"
        ]
    );
    let of_forearm = ["pose_forearm", "velocity_forearm", "jacobian_world_forearm", "jacobian_dot_v_world_forearm"];
    let right = names(&right::OPERATIONS);
    assert_eq!(right[..2], ["gravity", "pose_upper_arm"]);
    assert_eq!(right[2..], of_forearm);
    assert_eq!(inner::names(), ["coriolis_matrix"]);
    assert!(names(&arm::OPERATIONS).contains(&"forward_dynamics_derivatives"));
}
