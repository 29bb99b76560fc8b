//! The cone problem of one contact whose other impulses are given, solved exactly.

use super::problem::Vec3;
use super::projection::length;
use crate::real::Real;

/// Most iterations for a sliding contact. Newton's method takes about five; bisection alone finds all digits.
const ITERATIONS: usize = 100;

/// One contact, prepared: its block of the Delassus matrix after elimination of the normal impulse, in principal axes.
///
/// With γ_n = 0 the normal impulse is p_n = −(q_n + w·p_t)/G_nn, where q is the velocity without the impulse at this
/// contact and w = G_tn. There is left γ_t = S p_t + d, with S = G_tt − w wᵀ/G_nn and d = q_t − w q_n/G_nn. Sticking is
/// S p_t = −d. Sliding is γ_t = −λ p_t with λ > 0: (S + λ) p_t = −d, and |p_t| = μ p_n is one equation for λ (as a
/// polynomial of degree four: Bonnefon and Daviet 2011).
#[derive(Clone, Copy, Debug)]
pub(super) struct OneContact<T> {
    friction: T,
    /// G_nn.
    normal: T,
    /// w = G_tn, in principal axes.
    coupling: [T; 2],
    /// The eigenvalues of S, not negative.
    stiffness: [T; 2],
    /// Cosine and sine of the angle of the first principal axis.
    axis: [T; 2],
}

impl<T: Real> OneContact<T> {
    /// Prepares a contact with its coefficient of friction and its block on the diagonal of the Delassus matrix.
    pub(super) fn new(friction: T, block: &[Vec3<T>; 3]) -> Self {
        let zero = T::from_f64(0.0);
        let half = T::from_f64(0.5);
        let normal = block[2][2];
        let w = [block[0][2], block[1][2]];
        let over = if normal == zero {
            zero
        } else {
            T::from_f64(1.0) / normal
        };
        let [xx, yy] = [0, 1].map(|i| block[i][i] - w[i] * w[i] * over);
        let xy = half * (block[0][1] + block[1][0]) - w[0] * w[1] * over;
        let (mean, half_difference) = (half * (xx + yy), half * (xx - yy));
        let radius = length(half_difference, xy);
        let axis = principal_axis(half_difference, xy, radius);
        // What is left of the terms after subtraction is zero below their rounding errors.
        let least = T::EPSILON * T::from_f64(8.0) * (block[0][0].abs() + block[1][1].abs());
        let stiffness = [mean + radius, mean - radius];
        OneContact {
            friction,
            normal,
            coupling: turned(axis, w),
            stiffness: stiffness.map(|s| if s <= least { zero } else { s }),
            axis,
        }
    }

    /// Returns the impulse for the velocity q without it.
    pub(super) fn solve(&self, q: &Vec3<T>) -> Vec3<T> {
        let zero = T::from_f64(0.0);
        let [c, s] = self.axis;
        if q[2] >= zero || self.normal <= zero {
            return [zero; 3];
        }
        if self.friction == zero {
            return [zero, zero, -q[2] / self.normal];
        }
        let push = -q[2] / self.normal;
        let tangential = turned(self.axis, [q[0], q[1]]);
        let size = length(q[0], q[1]) + push * length(self.coupling[0], self.coupling[1]);
        let least = T::EPSILON * T::from_f64(8.0) * size.abs();
        let drive: [T; 2] = core::array::from_fn(|i| {
            let d = self.coupling[i].mul_add(push, tangential[i]);
            // A direction that cannot move, and does not.
            let still = self.stiffness[i] == zero && d.abs() <= least;
            if still { zero } else { d }
        });
        let p = self.sticking(&drive, push);
        let p = p.unwrap_or_else(|| self.sliding(&drive, push));
        [c * p[0] - s * p[1], s * p[0] + c * p[1], p[2]]
    }

    /// Returns the tangential impulse of a given multiplier λ, in principal axes, and the normal impulse.
    fn impulse(&self, drive: &[T; 2], push: T, multiplier: T) -> Vec3<T> {
        let zero = T::from_f64(0.0);
        let part = |i: usize| {
            let p = -drive[i] / (self.stiffness[i] + multiplier);
            if drive[i] == zero { zero } else { p }
        };
        let [x, y] = [part(0), part(1)];
        let coupled = self.coupling[0].mul_add(x, self.coupling[1] * y);
        [x, y, push - coupled / self.normal]
    }

