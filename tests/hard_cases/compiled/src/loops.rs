//! The mechanisms with loops by name, for any size.

use bgdyn::Scalar;
use bgdyn::runtime::closure::Dependent;

use crate::{Erased, Model, list, vector};

/// A compiled mechanism with loops. Matrices are stored row by row.
pub trait Closed<T>: Model<T> {
    /// Number of velocities of the open tree.
    fn nt(&self) -> usize;
    /// Names of the rows: the loop, and the direction in the axes of its place a.
    fn rows(&self) -> &'static [&'static str];
    /// The dependent joints.
    fn dependents(&self) -> &'static [Dependent];
    /// Returns the closed position of the start.
    fn neutral(&self) -> Vec<T>;
    /// Moves a position and closes the loops.
    fn integrate(&self, q: &[T], dv: &[T]) -> Vec<T>;
    /// Closes the loops, or returns the error as text.
    ///
    /// # Errors
    /// If a loop does not close.
    fn close(&self, q: &[T]) -> Result<Vec<T>, String>;
    /// Returns whether `close` takes no steps: all loops are planar polygons, whose positions have a closed form.
    fn closes_at_once(&self) -> bool;
    /// One Newton step, of the velocities of the open tree.
    fn closing_step(&self, q: &[T]) -> Vec<T>;
    /// S v
    fn tree_velocity(&self, q: &[T], v: &[T]) -> Vec<T>;
    /// S a + z
    fn tree_acceleration(&self, q: &[T], v: &[T], a: &[T]) -> Vec<T>;
    /// S
    fn velocity_map(&self, q: &[T]) -> Vec<T>;
    /// By how much the rows are open.
    fn constraint_residual(&self, q: &[T]) -> Vec<T>;
    /// B
    fn constraint_jacobian(&self, q: &[T]) -> Vec<T>;
    /// λ
    fn multipliers(&self, q: &[T], v: &[T], a: &[T]) -> Vec<T>;
}

macro_rules! closed {
    ($module:ident, $model:ident, $whole:literal) => {
        impl<T: Scalar> Closed<T> for Erased<$module::$model<T>, { $module::NQ }, { $module::NV }> {
            fn nt(&self) -> usize {
                $module::NT
            }

            fn rows(&self) -> &'static [&'static str] {
                &$module::CONSTRAINT_NAMES
            }

            fn dependents(&self) -> &'static [Dependent] {
                &$module::DEPENDENTS
            }

            fn neutral(&self) -> Vec<T> {
                list(&bgdyn::Dynamics::neutral(&self.0))
            }

            fn integrate(&self, q: &[T], dv: &[T]) -> Vec<T> {
                list(&bgdyn::Dynamics::integrate(
                    &self.0,
                    &vector(q),
                    &vector(dv),
                ))
            }

            fn close(&self, q: &[T]) -> Result<Vec<T>, String> {
                let closed = self.0.close(&vector(q));
                closed.map(|q| list(&q)).map_err(|e| format!("{e:?}"))
            }

            fn closes_at_once(&self) -> bool {
                $whole
            }

            fn closing_step(&self, q: &[T]) -> Vec<T> {
                list(&self.0.closing_step(&vector(q)))
            }

            fn tree_velocity(&self, q: &[T], v: &[T]) -> Vec<T> {
                list(&self.0.tree_velocity(&vector(q), &vector(v)))
            }

            fn tree_acceleration(&self, q: &[T], v: &[T], a: &[T]) -> Vec<T> {
                list(&self.0.tree_acceleration(&vector(q), &vector(v), &vector(a)))
            }

            fn velocity_map(&self, q: &[T]) -> Vec<T> {
                let map = self.0.velocity_map(&vector(q));
                map.row_iter()
                    .flat_map(|row| row.iter().copied().collect::<Vec<T>>())
                    .collect()
            }

            fn constraint_residual(&self, q: &[T]) -> Vec<T> {
                list(&self.0.constraint_residual(&vector(q)))
            }

            fn constraint_jacobian(&self, q: &[T]) -> Vec<T> {
                let rows = self.0.constraint_jacobian(&vector(q));
                rows.row_iter()
                    .flat_map(|row| row.iter().copied().collect::<Vec<T>>())
                    .collect()
            }

            fn multipliers(&self, q: &[T], v: &[T], a: &[T]) -> Vec<T> {
                list(&self.0.multipliers(&vector(q), &vector(v), &vector(a)))
            }
        }
    };
}

include!(concat!(env!("OUT_DIR"), "/loops.rs"));

/// Scalars in which all mechanisms with loops are compiled, only once, in this crate.
pub trait CompiledLoops: Scalar {
    /// Returns the model of this name, if it exists.
    fn closed(name: &str) -> Option<Box<dyn Closed<Self>>>;
}

impl CompiledLoops for f64 {
    fn closed(name: &str) -> Option<Box<dyn Closed<f64>>> {
        any(name)
    }
}

impl CompiledLoops for f32 {
    fn closed(name: &str) -> Option<Box<dyn Closed<f32>>> {
        any(name)
    }
}

/// Returns the model of this name.
///
/// # Panics
/// If it does not exist.
pub fn closed<T: CompiledLoops>(name: &str) -> Box<dyn Closed<T>> {
    T::closed(name).unwrap_or_else(|| panic!("no mechanism with loops is called {name}"))
}

/// Returns the spec of the mechanism of this name.
///
/// # Panics
/// If it does not exist.
pub fn spec(name: &str) -> &'static str {
    let found = TEXTS.iter().find(|(own, _)| *own == name);
    found.expect(name).1
}
