//! The law of Hunt and Crossley 1975 at the depth δ, for stops and contacts: F = E(δ) (1 + μ δ̇) ≥ 0 with an elastic force E.
//!
//! Unlike the force of a spring with a parallel damper, its force begins and ends without a jump. A store has the energy of
//! E, a resistor dissipates (F − E) δ̇ ≥ 0, also where F is cut off at 0 because the body parts faster than it is pushed.
//!
//! μ follows from the required restitution e at an impact speed v. For m ẍ = −E(x) (1 + μ ẋ), with ẋ as a
//! function of x, an impact from v to −e v satisfies (Marhefka and Orin 1999) (1 + e) y = ln((1 + y)/(1 −
//! e y)), y = μ v, for any mass and elastic force. With ρ = (1 − e)/(1 + e) and y = 2 z/(1 + e) this is coth z
//! − 1/z = ρ, which has one root. Slower impacts have a greater restitution, faster ones a smaller one.

use bgdyn_runtime::Dd;

use crate::effort_sums::EffortSums;
use crate::expr::Expr;
use crate::layout::StateLayout;

/// The law at one depth.
#[derive(Clone, Copy, Debug)]
pub(super) struct Push<'g> {
    /// F, never negative.
    pub(super) force: Expr<'g>,
    /// E (1 + μ δ̇): negative where the body parts faster than it is pushed.
    pub(super) follows: Expr<'g>,
    /// (F − E) δ̇, W.
    pub(super) dissipated: Expr<'g>,
}

/// Returns the law for an elastic force E, μ, and δ̇.
pub(super) fn push<'g>(
    sums: &EffortSums<'g, '_>,
    elastic: Expr<'g>,
    (damping, rate): (Expr<'g>, Expr<'g>),
) -> Push<'g> {
    let factor = damping * rate + sums.b.number(1.0);
    let force = elastic * factor.max(sums.b.zero());
    Push {
        force,
        follows: elastic * factor,
        dissipated: (force - elastic) * rate,
    }
}

/// Declares the events of the element `name`, with what each is.
pub(super) fn declare(name: &str, layout: &mut StateLayout, about: [String; 3]) {
    for (event, about) in events(name).into_iter().zip(about) {
        layout.event(event, about);
    }
}

/// Sets the events: the gap becomes 0, ends to be 0, and the body parts faster than it is pushed.
pub(super) fn set_events<'g>(
    name: &str,
    sums: &mut EffortSums<'g, '_>,
    (gap, follows): (Expr<'g>, Expr<'g>),
) {
    let values = [gap, -gap, follows];
    for (event, value) in events(name).into_iter().zip(values) {
        sums.event(&event, value);
    }
}

fn events(name: &str) -> [String; 3] {
    ["begins", "ends", "pulled"].map(|end| format!("{name}_{end}"))
}

/// Returns μ, s/m or s/rad: the damping for the restitution e, 0 < e ≤ 1, of an impact at `speed`.
pub(super) fn damping(restitution: Dd, speed: Dd) -> Dd {
    let two = Dd::from_f64(2.0);
    let ratio = (Dd::ONE - restitution) / (Dd::ONE + restitution);
    two * inverse_langevin(ratio) / ((Dd::ONE + restitution) * speed)
}

/// Solves coth z − 1/z = ρ for z ≥ 0, 0 ≤ ρ < 1. The left side increases with z and is greater than 1 −
/// 1/z, so z is at most 1/(1 − ρ).
fn inverse_langevin(ratio: Dd) -> Dd {
    if ratio <= Dd::ZERO {
        return Dd::ZERO;
    }
    let half = Dd::from_f64(0.5);
    let (mut low, mut high) = (Dd::ZERO, Dd::ONE / (Dd::ONE - ratio));
    // Each halving gains a bit; a small root needs more than the 106 bits of a double-double.
    for _ in 0..160 {
        let middle = (low + high) * half;
        if langevin(middle) < ratio {
            low = middle;
        } else {
            high = middle;
        }
    }
    (low + high) * half
}

/// Returns coth z − 1/z for z > 0. Near zero, where the terms cancel, it uses the continued fraction
/// z/(3 + z²/(5 + z²/(7 + …))).
fn langevin(z: Dd) -> Dd {
    if z < Dd::from_f64(2.0) {
        let square = z * z;
        let mut below = Dd::from_f64(65.0);
        for k in (1..32).rev() {
            below = Dd::from_f64(f64::from(2 * k + 1)) + square / below;
        }
        return z / below;
    }
    let decay = (z * Dd::from_f64(-2.0)).exp();
    (Dd::ONE + decay) / (Dd::ONE - decay) - Dd::ONE / z
}
