//! The functions of rigid contacts, and the check of their gaps at the start.

use super::holds::StuckJoints;
use super::{EffortSums, SceneEquations};
use crate::expr::{Builder, Expr};
use crate::fault::{Faults, wording};
use crate::formulation;

/// An overlap at the start below this, m, is no fault: that of decimals in the file.
const LEAST_OVERLAP: f64 = 1e-9;

/// Returns for each rigid contact gap, velocity along (x, y, normal), friction, restitution.
pub(super) fn states<'g>(system: &SceneEquations, b: &'g Builder) -> Vec<Expr<'g>> {
    let sums = system.effort_sums(b);
    let contacts = sums.rigid_contacts().iter();
    contacts
        .flat_map(|contact| {
            let [x, y, normal] = contact.velocity;
            [
                contact.gap,
                x,
                y,
                normal,
                contact.friction,
                contact.restitution,
            ]
        })
        .collect()
}

/// Returns for each rigid contact the three rows of its Jacobian J, then the three columns of M⁻¹ Jᵀ, for the
/// velocities. Contacts move no coordinate that has a store of its own.
pub(super) fn maps<'g>(system: &SceneEquations, b: &'g Builder) -> Vec<Expr<'g>> {
    let sums = system.effort_sums(b);
    let n = system.graph.coordinates.len();
    let mass = StuckJoints::new(&sums);
    // The factors of M are the same expressions for every column, and computed once.
    let column = |row: &Vec<Expr<'g>>| {
        let triangle = (0..n).map(|i| (0..=i).map(|j| mass.entry(i, j)).collect());
        formulation::solve_symmetric(b, triangle.collect(), row.clone())
    };
    let nv = system.scene.layout.nv();
    let padded = |of_links: Vec<Expr<'g>>| {
        let others = (of_links.len()..nv).map(|_| b.zero());
        of_links.into_iter().chain(others).collect::<Vec<_>>()
    };
    let mut all = Vec::new();
    for contact in sums.rigid_contacts() {
        for row in &contact.rows {
            all.extend(padded(row.clone()));
        }
        for row in &contact.rows {
            all.extend(padded(column(row)));
        }
    }
    all
}

/// Reports contacts that overlap at the start.
pub(super) fn check_start(system: &SceneEquations, sums: &EffortSums<'_, '_>, faults: &mut Faults) {
    for contact in sums.rigid_contacts() {
        let gap = sums.at_start(contact.gap, &system.initial).to_f64();
        if gap < -LEAST_OVERLAP {
            let element = &system.scene.elements[contact.element];
            let name = element.contact().unwrap_or_default();
            let fault = wording::rigid_contact_overlaps(&element.location, name, -gap);
            faults.push(fault);
        }
    }
}
