//! The search for the impulses: rounds of sweeps and of Newton's method, from a start.

use super::newton::Newton;
use super::problem::{ContactOptions, ContactOutcome, ContactProblem, Vec3};
use super::projection::Steps;
use super::sweeps::Sweeps;
use crate::real::Real;

/// Sweeps between series of Newton steps.
const SWEEPS: usize = 16;
/// Sweeps after each Newton step: they find which contacts stick, slide and separate.
const SMOOTHING: usize = 2;
/// Most Newton steps of a series.
const SERIES: usize = 20;
/// Rounds whose sweeps are not relaxed. After them sweeps go every other round half of the way, which ends cycles.
const WHOLE_ROUNDS: usize = 3;
/// Shifts of the diagonal for Newton's method: the least, the first and the largest. Less makes steps of redundant contacts
/// wild, more makes all steps slow.
const SHIFTS: [f64; 3] = [1e-5, 1e-4, 1e-3];
/// Factor by which the shift grows after a step that raises the residual, and falls after one that lowers it by more than
/// this factor.
const FACTOR: f64 = 10.0;

/// A problem while it is solved.
pub(super) struct Search<'a, T, const K: usize> {
    problem: &'a ContactProblem<'a, T, K>,
    options: &'a ContactOptions<T>,
    steps: Steps<T, K>,
    /// Prepared with the first sweep.
    sweeps: Option<Sweeps<T, K>>,
    newton: Newton<T, K>,
    shift: T,
    /// The impulses with the smallest residual so far.
    best: [Vec3<T>; K],
    outcome: ContactOutcome<T>,
}

impl<'a, T: Real, const K: usize> Search<'a, T, K> {
    /// Prepares a problem.
    pub(super) fn new(
        problem: &'a ContactProblem<'a, T, K>,
        options: &'a ContactOptions<T>,
    ) -> Self {
        let zero = T::from_f64(0.0);
        Search {
            problem,
            options,
            steps: Steps::new(problem),
            sweeps: None,
            newton: Newton::new(),
            shift: T::from_f64(SHIFTS[1]),
            best: [[zero; 3]; K],
            outcome: ContactOutcome {
                residual: T::from_f64(f64::NAN),
                sweeps: 0,
                newton_steps: 0,
                solved: false,
            },
        }
    }

    /// Returns the impulses with the smallest residual, and the outcome.
    pub(super) fn end(&self) -> ([Vec3<T>; K], ContactOutcome<T>) {
        (self.best, self.outcome)
    }

    /// Searches from a start. Returns whether the problem is solved.
    pub(super) fn run(&mut self, start: &[Vec3<T>; K]) -> bool {
        let most_sweeps = self.outcome.sweeps.saturating_add(self.options.most_sweeps);
        let most_steps = self
            .outcome
            .newton_steps
            .saturating_add(self.options.most_newton_steps);
        self.shift = T::from_f64(SHIFTS[1]);
        let mut p = *start;
        if self.problem.is_separate() {
            // One sweep is exact.
            self.sweep(&mut p, 1, most_sweeps, 1.0);
        }
        let mut residual = self.keep(&p);
        let mut round = 0;
        while self.goes_on(residual) && self.outcome.sweeps < most_sweeps {
            // Newton's method begins at the start itself: a sweep leads away from the impulses of the step before.
            if round > 0 {
                let half = round >= WHOLE_ROUNDS && round % 2 == 1;
                self.sweep(&mut p, SWEEPS, most_sweeps, if half { 0.5 } else { 1.0 });
                residual = self.keep(&p);
            }
            self.newton_series(&mut p, residual, most_sweeps, most_steps);
            round += 1;
        }
        self.outcome.solved
    }

    /// Returns whether there is something left to do after a residual.
    fn goes_on(&self, residual: T) -> bool {
        !self.outcome.solved && residual.is_finite()
    }

    /// Sweeps up to `count` times, while there are fewer than `most` sweeps.
    fn sweep(&mut self, p: &mut [Vec3<T>; K], count: usize, most: usize, relaxation: f64) {
        let count = count.min(most.saturating_sub(self.outcome.sweeps));
        let problem = self.problem;
        let sweeps = self.sweeps.get_or_insert_with(|| Sweeps::new(problem));
        for _ in 0..count {
            sweeps.sweep(problem, p, T::from_f64(relaxation));
        }
        self.outcome.sweeps += count;
    }

    /// Takes Newton steps with sweeps after each. The residual may rise for some steps; p becomes the impulses with the
    /// smallest one.
    fn newton_series(
        &mut self,
        p: &mut [Vec3<T>; K],
        residual: T,
        most_sweeps: usize,
        most_steps: usize,
    ) {
        let (mut trial, mut last, mut least) = (*p, residual, residual);
        for _ in 0..SERIES {
            if self.outcome.newton_steps >= most_steps || !self.goes_on(last) {
                return;
            }
            self.outcome.newton_steps += 1;
            let Some(next) = self
                .newton
                .step(self.problem, &self.steps, &trial, self.shift)
            else {
                return;
            };
            trial = next;
            let mut reached = self.keep(&trial);
            if !self.outcome.solved {
                self.sweep(&mut trial, SMOOTHING, most_sweeps, 1.0);
                reached = self.keep(&trial);
            }
            self.adapt_shift(reached, last);
            last = reached;
            if reached < least {
                least = reached;
                *p = trial;
            }
        }
    }

    /// Lowers the shift of Newton's method after a good step, and raises it after a bad one.
    fn adapt_shift(&mut self, reached: T, last: T) {
        let factor = T::from_f64(FACTOR);
        if reached * factor < last {
            self.shift = (self.shift / factor).max(T::from_f64(SHIFTS[0]));
        } else if last < reached {
            self.shift = (self.shift * factor).min(T::from_f64(SHIFTS[2]));
        }
    }

    /// Keeps impulses if they are the best so far. Returns their residual.
    fn keep(&mut self, p: &[Vec3<T>; K]) -> T {
        let residual = self.steps.residual(self.problem, p);
        let before = self.outcome.residual;
        if residual < before || (residual.is_finite() && !before.is_finite()) {
            self.best = *p;
            self.outcome.residual = residual;
            let bound = self.options.tolerance * self.problem.largest(p);
            self.outcome.solved = residual.is_finite() && residual <= bound;
        }
        residual
    }
}
