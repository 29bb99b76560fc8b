//! The spec as it was written: typed values with their positions in the file, not yet checked.
//!
//! [`parse`] reports what the format cannot say (syntax, unknown keys, wrong types, units);
//! whether it makes a mechanism is for [`crate::machine::check`] to tell.

mod document;
mod field;
mod index;
mod number;
mod parse;
mod raw;
mod scene;
mod value;
mod walk;
mod yaml;

pub use crate::unit::{Dimension, Unit};
pub use document::{
    FrameSpec, InertiaSpec, JointSpec, LENGTHS, LimitsSpec, LinkSpec, Origin, Spec,
};
pub use field::{Field, Located};
pub(crate) use number::misfit;
pub use number::quantity;
pub use parse::parse;
pub use raw::{Fields, Key, ParsedValue, Raw, Reads};
pub use scene::{SceneSpec, is_scene, parse_scene};
pub use value::{Number, Vector};
