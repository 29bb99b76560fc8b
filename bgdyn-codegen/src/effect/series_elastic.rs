//! Series elasticity: the drive's rotor and its joint, with a spring and a damper between them.
//!
//! The rotor's angle, scaled by the gear to that of the joint (θ), is a coordinate with a store of its
//! own: N²J θ̈ = τ_m − τ, τ = K (θ − q) + D (θ̇ − q̇), and τ drives the joint. This is the reduced model
//! of Spong 1987: the rotor's kinetic energy is that of its own rotation; its mass belongs to its carrier,
//! and its gyroscopic terms are neglected. Motors, friction, stops and inputs act on θ by the effect's
//! name.

use bgdyn_runtime::Dd;

use super::keys::{INERTIA, JOINT, RATIO};
use super::viscous::EFFORT_PER_RATE;
use super::{Effect, nodes};
use crate::bond_graph::{BondNetwork, NodeKind};
use crate::declaration::{EffectKind, Element, ValueCheck};
use crate::effort_sums::EffortSums;
use crate::fault::Help;
use crate::format::{Dimension, Key, Reads};
use crate::layout::StateLayout;

pub(super) struct SeriesElastic;

const STIFFNESS: Key = Key {
    name: "stiffness",
    reads: Reads::Number(&[Dimension::AngularStiffness, Dimension::Stiffness]),
    needed: true,
    about: "K, of the spring, at the joint's scale",
};
const DAMPING: Key = Key {
    name: "damping",
    reads: EFFORT_PER_RATE,
    needed: false,
    about: "damping D, in parallel with the spring; default 0",
};

impl EffectKind for SeriesElastic {
    fn keyword(&self) -> &'static str {
        "series_elastic"
    }

    fn family(&self) -> &'static str {
        "elasticity"
    }

    fn summary(&self) -> &'static str {
        "series elasticity: N²J θ̈ = τ_m − τ, τ = K (θ − q) + D (θ̇ − q̇) on the joint"
    }

    fn symbol(&self) -> &'static str {
        "C"
    }

    fn keys(&self) -> &'static [Key] {
        &[STIFFNESS, DAMPING, INERTIA, RATIO, JOINT]
    }

    fn adds_coordinate(&self) -> bool {
        true
    }

    fn check_values(&self, check: &mut ValueCheck<'_>) {
        check.positive(&[STIFFNESS], Help::SpringIsNeeded);
        check.not_negative(&[DAMPING], Help::DampingDrivesMotion);
        check.positive(&[INERTIA, RATIO], Help::RotorIsNeeded);
    }

    fn declare(&self, element: &Element, layout: &mut StateLayout) {
        let joint = element.needed_name(&JOINT);
        layout.coordinate_beside(&element.name, joint);
    }
}

impl Effect for SeriesElastic {
    fn elements(&self, element: &Element, _: &[Element], network: &mut BondNetwork) {
        let joint = nodes::port(element, network);
        let effort = network.add(NodeKind::Zero, "τ");
        network.bond(effort, joint);
        let drive = network.velocity(&element.name);
        network.bond(drive, effort);
        let stretch = network.add(NodeKind::One, "θ̇ − q̇");
        network.bond(effort, stretch);
        let stiffness = nodes::number(element, "K", &STIFFNESS);
        network.add_on(stretch, NodeKind::Compliance, stiffness);
        if element.quantity(&DAMPING).is_some() {
            let damping = nodes::number(element, "D", &DAMPING);
            network.add_on(stretch, NodeKind::Resistor, damping);
        }
        if network.is_driven(&element.name) {
            network.drive(&element.name);
        }
        nodes::add_rotor(element, drive, network);
    }

    fn law(&self, element: &Element, sums: &mut EffortSums<'_, '_>) {
        let (joint, drive) = (sums.port(element), sums.coordinate(&element.name));
        let (stretch, rate) = (
            drive.displacement - joint.displacement,
            drive.rate - joint.rate,
        );
        let (stiffness, damping) = (
            sums.number(element, &STIFFNESS),
            sums.number(element, &DAMPING),
        );
        let effort = stiffness * stretch + damping * rate;
        sums.push(&joint, effort);
        sums.push(&drive, -effort);
        sums.store(stiffness * stretch * stretch * Dd::from_f64(0.5));
        sums.dissipate(damping * rate * rate);
        let one = sums.b.number(1.0);
        let ratio = sums.optional(element, &RATIO).unwrap_or(one);
        sums.inertia(element, ratio * ratio * sums.number(element, &INERTIA));
        sums.reading(
            format!("{}_effort", element.name),
            effort,
            sums.port_units(element)[2],
            "effort of spring and damper on the joint".into(),
        );
    }
}
