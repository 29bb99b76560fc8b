//! The efforts of the actuated joints of a mechanism with loops, from those along the independent velocities.
//!
//! Power is the same: Pᵀ (Aᵀ u) = (A P)ᵀ u, where Aᵀ are the rows of S that belong to the actuated joints. As many
//! actuated joints as independent velocities: A P = f. More: among all P the one with the least Σ (P_j / e_j)², where
//! e_j are the largest efforts.
//!
//! A may be singular where the loops are regular ("type II" of parallel robots; Gosselin and Angeles 1990), and P exists
//! on both sides of such a position. No pivot here vanishes elsewhere: of up to three equations the pivot is the
//! determinant, of more it is the part of a row that is perpendicular to the rows before it (Gram and Schmidt).

use bgdyn_runtime::{ACTUATORS, Dd};

use super::elimination::largest_at;
use crate::bond_graph::ClosedTree;
use crate::expr::{Builder, Expr};
use crate::math::Vec3;

/// Returns the efforts on all joints of the tree for these of the actuated ones.
pub(super) fn on_tree<'g>(
    b: &'g Builder,
    closed: &ClosedTree,
    efforts: &[Expr<'g>],
) -> Option<Vec<Expr<'g>>> {
    let actuated = closed.closure.drives()?;
    let mut all = vec![b.zero(); closed.closure.positions.len()];
    for (j, &effort) in actuated.joints.iter().zip(efforts) {
        all[j.0] = effort;
    }
    Some(all)
}

/// Returns the efforts of the actuated joints that are equal to these along the independent velocities; `map` is S.
/// `None` if other joints are not actuated. The pivots have the indices of the independent joints after those of the
/// actuated joints and of the loops, from [`ACTUATORS`] on.
pub(super) fn actuator_efforts<'g>(
    b: &'g Builder,
    closed: &ClosedTree,
    map: &[Vec<Expr<'g>>],
    efforts: Vec<Expr<'g>>,
) -> Option<Vec<Expr<'g>>> {
    b.section(|| "efforts of the actuated joints".into());
    let (closure, samples) = (&closed.closure, &closed.closure.samples[..]);
    let actuated = closure.drives()?;
    let first = ACTUATORS + actuated.joints.len() + closure.loops.len();
    let columns = actuated.rows(map);
    let equations: Vec<Equation<'g>> = efforts
        .into_iter()
        .enumerate()
        .map(|(k, side)| Equation {
            row: columns.iter().map(|column| column[k]).collect(),
            side,
            pivot: Some(first + k),
        })
        .collect();
    if actuated.joints.len() > closure.independents.len() {
        let scales: Vec<Expr<'g>> = actuated.efforts.iter().map(|&e| b.constant(e)).collect();
        return Some(least(b, equations, (&scales, samples)));
    }
    // The column of an actuated independent joint has a single entry, 1: its effort follows from the others.
    let independent = |c: usize| {
        let mut places = closure.independents.iter();
        places.position(|i| *i == actuated.joints[c])
    };
    let (own, others): (Vec<usize>, Vec<usize>) =
        (0..columns.len()).partition(|&c| independent(c).is_some());
    let alone: Vec<usize> = own.iter().filter_map(|&c| independent(c)).collect();
    let left = equations.iter().enumerate();
    let left = left.filter(|(k, _)| !alone.contains(k));
    let left = left.map(|(_, equation)| equation.of(&others)).collect();
    let mut found = vec![b.zero(); columns.len()];
    for (&c, x) in others.iter().zip(square(b, left, samples)) {
        found[c] = x;
    }
    for (&c, &k) in own.iter().zip(&alone) {
        let terms = others.iter().map(|&other| (other, equations[k].row[other]));
        found[c] = terms.fold(equations[k].side, |sum, (other, s)| sum - s * found[other]);
    }
    Some(found)
}

/// Returns the solution of as many equations Σ row · x = side as unknowns, without checks of pivots.
pub(crate) fn solve_square<'g>(
    b: &'g Builder,
    equations: Vec<(Vec<Expr<'g>>, Expr<'g>)>,
    samples: &[Vec<Dd>],
) -> Vec<Expr<'g>> {
    let unchecked = |(row, side)| Equation {
        row,
        side,
        pivot: None,
    };
    square(b, equations.into_iter().map(unchecked).collect(), samples)
}

/// Σ row · x = side, with the index of its pivot; `None` for one that is not checked.
struct Equation<'g> {
    row: Vec<Expr<'g>>,
    side: Expr<'g>,
    pivot: Option<usize>,
}

impl<'g> Equation<'g> {
    /// Returns it with these columns alone.
    fn of(&self, columns: &[usize]) -> Self {
        Equation {
            row: columns.iter().map(|&c| self.row[c]).collect(),
            ..*self
        }
    }
}

