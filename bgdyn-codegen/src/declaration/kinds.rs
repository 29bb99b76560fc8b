//! The list of all kinds of effects, an argument of the checks.

use super::EffectKind;

/// All kinds of effects.
#[derive(Clone, Debug)]
pub struct EffectKinds(Vec<&'static dyn EffectKind>);

impl EffectKinds {
    /// Returns a list of these kinds.
    pub fn new(all: impl IntoIterator<Item = &'static dyn EffectKind>) -> Self {
        EffectKinds(all.into_iter().collect())
    }

    /// Returns all kinds, in the order of the list.
    pub fn iter(&self) -> impl Iterator<Item = &'static dyn EffectKind> {
        self.0.iter().copied()
    }

    /// Returns the kind with this keyword.
    pub fn named(&self, keyword: &str) -> Option<&'static dyn EffectKind> {
        self.iter().find(|kind| kind.keyword() == keyword)
    }
}
