//! The problem, the options of its solution, and the outcome.

use crate::real::Real;

/// Three components at a contact: along the two tangents x and y, and along the normal z.
pub(super) type Vec3<T> = [T; 3];

/// The impulses of `K` contacts with Coulomb friction, as a problem: γ = G p + b, and at each active contact
///
/// K* ∋ γ + μ |γ_t| n ⟂ p ∈ K, K = {|p_t| ≤ μ p_n}
///
/// with the dual cone K* = {γ_n ≥ μ |γ_t|} (de Saxcé and Feng 1998; Acary and Brogliato 2008, chapter 3). A contact separates (p = 0,
/// γ_n ≥ 0), sticks (γ = 0, p in the cone) or slides (γ_n = 0, |p_t| = μ p_n, p_t against γ_t). Components are in the order
/// (x, y, z): x and y along orthogonal unit vectors in the plane of the contact, z along its normal n, away from the
/// surface; a positive normal velocity separates.
#[derive(Clone, Copy, Debug)]
pub struct ContactProblem<'a, T, const K: usize> {
    /// The Delassus matrix G = J M⁻¹ Jᵀ, in 1/kg, symmetric and positive semidefinite: `delassus[c][d][i][j]` is the
    /// velocity i at contact c from a unit of impulse j at contact d. Several contacts at one rigid body make it
    /// singular. Blocks of contacts that are not active do not influence the result.
    pub delassus: &'a [[[[T; 3]; 3]; K]; K],
    /// Relative velocities b without the impulses, in m/s. Terms of restitution are part of them.
    pub velocities: &'a [[T; 3]; K],
    /// Coefficients of friction μ ≥ 0.
    pub friction: &'a [T; K],
    /// Which contacts can have impulses. The others have p = 0.
    pub active: &'a [bool; K],
}

impl<T: Real, const K: usize> ContactProblem<'_, T, K> {
    /// Returns γ_c = Σ_d G_cd p_d + b_c, without the contact `except`.
    pub(super) fn velocity(&self, c: usize, p: &[Vec3<T>; K], except: Option<usize>) -> Vec3<T> {
        let mut sum = self.velocities[c];
        for d in 0..K {
            if self.active[d] && except != Some(d) {
                add_product(&mut sum, &self.delassus[c][d], &p[d]);
            }
        }
        sum
    }

    /// Returns whether there are active contacts, none of which acts on another one.
    pub(super) fn is_separate(&self) -> bool {
        let zero = [[T::from_f64(0.0); 3]; 3];
        let alone = |c: usize| {
            let mut others = (0..K).filter(|&d| d != c && self.active[d]);
            others.all(|d| self.delassus[c][d] == zero)
        };
        let mut active = (0..K).filter(|&c| self.active[c]).peekable();
        active.peek().is_some() && active.all(alone)
    }

    /// Returns the largest magnitude of a component of the impulses; NaN if one is NaN.
    pub(crate) fn largest(&self, p: &[Vec3<T>; K]) -> T {
        let components = p.as_flattened().iter();
        components.fold(T::from_f64(0.0), |most, x| most.max(x.abs()))
    }
}

/// Computes sum ← sum + G p.
#[inline(always)]
pub(super) fn add_product<T: Real>(sum: &mut Vec3<T>, block: &[Vec3<T>; 3], p: &Vec3<T>) {
    for i in 0..3 {
        let row = &block[i];
        let rest = row[0].mul_add(p[0], sum[i]);
        sum[i] = row[2].mul_add(p[2], row[1].mul_add(p[1], rest));
    }
}

/// When [`solve`](super::solve) ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactOptions<T> {
    /// Largest residual of a solution, relative to the largest magnitude of a component of the impulses. Without impulses
    /// the residual must be 0.
    pub tolerance: T,
    /// Most sweeps over the contacts from one start.
    pub most_sweeps: usize,
    /// Most steps of Newton's method from one start. With 0 there are sweeps alone.
    pub most_newton_steps: usize,
}

impl<T: Real> Default for ContactOptions<T> {
    /// A tolerance of 64 ε (1.4e-14 in `f64`, 8e-6 in `f32`), a few times the rounding errors of the sums over 30 contacts:
    /// convergence is so fast in the end that fewer digits save little. 2,000 sweeps and 500 Newton steps: most problems take
    /// a hundredth of that, but with a tenth one in 20 stacks of four boxes on their corners is not solved.
    fn default() -> Self {
        ContactOptions {
            tolerance: T::EPSILON * T::from_f64(64.0),
            most_sweeps: 2000,
            most_newton_steps: 500,
        }
    }
}

/// What [`solve`](super::solve) ended with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactOutcome<T> {
    /// The residual in N·s: the largest component of p − proj_K(p − ρ (γ + μ |γ_t| n)) at all active contacts, zero at
    /// solutions only (natural map; Acary, Brémond and Huber 2018). ρ is a length of step in kg: 3 over the trace
    /// of the contact's block G_cc. A contact whose block is zero has 1/ε times the smallest ρ of the others, or 1 kg if
    /// all are zero. NaN if the problem contains NaN.
    pub residual: T,
    /// Number of sweeps, from all starts.
    pub sweeps: usize,
    /// Number of Newton steps, from all starts, with those that lead nowhere.
    pub newton_steps: usize,
    /// Whether the residual meets the tolerance. False if it is NaN.
    pub solved: bool,
}
