//! Loops that are closed by joints that follow.

use super::closure::ClosingType;
use super::{LinkId, Pose};

/// A parallelogram on its parallel branch: opposite links stay parallel, so that its dependent joints follow others
/// with constant ratios and offsets, like those of a gear.
#[derive(Clone, Debug, PartialEq)]
pub struct ParallelLoop {
    /// Its name.
    pub name: String,
    /// Its type.
    pub kind: &'static ClosingType,
    /// The links of its places a and b; `None` for the world.
    pub links: [Option<LinkId>; 2],
    /// The places on these links.
    pub places: [Pose; 2],
    /// The links of its joints that move, from a to b.
    pub joints: Vec<LinkId>,
    /// The number of joints that it makes follow others: 2, or fewer where other loops make them follow already.
    pub rows: usize,
}
