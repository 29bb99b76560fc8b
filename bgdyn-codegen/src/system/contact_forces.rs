//! The forces at the contacts of a scene, for drawings.

use super::SceneEquations;
use crate::function::Function;
use crate::method::SceneFunction;

impl SceneEquations {
    /// Returns the elements that act at contacts, and a function with six numbers for each: the contact point, m, and the
    /// force on the sphere there, N, world axes. `None` without such elements.
    pub fn contact_forces(&self) -> Option<(Vec<String>, Function)> {
        let acting = self.scene.elements.iter();
        let names: Vec<String> = acting
            .filter(|element| element.contact().is_some())
            .map(|element| element.name.clone())
            .collect();
        if names.is_empty() {
            return None;
        }
        let function = self.one(SceneFunction::Outputs, |system, b| {
            let sums = system.effort_sums(b);
            let forces = sums.contact_forces().iter();
            forces
                .flat_map(|(point, force)| [point.0, force.0].concat())
                .collect()
        });
        Some((names, function))
    }
}
