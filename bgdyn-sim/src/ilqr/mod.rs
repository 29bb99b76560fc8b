//! Iterative linear-quadratic regulator: the efforts that take a model along a motion of least cost, and the feedback
//! around it. `no_std`, no heap, in any [`Real`] scalar.
//!
//! A motion has `N` steps of the semi-implicit Euler method, with constant efforts u_k in each. An iteration has two parts
//! (Li and Todorov 2004; with limits Tassa, Mansard and Todorov 2014):
//!
//! - A **sweep** from the end to the start makes each step linear and its [`Cost`] quadratic, and finds the law
//!   δu = step − K δ(q, v) that is best if all later nodes follow theirs. Efforts at their limits are held.
//! - A **search** follows the laws from the start, with the whole step or a half, a quarter … of it, until the cost falls
//!   by at least a tenth of what the quadratic model promises.
//!
//! The cost falls in every iteration. Each step is linearised where the sweep reaches it, so that only states, efforts and
//! laws are stored. Curvature of the dynamics is left out, and costs may give that of Gauss and Newton: convergence is
//! linear, and fast where the cost at the optimum is small. Changes of positions are along the tangent, as in
//! [`bgdyn_runtime::step`]: joints of every type are allowed.
//!
//! ```
//! use bgdyn::nalgebra::SVector;
//! use bgdyn::runtime::step::{SemiImplicit, State};
//! use bgdyn_sim::ilqr::{Cost, Ending, Ilqr, Part, Problem, Quadratic};
//! bgdyn::bgdyn!("../specs/cart_pole.yaml", derivatives = true);
//! use cart_pole::CartPole;
//!
//! /// Upright at x = 0 in the end, with little effort.
//! struct Upright;
//!
//! impl Cost<CartPole<f64>, f64, 2, 2> for Upright {
//!     fn node(&self, _: &CartPole<f64>, _: usize, _: &State<f64, 2, 2>, tau: &SVector<f64, 2>) -> f64 {
//!         0.5e-4 * tau.norm_squared()
//!     }
//!     fn end(&self, _: &CartPole<f64>, state: &State<f64, 2, 2>) -> f64 {
//!         5.0 * (state.q.norm_squared() + state.v.norm_squared())
//!     }
//!     fn add_node(&self, _: &CartPole<f64>, _: usize, _: &State<f64, 2, 2>, tau: &SVector<f64, 2>, sum: &mut Quadratic<f64, 2>) {
//!         sum.add_square(Part::U, 1e-4, tau);
//!     }
//!     fn add_end(&self, _: &CartPole<f64>, state: &State<f64, 2, 2>, sum: &mut Quadratic<f64, 2>) {
//!         sum.add_square(Part::Q, 10.0, &state.q);
//!         sum.add_square(Part::V, 10.0, &state.v);
//!     }
//! }
//!
//! let model = CartPole::<f64>::default();
//! // The joint of the pole has no motor.
//! let limits = Some([SVector::from([-30.0, 0.0]), SVector::from([30.0, 0.0])]);
//! let problem = Problem { model: &model, cost: &Upright, step: SemiImplicit { step: 0.02 }, limits };
//! let tilted = State { q: SVector::from([0.0, 0.3]), v: SVector::zeros() };
//! let mut ilqr = Ilqr::<f64, 2, 2, 50>::new(&problem, &tilted, &[SVector::zeros(); 50])?;
//! let outcome = ilqr.solve(&problem, 1e-9, 100).expect("a regular mass matrix");
//! assert_eq!(outcome.end, Ending::Converged);
//! // Effort has a cost: the pole is nearly at rest, and not quite upright.
//! assert!(ilqr.last().v.amax() < 0.05 && ilqr.last().q[1] < 0.15);
//! # Ok::<(), bgdyn::runtime::Singular>(())
//! ```

mod boxed;
mod cost;
mod gradient;
mod motion;
mod problem;
mod rows;
mod search;
mod sweep;
mod value;

use bgdyn_runtime::step::{Linearizable, State, Step};
use nalgebra::{SMatrix, SVector};

pub use cost::{Cost, Part, Quadratic};
use motion::{Motion, Node, roll_out};
pub use problem::{Ending, Iteration, NoLaw, Problem, Solution};
use sweep::{Law, Promise, add_value, eliminate};
use value::Value;

