//! Steps of the semismooth Newton method on all contacts at once.

use super::problem::{ContactProblem, Vec3, add_product};
use super::projection::{Steps, length, project};
use crate::lu;
use crate::real::Real;

/// A contact in the linear equations of a step: its change of impulse is Δp = `basis` z + `offset`, with up to three
/// unknowns z, and each unknown has an equation, `rows` (γ + G Δp) + `diagonal` z + `rest` = 0.
#[derive(Clone, Copy, Debug)]
struct Piece<T> {
    contact: usize,
    unknowns: usize,
    basis: [Vec3<T>; 3],
    rows: [Vec3<T>; 3],
    offset: Vec3<T>,
    diagonal: Vec3<T>,
    rest: Vec3<T>,
}

impl<T: Real> Piece<T> {
    /// Returns the equations γ + G Δp = 0 of a sticking contact.
    fn sticking(contact: usize) -> Self {
        let zero = T::from_f64(0.0);
        let one = T::from_f64(1.0);
        let unit =
            core::array::from_fn(|i| core::array::from_fn(|j| if i == j { one } else { zero }));
        Piece {
            contact,
            unknowns: 3,
            basis: unit,
            rows: unit,
            offset: [zero; 3],
            diagonal: [zero; 3],
            rest: [zero; 3],
        }
    }

    /// Returns the equations of a contact that presses without friction, or slides along u = x_t/|x_t|, where
    /// x_t = p_t − ρ γ_t: γ_n = 0 and p_t = μ p_n u, linearised (Alart and Curnier 1991). The component along u follows
    /// Δp_n; across it (1 − k) Δp + k ρ Δγ = −p with k = μ p_n/|x_t|.
    fn sliding(contact: usize, friction: T, step: T, p: &Vec3<T>, x: [T; 2]) -> Self {
        let (zero, one) = (T::from_f64(0.0), T::from_f64(1.0));
        let size = length(x[0], x[1]);
        let [u, v] = if size == zero {
            [one, zero]
        } else {
            x.map(|x| x / size)
        };
        let (along, across) = (p[0] * u + p[1] * v, p[1] * u - p[0] * v);
        let lag = friction * p[2] - along;
        let share = if size == zero {
            zero
        } else {
            friction * p[2] / size
        };
        let mut piece = Piece::sticking(contact);
        piece.unknowns = if friction == zero { 1 } else { 2 };
        piece.basis[0] = [friction * u, friction * v, one];
        piece.basis[1] = [-v, u, zero];
        piece.rows[0] = [zero, zero, one];
        piece.rows[1] = [-(share * v), share * u, zero];
        piece.offset = [lag * u, lag * v, zero];
        piece.diagonal[1] = (one - share) / step;
        piece.rest[1] = across / step;
        piece
    }

    /// Writes the changes of the equations with an unknown that moves the impulse along `direction`.
    fn write_column(&self, block: &[Vec3<T>; 3], direction: &Vec3<T>, entries: &mut [T]) {
        let mut change = [T::from_f64(0.0); 3];
        add_product(&mut change, block, direction);
        for (row, entry) in self.rows[..self.unknowns].iter().zip(entries) {
            *entry = inner(row, &change);
        }
    }
}

/// The equations of a step, and the memory that solving them takes: about 9 K² numbers.
#[derive(Clone, Debug)]
pub(super) struct Newton<T, const K: usize> {
    pieces: [Piece<T>; K],
    matrix: [[[[T; 3]; K]; 3]; K],
    pivots: [[usize; 3]; K],
    right: [Vec3<T>; K],
}

impl<T: Real, const K: usize> Newton<T, K> {
    /// Returns the memory, without equations.
    pub(super) fn new() -> Self {
        let zero = T::from_f64(0.0);
        Newton {
            pieces: [Piece::sticking(0); K],
            matrix: [[[[zero; 3]; K]; 3]; K],
            pivots: [[0; 3]; K],
            right: [[zero; 3]; K],
        }
    }

