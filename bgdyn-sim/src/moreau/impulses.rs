//! The impulses of a step.

use bgdyn_runtime::{ContactMap, MOST_CONTACTS, RigidContact, Scalar as _, StateVector};

use super::middle::Middle;
use crate::cone::{ContactOptions, ContactOutcome, ContactProblem, improve, solve};
use crate::contact_step::ContactStep;
use crate::contacts_at::{dot, products, write_contacts};
use crate::failure::Reason;
use crate::ode::Ode;
use crate::real::{Of, Real};

/// The effort for impulses while the velocities still change by more than √ε: how many sweeps and Newton steps at the most, and
/// the factor of the tolerance. Contacts that hold each other have no impulses at which all stick if the velocities do not
/// agree, and the search goes on for long.
const ROUGH_SWEEPS: usize = 24;
const ROUGH_NEWTON_STEPS: usize = 10;
const ROUGH_TOLERANCE: f64 = 64.0;

/// Three components at a contact.
type Components<T> = [T; 3];

/// The impulses of all contacts.
type AllImpulses<T> = [Components<T>; MOST_CONTACTS];

/// The contacts of a step and their impulses.
pub(super) struct Impulses<'m, Y: StateVector> {
    options: ContactOptions<Of<Y>>,
    number: usize,
    /// The contacts at the beginning of the step, and in its middle with the velocities of the beginning.
    pub(super) before: Contacts<Of<Y>>,
    middle: Contacts<Of<Y>>,
    /// The contacts at the end of the step, with the last velocities.
    ahead: Contacts<Of<Y>>,
    /// Those whose gap would close.
    pub(super) active: [bool; MOST_CONTACTS],
    /// Those that approach by less than forces add in the step: after a bounce they would touch again within it. They do
    /// not bounce, but close what is left of their gap.
    pub(super) slow: [bool; MOST_CONTACTS],
    /// Their Jacobian, and M⁻¹ Jᵀ, in the middle; B⁻¹ M⁻¹ Jᵀ of the contacts that are `implicit`.
    pub(super) maps: &'m mut [Option<ContactMap<Y>>],
    implicit: [bool; MOST_CONTACTS],
    impulses: AllImpulses<Of<Y>>,
    /// Whether the first impulses are those of a step without an impact.
    continues: bool,
    /// Whether the impulses are sought with little effort, while the velocities still change.
    rough: bool,
    /// Whether the velocities γ⁺ are linear in the impulses, with G in the middle of the step.
    linear: bool,
    outcome: Option<ContactOutcome<Of<Y>>>,
}

/// The contacts of an equation in a state; those after its own ones are zero.
pub(super) type Contacts<T> = [RigidContact<T>; MOST_CONTACTS];

