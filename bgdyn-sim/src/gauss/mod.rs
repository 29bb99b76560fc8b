//! The Gauss–Legendre methods: the implicit midpoint rule, and methods of 2 and more stages.

mod coefficients;
mod convergence;
mod newton;

use bgdyn_runtime::{Scalar as _, StateVector};
use coefficients::{Coefficients, Split};
use convergence::ConvergenceMonitor;
use newton::Blocks;

use crate::failure::Reason;
use crate::integrator::{Integrator, IntegratorInfo, Start, Step};
use crate::ode::{Ode, ScalarOf};
use crate::real::{Of, Real};

/// The Gauss–Legendre method with `S` stages, of order 2S with fixed steps (Butcher 1964; Hairer,
/// Lubich, Wanner, Geometric Numerical Integration, II.1 and VIII.6).
///
/// Symmetric, and symplectic for equations in canonical form: the energy error remains bounded. Stable for
/// steps of any length, but motions faster than the step are not damped.
///
/// The equations of the stages are solved to rounding: by simplified Newton steps if the slopes of the
/// rates are available, else by fixed-point iteration. The initial guess extrapolates the previous step.
#[derive(Clone, Debug)]
pub struct Gauss<T, const S: usize> {
    of: Coefficients<T, S>,
}

/// The implicit midpoint rule, of order 2.
pub type Midpoint<T> = Gauss<T, 1>;
/// The Gauss–Legendre method of order 4.
pub type Gauss2<T> = Gauss<T, 2>;
/// The Gauss–Legendre method of order 6.
pub type Gauss3<T> = Gauss<T, 3>;
/// The Gauss–Legendre method of order 8.
pub type Gauss4<T> = Gauss<T, 4>;

/// The rates at the stages and the change of the state.
type Solved<O, const S: usize> =
    Result<([<O as Ode>::State; S], <O as Ode>::State), Reason<<O as Ode>::Error>>;

impl<T: Real, const S: usize> Default for Gauss<T, S> {
    fn default() -> Self {
        Self::new()
    }
}

impl<T: Real, const S: usize> Gauss<T, S> {
    /// Returns the integrator, with coefficients rounded from double-double.
    pub fn new() -> Self {
        const { assert!(0 < S && S < 7, "one to six stages") }
        let of = Coefficients::new();
        Gauss { of }
    }

    /// Returns zᵢ = h Σ aᵢⱼ fⱼ, the displacements of the stages.
    fn displacements<Y: StateVector<Scalar = T>>(&self, rates: &[Y; S], h: T) -> [Y; S] {
        core::array::from_fn(|i| weighed_exactly(&self.of.a[i], rates).times(h))
    }

    /// Returns rates at the stages, extrapolated by the polynomial of the previous step.
    fn continued<Y: StateVector<Scalar = T>>(&self, before: &Step<Y, [Y; S]>, h: T) -> [Y; S] {
        let (one, c) = (T::from_f64(1.0), &self.of.c);
        core::array::from_fn(|i| {
            let x = one + c[i] * h / before.h;
            let weights = core::array::from_fn(|j| {
                let others = (0..S).filter(|&k| k != j);
                others.fold(one, |w, k| w * (x - c[k]) / (c[j] - c[k]))
            });
            weighed(&weights, &before.stages)
        })
    }

    /// Evaluates the rates at the displaced stages.
    fn rates<O: Ode>(
        &self,
        ode: &O,
        (t, y): (T, &O::State),
        h: T,
        displacements: &[O::State; S],
    ) -> Result<[O::State; S], Reason<O::Error>>
    where
        O::State: StateVector<Scalar = T>,
    {
        let mut rates = displacements.clone();
        for (rate, &c) in rates.iter_mut().zip(&self.of.c) {
            let there = y.plus(T::from_f64(1.0), rate);
            *rate = ode.rates(t + c * h, &there).map_err(Reason::Singular)?;
        }
        Ok(rates)
    }

    /// Fixed-point iteration: zᵢ ← h Σ aᵢⱼ f(y + zⱼ).
    fn substitute<O: Ode>(
        &self,
        ode: &O,
        at: (T, &O::State),
        h: T,
        guess: [O::State; S],
    ) -> Solved<O, S>
    where
        O::State: StateVector<Scalar = T>,
    {
        let mut z = self.displacements(&guess, h);
        let mut monitor = ConvergenceMonitor::new(at.1.zero());
        loop {
            let rates = self.rates(ode, at, h, &z)?;
            let next = self.displacements(&rates, h);
            let changes = core::array::from_fn(|i| next[i].plus(-T::from_f64(1.0), &z[i]));
            z = next;
            if monitor.ends(at.1, &z, &changes)? {
                // Evaluate the rates of the solution: the last rates are one change behind, in every step
                // with the same sign.
                let rates = self.rates(ode, at, h, &z)?;
                let change = weighed_exactly(&self.of.b, &rates).times(h);
                return Ok((rates, change));
            }
        }
    }

