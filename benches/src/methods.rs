//! The methods that benchmarks time, and build scripts generate for them.

/// The methods of a controller.
pub const CONTROLLER: [&str; 5] = [
    "inverse_dynamics",
    "mass_matrix",
    "forward_dynamics",
    "bias",
    "gravity",
];
