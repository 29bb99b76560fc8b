//! The functions of rigid contacts, and the check of their gaps at the start.

use super::{EffortSums, SceneEquations};
use crate::expr::{Builder, Expr};
use crate::fault::{Faults, wording};
use crate::method::{CONTACT_DIRECTIONS, ContactMethod};

/// An overlap at the start below this, m, is no fault: that of decimals in the file.
const LEAST_OVERLAP: f64 = 1e-9;

/// Returns for each rigid contact gap, velocity along (x, y, normal), friction, restitution.
pub(super) fn states<'g>(system: &SceneEquations, b: &'g Builder) -> Vec<Expr<'g>> {
    let sums = system.effort_sums(b);
    let gaps = sums.of_contacts(ContactMethod::Gaps);
    let velocities = sums.of_contacts(ContactMethod::Velocity);
    let mut all = Vec::new();
    for law in sums.rigid_contacts() {
        all.push(gaps[law.contact]);
        all.extend(&velocities[directions(law.contact)]);
        all.extend([law.friction, law.restitution]);
    }
    all
}

/// Returns for each rigid contact the three rows of its Jacobian J, then the three columns of M⁻¹ Jᵀ, for the
/// velocities. Contacts move no coordinate that has a store of its own.
pub(super) fn maps<'g>(system: &SceneEquations, b: &'g Builder) -> Vec<Expr<'g>> {
    let sums = system.effort_sums(b);
    let (n, nv) = (system.graph.coordinates.len(), system.scene.layout.nv());
    let jacobian = sums.of_contacts(ContactMethod::Jacobian);
    // As many numbers as there are coordinates come before the matrix.
    let response = sums.of_contacts(ContactMethod::Response).split_off(n);
    let width = jacobian.len() / n;
    let mut all = Vec::new();
    let mut add = |of_links: &mut dyn Iterator<Item = Expr<'g>>| {
        all.extend(of_links);
        all.extend((n..nv).map(|_| b.zero()));
    };
    for law in sums.rigid_contacts() {
        for r in directions(law.contact) {
            add(&mut jacobian[r * n..(r + 1) * n].iter().copied());
        }
        for r in directions(law.contact) {
            add(&mut (0..n).map(|j| response[j * width + r]));
        }
    }
    all
}

/// Returns for each rigid contact γ̇ at v̇ = 0 along (x, y, normal): J̇ v, and the motion of what is prescribed.
pub(super) fn biases<'g>(system: &SceneEquations, b: &'g Builder) -> Vec<Expr<'g>> {
    let sums = system.effort_sums(b);
    let biases = sums.of_contacts(ContactMethod::Bias);
    let laws = sums.rigid_contacts().iter();
    laws.flat_map(|law| biases[directions(law.contact)].to_vec())
        .collect()
}

/// Returns the rows of a contact in the methods of contacts.
pub(super) fn directions(contact: usize) -> std::ops::Range<usize> {
    let first = CONTACT_DIRECTIONS * contact;
    first..first + CONTACT_DIRECTIONS
}

/// Reports contacts that overlap at the start.
pub(super) fn check_start(system: &SceneEquations, sums: &EffortSums<'_, '_>, faults: &mut Faults) {
    let gaps = sums.of_contacts(ContactMethod::Gaps);
    for law in sums.rigid_contacts() {
        let gap = sums.at_start(gaps[law.contact], &system.initial).to_f64();
        if gap < -LEAST_OVERLAP {
            let element = &system.scene.elements[law.element];
            let name = element.contact().unwrap_or_default();
            let fault = wording::rigid_contact_overlaps(&element.location, name, -gap);
            faults.push(fault);
        }
    }
}
