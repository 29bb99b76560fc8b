//! The middle of a step, and the velocities at its end without impulses.

use bgdyn_runtime::{MatrixOf, Scalar as _, StateVector};

use crate::failure::Reason;
use crate::lu::invert;
use crate::motion::{add_turning, moved, turn_velocities};
use crate::ode::Ode;
use crate::real::{Of, Real};

/// So many ε of the largest velocity are neglected.
pub(super) const NEGLIGIBLE: f64 = 256.0;

/// The middle of a step. Components that are not positions are called velocities here; first-order states are among them.
/// Velocities of the beginning and of the end are along the axes of links in the middle.
pub(super) struct Middle<'a, Y: StateVector> {
    /// t + h/2
    pub(super) t: Of<Y>,
    /// h
    pub(super) h: Of<Y>,
    /// The positions q_m = q + (h/2) v, with the velocities at the beginning.
    pub(super) y: Y,
    /// The number of positions.
    pub(super) positions: usize,
    /// B⁻¹ for B = 1 − (h/2) ∂v̇/∂v, of this step or of one before; without one B = 1.
    own: Option<Inverse<Y>>,
    before: Option<&'a Inverse<Y>>,
    linearised: bool,
}

/// B⁻¹: n × n for n velocities at the beginning of the matrix. Each B has dozens of right-hand sides, so its inverse costs
/// less than its factors do. It needs few correct digits: residuals are of the equations themselves.
#[derive(Clone, Debug)]
pub(super) struct Inverse<Y: StateVector> {
    matrix: MatrixOf<Y>,
    /// The number of steps that B has served.
    age: usize,
}

/// B serves so many steps.
const MOST_STEPS: usize = 10;

/// Returns a state with the positions in the middle of the step of length `h` from it, at a time.
pub(super) fn positions_in_middle<O: Ode>(
    ode: &O,
    (t, from): (Of<O::State>, &O::State),
    h: Of<O::State>,
) -> Result<O::State, Reason<O::Error>>
where
    Of<O::State>: Real,
{
    let half = h * Of::<O::State>::from_f64(0.5);
    let positions = ode.positions();
    let mut y = from.clone();
    moved(ode, t, &mut y, half).map_err(Reason::Singular)?;
    ode.project(t + half, &mut y).map_err(Reason::Singular)?;
    y.entries_mut()[positions..].copy_from_slice(&from.entries()[positions..]);
    turn_velocities(ode, from, &mut y);
    Ok(y)
}

