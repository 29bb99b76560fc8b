//! Options of the import.

use super::base::Base;
use super::number::Num;
use bgdyn_codegen::format::Dimension;
use std::path::PathBuf;

/// Options of the caller.
#[derive(Debug, Clone, Default)]
pub struct Options {
    /// Joints to fix, each at a value of its coordinate.
    pub lock: Vec<Lock>,
    /// The first and the last link of the chain to retain, with everything fixed to it.
    pub chain: Option<[String; 2]>,
    /// The key `snap` of the mechanism, rad; without it the parser's default.
    pub snap: Option<f64>,
    /// Links to convert to frames, by name; `all` for every link without inertia that is fixed and carries
    /// no body.
    pub frames: Vec<String>,
    /// Whether to omit damping, friction, springs and rotors of joints; otherwise they are declared as
    /// effects.
    pub no_effects: bool,
    /// The joint between the world and the link without a joint; fixed by default.
    pub base: Option<Base>,
    /// The folder of the files that an MJCF includes; without it such a file is refused.
    pub folder: Option<PathBuf>,
}

/// A joint to fix at a value of its coordinate.
#[derive(Debug, Clone, PartialEq)]
pub struct Lock {
    pub(super) joint: String,
    /// rad or m.
    pub(super) value: Num,
    /// The dimension of its unit, if it has one.
    pub(super) unit: Option<Dimension>,
}