    /// Newton's method with the slopes at the start: (I − h A ⊗ J) δ = h A f(y + z) − z. The change of the
    /// state is computed from the displacements, which are accurate also for stiff rates.
    fn newton<O: Ode>(
        &self,
        ode: &O,
        at: (T, &O::State),
        h: T,
        guess: [O::State; S],
        jacobian: &<O::State as StateVector>::Matrix,
    ) -> Solved<O, S>
    where
        O::State: StateVector<Scalar = T>,
    {
        let blocks = Blocks::new(
            &self.of.a.map(|row| row.map(Split::whole)),
            h,
            jacobian,
            at.1,
        )
        .ok_or(Reason::SingularMatrix)?;
        let mut z = self.displacements(&guess, h);
        let mut monitor = ConvergenceMonitor::new(sizes::<O::State>(jacobian, at.1).times(h.abs()));
        loop {
            let rates = self.rates(ode, at, h, &z)?;
            let mut changes = self.displacements(&rates, h);
            for (change, z) in changes.iter_mut().zip(&z) {
                change.add(-T::from_f64(1.0), z);
            }
            blocks.solve(&mut changes);
            for (z, change) in z.iter_mut().zip(&changes) {
                z.add(T::from_f64(1.0), change);
            }
            if monitor.ends(at.1, &z, &changes)? {
                return Ok((rates, weighed(&self.of.d, &z)));
            }
        }
    }
}

/// Returns |J| |y|, component by component.
fn sizes<Y: StateVector>(jacobian: &Y::Matrix, y: &Y) -> Y {
    let mut matrix = jacobian.clone();
    for m in Y::columns_mut(&mut matrix) {
        *m = m.abs();
    }
    let mut size = y.clone();
    for x in size.entries_mut() {
        *x = x.abs();
    }
    size.mapped(&matrix)
}

/// Returns Σ wⱼ xⱼ with weights in two parts.
fn weighed_exactly<Y: StateVector, const S: usize>(weights: &[Split<Of<Y>>; S], x: &[Y; S]) -> Y
where
    Of<Y>: Real,
{
    let rest = weighed(&weights.map(|w| w.rest), x);
    weighed(&weights.map(|w| w.short), x).plus(Of::<Y>::from_f64(1.0), &rest)
}

/// Returns Σ wⱼ xⱼ.
fn weighed<Y: StateVector, const S: usize>(weights: &[Of<Y>; S], x: &[Y; S]) -> Y {
    let mut sum = x[0].times(weights[0]);
    for (&w, x) in weights.iter().zip(x).skip(1) {
        sum.add(w, x);
    }
    sum
}

impl<Y: StateVector, const S: usize> Integrator<Y> for Gauss<Of<Y>, S>
where
    Of<Y>: Real,
{
    /// Rates at the stages.
    type Stages = [Y; S];

    fn info(&self) -> IntegratorInfo {
        let (name, order) = [
            ("midpoint", 2),
            ("gauss2", 4),
            ("gauss3", 6),
            ("gauss4", 8),
            ("gauss5", 10),
            ("gauss6", 12),
        ][S - 1];
        IntegratorInfo {
            name,
            order,
            estimate: None,
            looks: 1,
            reads_jacobian: true,
        }
    }

    fn keeps_lengths(&self) -> bool {
        true
    }

    fn step<O: Ode<State = Y>>(
        &self,
        ode: &O,
        from: &Start<'_, Y, [Y; S]>,
        h: ScalarOf<O>,
    ) -> Result<Step<Y, [Y; S]>, Reason<O::Error>> {
        let at = (from.t, from.y);
        let guess = match from.before {
            Some(before) => self.continued(before, h),
            None => {
                let rates = ode.rates(from.t, from.y).map_err(Reason::Singular)?;
                core::array::from_fn(|_| rates.clone())
            }
        };
        let (stages, change) = match ode.jacobian(from.t, from.y) {
            Some(jacobian) => {
                let jacobian = jacobian.map_err(Reason::Singular)?;
                self.newton(ode, at, h, guess, &jacobian.state)?
            }
            None => self.substitute(ode, at, h, guess)?,
        };
        Ok(Step { h, change, stages })
    }
}
