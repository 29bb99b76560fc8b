//! The JSON Schemas of mechanisms and scenes, for completion and checks in editors.
//!
//! They say what the readers say about keys, words, types and units; what a check finds by computing (a tensor
//! that no body has, a circle of parents) is for `bgdyn check`.

mod effects;
mod mechanism;
mod parts;
mod scene;

pub use mechanism::mechanism;
pub use scene::scene;
