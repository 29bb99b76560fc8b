//! The measured arms: generated, and as lists of bodies for the textbook recursions.

include!(concat!(env!("OUT_DIR"), "/scara.rs"));
include!(concat!(env!("OUT_DIR"), "/puma560.rs"));
include!(concat!(env!("OUT_DIR"), "/panda.rs"));

/// The arms as lists of bodies.
pub mod bodies {
    use bgdyn::nalgebra::{Matrix3, Vector3};
    use textbook::{Body, Placement};

    include!(concat!(env!("OUT_DIR"), "/bodies.rs"));
}