use crate::real::Real;

/// Damping of the first iteration that needs it: the share of the diagonal of Q_uu that is added to it.
const LEAST_DAMPING: f64 = 1e-4;
/// Growth of the damping, and its decrease after a success.
const FACTOR: f64 = 10.0;
/// Damping at which a search is given up.
const MOST_DAMPING: f64 = 1e8;

/// A motion of `N` steps with its laws: the unknowns of a [`Problem`], and the memory that solving it takes.
///
/// It contains about N (NV² · 2 + NV · 9) numbers: 56 kB for 7 joints, 50 nodes and `f64`.
#[derive(Clone, Debug)]
pub struct Ilqr<T: Real, const NQ: usize, const NV: usize, const N: usize> {
    motion: Motion<T, NQ, NV, N>,
    /// The motion that a search tries.
    trial: Motion<T, NQ, NV, N>,
    laws: [Law<T, NV>; N],
    damping: T,
}

impl<T: Real, const NQ: usize, const NV: usize, const N: usize> Ilqr<T, NQ, NV, N> {
    /// Returns the motion from a state under the given efforts, which are moved into the limits.
    ///
    /// # Errors
    /// If the mass matrix is singular on the way.
    pub fn new<M, C>(
        problem: &Problem<'_, M, C, T, NV>,
        first: &State<T, NQ, NV>,
        efforts: &[SVector<T, NV>; N],
    ) -> Result<Self, T::Singular<NV>>
    where
        M: Linearizable<T, NQ, NV>,
        C: Cost<M, T, NQ, NV>,
    {
        let zero = T::from_f64(0.0);
        let nodes = efforts.map(|tau| Node { state: *first, tau });
        let motion = Motion {
            nodes,
            end: *first,
            cost: zero,
        };
        let law = Law {
            step: [zero; NV],
            gain: [[[zero; NV]; 2]; NV],
            slope: [zero; NV],
            promise: [zero; 2],
        };
        let mut new = Ilqr {
            motion,
            trial: motion,
            laws: [law; N],
            damping: zero,
        };
        new.restart(problem, first, efforts)?;
        Ok(new)
    }

    /// Replaces the motion by that from a state under the given efforts, as [`Ilqr::new`].
    ///
    /// # Errors
    /// If the mass matrix is singular on the way; the motion is then the one before.
    pub fn restart<M, C>(
        &mut self,
        problem: &Problem<'_, M, C, T, NV>,
        first: &State<T, NQ, NV>,
        efforts: &[SVector<T, NV>; N],
    ) -> Result<(), T::Singular<NV>>
    where
        M: Linearizable<T, NQ, NV>,
        C: Cost<M, T, NQ, NV>,
    {
        roll_out(problem, first, &mut self.trial, |k, _| efforts[k])?;
        core::mem::swap(&mut self.motion, &mut self.trial);
        self.damping = T::from_f64(0.0);
        Ok(())
    }

    /// Returns the cost of the motion.
    pub fn cost(&self) -> T {
        self.motion.cost
    }

    /// Returns the states before each step.
    pub fn states(&self) -> impl ExactSizeIterator<Item = &State<T, NQ, NV>> {
        self.motion.nodes.iter().map(|node| &node.state)
    }

    /// Returns the state after the last step.
    pub fn last(&self) -> &State<T, NQ, NV> {
        &self.motion.end
    }

    /// Returns the efforts of each step, N·m, N.
    pub fn efforts(&self) -> impl ExactSizeIterator<Item = &SVector<T, NV>> {
        self.motion.nodes.iter().map(|node| &node.tau)
    }

    /// Returns the gains of node `k` from the last sweep, by positions along the tangent and by velocities:
    /// u = u_k − K_q δq − K_v δv.
    ///
    /// After [`Ending::Converged`] they are those around this motion, otherwise those around the motion before the last
    /// search.
    ///
    /// # Panics
    /// If there is no node `k`.
    pub fn gain(&self, k: usize) -> [SMatrix<T, NV, NV>; 2] {
        let gain = &self.laws[k].gain;
        [0, 1].map(|part| SMatrix::from_fn(|i, j| gain[i][part][j]))
    }

