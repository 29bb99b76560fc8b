//! Options are names with values.

bgdyn::bgdyn!("good_arm.yaml" literal);

fn main() {
    println!("{}", good_arm::NV);
}
