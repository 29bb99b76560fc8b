//! A hydraulic cylinder at a joint or along the line between two sites.
//!
//! It is a transformer from the pressures of its two sides to its force, f = p_a A_a − p_b A_b, and two volumes
//! that its motion changes, V_a = V_a0 + A_a (s − s₀), V_b = V_b0 + A_b (H − (s − s₀)). At a rotating joint it is
//! a vane actuator: areas are volumes per angle, the force is a torque.

use super::keys::{FAMILY, FLUID, number};
use super::volume::{add_volume, declare_volume, fill, filled, has_fluid};
use crate::bond_graph::{BondNetwork, NodeKind};
use crate::declaration::{EffectKind, Element, SceneContext, ValueCheck};
use crate::effect::spring::{BETWEEN, MAYBE_JOINT};
use crate::effect::{Effect, nodes};
use crate::effort_sums::EffortSums;
use crate::expr::Expr;
use crate::fault::{Faults, Help, wording};
use crate::format::{Dimension, Key};
use crate::layout::StateLayout;

pub(in crate::effect) struct Cylinder;

/// Volume per displacement: per angle, per length.
const AREA: &[Dimension] = &[Dimension::Volume, Dimension::Area];
const PLACE: &[Dimension] = &[Dimension::Angle, Dimension::Length];
const VOLUME: &[Dimension] = &[Dimension::Volume];

const AREA_A: Key = number(
    "area_a",
    AREA,
    true,
    "A_a, of the side that pushes towards larger s",
);
const AREA_B: Key = number(
    "area_b",
    AREA,
    false,
    "A_b, of the other side; single-acting without it",
);
const DEAD_A: Key = number(
    "dead_a",
    VOLUME,
    false,
    "V_a0, volume of side a at s = s₀; 0 without it",
);
const DEAD_B: Key = number(
    "dead_b",
    VOLUME,
    false,
    "V_b0, volume of side b at s = s₀ + H; 0 without it",
);
const STROKE: Key = number(
    "stroke",
    PLACE,
    false,
    "H; 0 without it, and then V_b0 is the volume at s = s₀",
);
const OFFSET: Key = number(
    "offset",
    PLACE,
    false,
    "s₀, coordinate or length with side a closed; 0 without it",
);

static KEYS: [Key; 9] = [
    AREA_A,
    AREA_B,
    DEAD_A,
    DEAD_B,
    STROKE,
    OFFSET,
    MAYBE_JOINT,
    BETWEEN,
    FLUID,
];

impl EffectKind for Cylinder {
    fn keyword(&self) -> &'static str {
        "cylinder"
    }

    fn family(&self) -> &'static str {
        FAMILY
    }

    fn summary(&self) -> &'static str {
        "hydraulic cylinder: f = p_a A_a − p_b A_b, V_a = V_a0 + A_a (s − s₀), V_b = V_b0 + A_b (H − (s − s₀))"
    }

    fn symbol(&self) -> &'static str {
        "TF"
    }

    fn keys(&self) -> &'static [Key] {
        &KEYS
    }

    fn nodes(&self, given: &dyn Fn(&Key) -> bool) -> &'static [&'static str] {
        if given(&AREA_B) { &["a", "b"] } else { &["a"] }
    }

    fn order(&self) -> u8 {
        0
    }

    fn check_values(&self, check: &mut ValueCheck<'_>) {
        check.one_of(&[MAYBE_JOINT, BETWEEN]);
        check.positive(&[AREA_A, AREA_B], Help::SideIsOptional);
        check.positive(&[STROKE], Help::StrokeIsOptional);
        check.not_negative(&[DEAD_A, DEAD_B], Help::VolumeIsPositive);
        for key in [DEAD_B, STROKE] {
            if check.number(&key).is_some() && check.number(&AREA_B).is_none() {
                check.report(wording::side_without_area(&check.location(&key), key.name));
            }
        }
    }

    fn check_in_scene(&self, element: &Element, beside: &SceneContext<'_>, faults: &mut Faults) {
        has_fluid(element, beside, faults);
    }

    fn declare(&self, element: &Element, layout: &mut StateLayout) {
        for node in element.nodes() {
            declare_volume(&node, layout);
        }
    }

    fn owns_state(&self, element: &Element, state: &str) -> bool {
        element.nodes().iter().any(|node| node == state)
    }
}

impl Effect for Cylinder {
    fn initial_state<'g>(
        &self,
        element: &Element,
        sums: &EffortSums<'g, '_>,
        state: &str,
        entered: Expr<'g>,
    ) -> Expr<'g> {
        filled(element, sums, state, entered)
    }

    fn elements(&self, element: &Element, scene: &[Element], network: &mut BondNetwork) {
        let port = nodes::port(element, network);
        let sides = [("", AREA_A, DEAD_A), ("−", AREA_B, DEAD_B)];
        for (node, (sign, area, dead)) in element.nodes().into_iter().zip(sides) {
            let area = element.written(&area).unwrap_or_default();
            let text = format!("{}, A = {sign}{area}", element.name);
            let side = network.add(NodeKind::Transformer, text);
            network.bond(side, port);
            let dead = element.written(&dead).map(|v| format!("V₀ = {v}"));
            let pressure = add_volume(element, &node, dead, scene, network);
            network.bond(pressure, side);
        }
    }

    fn law(&self, element: &Element, sums: &mut EffortSums<'_, '_>) {
        let port = sums.port(element);
        let name = &element.name;
        let [area_a, area_b, dead_a, dead_b, stroke, offset] =
            [&AREA_A, &AREA_B, &DEAD_A, &DEAD_B, &STROKE, &OFFSET]
                .map(|key| sums.number(element, key));
        let travelled = port.displacement - offset;
        let volumes = [
            dead_a + area_a * travelled,
            dead_b + area_b * (stroke - travelled),
        ];
        let mut force = sums.b.zero();
        let sides = element.nodes().into_iter().zip(volumes);
        for ((node, volume), area) in sides.zip([area_a, -area_b]) {
            let what = format!("the volume of `{node}`, m^3,");
            let way_out = Help::CylinderIsLongEnough.text();
            sums.stays_positive(volume, what, way_out);
            force = force + area * fill(element, &node, volume, sums);
        }
        sums.push(&port, force);
        sums.reading(
            format!("{name}_force"),
            force,
            sums.port_units(element)[2],
            format!("effort of `{name}` towards larger s"),
        );
        sums.reading(
            format!("{name}_length"),
            port.displacement,
            sums.port_units(element)[0],
            format!("coordinate or length s of `{name}`"),
        );
    }
}
