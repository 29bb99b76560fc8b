//! The list of all kinds of effects, which is passed to the checks.

use super::Declaration;

/// Every kind of effect.
#[derive(Clone, Debug)]
pub struct Kinds(Vec<&'static dyn Declaration>);

impl Kinds {
    /// These.
    pub fn new(all: impl IntoIterator<Item = &'static dyn Declaration>) -> Self {
        Kinds(all.into_iter().collect())
    }

    /// All of them, in the order of the list.
    pub fn iter(&self) -> impl Iterator<Item = &'static dyn Declaration> {
        self.0.iter().copied()
    }

    /// The one with this keyword.
    pub fn named(&self, keyword: &str) -> Option<&'static dyn Declaration> {
        self.iter().find(|kind| kind.keyword() == keyword)
    }
}
