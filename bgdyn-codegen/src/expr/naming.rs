//! Names of values, titles and units of sections: what a graph holds for readers of the output.

use bgdyn_runtime::Dd;

/// A name for a value. The node may hold the value with the opposite sign.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Name {
    /// The name of the value.
    pub text: String,
    /// Whether the node is the value times −1.
    pub negative: bool,
}

impl Name {
    /// An identifier for the node: `neg_m_elbow_turn` for −m_elbow_turn.
    pub fn identifier(&self) -> String {
        let prefix = if self.negative { "neg_" } else { "" };
        format!("{prefix}{}", self.text)
    }
}

/// What readers of the output find above a section.
#[derive(Clone, Debug)]
pub(super) struct Title {
    pub text: String,
    /// The unit of length, m, where the section knows it.
    pub unit: Option<Dd>,
}

/// A stretch of the algorithm that readers of the output find under one title; 0 has none.
pub(super) type Section = u32;
