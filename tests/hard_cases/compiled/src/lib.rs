//! The mechanisms of the hard cases by name, for any size, and the scenes.
#![forbid(unsafe_code)]

pub mod loops;

use bgdyn::nalgebra::{SMatrix, SVector};
use bgdyn::{Dynamics, Scalar};

/// A compiled mechanism. Matrices are stored row by row.
pub trait Model<T> {
    /// Number of positions.
    fn nq(&self) -> usize;
    /// Number of velocities.
    fn nv(&self) -> usize;
    /// Returns the position for numbers in 0 … 1, as [`Dynamics::sample`].
    fn sample(&self, u: &[T]) -> Vec<T>;
    /// Joint efforts.
    fn inverse_dynamics(&self, q: &[T], v: &[T], a: &[T]) -> Vec<T>;
    /// The mass matrix.
    fn mass_matrix(&self, q: &[T]) -> Vec<T>;
    /// Efforts at zero accelerations.
    fn bias(&self, q: &[T], v: &[T]) -> Vec<T>;
    /// Efforts at rest.
    fn gravity(&self, q: &[T]) -> Vec<T>;
    /// Returns accelerations, or the error as text.
    ///
    /// # Errors
    /// If the mass matrix is singular.
    fn forward_dynamics(&self, q: &[T], v: &[T], tau: &[T]) -> Result<Vec<T>, String>;
}

/// A generated struct with its numbers of positions and velocities erased.
struct Erased<M, const NQ: usize, const NV: usize>(M);

fn vector<T: Scalar, const N: usize>(x: &[T]) -> SVector<T, N> {
    SVector::from_column_slice(x)
}

fn list<T: Scalar, const N: usize>(x: &SVector<T, N>) -> Vec<T> {
    x.as_slice().to_vec()
}

impl<T: Scalar, M: Dynamics<T, NQ, NV>, const NQ: usize, const NV: usize> Model<T>
    for Erased<M, NQ, NV>
{
    fn nq(&self) -> usize {
        NQ
    }

    fn nv(&self) -> usize {
        NV
    }

    fn sample(&self, u: &[T]) -> Vec<T> {
        list(&self.0.sample(&vector(u)))
    }

    fn inverse_dynamics(&self, q: &[T], v: &[T], a: &[T]) -> Vec<T> {
        list(&self.0.inverse_dynamics(&vector(q), &vector(v), &vector(a)))
    }

    fn mass_matrix(&self, q: &[T]) -> Vec<T> {
        let m: SMatrix<T, NV, NV> = self.0.mass_matrix(&vector(q));
        (0..NV * NV).map(|k| m[(k / NV, k % NV)]).collect()
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

/// Scalars in which all models are compiled, only once, in this crate.
pub trait Compiled: Scalar {
    /// Returns the model of this name, if it exists.
    fn named(name: &str) -> Option<Box<dyn Model<Self>>>;
}

impl Compiled for f64 {
    fn named(name: &str) -> Option<Box<dyn Model<f64>>> {
        any(name)
    }
}

impl Compiled for f32 {
    fn named(name: &str) -> Option<Box<dyn Model<f32>>> {
        any(name)
    }
}

/// Returns the model of this name.
///
/// # Panics
/// If it does not exist.
pub fn model<T: Compiled>(name: &str) -> Box<dyn Model<T>> {
    T::named(name).unwrap_or_else(|| panic!("no model is called {name}"))
}

/// Returns the bit of argument `i` of a kind in a mask of a result's dependences: positions (0),
/// velocities (1), accelerations or first-order states (2), efforts or inputs (3). Bit 127 is for all
/// others.
pub fn bit(kind: usize, i: usize) -> u128 {
    1 << (24 * kind + i)
}

/// The scenes.
pub mod scenes {
    include!(concat!(env!("OUT_DIR"), "/scenes.rs"));
}

/// Returns the spec of the model of this name.
///
/// # Panics
/// If it does not exist.
pub fn spec(name: &str) -> &'static str {
    let found = TEXTS.iter().find(|(own, _)| *own == name);
    found.expect(name).1
}
