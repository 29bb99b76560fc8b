//! Generates the models to be timed.

#[path = "../../build/peers.rs"]
mod peers;
#[path = "../../build/robots.rs"]
mod robots;

use bgdyn_codegen::build_script::Build;

/// Largest number of joints for which derivatives are generated, and states in lanes timed: for more, the
/// C code of the peers takes minutes to compile.
const SMALL: usize = 12;

fn main() {
    robots::generate(&peers::paths(), |path, mechanism| {
        let small = mechanism.nv() <= SMALL;
        let build = Build::new(path)
            .methods(["inverse_dynamics", "mass_matrix", "forward_dynamics"])
            .derivatives(small);
        let size = if small { "small" } else { "large" };
        (build, format!("{size} {path:?}"))
    });
}
