//! The places and forces at the contacts of a scene, for drawings.

use super::SceneEquations;
use crate::function::Function;
use crate::method::{ContactMethod, SceneFunction};

impl SceneEquations {
    /// Returns the elements with a compliant law at a contact, and a function with six numbers for each: the contact
    /// point, m, and the force on the sphere there, N, world axes. `None` without such elements.
    pub fn contact_forces(&self) -> Option<(Vec<String>, Function)> {
        let acting = self.scene.elements.iter();
        let rigid = &self.scene.layout.rigid_contacts;
        let names: Vec<String> = acting
            .filter(|element| element.contact().is_some() && !rigid.contains(&element.name))
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

    /// Returns a function with the frame of each rigid contact, twelve numbers: the rotation row by row, whose columns are the
    /// directions x, y and normal in which its impulses are, and the contact point, m. `None` without rigid contacts.
    pub fn rigid_contact_frames(&self) -> Option<Function> {
        if self.scene.layout.rigid_contacts.is_empty() {
            return None;
        }
        Some(self.one(SceneFunction::Outputs, |system, b| {
            let sums = system.effort_sums(b);
            let frames = sums.of_contacts(ContactMethod::Frames);
            let laws = sums.rigid_contacts().iter();
            laws.flat_map(|law| frames[12 * law.contact..][..12].to_vec())
                .collect()
        }))
    }
}
