//! Compiled mechanisms as test subjects.

use hard_cases_compiled::Model;

use crate::State;
use crate::bars::{Digits, Subject};

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

/// Converts numbers to the scalar under test.
pub(crate) fn narrow<T: Digits>(x: &[f64]) -> Vec<T> {
    x.iter().map(|&x| T::from_f64(x)).collect()
}

/// Converts the numbers to `f64`.
pub(crate) fn wide<T: Digits>(x: Vec<T>) -> Vec<f64> {
    x.into_iter().map(T::to_f64).collect()
}
