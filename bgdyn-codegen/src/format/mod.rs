//! Parses a spec into typed values with their positions in the file, before the checks.
//!
//! [`parse`] reports violations of the format (syntax, unknown keys, wrong types, units);
//! [`crate::machine::check`] checks the mechanism.

mod document;
mod field;
mod index;
mod loops;
mod number;
mod parse;
mod raw;
mod scene;
mod value;
mod walk;
mod yaml;

pub use crate::unit::{Dimension, Unit};
pub use document::{
    FrameSpec, InertiaSpec, JointSpec, LENGTHS, LIMIT_PARTS, LimitsSpec, LinkSpec, LoopEndSpec,
    LoopSpec, MimicSpec, Origin, Spec,
};
pub use field::{Field, Located};
pub(crate) use number::check_unit;
pub use number::quantity;
pub use parse::parse;
pub use raw::{Fields, Key, ParsedValue, Raw, Reads};
pub use scene::{ControllerModelSpec, SceneSpec, is_scene, parse_scene};
pub use value::{Number, Vector};
