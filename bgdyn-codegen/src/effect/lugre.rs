//! LuGre friction: the deflection z of bristles between the surfaces is a state.
//!
//! The law is that of Canudas de Wit, Olsson, Åström and Lischinsky 1995.
//!
//! With the bristle energy σ₀z²/2, the slip s dissipates |s| (g u² − σ₁ |s| u + (σ₁ + σ₂) |s|), u =
//! ±σ₀z/g. This is nonnegative at every speed with u ≤ F_s/F_c only if σ₂ ≥ σ₁ (F_s − F_c)/F_c. Barabanov
//! and Ortega 2000 show that this condition is also necessary for passivity, with any energy function.

use bgdyn_runtime::Dd;

use super::coulomb::EFFORT;
use super::coulomb_smooth::SPEED;
use super::keys::{JOINT, REFERENCE};
use super::stribeck::{KINETIC, curve};
use super::viscous::EFFORT_PER_RATE;
use super::{Effect, nodes, slip};
use crate::bond_graph::{BondNetwork, NodeKind, PowerTerm};
use crate::declaration::{EffectKind, Element, ValueCheck};
use crate::effort_sums::EffortSums;
use crate::fault::{Help, wording};
use crate::format::{Dimension, Key, Reads};
use crate::layout::{Level, StateLayout};

pub(super) struct LuGre;

const STIFFNESS: Key = Key {
    name: "stiffness",
    reads: Reads::Number(&[Dimension::AngularStiffness, Dimension::Stiffness]),
    needed: true,
    about: "σ₀, stiffness of the bristles",
};
const DAMPING: Key = Key {
    name: "damping",
    reads: EFFORT_PER_RATE,
    needed: false,
    about: "σ₁, damping of the bristles",
};
const VISCOUS: Key = Key {
    name: "viscous",
    reads: EFFORT_PER_RATE,
    needed: false,
    about: "σ₂, viscous friction",
};
const STATIC: Key = Key {
    name: "static",
    reads: EFFORT,
    needed: false,
    about: "F_s, friction at rest; F_c without it",
};
const STRIBECK_SPEED: Key = Key {
    name: "stribeck_speed",
    reads: SPEED,
    needed: false,
    about: "v_s, speed of the Stribeck curve; needed where F_s is given",
};

impl EffectKind for LuGre {
    fn keyword(&self) -> &'static str {
        "lugre"
    }

    fn family(&self) -> &'static str {
        "friction"
    }

    fn summary(&self) -> &'static str {
        "LuGre friction: τ = −(σ₀ z + σ₁ ż + σ₂ s), ż = s − σ₀ |s| z / g(s), g = F_c + (F_s − F_c) exp(−(s/v_s)²)"
    }

    fn symbol(&self) -> &'static str {
        "R"
    }

    fn reads_position(&self) -> bool {
        false
    }

    fn keys(&self) -> &'static [Key] {
        &[
            STIFFNESS,
            DAMPING,
            VISCOUS,
            KINETIC,
            STATIC,
            STRIBECK_SPEED,
            JOINT,
            REFERENCE,
        ]
    }

    fn check_values(&self, check: &mut ValueCheck<'_>) {
        check.positive(
            &[STIFFNESS, KINETIC, STRIBECK_SPEED],
            Help::BristlesNeedRest,
        );
        check.not_negative(&[DAMPING, VISCOUS], Help::BristlesDriveJoint);
        check.ordered(&KINETIC, &STATIC, Help::RestHoldsMore);
        if check.number(&STATIC).is_some() && check.number(&STRIBECK_SPEED).is_none() {
            let location = check.location(&STATIC);
            check.report(wording::no_stribeck_speed(&location));
        }
        let [damping, viscous] = [DAMPING, VISCOUS].map(|key| check.value_or(&key, 0.0));
        let kinetic = check.value_or(&KINETIC, 1.0);
        let excess = (check.value_or(&STATIC, kinetic) - kinetic) / kinetic;
        if viscous < damping * excess {
            let location = check.location(&DAMPING);
            let least = damping * excess;
            check.report(wording::friction_feeds_energy(&location, least));
        }
    }

    fn declare(&self, element: &Element, layout: &mut StateLayout) {
        let joint = element.needed_name(&JOINT);
        let dimension = layout.position_of(joint);
        let about = format!("deflection of the bristles at `{joint}`");
        layout.state(element.name.clone(), dimension, about);
        let kink = format!("the slip at `{joint}` changes its sign: the law has a kink there");
        layout.event(element.name.clone(), kink);
        slip::declare(element, layout);
    }
}

impl Effect for LuGre {
    fn elements(&self, element: &Element, _: &[Element], network: &mut BondNetwork) {
        let friction = nodes::add_acting(element, NodeKind::Resistor, network);
        // The bristles store energy.
        network.set_powers(friction, &[PowerTerm::Stored, PowerTerm::Dissipated]);
    }

    fn law(&self, element: &Element, sums: &mut EffortSums<'_, '_>) {
        let port = sums.port(element);
        let counterpart = sums.reference(element.name(&REFERENCE), Level::Rate);
        let slip = port.rate - counterpart;
        let z = sums.state(&element.name);
        let number = |key: &Key| sums.number(element, key);
        let (stiffness, damping, viscous) =
            (number(&STIFFNESS), number(&DAMPING), number(&VISCOUS));
        let rate = slip - stiffness * slip.abs() * z / curve(element, sums, slip);
        sums.flow(&element.name, rate);
        let effort = -(stiffness * z + damping * rate + viscous * slip);
        sums.push(&port, effort);
        sums.supply(effort * counterpart);
        sums.store(stiffness * z * z * Dd::from_f64(0.5));
        // The power from the slip minus the rate of the bristles' energy, σ₀ z ż.
        sums.dissipate(-(effort * slip) - stiffness * z * rate);
        sums.event(&element.name, slip);
    }
}
