//! Rigid contact: surfaces that do not overlap, Coulomb friction, restitution.
//!
//! In the graph it is a resistor with a set-valued law: along the normal a diode, which is a source of the flow 0 while it is
//! closed (0 ≤ g ⟂ λ_n ≥ 0) and of the effort 0 while it is open; so that no causality is assigned to it for good. It takes
//! energy only by friction and at impacts.
//!
//! Its forces and impulses are in no law: they follow from all contacts at once, in the integrator.

use super::super::keys::optional_number;
use super::super::{Effect, nodes};
use super::one_law;
use crate::bond_graph::{BondNetwork, NodeKind};
use crate::declaration::{EffectKind, Element, SceneContext, ValueCheck};
use crate::effort_sums::EffortSums;
use crate::fault::{Faults, Help};
use crate::format::{Dimension, Key};
use crate::layout::StateLayout;

pub(in crate::effect) struct RigidContact;

const FRICTION: Key = optional_number(
    "friction",
    &[Dimension::One],
    "μ, the coefficient of friction, at rest and while slipping; no friction without it",
);
const RESTITUTION: Key = optional_number(
    "restitution",
    &[Dimension::One],
    "e, normal speed after an impact to the speed before it (Newton); 0 without it",
);

impl EffectKind for RigidContact {
    fn keyword(&self) -> &'static str {
        "rigid_contact"
    }

    fn family(&self) -> &'static str {
        "contact"
    }

    fn summary(&self) -> &'static str {
        "rigid contact: 0 ≤ g ⟂ λ_n ≥ 0, |λ_t| ≤ μ λ_n and against the slip, γ_n⁺ = −e γ_n⁻ at impacts; by the integrator `moreau`, or from event to event by others"
    }

    fn symbol(&self) -> &'static str {
        "R"
    }

    fn keys(&self) -> &'static [Key] {
        &[FRICTION, RESTITUTION, super::CONTACT]
    }

    fn check_values(&self, check: &mut ValueCheck<'_>) {
        check.not_negative(&[FRICTION], Help::FrictionOpposes);
        check.not_negative(&[RESTITUTION], Help::RestitutionAboveOne);
        check.at_most_one(&RESTITUTION, Help::RestitutionAboveOne);
    }

    fn check_in_scene(&self, element: &Element, beside: &SceneContext<'_>, faults: &mut Faults) {
        one_law(element, beside, faults);
    }

    fn declare(&self, element: &Element, layout: &mut StateLayout) {
        layout.rigid_contacts.push(element.name.clone());
    }
}

impl Effect for RigidContact {
    fn elements(&self, element: &Element, _: &[Element], network: &mut BondNetwork) {
        let port = nodes::contact(element, network);
        network.add_on(port, NodeKind::Resistor, nodes::label(element));
    }

    fn law(&self, element: &Element, sums: &mut EffortSums<'_, '_>) {
        let [friction, restitution] = [&FRICTION, &RESTITUTION]
            .map(|key| sums.optional(element, key).unwrap_or(sums.b.zero()));
        let (gap, [x, y, _]) = sums.touch(element, friction, restitution);
        let mut add = |end: &str, value, unit, about: &str| {
            sums.reading(
                format!("{}_{end}", element.name),
                value,
                unit,
                about.to_owned(),
            );
        };
        add("gap", gap, "m", "distance of the surfaces");
        add(
            "slip",
            (x * x + y * y).sqrt(),
            "m/s",
            "speed along the plane of contact",
        );
    }
}
