//! The impulses of a step.

use bgdyn_runtime::{ContactMap, MOST_CONTACTS, RigidContact, Scalar as _, StateVector};

use super::ContactStep;
use super::middle::Middle;
use crate::cone::{ContactOptions, ContactOutcome, ContactProblem, solve};
use crate::failure::Reason;
use crate::integrator::Step;
use crate::ode::Ode;
use crate::real::{Of, Real};

/// Three components at a contact.
type Components<T> = [T; 3];

/// The contacts of a step and their impulses.
pub(super) struct Impulses<Y: StateVector> {
    options: ContactOptions<Of<Y>>,
    /// The contacts in the middle of the step, with the velocities at the beginning.
    pub(super) contacts: [RigidContact<Of<Y>>; MOST_CONTACTS],
    number: usize,
    /// Those whose gap would close.
    pub(super) active: [bool; MOST_CONTACTS],
    /// Their Jacobian, and B⁻¹ M⁻¹ Jᵀ.
    pub(super) maps: [Option<ContactMap<Y>>; MOST_CONTACTS],
    impulses: [Components<Of<Y>>; MOST_CONTACTS],
    outcome: Option<ContactOutcome<Of<Y>>>,
}

/// Returns a contact with all numbers 0.
pub(super) fn no_contact<T: Real>() -> RigidContact<T> {
    let zero = T::from_f64(0.0);
    RigidContact {
        gap: zero,
        velocity: [zero; 3],
        friction: zero,
        restitution: zero,
    }
}

