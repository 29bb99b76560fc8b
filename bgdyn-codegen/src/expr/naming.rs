//! Names of values, titles and units of sections, for readers of the output.

use bgdyn_runtime::Dd;

/// A name for a value. The node may hold the value with the opposite sign.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Name {
    /// The name of the value.
    pub text: String,
    /// Whether the node is the value times −1.
    pub negative: bool,
    /// What a number is the sum of, if this is more than its name says.
    pub contents: Option<String>,
}

impl Name {
    /// Returns whether both name the same quantity with the same sign.
    pub(super) fn is_alike(&self, other: &Name) -> bool {
        self.text == other.text && self.negative == other.negative
    }

    /// Returns an identifier for the node: `neg_m_elbow_turn` for −m_elbow_turn.
    pub fn identifier(&self) -> String {
        let prefix = if self.negative { "neg_" } else { "" };
        format!("{prefix}{}", self.text)
    }
}

/// The title of a section for readers of the output.
#[derive(Clone, Debug)]
pub(super) struct Title {
    pub text: String,
    /// The unit of length, m, if it is set.
    pub unit: Option<Dd>,
}

/// A part of the algorithm that has one title in the output; 0 has none.
pub(super) type Section = u32;
