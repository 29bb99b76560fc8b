//! Names that the mechanism does not have: an error at each, none at the calls.

use bgdyn::nalgebra::Vector2;

bgdyn::bgdyn!(
    "good_arm.yaml",
    module = robot,
    methods = [inverse_dynamic, gravity, pose_gripper],
    frames = [uper_arm, forearm],
);

fn main() {
    let q = Vector2::new(0.3, -0.4);
    println!("{}", robot::GoodArm::<f64>::default().inverse_dynamics(&q, &q, &q));
}
