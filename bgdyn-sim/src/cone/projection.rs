//! The projection onto friction cones, and the residual.

use super::problem::{ContactProblem, Vec3};
use crate::real::Real;

/// Returns √(x² + y²).
pub(super) fn length<T: Real>(x: T, y: T) -> T {
    x.mul_add(x, y * y).sqrt()
}

/// Returns the point of the cone |p_t| ≤ μ p_n that is nearest to p. A point on the cone, but for rounding errors, stays.
pub(super) fn project<T: Real>(friction: T, p: &Vec3<T>) -> Vec3<T> {
    let tangential = length(p[0], p[1]);
    let limit = friction * p[2];
    // Without friction the limit of an impulse that pulls is −0, which is not less than 0.
    let presses = p[2] >= T::from_f64(0.0);
    if presses && tangential <= T::EPSILON.mul_add(T::from_f64(4.0) * limit, limit) {
        return *p;
    }
    on_boundary(friction, p, friction.mul_add(tangential, p[2]))
}

/// Returns the projection of a point outside of the cone; `along` is its product with (μ p_t/|p_t|, 1).
fn on_boundary<T: Real>(friction: T, p: &Vec3<T>, along: T) -> Vec3<T> {
    let zero = T::from_f64(0.0);
    if along <= zero {
        return [zero; 3];
    }
    let normal = along / friction.mul_add(friction, T::from_f64(1.0));
    let scale = friction * normal / length(p[0], p[1]);
    let scale = if friction == zero { zero } else { scale };
    [scale * p[0], scale * p[1], normal]
}

/// Returns the largest component of p − proj_K(p − ρ (γ + μ |γ_t| n)), in N·s: the natural map of de Saxcé's form, zero at
/// solutions only. `step` is ρ.
///
/// At a contact that slides fast ρ |γ_t| is large beside p. It cancels in μ |x_t| + x_n, where x is the projected point:
/// |x_t| − ρ |γ_t| = p_t·(p_t − 2 ρ γ_t)/(|x_t| + ρ |γ_t|) has no cancellation.
fn contact_residual<T: Real>(friction: T, step: T, p: &Vec3<T>, velocity: &Vec3<T>) -> T {
    let two = T::from_f64(2.0);
    let moved = velocity.map(|v| step * v);
    let x = [p[0] - moved[0], p[1] - moved[1]];
    let (tangential, slip) = (length(x[0], x[1]), length(moved[0], moved[1]));
    let push = p[2] - moved[2];
    let lifted = push - friction * slip;
    let target = if lifted >= T::from_f64(0.0) && tangential <= friction * lifted {
        [x[0], x[1], lifted]
    } else {
        let product = p[0] * (p[0] - two * moved[0]) + p[1] * (p[1] - two * moved[1]);
        let sum = tangential + slip;
        let excess = if sum == T::from_f64(0.0) {
            sum
        } else {
            product / sum
        };
        on_boundary(
            friction,
            &[x[0], x[1], push],
            friction.mul_add(excess, push),
        )
    };
    let off = |i: usize| (p[i] - target[i]).abs();
    off(0).max(off(1)).max(off(2))
}

/// The lengths ρ of the steps of the natural map, in kg: for each contact 3 over the trace of its block.
#[derive(Clone, Debug)]
pub(super) struct Steps<T, const K: usize>(pub(super) [T; K]);

impl<T: Real, const K: usize> Steps<T, K> {
    /// Returns the steps. A contact whose own trace is negligible has the one of the largest trace times 1/ε, and contacts
    /// without any trace have 1 kg.
    pub(super) fn new(problem: &ContactProblem<'_, T, K>) -> Self {
        let zero = T::from_f64(0.0);
        let traces: [T; K] = core::array::from_fn(|c| {
            let block = &problem.delassus[c][c];
            let trace = block[0][0] + block[1][1] + block[2][2];
            if problem.active[c] { trace } else { zero }
        });
        let most = traces.iter().fold(zero, |most, &x| most.max(x));
        let least = T::EPSILON * most;
        Steps(traces.map(|trace| {
            let trace = trace.max(least);
            if trace == zero {
                T::from_f64(1.0)
            } else {
                T::from_f64(3.0) / trace
            }
        }))
    }

    /// Returns the largest residual of the active contacts; NaN if one is NaN.
    pub(super) fn residual(&self, problem: &ContactProblem<'_, T, K>, p: &[Vec3<T>; K]) -> T {
        let mut most = T::from_f64(0.0);
        for c in (0..K).filter(|&c| problem.active[c]) {
            let velocity = problem.velocity(c, p, None);
            most = most.max(contact_residual(
                problem.friction[c],
                self.0[c],
                &p[c],
                &velocity,
            ));
        }
        most
    }
}
