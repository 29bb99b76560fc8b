//! Options with values of the wrong kind, and one given twice.

bgdyn::bgdyn!("good_arm.yaml", module = GoodArm, derivatives = true, derivatives = false, methods = gravity);

fn main() {
    println!("{}", good_arm::NV);
}
