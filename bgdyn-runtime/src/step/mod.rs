//! Discrete steps of any model, with their exact derivatives and adjoints: `no_std`, no heap.
//!
//! A [`Step`] takes a [`State`] x = (q, v) with constant joint efforts u to the state x⁺ one time step later:
//! [`SemiImplicit`] with one evaluation of the accelerations, [`Rk4`] with four. [`Step::linear`] returns the derivatives
//! of exactly that map, rounding errors apart: not those of the differential equation.
//!
//! Small changes of positions are **along the tangent**, as in [`crate::Derivatives`]: they are displacements
//! of `integrate`. δq leads from q to `integrate(q, δq)`, and δq⁺ from q⁺ to `integrate(q⁺, δq⁺)`; both have as many
//! components as v. Where q̇ = v, these are plain
//! partial derivatives. At planar, spherical and floating joints δq is in the link axes of q, and δq⁺ in those of q⁺.
//!
//! | | model has | blocks |
//! |---|---|---|
//! | semi-implicit Euler | `derivatives = true` | F = ∂v⁺/∂(q, v), G = ∂v⁺/∂u; δq⁺ = E δq + h J δv⁺, with E = J = 1 where q̇ = v |
//! | Runge–Kutta 4 | the same | ∂q⁺ and ∂v⁺ by q, v, u |

mod products;
mod rk4;
mod semi_implicit;
mod tangent;

use nalgebra::{SMatrix, SVector};

use crate::{Derivatives, Dynamics, JointGroups, Scalar};
pub use rk4::{Rk4, Rk4Blocks};
pub use semi_implicit::{SemiImplicit, SemiImplicitBlocks};

/// Positions and velocities of a mechanism.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct State<T: Scalar, const NQ: usize, const NV: usize> {
    /// Positions: rad, m.
    pub q: SVector<T, NQ>,
    /// Velocities: rad/s, m/s.
    pub v: SVector<T, NV>,
}

/// A change of a state along the tangent, or its dual: derivatives of a number by the components of a state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tangent<T, const NV: usize> {
    /// Of the positions.
    pub q: SVector<T, NV>,
    /// Of the velocities.
    pub v: SVector<T, NV>,
}

/// A model with all that steps with derivatives take: every type that implements the three traits.
pub trait Linearizable<T: Scalar, const NQ: usize, const NV: usize>:
    Dynamics<T, NQ, NV> + Derivatives<T, NQ, NV> + JointGroups
{
}

impl<M, T: Scalar, const NQ: usize, const NV: usize> Linearizable<T, NQ, NV> for M where
    M: Dynamics<T, NQ, NV> + Derivatives<T, NQ, NV> + JointGroups
{
}

/// A discrete step of the model `M` under joint efforts that are constant during the step.
pub trait Step<M, T: Scalar, const NQ: usize, const NV: usize> {
    /// The derivatives.
    type Blocks: StepBlocks<T, NV>;

    /// Returns the state after the step. `tau`: joint efforts, N·m, N.
    ///
    /// # Errors
    /// Returns an error with the joint whose pivot vanishes if the mass matrix is singular.
    fn next(
        &self,
        model: &M,
        from: &State<T, NQ, NV>,
        tau: &SVector<T, NV>,
    ) -> Result<State<T, NQ, NV>, T::Singular<NV>>;

    /// Returns the derivatives of [`Step::next`].
    ///
    /// # Errors
    /// As [`Step::next`].
    fn linear(
        &self,
        model: &M,
        from: &State<T, NQ, NV>,
        tau: &SVector<T, NV>,
    ) -> Result<Self::Blocks, T::Singular<NV>>;
}

/// The derivatives of a step at a state.
pub trait StepBlocks<T: Scalar, const NV: usize> {
    /// Returns the change of the next state for a change of the state and of the efforts.
    fn forward(&self, from: &Tangent<T, NV>, tau: &SVector<T, NV>) -> Tangent<T, NV>;

    /// Returns the derivatives of a number by the state and by the efforts, from `next`, those by the next state: the
    /// transpose of [`StepBlocks::forward`].
    fn adjoint(&self, next: &Tangent<T, NV>) -> (Tangent<T, NV>, SVector<T, NV>);

    /// Returns ∂q⁺ and ∂v⁺ by q, v and u.
    fn dense(&self) -> [[SMatrix<T, NV, NV>; 3]; 2];
}
