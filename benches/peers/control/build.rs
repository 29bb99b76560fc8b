//! Generates the arms to be timed, with the methods of controllers.

#[path = "../../build/peers.rs"]
mod peers;
#[path = "../../build/robots.rs"]
mod robots;

use bgdyn_codegen::build_script::Build;

const METHODS: [&str; 13] = [
    "regressor",
    "inverse_mass_matrix",
    "inverse_dynamics_along",
    "inverse_dynamics_adjoint",
    "forward_dynamics_along",
    "forward_dynamics_adjoint",
    "inverse_dynamics_curvature",
    "mass_matrix_rate",
    "centre_of_mass",
    "com_jacobian",
    "centroidal_map",
    "centroidal_momentum",
    "centroidal_bias",
];

/// Number of joints that a link has to be moved by to have an inertia Λ.
const SPATIAL: usize = 6;

fn main() {
    robots::generate(&peers::paths(), |path, mechanism| {
        let last = mechanism.coordinates().last().expect("a joint that moves");
        let tip = &mechanism.links()[last.0].name;
        let [inverse, inertia] = ["inverse", "inertia"].map(|of| format!("operational_{of}_{tip}"));
        let mut methods = METHODS.map(String::from).to_vec();
        methods.push(inverse.clone());
        let spatial = mechanism.nv() >= SPATIAL;
        methods.extend(spatial.then(|| inertia.clone()));
        let size = if spatial { "spatial" } else { "planar" };
        let build = Build::new(path).methods(methods);
        (build, format!("{size} {inverse} {inertia} {path:?}"))
    });
}
