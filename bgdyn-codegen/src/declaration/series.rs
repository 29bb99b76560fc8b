//! Hydraulic elements in series, which have the same flow.

/// Elements in series, joined by junctions without volume; the same flow passes through all of them.
#[derive(Clone, Debug, PartialEq)]
pub struct Chain {
    /// The first node; its pressure is known.
    pub from: String,
    /// The last node; its pressure is known.
    pub to: String,
    /// Elements by their index in the scene, and whether the flow is directed from their `from` to their
    /// `to`.
    pub members: Vec<(usize, bool)>,
    /// The junctions between them.
    pub through: Vec<String>,
}
