//! Puts the positions and velocities of closed contacts right, in the metric of M.

use bgdyn_runtime::{MOST_EVENT_CONTACTS, Scalar as _, StateVector};

use super::equations::{ErrorOf, EventDriven, PlantModes, touching};
use super::error::EventError;
use super::modes::{ContactMode, PerContact};
use super::snapshot::{Snapshot, contacts_of};
use super::system::{Unknowns, solved};
use crate::motion::moved;
use crate::plant::{FixedModes, Plant, Time};
use crate::real::Real;

/// The largest number of Newton steps for the gaps.
const MOST_STEPS: usize = 4;

impl<P: Plant> EventDriven<P>
where
    Time<P>: Real,
{
    /// Projects a state: g = 0 and γ_n = 0 of closed contacts, γ = 0 of those that stick, if one is
    /// faster than what is negligible, m/s. Returns whether the state changed.
    pub(super) fn close(
        &self,
        t: Time<P>,
        y: &mut P::State,
        modes: &PlantModes<P>,
        negligible: Time<P>,
    ) -> Result<bool, ErrorOf<P>> {
        let closed = modes.contacts.map(ContactMode::is_closed);
        let moved = self.lift(t, y, &modes.plant, &closed)?;
        let contacts = contacts_of(&self.plant, t, y, &modes.plant)?;
        let off = |c: usize| {
            let all = contacts[c].velocity;
            let held = match modes.contacts[c] {
                ContactMode::Open => &all[..0],
                ContactMode::Stick => &all[..],
                ContactMode::Start(_) | ContactMode::Slip(_) => &all[2..],
            };
            held.iter().any(|v| v.abs() > negligible)
        };
        if !(0..self.plant.rigid_contacts()).any(off) {
            return Ok(moved);
        }
        let snapshot = Snapshot::new(&self.plant, t, y, &modes.plant)?;
        let impulses = held(&snapshot, &modes.contacts);
        snapshot.push(y, &impulses);
        Ok(true)
    }

    /// Moves positions so that the gaps of these contacts are 0, by Newton steps δq = M⁻¹ Jₙᵀ λ, g + Jₙ δq = 0. Returns whether
    /// they moved.
    pub(super) fn lift(
        &self,
        t: Time<P>,
        y: &mut P::State,
        modes: &P::Modes,
        closed: &PerContact<bool>,
    ) -> Result<bool, ErrorOf<P>> {
        let (zero, one) = (Time::<P>::from_f64(0.0), Time::<P>::from_f64(1.0));
        let negligible = touching(&self.plant, y) * Time::<P>::from_f64(1.0 / 16.0);
        let positions = self.plant.positions();
        for step in 0..MOST_STEPS {
            let contacts = contacts_of(&self.plant, t, y, modes)?;
            let worst = (0..MOST_EVENT_CONTACTS).filter(|&c| closed[c]);
            let worst = worst.fold(zero, |most, c| most.max(contacts[c].gap.abs()));
            if worst <= negligible {
                return Ok(step > 0);
            }
            let snapshot = Snapshot::new(&self.plant, t, y, modes)?;
            let mut unknowns = Unknowns::new();
            for c in (0..snapshot.number).filter(|&c| closed[c]) {
                unknowns.add_axis(c, 2, -contacts[c].gap);
            }
            let mut change = y.clone();
            for x in &mut change.entries_mut()[positions..] {
                *x = zero;
            }
            snapshot.push(&mut change, &solved(&unknowns, &snapshot.delassus));
            let plant = &self.plant;
            moved(&FixedModes { plant, modes }, t, &mut change, one).map_err(EventError::Plant)?;
            let lifted = &change.entries()[..positions];
            y.entries_mut()[..positions].copy_from_slice(lifted);
            plant.project(t, y, modes).map_err(EventError::Plant)?;
        }
        Ok(true)
    }
}

/// Returns the impulses that stop closed contacts along their normals, and those that stick altogether.
pub(super) fn held<Y: StateVector>(
    snapshot: &Snapshot<Y>,
    modes: &PerContact<ContactMode<Y::Scalar>>,
) -> PerContact<[Y::Scalar; 3]>
where
    Y::Scalar: Real,
{
    let mut unknowns = Unknowns::new();
    for c in 0..snapshot.number {
        let velocity = snapshot.contacts[c].velocity;
        match modes[c] {
            ContactMode::Open => {}
            ContactMode::Stick => unknowns.add_all(c, velocity.map(|v| -v)),
            ContactMode::Start(_) | ContactMode::Slip(_) => {
                unknowns.add_axis(c, 2, -velocity[2]);
            }
        }
    }
    solved(&unknowns, &snapshot.delassus)
}