    /// Returns the derivatives of the cost by the efforts of node `k` at the last sweep, where later nodes follow their
    /// laws. With limits equal to the efforts no node reacts, and these are the [`Ilqr::gradient`].
    ///
    /// # Panics
    /// If there is no node `k`.
    pub fn slope(&self, k: usize) -> SVector<T, NV> {
        SVector::from_column_slice(&self.laws[k].slope)
    }

    /// Iterates until the promised decrease of the cost is no larger than `tolerance`, in units of the cost.
    ///
    /// # Errors
    /// See [`NoLaw`]; the motion is then the last one.
    pub fn solve<M, C>(
        &mut self,
        problem: &Problem<'_, M, C, T, NV>,
        tolerance: T,
        iterations: usize,
    ) -> Result<Solution<T>, NoLaw<T::Singular<NV>>>
    where
        M: Linearizable<T, NQ, NV>,
        C: Cost<M, T, NQ, NV>,
    {
        for done in 0..iterations {
            if let Iteration::Ended(end) = self.iterate(problem, tolerance)? {
                return Ok(self.outcome(done, end));
            }
        }
        Ok(self.outcome(iterations, Ending::Iterations))
    }

    /// Returns the outcome after so many searches.
    fn outcome(&self, iterations: usize, end: Ending) -> Solution<T> {
        Solution {
            cost: self.motion.cost,
            iterations,
            end,
        }
    }

    /// Sweeps and searches once; does not search if the promised decrease of the cost is no larger than `tolerance`.
    ///
    /// # Errors
    /// See [`NoLaw`]; the motion is then the one before.
    pub fn iterate<M, C>(
        &mut self,
        problem: &Problem<'_, M, C, T, NV>,
        tolerance: T,
    ) -> Result<Iteration<T>, NoLaw<T::Singular<NV>>>
    where
        M: Linearizable<T, NQ, NV>,
        C: Cost<M, T, NQ, NV>,
    {
        let (least, factor) = (T::from_f64(LEAST_DAMPING), T::from_f64(FACTOR));
        loop {
            let tried = self.sweep(problem);
            if let Ok(promise) = &tried {
                if promise.decrease(T::from_f64(1.0)) <= tolerance {
                    return Ok(Iteration::Ended(Ending::Converged));
                }
                if let Some(share) = self.search(problem, promise) {
                    let less = self.damping / factor;
                    self.damping = T::from_f64(if less < least { 0.0 } else { 1.0 }) * less;
                    let cost = self.motion.cost;
                    return Ok(Iteration::Moved { cost, share });
                }
            }
            if let Err(failure @ NoLaw::Singular { .. }) = tried {
                return Err(failure);
            }
            self.damping = (self.damping * factor).max(least);
            if self.damping > T::from_f64(MOST_DAMPING) {
                self.damping = T::from_f64(0.0);
                tried?;
                return Ok(Iteration::Ended(Ending::Stalled));
            }
        }
    }

    /// Finds the laws around the motion, from its end to its start.
    fn sweep<M, C>(
        &mut self,
        problem: &Problem<'_, M, C, T, NV>,
    ) -> Result<Promise<T>, NoLaw<T::Singular<NV>>>
    where
        M: Linearizable<T, NQ, NV>,
        C: Cost<M, T, NQ, NV>,
    {
        let Problem {
            model, cost, step, ..
        } = problem;
        let mut sum = Quadratic::zero();
        cost.add_end(model, &self.motion.end, &mut sum);
        let mut value = Value::of_end(&sum);
        let zero = T::from_f64(0.0);
        let mut promise = [zero; 2];
        let nodes = self.motion.nodes.iter().zip(&mut self.laws).enumerate();
        for (k, (Node { state, tau }, law)) in nodes.rev() {
            let blocks = step.linear(*model, state, tau);
            let blocks = blocks.map_err(|error| NoLaw::Singular { node: k, error })?;
            sum = Quadratic::zero();
            cost.add_node(model, k, state, tau, &mut sum);
            add_value(&value, &blocks, &mut sum);
            let room = problem.room(tau);
            let found = eliminate(&sum, self.damping, room.as_ref());
            (*law, value) = found.ok_or(NoLaw::Indefinite { node: k })?;
            promise = [promise[0] + law.promise[0], promise[1] + law.promise[1]];
        }
        Ok(Promise {
            slope: promise[0],
            half_curvature: T::from_f64(0.5) * promise[1],
        })
    }
}
