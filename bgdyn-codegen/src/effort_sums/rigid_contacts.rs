//! What rigid contacts add to the sums: nothing on the junctions, but laws for the integrator.

use super::EffortSums;
use super::parts::RigidLaw;
use crate::declaration::{Element, undeclared};
use crate::expr::Expr;
use crate::method::{CONTACT_DIRECTIONS, ContactMethod, Method};

impl<'g> EffortSums<'g, '_> {
    /// Adds a rigid contact with these coefficients of friction and restitution. Returns its gap and its velocity along (x,
    /// y, normal).
    ///
    /// # Panics
    /// If the element's effect acts at no contact, or the mechanism does not have it.
    pub fn touch(
        &mut self,
        element: &Element,
        friction: Expr<'g>,
        restitution: Expr<'g>,
    ) -> (Expr<'g>, [Expr<'g>; CONTACT_DIRECTIONS]) {
        let name = element.contact();
        let name = name.unwrap_or_else(|| undeclared(element, "value of the key", "contact"));
        let mut pairs = self.scene.mechanism.contact_pairs().iter();
        let contact = pairs.position(|pair| pair.name == name);
        let contact = contact.unwrap_or_else(|| undeclared(element, "contact", name));
        self.rigid.push(RigidLaw {
            element: self.at,
            contact,
            friction,
            restitution,
        });
        let gap = self.of_contacts(ContactMethod::Gaps)[contact];
        let velocities = self.of_contacts(ContactMethod::Velocity);
        let first = CONTACT_DIRECTIONS * contact;
        (gap, std::array::from_fn(|k| velocities[first + k]))
    }

    /// Returns the rigid contacts, in the order of the elements.
    pub fn rigid_contacts(&self) -> &[RigidLaw<'g>] {
        &self.rigid
    }

    /// Returns the results of a method of all contacts of the mechanism.
    pub(crate) fn of_contacts(&self, of: fn(usize) -> ContactMethod) -> Vec<Expr<'g>> {
        let number = self.scene.mechanism.contact_pairs().len();
        self.method(Method::Contact(of(number)))
    }
}
