//! What all functions of a pair of files have in common.

use super::style::Style;
use crate::plan::Naming;

/// What all functions of a pair of files have in common.
pub(super) struct FunctionContext<'a> {
    pub(super) style: &'a Style,
    pub(super) naming: &'a Naming<'a>,
    /// Number of velocities.
    pub(super) nv: usize,
}
