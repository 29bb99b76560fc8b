//! Options of the import.

use bgdyn_codegen::format::Dimension;

use super::number::Num;

/// What a caller asks for beside the file.
#[derive(Debug, Clone, Default)]
pub struct Options {
    /// Joints to fix, each where its coordinate has a value.
    pub lock: Vec<Lock>,
    /// The first and the last link of the chain to keep, with what is fixed to it.
    pub chain: Option<[String; 2]>,
    /// `snap` as the mechanism states it, rad; its reader's own if none.
    pub snap: Option<f64>,
    /// Links to make frames, by name; `all` for every link without inertia that is fixed and carries no body.
    pub frames: Vec<String>,
    /// Leave damping and friction out: otherwise they are declared as effects.
    pub no_effects: bool,
}

/// A joint to fix where its coordinate has a value.
#[derive(Debug, Clone, PartialEq)]
pub struct Lock {
    pub(super) joint: String,
    /// rad or m.
    pub(super) value: Num,
    /// What its unit measures, where it has one.
    pub(super) unit: Option<Dimension>,
}
