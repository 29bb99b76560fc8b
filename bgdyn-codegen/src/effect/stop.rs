//! Compliant stops at a joint's limits, with a given coefficient of restitution.
//!
//! At the depth δ the stop pushes back with k δ (1 + μ δ̇), never inwards (`hunt_crossley.rs`).

use bgdyn_runtime::Dd;

use super::coulomb_smooth::SPEED;
use super::keys::JOINT;
use super::{Effect, hunt_crossley, nodes};
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
        let about = [
            format!("`{joint}` meets a stop"),
            format!("`{joint}` leaves a stop"),
            format!("`{joint}` is pulled off a stop faster than that springs back, or no more"),
        ];
        hunt_crossley::declare(name, layout, about);
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
        hunt_crossley::set_events(&element.name, sums, (gap, follows));
        sums.reading(
            format!("{}_effort", element.name),
            pushed,
            sums.port_units(element)[2],
            "effort of the stops on the joint".into(),
        );
    }
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
    let (restitution, speed) = (value(&RESTITUTION), value(&IMPACT_SPEED));
    let damping = sums.b.constant(hunt_crossley::damping(restitution, speed));
    let (depth, rate) = (depth.max(zero), port.rate * outwards);
    let elastic = sums.number(element, &STIFFNESS) * depth;
    let push = hunt_crossley::push(sums, elastic, (damping, rate));
    let effort = push.force * -outwards;
    sums.push(port, effort);
    sums.store(elastic * depth * Dd::from_f64(0.5));
    sums.dissipate(push.dissipated);
    Side {
        effort,
        follows: push.follows,
    }
}
