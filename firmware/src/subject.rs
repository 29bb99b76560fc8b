//! The measured functions: the four functions of a model, generated or by the textbook, with the same
//! arguments.

use bgdyn::nalgebra::{RealField, SMatrix, SVector};
use bgdyn::{Dynamics, Scalar};
use control::{ComputedTorque, Record};
use textbook::Textbook;

/// The results of all functions.
#[derive(Clone, Debug)]
pub struct Out<T, const N: usize> {
    /// Efforts or accelerations.
    pub vector: SVector<T, N>,
    /// The mass matrix.
    pub matrix: SMatrix<T, N, N>,
    /// Whether a mass matrix was refused as singular.
    pub refused: bool,
}

impl<T: Scalar, const N: usize> Default for Out<T, N> {
    fn default() -> Self {
        let zero = T::from_f64(0.0);
        Out {
            vector: SVector::repeat(zero),
            matrix: SMatrix::repeat(zero),
            refused: false,
        }
    }
}

/// A model whose functions are measured: at the record's q and v, with its desired acceleration as a, and
/// with its efforts.
pub trait Subject<T, const N: usize> {
    /// tau = ID(q, v, a)
    fn inverse_dynamics(&mut self, at: &Record<T, N>, out: &mut Out<T, N>);
    /// M(q)
    fn mass_matrix(&mut self, at: &Record<T, N>, out: &mut Out<T, N>);
    /// a = FD(q, v, tau)
    fn forward_dynamics(&mut self, at: &Record<T, N>, out: &mut Out<T, N>);
    /// Computed torque, with errors, gains and limits.
    fn control_step(&mut self, at: &Record<T, N>, out: &mut Out<T, N>);
}

/// A function of a subject.
pub type Function<S, T, const N: usize> = fn(&mut S, &Record<T, N>, &mut Out<T, N>);

/// Returns all of a subject's functions, with their names.
pub fn functions<S: Subject<T, N>, T, const N: usize>() -> [(&'static str, Function<S, T, N>); 4] {
    [
        ("inverse dynamics", S::inverse_dynamics),
        ("mass matrix", S::mass_matrix),
        ("forward dynamics", S::forward_dynamics),
        ("control step", S::control_step),
    ]
}

/// A generated model with a controller.
#[derive(Clone, Debug)]
pub struct Generated<M, T, const N: usize> {
    /// The model.
    pub model: M,
    /// Its controller.
    pub law: ComputedTorque<T, N>,
}

impl<M: Dynamics<T, N, N>, T: Scalar, const N: usize> Subject<T, N> for Generated<M, T, N> {
    fn inverse_dynamics(&mut self, at: &Record<T, N>, out: &mut Out<T, N>) {
        let (q, v, a) = (at.q.into(), at.v.into(), at.wanted_a.into());
        out.vector = self.model.inverse_dynamics(&q, &v, &a);
    }

    fn mass_matrix(&mut self, at: &Record<T, N>, out: &mut Out<T, N>) {
        out.matrix = self.model.mass_matrix(&at.q.into());
    }

    fn forward_dynamics(&mut self, at: &Record<T, N>, out: &mut Out<T, N>) {
        let (q, v, tau) = (at.q.into(), at.v.into(), at.tau.into());
        match self.model.forward_dynamics(&q, &v, &tau) {
            Ok(a) => out.vector = a,
            Err(_) => out.refused = true,
        }
    }

    fn control_step(&mut self, at: &Record<T, N>, out: &mut Out<T, N>) {
        out.vector = self.law.effort(&self.model, at);
    }
}

/// The textbook's recursions with a controller.
#[derive(Clone, Debug)]
pub struct Plain<T: RealField + Copy, const N: usize> {
    /// The tree.
    pub tree: Textbook<T, N>,
    /// Its controller.
    pub law: ComputedTorque<T, N>,
}

impl<T: Scalar + RealField, const N: usize> Subject<T, N> for Plain<T, N> {
    fn inverse_dynamics(&mut self, at: &Record<T, N>, out: &mut Out<T, N>) {
        let tau = out.vector.as_mut_slice();
        self.tree.inverse_dynamics(&at.q, &at.v, &at.wanted_a, tau);
    }

    fn mass_matrix(&mut self, at: &Record<T, N>, out: &mut Out<T, N>) {
        self.tree.mass_matrix(&at.q, &mut out.matrix);
    }

    fn forward_dynamics(&mut self, at: &Record<T, N>, out: &mut Out<T, N>) {
        let a = out.vector.as_mut_slice();
        self.tree.forward_dynamics(&at.q, &at.v, &at.tau, a);
    }

    fn control_step(&mut self, at: &Record<T, N>, out: &mut Out<T, N>) {
        let tree = &mut self.tree;
        out.vector = self.law.effort_by(at, |q, v, a| {
            let mut tau = SVector::<T, N>::repeat(T::zero());
            let (q, v, a) = (q.as_slice(), v.as_slice(), a.as_slice());
            tree.inverse_dynamics(q, v, a, tau.as_mut_slice());
            tau
        });
    }
}
