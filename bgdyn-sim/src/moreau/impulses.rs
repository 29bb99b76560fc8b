//! The impulses of a step.

use bgdyn_runtime::{ContactMap, MOST_CONTACTS, RigidContact, Scalar as _, StateVector};

use super::middle::Middle;
use crate::cone::{ContactOptions, ContactOutcome, ContactProblem, solve};
use crate::contact_step::ContactStep;
use crate::contacts_at::{contacts_at, dot};
use crate::failure::Reason;
use crate::integrator::Start;
use crate::ode::Ode;
use crate::real::{Of, Real};

/// Three components at a contact.
type Components<T> = [T; 3];

/// The contacts of a step and their impulses.
pub(super) struct Impulses<Y: StateVector> {
    options: ContactOptions<Of<Y>>,
    number: usize,
    /// The contacts at the beginning of the step, and in its middle with the velocities of the beginning.
    pub(super) before: Contacts<Of<Y>>,
    middle: Contacts<Of<Y>>,
    /// Those whose gap would close.
    pub(super) active: [bool; MOST_CONTACTS],
    /// Those that approach by less than forces add in the step: after a bounce they would touch again within it. They do
    /// not bounce, but close what is left of their gap.
    pub(super) slow: [bool; MOST_CONTACTS],
    /// Their Jacobian, and B⁻¹ M⁻¹ Jᵀ, in the middle.
    pub(super) maps: [Option<ContactMap<Y>>; MOST_CONTACTS],
    impulses: [Components<Of<Y>>; MOST_CONTACTS],
    outcome: Option<ContactOutcome<Of<Y>>>,
}

/// The contacts of an equation in a state; those after its own ones are zero.
pub(super) type Contacts<T> = [RigidContact<T>; MOST_CONTACTS];

