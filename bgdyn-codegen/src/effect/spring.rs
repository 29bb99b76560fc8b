//! A spring, at a joint or along the line between two sites.

use bgdyn_runtime::Dd;

use super::keys::REFERENCE;
use super::{Effect, nodes};
use crate::bond_graph::{BondNetwork, NodeKind};
use crate::declaration::{EffectKind, Element, ValueCheck};
use crate::effort_sums::EffortSums;
use crate::fault::Help;
use crate::format::{Dimension, Key, Reads};
use crate::layout::{Level, StateLayout};

pub(super) struct Spring;

/// The joint of an effect that can act between two sites instead.
pub(super) const MAYBE_JOINT: Key = Key {
    name: "joint",
    reads: Reads::Coordinate,
    needed: false,
    about: "the joint it acts on",
};

/// The two sites between which an effect acts.
pub(super) const BETWEEN: Key = Key {
    name: "between",
    reads: Reads::Sites,
    needed: false,
    about: "two links or frames: it acts along the line between their origins",
};

const STIFFNESS: Key = Key {
    name: "stiffness",
    reads: Reads::Number(&[Dimension::AngularStiffness, Dimension::Stiffness]),
    needed: true,
    about: "k",
};
const REST: Key = Key {
    name: "rest",
    reads: Reads::Number(&[Dimension::Angle, Dimension::Length]),
    needed: false,
    about: "s₀, coordinate or length at which only the preload acts; 0 without it",
};
const PRELOAD: Key = Key {
    name: "preload",
    reads: Reads::Number(&[Dimension::Torque, Dimension::Force]),
    needed: false,
    about: "f₀, effort at rest, towards smaller s where positive",
};

impl EffectKind for Spring {
    fn keyword(&self) -> &'static str {
        "spring"
    }

    fn family(&self) -> &'static str {
        "springs"
    }

    fn summary(&self) -> &'static str {
        "spring: f = −k (s − r − s₀) − f₀"
    }

    fn symbol(&self) -> &'static str {
        "C"
    }

    fn keys(&self) -> &'static [Key] {
        &[STIFFNESS, REST, PRELOAD, MAYBE_JOINT, BETWEEN, REFERENCE]
    }

    fn check_values(&self, check: &mut ValueCheck<'_>) {
        check.one_of(&[MAYBE_JOINT, BETWEEN]);
        check.not_negative(&[STIFFNESS], Help::StiffnessPushes);
    }

    fn declare(&self, element: &Element, layout: &mut StateLayout) {
        if let Some(reference) = element.name(&REFERENCE) {
            let dimension = match element.joint() {
                Some(joint) => layout.position_of(joint),
                None => Dimension::Length,
            };
            layout.reference(reference, Level::Position, Level::Rate, dimension);
        }
    }
}

impl Effect for Spring {
    fn elements(&self, element: &Element, _: &[Element], network: &mut BondNetwork) {
        nodes::add_acting(element, NodeKind::Compliance, network);
    }

    fn law(&self, element: &Element, sums: &mut EffortSums<'_, '_>) {
        let port = sums.port(element);
        let reference = element.name(&REFERENCE);
        let [location, rate] = [Level::Position, Level::Rate].map(|l| sums.reference(reference, l));
        let stretch = port.displacement - location - sums.number(element, &REST);
        let (stiffness, preload) = (
            sums.number(element, &STIFFNESS),
            sums.number(element, &PRELOAD),
        );
        let effort = -(stiffness * stretch) - preload;
        sums.push(&port, effort);
        sums.store(stretch * (stiffness * stretch * Dd::from_f64(0.5) + preload));
        // The reference moves with ṙ against the reaction of the effort, and supplies power.
        sums.supply(effort * rate);
    }
}
