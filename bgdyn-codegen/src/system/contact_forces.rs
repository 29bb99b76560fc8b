//! The places and forces at the contacts of a scene, for drawings.

use super::SceneEquations;
use crate::function::Function;
use crate::method::SceneFunction;

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

    /// Returns a function with twelve numbers for each rigid contact: the contact point, m, and the directions x, y and
    /// normal in which its impulses are, world axes. `None` without rigid contacts.
    pub fn rigid_contact_places(&self) -> Option<Function> {
        if self.scene.layout.rigid_contacts.is_empty() {
            return None;
        }
        Some(self.one(SceneFunction::Outputs, |system, b| {
            let sums = system.effort_sums(b);
            let contacts = sums.rigid_contacts().iter();
            contacts
                .flat_map(|contact| {
                    let [x, y, normal] = contact.axes;
                    [contact.point.0, x.0, y.0, normal.0].concat()
                })
                .collect()
        }))
    }
}