impl<Y: StateVector> Impulses<Y>
where
    Of<Y>: Real,
{
    /// Returns the contacts of a step from a state. The search for impulses begins at those of the step before.
    pub(super) fn new<O: Ode<State = Y>>(
        ode: &O,
        (from, middle): (&Start<'_, Y, ContactStep<Of<Y>>>, &Middle<Y>),
        options: ContactOptions<Of<Y>>,
    ) -> Result<Self, Reason<O::Error>> {
        let number = ode.rigid_contacts();
        let zero = Of::<Y>::from_f64(0.0);
        let impulses = match from.before {
            Some(step) => {
                let scale = middle.h / step.h;
                step.stages.impulses.map(|p| p.map(|p| scale * p))
            }
            None => [[zero; 3]; MOST_CONTACTS],
        };
        Ok(Impulses {
            options,
            number,
            before: contacts_at(ode, from.t, from.y).map_err(Reason::Singular)?,
            middle: contacts_at(ode, middle.t, &middle.y).map_err(Reason::Singular)?,
            active: [false; MOST_CONTACTS],
            slow: [false; MOST_CONTACTS],
            maps: [const { None }; MOST_CONTACTS],
            impulses,
            outcome: None,
        })
    }

    /// Makes the maps anew, since B changed.
    pub(super) fn remake_maps<O: Ode<State = Y>>(
        &mut self,
        ode: &O,
        middle: &Middle<Y>,
    ) -> Result<(), Reason<O::Error>> {
        match self.maps.iter().any(Option::is_some) {
            true => self.make_maps(ode, middle),
            false => Ok(()),
        }
    }

    /// Marks the impulses as not solved. Returns whether there are active contacts.
    pub(super) fn give_up(&mut self) -> bool {
        if let Some(outcome) = &mut self.outcome {
            outcome.solved = false;
        }
        self.outcome.is_some()
    }

    /// Returns velocities with the impulses that their contacts then need. `free` are those without impulses.
    ///
    /// The velocities γ⁺ at the contacts are those at the end of the step, where the axes of bodies have turned on. They are
    /// linearised with J in the middle: γ⁺ = γ⁺(p₀) + G (p − p₀) for the last impulses p₀.
    pub(super) fn pushed<O: Ode<State = Y>>(
        &mut self,
        ode: &O,
        middle: &Middle<Y>,
        free: &Y,
    ) -> Result<Y, Reason<O::Error>> {
        if self.number == 0 {
            return Ok(free.clone());
        }
        let first = self.outcome.is_none();
        let known = if first {
            free.clone()
        } else {
            self.with_impulses(free)
        };
        let mut end = known.clone();
        middle.advance(ode, &mut end)?;
        let ahead = contacts_at(ode, middle.end(), &end).map_err(Reason::Singular)?;
        self.find_active(&ahead, first);
        if first {
            for (c, slow) in self.slow.iter_mut().enumerate() {
                let approach = self.before[c].velocity[2];
                *slow = approach.abs() <= (ahead[c].velocity[2] - approach).abs();
            }
        }
        let (at, n) = listed(&self.active);
        if n == 0 {
            return Ok(known);
        }
        if self.maps[at[0]].is_none() {
            self.make_maps(ode, middle)?;
        }
        let given = (middle, &ahead, first);
        match n {
            1 => self.solve::<1>(given, &at[..n]),
            2..=4 => self.solve::<4>(given, &at[..n]),
            5..=8 => self.solve::<8>(given, &at[..n]),
            9..=16 => self.solve::<16>(given, &at[..n]),
            _ => self.solve::<MOST_CONTACTS>(given, &at[..n]),
        }
        Ok(self.with_impulses(free))
    }

    /// Returns velocities with the impulses of the active contacts.
    fn with_impulses(&self, free: &Y) -> Y {
        let mut end = free.clone();
        for c in (0..self.number).filter(|&c| self.active[c]) {
            if let Some(map) = &self.maps[c] {
                for (column, &p) in map.columns.iter().zip(&self.impulses[c]) {
                    end.add(p, column);
                }
            }
        }
        end
    }

    /// Finds the contacts whose gap would be closed at the end of the step. A contact stays active in its step; one that
    /// is found later begins without an impulse, as `ahead` is without it.
    fn find_active(&mut self, ahead: &Contacts<Of<Y>>, first: bool) {
        let zero = Of::<Y>::from_f64(0.0);
        for c in (0..self.number).filter(|&c| ahead[c].gap <= zero) {
            if !first && !self.active[c] {
                self.impulses[c] = [zero; 3];
            }
            self.active[c] = true;
        }
    }

    /// Returns the normal velocity that a contact needs to open again, with the opposite sign: Newton's e γ_n⁻; of a slow
    /// one the speed at which the gap in the middle closes until the end.
    fn returned(&self, c: usize, h: Of<Y>) -> Of<Y> {
        if self.slow[c] {
            let gap = self.middle[c].gap.max(Of::<Y>::from_f64(0.0));
            return gap * Of::<Y>::from_f64(2.0) / h;
        }
        self.before[c].restitution * self.before[c].velocity[2]
    }

    fn make_maps<O: Ode<State = Y>>(
        &mut self,
        ode: &O,
        middle: &Middle<Y>,
    ) -> Result<(), Reason<O::Error>> {
        ode.rigid_contact_maps(middle.t, &middle.y, &mut self.maps[..self.number])
            .map_err(Reason::Singular)?;
        for column in self
            .maps
            .iter_mut()
            .flatten()
            .flat_map(|map| &mut map.columns)
        {
            middle.solve(column);
        }
        Ok(())
    }

    /// Solves for the impulses of the contacts `at`, of which there are at most K. `ahead` are the contacts at the end of
    /// the step with the last impulses, or, the `first` time, without impulses.
    fn solve<const K: usize>(
        &mut self,
        (middle, ahead, first): (&Middle<Y>, &Contacts<Of<Y>>, bool),
        at: &[usize],
    ) {
        let zero = Of::<Y>::from_f64(0.0);
        let delassus = self.delassus::<K>(middle.positions, at);
        let mut velocities = [[zero; 3]; K];
        let (mut friction, mut active) = ([zero; K], [false; K]);
        let mut impulses = [[zero; 3]; K];
        for (i, &c) in at.iter().enumerate() {
            velocities[i] = ahead[c].velocity;
            velocities[i][2] = velocities[i][2] + self.returned(c, middle.h);
            (friction[i], active[i]) = (self.before[c].friction, true);
            impulses[i] = self.impulses[c];
        }
        if !first {
            for (c, velocity) in velocities.iter_mut().enumerate() {
                for (d, p) in impulses.iter().enumerate() {
                    for (sum, row) in velocity.iter_mut().zip(&delassus[c][d]) {
                        for (&g, &p) in row.iter().zip(p) {
                            *sum = *sum - g * p;
                        }
                    }
                }
            }
        }
        let problem = ContactProblem {
            delassus: &delassus,
            velocities: &velocities,
            friction: &friction,
            active: &active,
        };
        self.outcome = Some(solve(&problem, &self.options, &mut impulses));
        for (&c, p) in at.iter().zip(impulses) {
            self.impulses[c] = p;
        }
    }

    /// Returns the symmetric part of G = J B⁻¹ M⁻¹ Jᵀ for the contacts `at`: B has a small other one, due to gyroscopic terms.
    pub(super) fn delassus<const K: usize>(
        &self,
        positions: usize,
        at: &[usize],
    ) -> [[[[Of<Y>; 3]; 3]; K]; K] {
        let zero = Of::<Y>::from_f64(0.0);
        let half = Of::<Y>::from_f64(0.5);
        let mut all = [[[[zero; 3]; 3]; K]; K];
        for (i, &c) in at.iter().enumerate() {
            for (j, &d) in at.iter().enumerate() {
                let (Some(map), Some(other)) = (&self.maps[c], &self.maps[d]) else {
                    continue;
                };
                for (k, row) in map.rows.iter().enumerate() {
                    for (l, column) in other.columns.iter().enumerate() {
                        let part = half * dot(positions, row, column);
                        all[i][j][k][l] = all[i][j][k][l] + part;
                        all[j][i][l][k] = all[j][i][l][k] + part;
                    }
                }
            }
        }
        all
    }

    /// Returns impulses and losses, with the velocities at the end.
    pub(super) fn result(&self, middle: &Middle<Y>, end: &Y) -> ContactStep<Of<Y>> {
        let zero = Of::<Y>::from_f64(0.0);
        let mut step = ContactStep {
            impulses: [[zero; 3]; MOST_CONTACTS],
            losses: [zero; MOST_CONTACTS],
            residual: self.outcome.map_or(zero, |outcome| outcome.residual),
            solved: self.outcome.is_none_or(|outcome| outcome.solved),
            depth: zero,
        };
        let gained = end.plus(-Of::<Y>::from_f64(1.0), &middle.y);
        let half = Of::<Y>::from_f64(0.5);
        for c in (0..self.number).filter(|&c| self.active[c]) {
            let Some(map) = &self.maps[c] else { continue };
            let (p, before) = (self.impulses[c], self.middle[c].velocity);
            let work = (0..3).fold(zero, |work, k| {
                let gain = dot(middle.positions, &map.rows[k], &gained);
                work + p[k] * (before[k] + half * gain)
            });
            (step.impulses[c], step.losses[c]) = (p, -work);
        }
        step
    }
}

/// Returns the marked contacts, first ones in the list, and their number.
pub(super) fn listed(marked: &[bool; MOST_CONTACTS]) -> ([usize; MOST_CONTACTS], usize) {
    let (mut list, mut n) = ([0; MOST_CONTACTS], 0);
    for c in (0..MOST_CONTACTS).filter(|&c| marked[c]) {
        list[n] = c;
        n += 1;
    }
    (list, n)
}
