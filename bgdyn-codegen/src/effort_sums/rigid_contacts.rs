//! What contacts add to the sums beside efforts: the laws of rigid ones for the integrator, the springs of compliant ones.

use super::EffortSums;
use super::parts::{ContactSpring, RigidLaw};
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
        let contact = self.contact_of(element);
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

    /// Adds the spring of a compliant contact.
    ///
    /// # Panics
    /// As [`EffortSums::touch`].
    pub fn spring_at_contact(&mut self, element: &Element, stiffness: Expr<'g>, hertz: bool) {
        let contact = self.contact_of(element);
        self.springs.push(ContactSpring {
            element: self.at,
            contact,
            stiffness,
            hertz,
        });
    }

    /// Returns the index of an element's contact.
    fn contact_of(&self, element: &Element) -> usize {
        let name = element.contact();
        let name = name.unwrap_or_else(|| undeclared(element, "value of the key", "contact"));
        let mut pairs = self.scene.mechanism.contact_pairs().iter();
        let contact = pairs.position(|pair| pair.name == name);
        contact.unwrap_or_else(|| undeclared(element, "contact", name))
    }

    /// Returns the springs of compliant contacts, in the order of the elements.
    pub fn contact_springs(&self) -> &[ContactSpring<'g>] {
        &self.springs
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
