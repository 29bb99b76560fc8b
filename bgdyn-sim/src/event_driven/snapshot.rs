//! The contacts of a plant in a state: gaps, velocities, accelerations, and how they act on each other.

use bgdyn_runtime::{ContactMap, MOST_EVENT_CONTACTS, RigidContact, Scalar as _, StateVector};

use super::error::EventError;
use super::modes::{ContactMode, PerContact};
use super::system::{Constraint, Delassus, Unknowns, solved};
use crate::contacts_at::{contacts_at, dot};
use crate::plant::{FixedModes, Plant, Time};
use crate::real::{Of, Real};

/// The contacts in a state.
pub(super) struct Snapshot<Y: StateVector> {
    /// The number of contacts.
    pub(super) number: usize,
    /// Gaps, velocities and coefficients.
    pub(super) contacts: PerContact<RigidContact<Of<Y>>>,
    /// Rows of J, columns of M⁻¹ Jᵀ.
    maps: PerContact<Option<ContactMap<Y>>>,
    /// The number of positions, the first components of a state.
    positions: usize,
    /// G = J M⁻¹ Jᵀ.
    pub(super) delassus: Delassus<Of<Y>>,
}

/// Returns the gaps and velocities of the contacts.
pub(super) fn contacts_of<P: Plant>(
    plant: &P,
    t: Time<P>,
    y: &P::State,
    modes: &P::Modes,
) -> Result<PerContact<RigidContact<Time<P>>>, EventError<P::Error>> {
    let number = plant.rigid_contacts();
    if number > MOST_EVENT_CONTACTS {
        return Err(EventError::TooManyContacts { number });
    }
    contacts_at(&FixedModes { plant, modes }, t, y).map_err(EventError::Plant)
}

impl<Y: StateVector> Snapshot<Y>
where
    Of<Y>: Real,
{
    /// Returns the contacts of a plant in a state.
    pub(super) fn new<P: Plant<State = Y>>(
        plant: &P,
        t: Of<Y>,
        y: &Y,
        modes: &P::Modes,
    ) -> Result<Self, EventError<P::Error>> {
        let number = plant.rigid_contacts();
        let contacts = contacts_of(plant, t, y, modes)?;
        let mut maps = [const { None }; MOST_EVENT_CONTACTS];
        plant
            .rigid_contact_maps(t, y, modes, &mut maps[..number])
            .map_err(EventError::Plant)?;
        if let Some(contact) = maps[..number].iter().position(Option::is_none) {
            return Err(EventError::NoMap { contact });
        }
        let zero = Of::<Y>::from_f64(0.0);
        let mut snapshot = Snapshot {
            number,
            contacts,
            maps,
            positions: plant.positions(),
            delassus: [[[[zero; 3]; 3]; MOST_EVENT_CONTACTS]; MOST_EVENT_CONTACTS],
        };
        snapshot.fill_delassus();
        Ok(snapshot)
    }

    /// Computes G; it is symmetric, so half of its blocks are copied.
    fn fill_delassus(&mut self) {
        for c in 0..self.number {
            for d in 0..=c {
                let (Some(map), Some(other)) = (&self.maps[c], &self.maps[d]) else {
                    continue;
                };
                for i in 0..3 {
                    for j in 0..3 {
                        let g = dot(self.positions, &map.rows[i], &other.columns[j]);
                        self.delassus[c][d][i][j] = g;
                        self.delassus[d][c][j][i] = g;
                    }
                }
            }
        }
    }

    /// Returns J x for velocities, or accelerations, x.
    pub(super) fn along(&self, c: usize, x: &Y) -> [Of<Y>; 3] {
        match &self.maps[c] {
            Some(map) => [0, 1, 2].map(|k| dot(self.positions, &map.rows[k], x)),
            None => [Of::<Y>::from_f64(0.0); 3],
        }
    }

    /// Adds M⁻¹ Jᵀ p to velocities, or accelerations.
    pub(super) fn push(&self, y: &mut Y, impulses: &PerContact<[Of<Y>; 3]>) {
        let zero = Of::<Y>::from_f64(0.0);
        for (map, p) in self.maps.iter().zip(impulses) {
            let Some(map) = map else { continue };
            for (column, &p) in map.columns.iter().zip(p).filter(|&(_, &p)| p != zero) {
                y.add(p, column);
            }
        }
    }

    /// Returns γ = G p + b at a contact.
    pub(super) fn velocity(
        &self,
        c: usize,
        impulses: &PerContact<[Of<Y>; 3]>,
        start: [Of<Y>; 3],
    ) -> [Of<Y>; 3] {
        let mut sum = start;
        for (block, p) in self.delassus[c].iter().zip(impulses).take(self.number) {
            for (sum, row) in sum.iter_mut().zip(block) {
                for (&g, &p) in row.iter().zip(p) {
                    *sum = g.mul_add(p, *sum);
                }
            }
        }
        sum
    }

    /// Returns the forces λ of contacts in their modes, for the accelerations γ̇ = a without them: of closed contacts γ̇_n = 0, of
    /// those that stick γ̇ = 0; `Err` with the contact where slip has no forces (Painlevé).
    pub(super) fn forces(
        &self,
        modes: &PerContact<ContactMode<Of<Y>>>,
        accelerations: &PerContact<[Of<Y>; 3]>,
    ) -> Result<PerContact<[Of<Y>; 3]>, usize> {
        let [zero, one] = [0.0, 1.0].map(Of::<Y>::from_f64);
        let mut unknowns = Unknowns::new();
        for c in (0..self.number).filter(|&c| modes[c].is_closed()) {
            let a = accelerations[c];
            match modes[c].direction(self.contacts[c].velocity) {
                None => unknowns.add_all(c, a.map(|a| -a)),
                Some(d) => {
                    let friction = self.contacts[c].friction;
                    let force = [-friction * d[0], -friction * d[1], one];
                    let row = [zero, zero, one];
                    let constraint = Constraint {
                        contact: c,
                        row,
                        force,
                    };
                    let least = self.delassus[c][c][2][2] * Of::<Y>::from_f64(JAMS);
                    if constraint.product(&self.delassus, &constraint) <= least {
                        return Err(c);
                    }
                    unknowns.add(constraint, -a[2]);
                }
            }
        }
        Ok(solved(&unknowns, &self.delassus))
    }
}

/// Friction that leaves less than this part of the normal acceleration by a normal force jams: forces grow without bound.
const JAMS: f64 = 1e-6;