/// Returns the solution of as many equations as unknowns.
fn square<'g>(b: &'g Builder, equations: Vec<Equation<'g>>, samples: &[Vec<Dd>]) -> Vec<Expr<'g>> {
    match equations.as_slice() {
        [] => vec![],
        [one] => vec![one.side * inverted(b, one.row[0], samples, one.pivot)],
        [x, y] => {
            // Cramer's rule.
            let determinant = x.row[0] * y.row[1] - x.row[1] * y.row[0];
            let inverse = inverted(b, determinant, samples, y.pivot);
            vec![
                (y.row[1] * x.side - x.row[1] * y.side) * inverse,
                (x.row[0] * y.side - y.row[0] * x.side) * inverse,
            ]
        }
        [x, y, z] => {
            // Cramer's rule: x · v = f with v = (f₁ y×z + f₂ z×x + f₃ x×y) / (x · y×z).
            let [first, second, third] =
                [x, y, z].map(|equation| Vec3(std::array::from_fn(|k| equation.row[k])));
            let crosses = [second.cross(third), third.cross(first), first.cross(second)];
            let inverse = inverted(b, first.dot(crosses[0]), samples, z.pivot);
            let entry = |k: usize| {
                let terms = [x, y, z].into_iter().zip(crosses);
                let sum = terms.fold(b.zero(), |sum, (equation, cross)| {
                    sum + cross.0[k] * equation.side
                });
                sum * inverse
            };
            (0..3).map(entry).collect()
        }
        all => {
            let scales = vec![b.number(1.0); all.len()];
            least(b, equations, (&scales, samples))
        }
    }
}

/// Returns 1 / value. The value, of either sign, is refused if it is a rounding error of its size at the sampled
/// positions, with an index to check it by.
fn inverted<'g>(
    b: &'g Builder,
    value: Expr<'g>,
    samples: &[Vec<Dd>],
    index: Option<usize>,
) -> Expr<'g> {
    match (value.as_constant(), index) {
        (Some(x), _) if x != Dd::ZERO => b.constant(Dd::ONE) / value,
        (_, None) => b.constant(Dd::ONE) / value,
        (_, Some(index)) => {
            let size = b.number(largest_at(b, value, samples));
            value.sign() / value.abs().pivot(size, index)
        }
    }
}

/// Returns the solution with the least Σ (x / scale)² of equations whose rows are independent: x = E y for the shortest
/// y of (A E) y = f. With perpendicular rows, A E = L Q (modified Gram–Schmidt, rows in the order of the equations),
/// L z = f and y = Qᵀ D⁻¹ z, where D are the squares of the rows of Q.
fn least<'g>(
    b: &'g Builder,
    equations: Vec<Equation<'g>>,
    (scales, samples): (&[Expr<'g>], &[Vec<Dd>]),
) -> Vec<Expr<'g>> {
    let dot = |x: &[Expr<'g>], y: &[Expr<'g>]| {
        let terms = x.iter().zip(y);
        terms.fold(b.zero(), |sum, (x, y)| sum + *x * *y)
    };
    // Rows of Q, each with its D⁻¹ and its z.
    let mut done: Vec<(Vec<Expr<'g>>, Expr<'g>, Expr<'g>)> = Vec::new();
    for equation in equations {
        let scaled = equation.row.iter().zip(scales).map(|(&x, &e)| x * e);
        let mut row: Vec<Expr<'g>> = scaled.collect();
        let (whole, mut side) = (dot(&row, &row), equation.side);
        for (other, inverse, known) in &done {
            let factor = dot(&row, other) * *inverse;
            for (x, &y) in row.iter_mut().zip(other) {
                *x = *x - factor * y;
            }
            side = side - factor * *known;
        }
        // What is left of the row is refused if it is a rounding error of the row at the sampled positions.
        let left = dot(&row, &row);
        let inverse = match (left.as_constant(), equation.pivot) {
            (Some(x), _) if x > Dd::ZERO => b.constant(Dd::ONE) / left,
            (_, None) => b.constant(Dd::ONE) / left,
            (_, Some(pivot)) => {
                let size = b.number(largest_at(b, whole, samples).sqrt());
                let length = left.sqrt().pivot(size, pivot);
                b.constant(Dd::ONE) / (length * length)
            }
        };
        done.push((row, inverse, side));
    }
    let mut found = vec![b.zero(); scales.len()];
    for (row, inverse, side) in &done {
        let share = *side * *inverse;
        for (x, &y) in found.iter_mut().zip(row) {
            *x = *x + share * y;
        }
    }
    found.iter().zip(scales).map(|(&x, &e)| x * e).collect()
}
