//! The JSON Schemas of mechanisms and scenes, for completion and checks in editors.
//!
//! They have the same rules as the parsers for keys, words, types and units. Faults that need computation
//! (an invalid tensor, a cycle of parents) are found by `bgdyn check`.

mod constraints;
mod effects;
mod mechanism;
mod parts;
mod scene;

pub use mechanism::mechanism;
pub use scene::scene;
