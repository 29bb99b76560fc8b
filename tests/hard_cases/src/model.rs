//! Compiled mechanisms by name, whatever their size.

use bgdyn::{Dynamics, Scalar};
use nalgebra::{SMatrix, SVector};

use crate::State;
use crate::bars::{Digits, Subject};

/// A compiled mechanism. Matrices are given row by row.
pub trait Model<T> {
    /// Number of joints.
    fn nv(&self) -> usize;
    /// Joint efforts.
    fn inverse_dynamics(&self, q: &[T], v: &[T], a: &[T]) -> Vec<T>;
    /// The mass matrix.
    fn mass_matrix(&self, q: &[T]) -> Vec<T>;
    /// Efforts at zero accelerations.
    fn bias(&self, q: &[T], v: &[T]) -> Vec<T>;
    /// Efforts at rest.
    fn gravity(&self, q: &[T]) -> Vec<T>;
    /// Accelerations, or the error as text.
    ///
    /// # Errors
    /// Where the mass matrix is singular.
    fn forward_dynamics(&self, q: &[T], v: &[T], tau: &[T]) -> Result<Vec<T>, String>;
}

/// A generated struct whose number of joints is no longer seen.
struct Erased<M, const N: usize>(M);

fn vector<T: Scalar, const N: usize>(x: &[T]) -> SVector<T, N> {
    SVector::from_column_slice(x)
}

fn list<T: Scalar, const N: usize>(x: &SVector<T, N>) -> Vec<T> {
    x.as_slice().to_vec()
}

impl<T: Scalar, M: Dynamics<T, N, N>, const N: usize> Model<T> for Erased<M, N> {
    fn nv(&self) -> usize {
        N
    }

    fn inverse_dynamics(&self, q: &[T], v: &[T], a: &[T]) -> Vec<T> {
        list(&self.0.inverse_dynamics(&vector(q), &vector(v), &vector(a)))
    }

    fn mass_matrix(&self, q: &[T]) -> Vec<T> {
        let m: SMatrix<T, N, N> = self.0.mass_matrix(&vector(q));
        (0..N * N).map(|k| m[(k / N, k % N)]).collect()
    }

    fn bias(&self, q: &[T], v: &[T]) -> Vec<T> {
        list(&self.0.bias(&vector(q), &vector(v)))
    }

    fn gravity(&self, q: &[T]) -> Vec<T> {
        list(&self.0.gravity(&vector(q)))
    }

    fn forward_dynamics(&self, q: &[T], v: &[T], tau: &[T]) -> Result<Vec<T>, String> {
        let found = self
            .0
            .forward_dynamics(&vector(q), &vector(v), &vector(tau));
        found.map(|a| list(&a)).map_err(|e| format!("{e:?}"))
    }
}

include!(concat!(env!("OUT_DIR"), "/mechanisms.rs"));

/// The model of this name.
///
/// # Panics
/// Where there is none.
pub fn model<T: Scalar>(name: &str) -> Box<dyn Model<T>> {
    named(name).unwrap_or_else(|| panic!("no model is called {name}"))
}

/// The spec of the model of this name.
///
/// # Panics
/// Where there is none.
pub fn spec(name: &str) -> &'static str {
    let found = TEXTS.iter().find(|(own, _)| *own == name);
    found.expect(name).1
}

impl<T: Digits> Subject<T> for Box<dyn Model<T>> {
    fn inverse(&self, s: &State) -> Vec<f64> {
        wide(self.inverse_dynamics(&narrow(&s.q), &narrow(&s.v), &narrow(&s.a)))
    }

    fn mass(&self, s: &State) -> Vec<f64> {
        wide(self.mass_matrix(&narrow(&s.q)))
    }

    fn forward(&self, s: &State) -> Option<Vec<f64>> {
        let found = self.forward_dynamics(&narrow(&s.q), &narrow(&s.v), &narrow(&s.tau));
        found.ok().map(wide)
    }
}

/// Numbers in the scalar under test.
pub(crate) fn narrow<T: Digits>(x: &[f64]) -> Vec<T> {
    x.iter().map(|&x| T::from_f64(x)).collect()
}

/// The same numbers as `f64`.
pub(crate) fn wide<T: Digits>(x: Vec<T>) -> Vec<f64> {
    x.into_iter().map(T::to_f64).collect()
}