    /// Returns the impulse that stops the contact, if it is in the cone.
    fn sticking(&self, drive: &[T; 2], push: T) -> Option<Vec3<T>> {
        let p = self.impulse(drive, push, T::from_f64(0.0));
        (length(p[0], p[1]) <= self.friction * p[2]).then_some(p)
    }

    /// Returns the impulse of sliding: the root of h(λ) = μ p_n/|p_t| − 1, which is negative at 0, and linear in λ if S is a
    /// multiple of the identity and w is 0. Newton's method in a bracket.
    fn sliding(&self, drive: &[T; 2], push: T) -> Vec3<T> {
        let (zero, one, half) = (T::from_f64(0.0), T::from_f64(1.0), T::from_f64(0.5));
        let size = length(drive[0], drive[1]);
        let weight = length(self.coupling[0], self.coupling[1]);
        // |p_t| ≤ size/λ, and p_n ≥ push − weight |p_t|/G_nn: h is not negative here.
        let mut high = size * (one / self.friction + weight / self.normal) / push;
        let mut low = zero;
        let mut multiplier =
            size / (self.friction * push) - half * (self.stiffness[0] + self.stiffness[1]);
        if !(multiplier > low && multiplier < high) {
            multiplier = half * high;
        }
        let mut p = self.impulse(drive, push, multiplier);
        // Ends when a step is below the rounding error, or nothing is left of the bracket.
        for _ in 0..ITERATIONS {
            let (value, slope) = self.excess(&p, multiplier);
            if value < zero {
                low = multiplier;
            } else {
                high = multiplier;
            }
            let newton = multiplier - value / slope;
            let next = if newton > low && newton < high {
                newton
            } else if newton == multiplier {
                break;
            } else {
                half * (low + high)
            };
            let moved = (next - multiplier).abs();
            multiplier = next;
            p = self.impulse(drive, push, multiplier);
            if moved <= T::EPSILON * next {
                break;
            }
        }
        // For the largest multipliers p_t is too small to have a direction: it is against d.
        let tangential = length(p[0], p[1]);
        let [x, y, tangential] = if tangential > zero {
            [p[0], p[1], tangential]
        } else {
            [-drive[0], -drive[1], size]
        };
        let scale = self.friction * p[2] / tangential;
        [scale * x, scale * y, p[2]]
    }

    /// Returns h(λ) = μ p_n/|p_t| − 1 and its derivative.
    fn excess(&self, p: &Vec3<T>, multiplier: T) -> (T, T) {
        let slope: [T; 2] = core::array::from_fn(|i| -p[i] / (self.stiffness[i] + multiplier));
        let coupled = self.coupling[0].mul_add(slope[0], self.coupling[1] * slope[1]);
        let tangential = length(p[0], p[1]);
        let ratio = self.friction * p[2] / tangential;
        let lengthening = p[0].mul_add(slope[0], p[1] * slope[1]) / tangential;
        let normal_slope = -coupled / self.normal;
        let rate = (self.friction * normal_slope - ratio * lengthening) / tangential;
        (ratio - T::from_f64(1.0), rate)
    }
}

/// Returns cosine and sine of the angle of the axis of the larger eigenvalue of ((a, b), (b, −a)).
fn principal_axis<T: Real>(a: T, b: T, radius: T) -> [T; 2] {
    let (zero, one) = (T::from_f64(0.0), T::from_f64(1.0));
    if radius == zero {
        return [one, zero];
    }
    // Of two multiples of the eigenvector the one without cancellation.
    let (x, y) = if a >= zero {
        (radius + a, b)
    } else {
        (b, radius - a)
    };
    let norm = length(x, y);
    [x / norm, y / norm]
}

/// Returns the components of a vector along the principal axes.
fn turned<T: Real>([c, s]: [T; 2], v: [T; 2]) -> [T; 2] {
    [c * v[0] + s * v[1], c * v[1] - s * v[0]]
}
