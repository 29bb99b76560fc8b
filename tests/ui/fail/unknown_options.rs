//! Each wrong option is an error of its own; the module is there.

bgdyn::bgdyn!("good_arm.yaml", speed = "high", formulation = "fastest", prefer = "acuracy");

fn main() {
    println!("{}", good_arm::NV);
}
