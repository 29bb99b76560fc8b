//! A gear with losses between a joint's drive and the joint.
//!
//! The joint receives η τ if the drive supplies power (τ q̇ ≥ 0), τ/η if the joint drives the gear.
//!
//! η is the efficiency of gear catalogues, equal in both directions. At rest the gear holds the joint with
//! any effort between the two. The loss is proportional to the load; losses without load belong to the
//! friction of the joint.

use super::keys::JOINT;
use super::{Effect, nodes};
use crate::bond_graph::BondNetwork;
use crate::declaration::{EffectKind, Element, ValueCheck};
use crate::effort_sums::{EffortSums, load_event};
use crate::fault::Help;
use crate::format::{Dimension, Key, Reads};
use crate::layout::StateLayout;

pub(super) struct GearEffect;

const EFFICIENCY: Key = Key {
    name: "efficiency",
    reads: Reads::Number(&[Dimension::One]),
    needed: true,
    about: "η, greater than 0, at most 1",
};

impl EffectKind for GearEffect {
    fn keyword(&self) -> &'static str {
        "gear"
    }

    fn family(&self) -> &'static str {
        "gears"
    }

    fn summary(&self) -> &'static str {
        "gear with losses: η τ where the joint's own effort drives, τ/η where it is driven"
    }

    fn symbol(&self) -> &'static str {
        "TF"
    }

    fn reads_position(&self) -> bool {
        false
    }

    fn keys(&self) -> &'static [Key] {
        &[EFFICIENCY, JOINT]
    }

    fn acts_on_followers(&self) -> bool {
        false
    }

    fn once_per_joint(&self) -> bool {
        true
    }

    fn check_values(&self, check: &mut ValueCheck<'_>) {
        check.positive(&[EFFICIENCY], Help::EfficiencyOfLock);
        check.at_most_one(&EFFICIENCY, Help::EfficiencyAboveOne);
    }

    fn declare(&self, element: &Element, layout: &mut StateLayout) {
        declare_mode(element, &element.name, layout);
    }
}

impl Effect for GearEffect {
    fn elements(&self, element: &Element, _: &[Element], network: &mut BondNetwork) {
        let joint = element.needed_name(&JOINT);
        let efficiency = nodes::number(element, "η", &EFFICIENCY);
        let gear = network.add_to_drive(joint, format!("{}, {efficiency}", element.name));
        network.set_powers(gear, nodes::gear_losses(element, &EFFICIENCY));
    }

    fn law(&self, element: &Element, sums: &mut EffortSums<'_, '_>) {
        sums.gear_of_drive(element, &EFFICIENCY);
    }
}

/// Declares the mode of a gear with losses, with its event, and the event at which its load changes sign,
/// a kink of the law.
pub(super) fn declare_mode(element: &Element, mode: &str, layout: &mut StateLayout) {
    let joint = element.needed_name(&JOINT);
    let rate = layout.motion_in_words(joint, "rate");
    let about =
        format!("whether `{joint}` moves (−1, 1: the sign of {rate}) or its gear holds it (0)");
    layout.mode(mode.to_owned(), about);
    let about = format!("`{joint}` comes to rest, or breaks away from its gear");
    layout.event(mode.to_owned(), about);
    let about = format!("the load of the gear of `{joint}` changes its sign");
    layout.event(load_event(element), about);
}
