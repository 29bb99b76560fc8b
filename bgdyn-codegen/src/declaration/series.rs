//! Hydraulic elements in series, which have one flow in common.

/// Elements in series, joined by junctions without volume: one flow runs through all of them.
#[derive(Clone, Debug, PartialEq)]
pub struct Chain {
    /// The node where it begins; its pressure is known.
    pub from: String,
    /// The node where it ends; its pressure is known.
    pub to: String,
    /// Elements by their place in the scene, and whether the flow runs from their `from` to their
    /// `to`.
    pub members: Vec<(usize, bool)>,
    /// The junctions between them.
    pub through: Vec<String>,
}
