//! Methods of the contacts of a mechanism: gaps, frames, and what impulses and forces at contacts do.
//!
//! Each contact has the axes x, y, n and the contact point c: n is the unit normal from the partner to the sphere, x and y
//! are those of the plane, or of two spheres an orthonormal pair that follows from n. γ is the velocity of the sphere's
//! link at c less that of the partner's, along x, y and n; its last component is the rate of the gap. A method has the
//! components of all contacts, contact after contact, in the order of the file.

use super::{Argument, Entries, Shape};

/// The directions of a contact.
pub const CONTACT_DIRECTIONS: usize = 3;

/// A method of the contacts of a mechanism, with their number K.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum ContactMethod {
    /// The distances of the surfaces, negative where they overlap.
    Gaps(usize),
    /// Axes and contact points.
    Frames(usize),
    /// γ.
    Velocity(usize),
    /// J: γ = J v.
    Jacobian(usize),
    /// J̇ v: γ̇ where the accelerations are zero.
    Bias(usize),
    /// G = J M⁻¹ Jᵀ.
    Delassus(usize),
    /// M⁻¹ Jᵀ.
    Response(usize),
}

impl ContactMethod {
    /// Returns all of them, for this number of contacts.
    pub fn all(contacts: usize) -> [ContactMethod; 7] {
        [
            ContactMethod::Gaps(contacts),
            ContactMethod::Frames(contacts),
            ContactMethod::Velocity(contacts),
            ContactMethod::Jacobian(contacts),
            ContactMethod::Bias(contacts),
            ContactMethod::Delassus(contacts),
            ContactMethod::Response(contacts),
        ]
    }

    /// Returns the number of contacts.
    pub fn contacts(self) -> usize {
        match self {
            ContactMethod::Gaps(contacts)
            | ContactMethod::Frames(contacts)
            | ContactMethod::Velocity(contacts)
            | ContactMethod::Jacobian(contacts)
            | ContactMethod::Bias(contacts)
            | ContactMethod::Delassus(contacts)
            | ContactMethod::Response(contacts) => contacts,
        }
    }

    /// Returns whether it contains the mass matrix.
    pub fn is_dynamic(self) -> bool {
        matches!(
            self,
            ContactMethod::Delassus(_) | ContactMethod::Response(_)
        )
    }

    /// Returns its name.
    pub fn name(self) -> &'static str {
        match self {
            ContactMethod::Gaps(_) => "contact_gaps",
            ContactMethod::Frames(_) => "contact_frames",
            ContactMethod::Velocity(_) => "contact_velocity",
            ContactMethod::Jacobian(_) => "contact_jacobian",
            ContactMethod::Bias(_) => "contact_bias",
            ContactMethod::Delassus(_) => "contact_delassus",
            ContactMethod::Response(_) => "contact_response",
        }
    }

    pub(super) fn arguments(self) -> &'static [Argument] {
        match self {
            ContactMethod::Velocity(_) | ContactMethod::Bias(_) => &[Argument::Q, Argument::V],
            _ => &[Argument::Q],
        }
    }

    pub(super) fn shape(self) -> Shape {
        let rows = CONTACT_DIRECTIONS * self.contacts();
        match self {
            ContactMethod::Gaps(contacts) => Shape::Numbers(contacts),
            ContactMethod::Frames(contacts) => Shape::Poses(contacts),
            ContactMethod::Velocity(_) | ContactMethod::Bias(_) => Shape::Numbers(rows),
            ContactMethod::Jacobian(_) => Shape::Rows(rows),
            ContactMethod::Delassus(_) => Shape::Checked(Entries::Symmetric(rows)),
            ContactMethod::Response(_) => Shape::Checked(Entries::Columns(rows)),
        }
    }

    /// Describes the result: one line of documentation.
    pub(super) fn summary(self) -> &'static str {
        match self {
            ContactMethod::Gaps(_) => {
                "Gaps of the contacts, as in [`CONTACT_NAMES`]: the distance of both surfaces, negative where they overlap."
            }
            ContactMethod::Frames(_) => {
                "Frames of the contacts, as in [`CONTACT_NAMES`]: the contact point, and as columns the directions x, y and the normal from the partner to the sphere; world axes."
            }
            ContactMethod::Velocity(_) => {
                "Velocities γ at the contacts, as in [`CONTACT_NAMES`]: of the sphere's link less that of its partner at the contact point, along x, y and the normal of each; the last one is the rate of the gap."
            }
            ContactMethod::Jacobian(_) => {
                "Jacobian J of the contacts, as in [`CONTACT_NAMES`]: their velocities are J v; rows along x, y and the normal of each."
            }
            ContactMethod::Bias(_) => {
                "J̇ v of the contacts, as in [`CONTACT_NAMES`]: the rate of their velocities where the joints' accelerations are zero; points and directions move along."
            }
            ContactMethod::Delassus(_) => {
                "Delassus matrix G = J M⁻¹ Jᵀ of the contacts, as in [`CONTACT_NAMES`], exactly symmetric: their velocities by impulses at them, along x, y and the normal of each."
            }
            ContactMethod::Response(_) => {
                "M⁻¹ Jᵀ of the contacts, as in [`CONTACT_NAMES`]: velocities of the joints by impulses at the contacts, along x, y and the normal of each."
            }
        }
    }

    /// Returns the units of the result.
    pub(super) fn units(self) -> &'static str {
        match self {
            ContactMethod::Gaps(_) => "m",
            ContactMethod::Frames(_) => {
                "m; columns of the rotation are the contact's axes in the world's"
            }
            ContactMethod::Velocity(_) => "m/s",
            ContactMethod::Jacobian(_) => "m per unit of each joint",
            ContactMethod::Bias(_) => "m/s²",
            ContactMethod::Delassus(_) => "1/kg",
            ContactMethod::Response(_) => "velocities of the joints per N·s",
        }
    }
}