    /// Returns the impulses after a step, projected onto the cones; `None` if the equations are singular.
    ///
    /// `shift` times the largest trace of a block is added to the diagonal, so that redundant contacts do not make the
    /// equations singular: impulses that change no velocity hardly move, as in the proximal point method.
    pub(super) fn step(
        &mut self,
        problem: &ContactProblem<'_, T, K>,
        steps: &Steps<T, K>,
        p: &[Vec3<T>; K],
        shift: T,
    ) -> Option<[Vec3<T>; K]> {
        let mut next = *p;
        let mut count = 0;
        for c in (0..K).filter(|&c| problem.active[c]) {
            let velocity = problem.velocity(c, p, None);
            if p[c][2] - steps.0[c] * velocity[2] > T::from_f64(0.0) {
                self.pieces[count] = piece(problem, steps.0[c], c, &p[c], &velocity);
                count += 1;
            } else {
                next[c] = [T::from_f64(0.0); 3];
            }
        }
        let unknowns = self.assemble(problem, &next, count, shift);
        let matrix = self.matrix.as_flattened_mut().as_flattened_mut();
        let matrix = &mut matrix.as_flattened_mut()[..unknowns * unknowns];
        let pivots = &mut self.pivots.as_flattened_mut()[..unknowns];
        if !lu::factor(matrix, pivots, unknowns) {
            return None;
        }
        lu::solve(
            matrix,
            pivots,
            &mut self.right.as_flattened_mut()[..unknowns],
        );
        self.move_impulses(problem, &mut next, count);
        Some(next)
    }

    /// Changes the impulses of the first `count` pieces by the solution of the equations, and projects them.
    fn move_impulses(
        &self,
        problem: &ContactProblem<'_, T, K>,
        p: &mut [Vec3<T>; K],
        count: usize,
    ) {
        let mut unknowns = self.right.as_flattened().iter();
        for piece in &self.pieces[..count] {
            let c = piece.contact;
            let mut moved: Vec3<T> = core::array::from_fn(|i| p[c][i] + piece.offset[i]);
            for (direction, &z) in piece.basis[..piece.unknowns].iter().zip(&mut unknowns) {
                moved = core::array::from_fn(|i| direction[i].mul_add(z, moved[i]));
            }
            p[c] = project(problem.friction[c], &moved);
        }
    }

    /// Writes the linear equations of the first `count` pieces, by columns, and returns their number. `p` are the impulses
    /// after the open contacts have let go.
    fn assemble(
        &mut self,
        problem: &ContactProblem<'_, T, K>,
        p: &[Vec3<T>; K],
        count: usize,
        shift: T,
    ) -> usize {
        let pieces = &self.pieces[..count];
        let mut base = *p;
        for piece in pieces {
            let base = &mut base[piece.contact];
            *base = core::array::from_fn(|i| base[i] + piece.offset[i]);
        }
        let unknowns = pieces.iter().map(|piece| piece.unknowns).sum();
        let matrix = self
            .matrix
            .as_flattened_mut()
            .as_flattened_mut()
            .as_flattened_mut();
        let right = self.right.as_flattened_mut();
        let shift = shift * largest_trace(problem, pieces);
        let mut row = 0;
        for piece in pieces {
            let velocity = problem.velocity(piece.contact, &base, None);
            let mut column = 0;
            for other in pieces {
                let block = &problem.delassus[piece.contact][other.contact];
                for j in 0..other.unknowns {
                    let entries = &mut matrix[(column + j) * unknowns + row..];
                    piece.write_column(block, &other.basis[j], entries);
                }
                column += other.unknowns;
            }
            for k in row..row + piece.unknowns {
                let diagonal = &mut matrix[k * unknowns + k];
                *diagonal = *diagonal + piece.diagonal[k - row] + shift;
                right[k] = -inner(&piece.rows[k - row], &velocity) - piece.rest[k - row];
            }
            row += piece.unknowns;
        }
        unknowns
    }
}

/// Returns the equations of a closed contact.
fn piece<T: Real, const K: usize>(
    problem: &ContactProblem<'_, T, K>,
    step: T,
    c: usize,
    p: &Vec3<T>,
    velocity: &Vec3<T>,
) -> Piece<T> {
    let friction = problem.friction[c];
    let x: Vec3<T> = core::array::from_fn(|i| p[i] - step * velocity[i]);
    let sticks = length(x[0], x[1]) <= friction * x[2] && friction > T::from_f64(0.0);
    if sticks {
        Piece::sticking(c)
    } else {
        Piece::sliding(c, friction, step, p, [x[0], x[1]])
    }
}

/// Returns the largest trace of a block on the diagonal of the Delassus matrix.
fn largest_trace<T: Real, const K: usize>(
    problem: &ContactProblem<'_, T, K>,
    pieces: &[Piece<T>],
) -> T {
    pieces.iter().fold(T::from_f64(0.0), |most, piece| {
        let block = &problem.delassus[piece.contact][piece.contact];
        most.max(block[0][0] + block[1][1] + block[2][2])
    })
}

/// Returns the inner product.
fn inner<T: Real>(a: &Vec3<T>, b: &Vec3<T>) -> T {
    a[0].mul_add(b[0], a[1].mul_add(b[1], a[2] * b[2]))
}
