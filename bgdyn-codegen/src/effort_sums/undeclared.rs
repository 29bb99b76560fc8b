//! Looks up parts by name in a law; panics if the name is not declared, an error of the law's author.

use super::EffortSums;
use crate::declaration::{Element, undeclared};
use crate::scene::Variable;

impl EffortSums<'_, '_> {
    /// Returns the element whose law runs.
    pub(super) fn element_at_work(&self) -> &Element {
        &self.scene.elements[self.at]
    }

    /// Returns the index of the part with this name among the scene's states, modes, inputs or events;
    /// `kind` is the word for one of them.
    pub(super) fn part(&self, kind: &str, parts: &[Variable], name: &str) -> usize {
        let found = parts.iter().position(|part| part.name == name);
        found.unwrap_or_else(|| undeclared(self.element_at_work(), kind, name))
    }

    /// Returns the index of the coordinate with this name.
    pub(super) fn coordinate_index(&self, name: &str) -> usize {
        let found = self.scene.layout.coordinate_named(name);
        found.unwrap_or_else(|| undeclared(self.element_at_work(), "coordinate", name))
    }
}
