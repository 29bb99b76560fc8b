//! Compliant stops at a joint's limits, with a given coefficient of restitution.
//!
//! The law of Hunt and Crossley 1975: at the depth δ the stop pushes back with k δ (1 + μ δ̇), never
//! inwards. Unlike the force of a spring with a parallel damper, its force begins and ends without a jump.
//!
//! μ follows from the required restitution e at an impact speed v. For m ẍ = −k x (1 + μ ẋ), with ẋ as a
//! function of x, an impact from v to −e v satisfies (Marhefka and Orin 1999) (1 + e) y = ln((1 + y)/(1 −
//! e y)), y = μ v, for any mass and stiffness. With ρ = (1 − e)/(1 + e) and y = 2 z/(1 + e) this is coth z
//! − 1/z = ρ, which has one root. Slower impacts have a greater restitution, faster ones a smaller one.

use bgdyn_runtime::Dd;

use super::coulomb_smooth::SPEED;
use super::keys::JOINT;
use super::{Effect, nodes};
use crate::bond_graph::{BondNetwork, NodeKind, PowerTerm};
use crate::declaration::{EffectKind, Element, ValueCheck};
use crate::effort_sums::{EffortSums, Port};
use crate::expr::Expr;
use crate::fault::{Help, wording};
use crate::format::{Dimension, Key, Reads};
use crate::layout::StateLayout;
use crate::mechanism::Limits;

pub(super) struct Stop;

const PLACE: Reads = Reads::Number(&[Dimension::Angle, Dimension::Length]);

const STIFFNESS: Key = Key {
    name: "stiffness",
    reads: Reads::Number(&[Dimension::AngularStiffness, Dimension::Stiffness]),
    needed: true,
    about: "k",
};
const RESTITUTION: Key = Key {
    name: "restitution",
    reads: Reads::Number(&[Dimension::One]),
    needed: true,
    about: "e, speed after an impact to the speed before it",
};
const IMPACT_SPEED: Key = Key {
    name: "impact_speed",
    reads: SPEED,
    needed: true,
    about: "v, the speed of the impact that has this restitution",
};
const LOWER: Key = Key {
    name: "lower",
    reads: PLACE,
    needed: false,
    about: "where the lower stop begins; the joint's lower limit without it",
};
const UPPER: Key = Key {
    name: "upper",
    reads: PLACE,
    needed: false,
    about: "where the upper stop begins; the joint's upper limit without it",
};

impl EffectKind for Stop {
    fn keyword(&self) -> &'static str {
        "stop"
    }

    fn family(&self) -> &'static str {
        "stops"
    }

    fn summary(&self) -> &'static str {
        "stops: push back with k δ (1 + μ δ̇) ≥ 0 at the depth δ, μ from the restitution"
    }

    fn symbol(&self) -> &'static str {
        "C"
    }

    fn keys(&self) -> &'static [Key] {
        &[STIFFNESS, RESTITUTION, IMPACT_SPEED, LOWER, UPPER, JOINT]
    }

    fn limit_for(&self, key: &Key, limits: &Limits) -> Option<f64> {
        match key {
            key if *key == LOWER => limits.lower,
            key if *key == UPPER => limits.upper,
            _ => None,
        }
    }

    fn check_values(&self, check: &mut ValueCheck<'_>) {
        check.fixed(&[RESTITUTION, IMPACT_SPEED]);
        check.positive(&[STIFFNESS, IMPACT_SPEED], Help::StopsAreOptional);
        check.positive(&[RESTITUTION], Help::RestitutionIsPositive);
        check.at_most_one(&RESTITUTION, Help::RestitutionAboveOne);
        check.ordered(&LOWER, &UPPER, Help::JointIsBetweenStops);
        if check.number(&LOWER).or(check.number(&UPPER)).is_none() {
            let joint = check.element.needed_name(&JOINT);
            check.report(wording::no_stops(&check.element.location, joint));
        }
    }

    fn declare(&self, element: &Element, layout: &mut StateLayout) {
        let (name, joint) = (&element.name, element.needed_name(&JOINT));
        layout.event(begins(name), format!("`{joint}` meets a stop"));
        layout.event(ends(name), format!("`{joint}` leaves a stop"));
        let about =
            format!("`{joint}` is pulled off a stop faster than that springs back, or no more");
        layout.event(pulled(name), about);
    }
}

impl Effect for Stop {
    fn elements(&self, element: &Element, _: &[Element], network: &mut BondNetwork) {
        let stop = nodes::add_at_port(element, NodeKind::Compliance, network);
        network.set_powers(stop, &[PowerTerm::Stored, PowerTerm::Dissipated]);
    }

    fn law(&self, element: &Element, sums: &mut EffortSums<'_, '_>) {
        let port = sums.port(element);
        let zero = sums.b.zero();
        // `gap`: distance to the stops; 0 inside them.
        let (mut pushed, mut gap, mut follows) = (zero, None, zero);
        for (key, outwards) in [(&LOWER, -1.0), (&UPPER, 1.0)] {
            let Some(at) = sums.optional(element, key) else {
                continue;
            };
            let outwards = Dd::from_f64(outwards);
            let depth = (port.displacement - at) * outwards;
            let side = one_side(element, sums, &port, depth, outwards);
            (pushed, follows) = (pushed + side.effort, follows + side.follows);
            gap = Some(gap.map_or(-depth, |other: Expr<'_>| other.min(-depth)));
        }
        let gap = gap.unwrap_or(zero);
        sums.event(&begins(&element.name), gap);
        sums.event(&ends(&element.name), -gap);
        sums.event(&pulled(&element.name), follows);
        sums.reading(
            format!("{}_effort", element.name),
            pushed,
            sums.port_units(element)[2],
            "effort of the stops on the joint".into(),
        );
    }
}

fn begins(name: &str) -> String {
    format!("{name}_begins")
}

fn ends(name: &str) -> String {
    format!("{name}_ends")
}

fn pulled(name: &str) -> String {
    format!("{name}_pulled")
}

/// The law of one stop.
struct Side<'g> {
    /// The effort on the joint.
    effort: Expr<'g>,
    /// The force of the law without the condition that it never pulls.
    follows: Expr<'g>,
}

/// Returns one stop; `depth` is negative before contact.
fn one_side<'g>(
    element: &Element,
    sums: &mut EffortSums<'g, '_>,
    port: &Port<'g>,
    depth: Expr<'g>,
    outwards: Dd,
) -> Side<'g> {
    let zero = sums.b.zero();
    let value = |key| element.quantity(key).map_or(Dd::ONE, |q| q.value);
    let damping = sums
        .b
        .constant(damping(value(&RESTITUTION), value(&IMPACT_SPEED)));
    let (depth, rate) = (depth.max(zero), port.rate * outwards);
    let elastic = sums.number(element, &STIFFNESS) * depth;
    let follows = damping * rate + sums.b.number(1.0);
    let force = elastic * follows.max(zero);
    let effort = force * -outwards;
    sums.push(port, effort);
    sums.store(elastic * depth * Dd::from_f64(0.5));
    sums.dissipate((force - elastic) * rate);
    Side {
        effort,
        follows: elastic * follows,
    }
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
