//! The list of all kinds of effects, which is passed to the checks.

use super::EffectKind;

/// Every kind of effect.
#[derive(Clone, Debug)]
pub struct EffectKinds(Vec<&'static dyn EffectKind>);

impl EffectKinds {
    /// These.
    pub fn new(all: impl IntoIterator<Item = &'static dyn EffectKind>) -> Self {
        EffectKinds(all.into_iter().collect())
    }

    /// All of them, in the order of the list.
    pub fn iter(&self) -> impl Iterator<Item = &'static dyn EffectKind> {
        self.0.iter().copied()
    }

    /// The one with this keyword.
    pub fn named(&self, keyword: &str) -> Option<&'static dyn EffectKind> {
        self.iter().find(|kind| kind.keyword() == keyword)
    }
}