impl<Y: StateVector> Impulses<Y>
where
    Of<Y>: Real,
{
    /// Returns the contacts in the middle of a step. The search for impulses begins at those of the step before.
    pub(super) fn new<O: Ode<State = Y>>(
        ode: &O,
        middle: &Middle<Y>,
        options: ContactOptions<Of<Y>>,
        before: Option<&Step<Y, ContactStep<Of<Y>>>>,
    ) -> Result<Self, Reason<O::Error>> {
        let number = ode.contacts();
        let mut contacts = [no_contact(); MOST_CONTACTS];
        if number > 0 {
            ode.contact_states(middle.t, &middle.y, &mut contacts[..number])
                .map_err(Reason::Singular)?;
        }
        let zero = Of::<Y>::from_f64(0.0);
        let impulses = match before {
            Some(step) => {
                let scale = middle.h / step.h;
                step.stages.impulses.map(|p| p.map(|p| scale * p))
            }
            None => [[zero; 3]; MOST_CONTACTS],
        };
        Ok(Impulses {
            options,
            contacts,
            number,
            active: [false; MOST_CONTACTS],
            maps: [const { None }; MOST_CONTACTS],
            impulses,
            outcome: None,
        })
    }

    /// Makes the maps anew, since B changed.
    pub(super) fn forget_maps(&mut self) {
        self.maps = [const { None }; MOST_CONTACTS];
    }

    /// Returns velocities with the impulses that their contacts then need.
    pub(super) fn pushed<O: Ode<State = Y>>(
        &mut self,
        ode: &O,
        middle: &Middle<Y>,
        free: &Y,
    ) -> Result<Y, Reason<O::Error>> {
        if self.number == 0 {
            return Ok(free.clone());
        }
        self.find_active(ode, middle, free)?;
        let mut at = [0; MOST_CONTACTS];
        let mut n = 0;
        for c in (0..self.number).filter(|&c| self.active[c]) {
            at[n] = c;
            n += 1;
        }
        if n == 0 {
            return Ok(free.clone());
        }
        if self.maps[at[0]].is_none() {
            self.make_maps(ode, middle)?;
        }
        match n {
            1 => self.solve::<1>(middle, free, &at[..n]),
            2..=4 => self.solve::<4>(middle, free, &at[..n]),
            5..=8 => self.solve::<8>(middle, free, &at[..n]),
            9..=16 => self.solve::<16>(middle, free, &at[..n]),
            _ => self.solve::<MOST_CONTACTS>(middle, free, &at[..n]),
        }
        let mut end = free.clone();
        for &c in &at[..n] {
            if let Some(map) = &self.maps[c] {
                for (column, &p) in map.columns.iter().zip(&self.impulses[c]) {
                    end.add(p, column);
                }
            }
        }
        Ok(end)
    }

    /// Finds the contacts whose gap would be closed at the end of the step. A contact stays active in its step.
    fn find_active<O: Ode<State = Y>>(
        &mut self,
        ode: &O,
        middle: &Middle<Y>,
        free: &Y,
    ) -> Result<(), Reason<O::Error>> {
        let mut ahead = [no_contact(); MOST_CONTACTS];
        ode.contact_states(middle.t, free, &mut ahead[..self.number])
            .map_err(Reason::Singular)?;
        let half = middle.h * Of::<Y>::from_f64(0.5);
        for (active, contact) in self.active.iter_mut().zip(&ahead[..self.number]) {
            let closes = contact.gap + half * contact.velocity[2] <= Of::<Y>::from_f64(0.0);
            *active = *active || closes;
        }
        Ok(())
    }

    fn make_maps<O: Ode<State = Y>>(
        &mut self,
        ode: &O,
        middle: &Middle<Y>,
    ) -> Result<(), Reason<O::Error>> {
        ode.contact_maps(middle.t, &middle.y, &mut self.maps[..self.number])
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

    /// Solves for the impulses of the contacts `at`, of which there are at most K.
    fn solve<const K: usize>(&mut self, middle: &Middle<Y>, free: &Y, at: &[usize]) {
        let zero = Of::<Y>::from_f64(0.0);
        let mut delassus = [[[[zero; 3]; 3]; K]; K];
        let mut velocities = [[zero; 3]; K];
        let (mut friction, mut active) = ([zero; K], [false; K]);
        let mut impulses = [[zero; 3]; K];
        let gained = free.plus(-Of::<Y>::from_f64(1.0), &middle.y);
        for (i, &c) in at.iter().enumerate() {
            let (Some(map), contact) = (&self.maps[c], &self.contacts[c]) else {
                continue;
            };
            let gain = core::array::from_fn(|k| self.dot(middle, &map.rows[k], &gained));
            velocities[i] = sum(&contact.velocity, &gain);
            velocities[i][2] = velocities[i][2] + contact.restitution * contact.velocity[2];
            (friction[i], active[i]) = (contact.friction, true);
            impulses[i] = self.impulses[c];
            for (j, &d) in at.iter().enumerate() {
                if let Some(other) = &self.maps[d] {
                    delassus[i][j] = core::array::from_fn(|k| {
                        let row = &map.rows[k];
                        core::array::from_fn(|l| self.dot(middle, row, &other.columns[l]))
                    });
                }
            }
        }
        if middle.is_linearised() {
            symmetrise(&mut delassus, &impulses, &mut velocities);
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

    /// Returns the scalar product of the velocities.
    fn dot(&self, middle: &Middle<Y>, a: &Y, b: &Y) -> Of<Y> {
        let n = middle.positions;
        let products = a.entries()[n..].iter().zip(&b.entries()[n..]);
        products.fold(Of::<Y>::from_f64(0.0), |sum, (&a, &b)| a.mul_add(b, sum))
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
            let (p, before) = (self.impulses[c], self.contacts[c].velocity);
            let work = (0..3).fold(zero, |work, k| {
                let gain = self.dot(middle, &map.rows[k], &gained);
                work + p[k] * (before[k] + half * gain)
            });
            (step.impulses[c], step.losses[c]) = (p, -work);
        }
        step
    }
}

/// Replaces G by its symmetric part. The other part, small and due to gyroscopic terms, acts with the last impulses: the
/// iteration ends where both are the same.
fn symmetrise<T: Real, const K: usize>(
    delassus: &mut [[[[T; 3]; 3]; K]; K],
    impulses: &[[T; 3]; K],
    velocities: &mut [[T; 3]; K],
) {
    let half = T::from_f64(0.5);
    let all = *delassus;
    for (c, velocity) in velocities.iter_mut().enumerate() {
        for (d, p) in impulses.iter().enumerate() {
            for (i, sum) in velocity.iter_mut().enumerate() {
                for (j, &p) in p.iter().enumerate() {
                    let (own, other) = (all[c][d][i][j], all[d][c][j][i]);
                    delassus[c][d][i][j] = half * (own + other);
                    *sum = *sum + half * (own - other) * p;
                }
            }
        }
    }
}

fn sum<T: Real>(a: &Components<T>, b: &Components<T>) -> Components<T> {
    core::array::from_fn(|k| a[k] + b[k])
}