impl<'m, Y: StateVector> Impulses<'m, Y>
where
    Of<Y>: Real,
{
    /// Returns the impulses of a step, of as many contacts as there are `maps`, `before` it and in its `middle`. The search
    /// for them begins at those of the last step, times a factor; it `continues` a step without an impact.
    pub(super) fn new(
        options: ContactOptions<Of<Y>>,
        maps: &'m mut [Option<ContactMap<Y>>],
        (before, middle): (Contacts<Of<Y>>, Contacts<Of<Y>>),
        last: Option<(AllImpulses<Of<Y>>, Of<Y>)>,
        continues: bool,
    ) -> Self {
        let zero = Of::<Y>::from_f64(0.0);
        let impulses = match last {
            Some((impulses, scale)) => impulses.map(|p| p.map(|p| scale * p)),
            None => [[zero; 3]; MOST_CONTACTS],
        };
        Impulses {
            options,
            number: maps.len(),
            before,
            middle,
            ahead: before,
            active: [false; MOST_CONTACTS],
            slow: [false; MOST_CONTACTS],
            maps,
            implicit: [false; MOST_CONTACTS],
            impulses,
            continues,
            rough: true,
            linear: false,
            outcome: None,
        }
    }

    /// Says whether the next impulses are sought with little effort.
    pub(super) fn set_rough(&mut self, rough: bool) {
        self.rough = rough;
    }

    /// Returns whether the last impulses meet the tolerance.
    pub(super) fn is_solved(&self) -> bool {
        self.outcome.is_none_or(|outcome| outcome.solved)
    }

    /// Makes the velocities γ⁺ linear from now on: J v⁺ in the middle, as in the scheme of Jean. With the axes
    /// at the end, which the impulses turn, those of contacts that jam may jump to and fro.
    pub(super) fn make_velocities_linear(&mut self) {
        self.linear = true;
    }

    /// Returns whether no contact bounces.
    pub(super) fn are_slow(&self) -> bool {
        let mut contacts = self.active.iter().zip(&self.slow);
        contacts.all(|(&active, &slow)| slow || !active)
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
    /// linearised with J in the middle: γ⁺ = γ⁺(p₀) + G (p − p₀) for the last impulses p₀, at first for those of the step
    /// before without an impact.
    pub(super) fn pushed<O: Ode<State = Y>>(
        &mut self,
        ode: &O,
        middle: &Middle<'_, Y>,
        free: &Y,
    ) -> Result<Y, Reason<O::Error>> {
        if self.number == 0 {
            return Ok(free.clone());
        }
        let first = self.outcome.is_none();
        let mut without = first || self.linear;
        let known = if without {
            free.clone()
        } else {
            self.with_impulses(free)
        };
        self.look_ahead(ode, middle, &known)?;
        self.find_active(first);
        if first {
            self.find_slow();
        }
        let (at, n) = listed(&self.active);
        if n == 0 {
            return Ok(known);
        }
        if self.maps[at[0]].is_none() {
            self.make_maps(ode, middle)?;
        }
        self.make_implicit(middle, &at[..n]);
        if first && self.continues {
            self.look_ahead(ode, middle, &self.with_impulses(free))?;
            without = false;
        }
        if self.linear {
            let gained = free.plus(-Of::<Y>::from_f64(1.0), &middle.y);
            for &c in &at[..n] {
                self.ahead[c].velocity = self.after(c, middle, &gained);
            }
        }
        let given = (middle, without);
        match n {
            1 => self.solve::<1>(given, &at[..n]),
            2..=4 => self.solve::<4>(given, &at[..n]),
            5..=8 => self.solve::<8>(given, &at[..n]),
            9..=16 => self.solve::<16>(given, &at[..n]),
            _ => self.solve::<MOST_CONTACTS>(given, &at[..n]),
        }
        Ok(self.with_impulses(free))
    }

    /// Finds the contacts at the end of the step with these velocities.
    fn look_ahead<O: Ode<State = Y>>(
        &mut self,
        ode: &O,
        middle: &Middle<'_, Y>,
        velocities: &Y,
    ) -> Result<(), Reason<O::Error>> {
        let mut end = velocities.clone();
        middle.advance(ode, &mut end)?;
        write_contacts(ode, middle.end(), &end, &mut self.ahead).map_err(Reason::Singular)
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
    /// is found later begins without an impulse, as velocities are without it.
    fn find_active(&mut self, first: bool) {
        let zero = Of::<Y>::from_f64(0.0);
        let ahead = &self.ahead[..self.number];
        for (c, _) in ahead.iter().enumerate().filter(|at| at.1.gap <= zero) {
            if !first && !self.active[c] {
                self.impulses[c] = [zero; 3];
            }
            self.active[c] = true;
        }
    }

    /// Finds the contacts that approach by less than forces add in the step, which `ahead` are without impulses.
    fn find_slow(&mut self) {
        for (c, slow) in self.slow.iter_mut().enumerate() {
            let approach = self.before[c].velocity[2];
            *slow = approach.abs() <= (self.ahead[c].velocity[2] - approach).abs();
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

    /// Makes the maps anew, since B changed.
    pub(super) fn remake_maps<O: Ode<State = Y>>(
        &mut self,
        ode: &O,
        middle: &Middle<'_, Y>,
    ) -> Result<(), Reason<O::Error>> {
        if self.maps.iter().any(Option::is_some) {
            self.make_maps(ode, middle)?;
            let (at, n) = listed(&self.active);
            self.make_implicit(middle, &at[..n]);
        }
        Ok(())
    }

    fn make_maps<O: Ode<State = Y>>(
        &mut self,
        ode: &O,
        middle: &Middle<'_, Y>,
    ) -> Result<(), Reason<O::Error>> {
        ode.rigid_contact_maps(middle.t, &middle.y, self.maps)
            .map_err(Reason::Singular)?;
        self.implicit = [false; MOST_CONTACTS];
        Ok(())
    }

    /// Turns M⁻¹ Jᵀ of the contacts `at` into B⁻¹ M⁻¹ Jᵀ.
    fn make_implicit(&mut self, middle: &Middle<'_, Y>, at: &[usize]) {
        for &c in at {
            if let (false, Some(map)) = (self.implicit[c], &mut self.maps[c]) {
                map.columns
                    .iter_mut()
                    .for_each(|column| middle.solve(column));
                self.implicit[c] = true;
            }
        }
    }

    /// Solves for the impulses of the contacts `at`, of which there are at most K. Those ahead have the last impulses, or are
    /// `without` impulses.
    fn solve<const K: usize>(&mut self, (middle, without): (&Middle<'_, Y>, bool), at: &[usize]) {
        let zero = Of::<Y>::from_f64(0.0);
        let delassus = self.delassus::<K>(middle.positions, at);
        let mut velocities = [[zero; 3]; K];
        let (mut friction, mut active) = ([zero; K], [false; K]);
        let mut impulses = [[zero; 3]; K];
        for (i, &c) in at.iter().enumerate() {
            velocities[i] = self.ahead[c].velocity;
            velocities[i][2] = velocities[i][2] + self.returned(c, middle.h);
            (friction[i], active[i]) = (self.before[c].friction, true);
            impulses[i] = self.impulses[c];
        }
        if !without {
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
        let mut outcome = match self.rough {
            true => improve(&problem, &rough(&self.options), &mut impulses),
            false => solve(&problem, &self.options, &mut impulses),
        };
        let bound = self.options.tolerance * problem.largest(&impulses);
        outcome.solved = outcome.residual <= bound;
        self.outcome = Some(outcome);
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
                let block = products(positions, &map.rows, &other.columns);
                for (k, row) in block.iter().enumerate() {
                    for (l, &product) in row.iter().enumerate() {
                        let part = half * product;
                        all[i][j][k][l] = all[i][j][k][l] + part;
                        all[j][i][l][k] = all[j][i][l][k] + part;
                    }
                }
            }
        }
        all
    }

    /// Returns the velocity of a contact with J in the middle, where the velocities have `gained` so much in the step.
    fn after(&self, c: usize, middle: &Middle<'_, Y>, gained: &Y) -> Components<Of<Y>> {
        let mut velocity = self.middle[c].velocity;
        if let Some(map) = &self.maps[c] {
            for (velocity, row) in velocity.iter_mut().zip(&map.rows) {
                *velocity = *velocity + dot(middle.positions, row, gained);
            }
        }
        velocity
    }

    /// Returns impulses and losses, with the velocities at the end.
    pub(super) fn result(&self, middle: &Middle<'_, Y>, end: &Y) -> ContactStep<Of<Y>> {
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
            let (p, before) = (self.impulses[c], self.middle[c].velocity);
            let after = self.after(c, middle, &gained);
            let work = (0..3).fold(zero, |work, k| work + p[k] * half * (before[k] + after[k]));
            (step.impulses[c], step.losses[c]) = (p, -work);
        }
        step
    }
}

/// Returns options with a small part of the effort.
fn rough<T: Real>(options: &ContactOptions<T>) -> ContactOptions<T> {
    ContactOptions {
        tolerance: options.tolerance * T::from_f64(ROUGH_TOLERANCE),
        most_sweeps: options.most_sweeps.min(ROUGH_SWEEPS),
        most_newton_steps: options.most_newton_steps.min(ROUGH_NEWTON_STEPS),
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
