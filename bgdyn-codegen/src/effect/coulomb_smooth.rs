//! Coulomb friction smoothed over a given width: τ = −F tanh(s/w) at the slip s = q̇ − ṙ.
//!
//! At |s| = w it is 76 % of F, at 2.65 w 99 %. It never holds: under a load τ₀ < F the joint creeps at w
//! artanh(τ₀/F). Its steepest slope is F/w, a damping that a step of integration must resolve. The effects
//! `coulomb` and `lugre` can hold.

use super::coulomb::EFFORT;
use super::keys::{JOINT, REFERENCE};
use super::{Effect, nodes, slip};
use crate::bond_graph::{BondNetwork, NodeKind};
use crate::declaration::{EffectKind, Element, ValueCheck};
use crate::effort_sums::EffortSums;
use crate::fault::Help;
use crate::format::{Dimension, Key, Reads};
use crate::layout::StateLayout;

pub(super) struct CoulombSmooth;

/// The slip over which a law is smoothed, and other speeds of friction.
pub(super) const SPEED: Reads = Reads::Number(&[Dimension::AngularSpeed, Dimension::Speed]);

/// The width of a smoothed law.
pub(super) const WIDTH: Key = Key {
    name: "width",
    reads: SPEED,
    needed: true,
    about: "w, the slip at which friction has 76 % (tanh 1) of its size",
};

const KINETIC: Key = Key {
    name: "kinetic",
    reads: EFFORT,
    needed: true,
    about: "F, the effort far above the width",
};

impl EffectKind for CoulombSmooth {
    fn keyword(&self) -> &'static str {
        "coulomb_smooth"
    }

    fn family(&self) -> &'static str {
        "friction"
    }

    fn summary(&self) -> &'static str {
        "smooth Coulomb friction: τ = −F tanh(s/w), s = q̇ − ṙ"
    }

    fn symbol(&self) -> &'static str {
        "R"
    }

    fn reads_position(&self) -> bool {
        false
    }

    fn keys(&self) -> &'static [Key] {
        &[KINETIC, WIDTH, JOINT, REFERENCE]
    }

    fn check_values(&self, check: &mut ValueCheck<'_>) {
        check.not_negative(&[KINETIC], Help::FrictionOpposes);
        check.positive(&[WIDTH], Help::WidthOfJump);
    }

    fn declare(&self, element: &Element, layout: &mut StateLayout) {
        slip::declare(element, layout);
    }
}

impl Effect for CoulombSmooth {
    fn elements(&self, element: &Element, _: &[Element], network: &mut BondNetwork) {
        nodes::add_acting(element, NodeKind::Resistor, network);
    }

    fn law(&self, element: &Element, sums: &mut EffortSums<'_, '_>) {
        slip::resist(element, sums, |sums, s| {
            let number = |key| sums.number(element, key);
            -(number(&KINETIC) * (s / number(&WIDTH)).tanh())
        });
    }
}
