//! The linear equations for the forces, or impulses, of contacts whose modes are known.

use bgdyn_runtime::MOST_EVENT_CONTACTS;

use super::modes::PerContact;
use crate::lu::{factor, solve};
use crate::real::Real;

/// γ̇ = G λ + a for each pair of contacts, 3 × 3 blocks.
pub(super) type Delassus<T> = PerContact<PerContact<[[T; 3]; 3]>>;

/// The largest number of equations.
const MOST: usize = 3 * MOST_EVENT_CONTACTS;

/// One equation, row·γ = value, and the direction of the force that fulfils it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Constraint<T> {
    pub(super) contact: usize,
    pub(super) row: [T; 3],
    pub(super) force: [T; 3],
}

impl<T: Real> Constraint<T> {
    /// Returns the component of γ along this row for a unit of another constraint's force.
    pub(super) fn product(&self, delassus: &Delassus<T>, other: &Constraint<T>) -> T {
        let block = &delassus[self.contact][other.contact];
        let mut sum = T::from_f64(0.0);
        for (&r, row) in self.row.iter().zip(block) {
            for (&g, &f) in row.iter().zip(&other.force) {
                sum = (r * g).mul_add(f, sum);
            }
        }
        sum
    }
}

/// Equations and their values.
pub(super) struct Unknowns<T> {
    all: [Constraint<T>; MOST],
    values: [T; MOST],
    number: usize,
}

impl<T: Real> Unknowns<T> {
    /// Returns no equations.
    pub(super) fn new() -> Self {
        let zero = T::from_f64(0.0);
        let none = Constraint {
            contact: 0,
            row: [zero; 3],
            force: [zero; 3],
        };
        Unknowns {
            all: [none; MOST],
            values: [zero; MOST],
            number: 0,
        }
    }

    /// Adds an equation.
    pub(super) fn add(&mut self, constraint: Constraint<T>, value: T) {
        self.all[self.number] = constraint;
        self.values[self.number] = value;
        self.number += 1;
    }

    /// Adds γ = value for a contact.
    pub(super) fn add_all(&mut self, contact: usize, value: [T; 3]) {
        for (k, value) in value.into_iter().enumerate() {
            self.add_axis(contact, k, value);
        }
    }

    /// Adds the component k of γ = value for a contact, and the force along it.
    pub(super) fn add_axis(&mut self, contact: usize, k: usize, value: T) {
        let row = core::array::from_fn(|i| T::from_f64(if i == k { 1.0 } else { 0.0 }));
        let constraint = Constraint {
            contact,
            row,
            force: row,
        };
        self.add(constraint, value);
    }
}

/// The shift of the diagonal, in parts of its largest element.
const SHIFT: f64 = 1e-4;

/// The largest number of corrections. Each leaves of an error its part SHIFT/(σ + SHIFT), σ: singular value.
const MOST_CORRECTIONS: usize = 60;

/// Returns the forces that fulfil all equations, A x = values.
///
/// Redundant contacts, as the corners of a box, make A singular: x is found by the proximal point method,
/// (A + s 1)(x' − x) = values − A x from x = 0. Of a symmetric A this is the solution of least norm.
pub(super) fn solved<T: Real>(
    unknowns: &Unknowns<T>,
    delassus: &Delassus<T>,
) -> PerContact<[T; 3]> {
    let zero = T::from_f64(0.0);
    let n = unknowns.number;
    let all = &unknowns.all[..n];
    let mut forces = [[zero; 3]; MOST_EVENT_CONTACTS];
    if n == 0 {
        return forces;
    }
    let (mut matrix, mut shifted) = ([zero; MOST * MOST], [zero; MOST * MOST]);
    let mut largest = zero;
    for (j, force) in all.iter().enumerate() {
        for (i, row) in all.iter().enumerate() {
            matrix[j * n + i] = row.product(delassus, force);
        }
        largest = largest.max(matrix[j * n + j].abs());
    }
    shifted[..n * n].copy_from_slice(&matrix[..n * n]);
    for j in 0..n {
        shifted[j * n + j] = shifted[j * n + j] + largest * T::from_f64(SHIFT);
    }
    let mut pivots = [0; MOST];
    if !factor(&mut shifted[..n * n], &mut pivots[..n], n) {
        return forces.map(|_| [T::from_f64(f64::NAN); 3]);
    }
    let mut x = [zero; MOST];
    let mut before = T::from_f64(f64::INFINITY);
    for _ in 0..MOST_CORRECTIONS {
        let mut step = unknowns.values;
        for (column, &x) in matrix[..n * n].chunks(n).zip(&x) {
            for (rest, &a) in step.iter_mut().zip(column) {
                *rest = *rest - a * x;
            }
        }
        solve(&shifted[..n * n], &pivots[..n], &mut step[..n]);
        let size = |x: &[T]| x.iter().fold(zero, |most, x| most.max(x.abs()));
        let change = size(&step[..n]);
        for (x, &step) in x.iter_mut().zip(&step[..n]) {
            *x = *x + step;
        }
        // Rounding only: it does not fall any more.
        let negligible = T::EPSILON * size(&x[..n]);
        if change <= negligible || change >= before || !change.is_finite() {
            break;
        }
        before = change;
    }
    for (constraint, &x) in all.iter().zip(&x) {
        for (sum, &f) in forces[constraint.contact].iter_mut().zip(&constraint.force) {
            *sum = *sum + f * x;
        }
    }
    forces
}