impl<'a, Y: StateVector> Middle<'a, Y>
where
    Of<Y>: Real,
{
    /// Returns the middle, with the positions of [`positions_in_middle`], of the step of length `h` from a time. B, which
    /// changes little from step to step, is that of a step before of the same length, if it was needed there.
    pub(super) fn new(
        (t, y): (Of<Y>, Y),
        h: Of<Y>,
        positions: usize,
        inverse: Option<&'a Inverse<Y>>,
    ) -> Self {
        Middle {
            t: t + h * Of::<Y>::from_f64(0.5),
            h,
            y,
            positions,
            own: None,
            before: inverse,
            linearised: false,
        }
    }

    /// Returns B⁻¹ for the next step.
    pub(super) fn into_inverse(self) -> Option<Inverse<Y>> {
        self.own.or_else(|| {
            let before = self.before?;
            let mut same = before.clone();
            same.age += 1;
            Some(same)
        })
    }

    /// Inverts B anew where it has served for long.
    pub(super) fn renew<O: Ode<State = Y>>(
        &mut self,
        ode: &O,
        end: &Y,
    ) -> Result<(), Reason<O::Error>> {
        if self.before.is_some_and(|before| before.age >= MOST_STEPS) {
            self.linearise(ode, end)?;
        }
        Ok(())
    }

    /// Returns B⁻¹.
    fn inverse(&self) -> Option<&Inverse<Y>> {
        self.own.as_ref().or(self.before)
    }

    /// Returns the velocities at the end without impulses, from a guess of those with impulses: one step of Newton's method
    /// for v + h v̇((v + v⁺)/2) − v⁺ = 0. The positions are those of the middle.
    pub(super) fn free<O: Ode<State = Y>>(&self, ode: &O, end: &Y) -> Result<Y, Reason<O::Error>> {
        let mean = self.mean(end);
        let mut rates = ode.rates(self.t, &mean).map_err(Reason::Singular)?;
        add_turning(ode, (&mean, &mean), &mut rates);
        let mut step = end.zero();
        let (start, n) = (self.y.entries(), self.positions);
        for (i, x) in step.entries_mut().iter_mut().enumerate().skip(n) {
            *x = (start[i] - end.entries()[i]) + self.h * rates.entries()[i];
        }
        self.solve(&mut step);
        let mut free = self.y.clone();
        for (i, x) in free.entries_mut().iter_mut().enumerate().skip(n) {
            *x = end.entries()[i] + step.entries()[i];
        }
        Ok(free)
    }

    /// Returns the state in the middle with the mean velocities.
    fn mean(&self, end: &Y) -> Y {
        let half = Of::<Y>::from_f64(0.5);
        let mut mean = self.y.clone();
        let velocities = mean.entries_mut().iter_mut().zip(end.entries());
        for (x, &end) in velocities.skip(self.positions) {
            *x = half * (*x + end);
        }
        mean
    }

    /// Inverts B with the slopes at the mean velocities. Returns whether B changed: once in a step, if there are slopes.
    pub(super) fn linearise<O: Ode<State = Y>>(
        &mut self,
        ode: &O,
        end: &Y,
    ) -> Result<bool, Reason<O::Error>> {
        if self.linearised {
            return Ok(false);
        }
        self.linearised = true;
        let mean = self.mean(end);
        let Some(slopes) = ode.jacobian(self.t, &mean) else {
            return Ok(false);
        };
        let slopes = slopes.map_err(Reason::Singular)?.state;
        let (all, positions) = (end.entries().len(), self.positions);
        let n = all - positions;
        let half = self.h * Of::<Y>::from_f64(0.5);
        let mut matrix = end.matrix();
        let entries = Y::columns_mut(&mut matrix);
        for (j, column) in Y::columns(&slopes).chunks(all).skip(positions).enumerate() {
            let mut unit = end.zero();
            unit.entries_mut()[positions + j] = Of::<Y>::from_f64(1.0);
            let mut turning = end.zero();
            add_turning(ode, (&mean, &unit), &mut turning);
            add_turning(ode, (&unit, &mean), &mut turning);
            let slopes = column.iter().zip(turning.entries()).skip(positions);
            for (i, (&slope, &turning)) in slopes.enumerate() {
                let own = if i == j { 1.0 } else { 0.0 };
                entries[j * n + i] = Of::<Y>::from_f64(own) - half * (slope + turning);
            }
        }
        let mut pivots = end.array(0);
        if !invert(&mut entries[..n * n], &mut pivots.as_mut()[..n], n) {
            return Err(Reason::SingularMatrix);
        }
        self.own = Some(Inverse { matrix, age: 1 });
        Ok(true)
    }

    /// Replaces velocities x by B⁻¹ x.
    pub(super) fn solve(&self, x: &mut Y) {
        let Some(Inverse { matrix, .. }) = self.inverse() else {
            return;
        };
        let mut product = x.zero();
        let (right, sums) = (&x.entries()[self.positions..], product.entries_mut());
        let sums = &mut sums[self.positions..];
        let n = right.len();
        for (column, &x) in Y::columns(matrix)[..n * n].chunks(n.max(1)).zip(right) {
            for (sum, &entry) in sums.iter_mut().zip(column) {
                *sum = entry.mul_add(x, *sum);
            }
        }
        x.entries_mut()[self.positions..].copy_from_slice(&product.entries()[self.positions..]);
    }

    /// Returns the time at the end of the step.
    pub(super) fn end(&self) -> Of<Y> {
        self.t + self.h * Of::<Y>::from_f64(0.5)
    }

    /// Returns the largest change of a velocity in units of what is neglected: of 256 ε of the largest velocity.
    pub(super) fn change(&self, next: &Y, end: &Y, free: &Y) -> f64 {
        let (mut change, mut size) = (0.0_f64, f64::MIN_POSITIVE);
        for i in self.positions..next.entries().len() {
            let at = |y: &Y| y.entries()[i].to_f64();
            change = change.max((at(next) - at(end)).abs());
            let sizes = [next, free, &self.y].map(|y| at(y).abs());
            size = sizes.into_iter().fold(size, f64::max);
            if !at(next).is_finite() {
                return f64::INFINITY;
            }
        }
        change / (size * NEGLIGIBLE * Of::<Y>::EPSILON.to_f64())
    }

    /// Moves the positions of the middle to the end of the step, with the velocities there, and turns these to the axes there.
    pub(super) fn advance<O: Ode<State = Y>>(
        &self,
        ode: &O,
        end: &mut Y,
    ) -> Result<(), Reason<O::Error>> {
        let half = self.h * Of::<Y>::from_f64(0.5);
        moved(ode, self.t, end, half).map_err(Reason::Singular)?;
        turn_velocities(ode, &self.y, end);
        Ok(())
    }
}
