//! Bundles that cannot be: an error at each name, and the module is there.

bgdyn::bgdyn!(
    "good_arm.yaml",
    methods = [gravity],
    bundle gravity = [mass_matrix, bias],
    bundle control = [mass_matrix, bais, mass_matrix],
    bundle empty = [],
    bundle = [mass_matrix],
);

fn main() {
    println!("{}", good_arm::NV);
}
