//! Smooth friction with a Stribeck curve, at the slip s = q̇ − ṙ:
//! τ = −[F_c + (F_s − F_c) exp(−(s/v_s)²)] tanh(s/w) − b s.
//!
//! The curve falls from F_s to F_c with the speed (Stribeck 1902; the exponential form of Bo and Pavelescu
//! 1982), the hyperbolic tangent smooths it at rest (Andersson, Söderberg, Björklund 2007). The tangent
//! rises over the width w while the curve falls, so the peak is F_s only if w ≪ v_s. Like every law
//! without memory it never holds, but creeps.

use super::coulomb::EFFORT;
use super::coulomb_smooth::{SPEED, WIDTH};
use super::keys::{JOINT, REFERENCE};
use super::viscous::EFFORT_PER_RATE;
use super::{Effect, nodes, slip};
use crate::bond_graph::{BondNetwork, NodeKind};
use crate::declaration::{EffectKind, Element, ValueCheck};
use crate::effort_sums::EffortSums;
use crate::expr::Expr;
use crate::fault::{Help, wording};
use crate::format::Key;
use crate::layout::StateLayout;

pub(super) struct Stribeck;

/// The effort at the upper end of the curve.
pub(super) const KINETIC: Key = Key {
    name: "kinetic",
    reads: EFFORT,
    needed: true,
    about: "F_c, Coulomb friction",
};

/// The effort at its lower end.
const STATIC: Key = Key {
    name: "static",
    reads: EFFORT,
    needed: true,
    about: "F_s, friction close to rest",
};

/// The speed over which the curve falls.
const STRIBECK_SPEED: Key = Key {
    name: "stribeck_speed",
    reads: SPEED,
    needed: true,
    about: "v_s, speed of the Stribeck curve",
};

const DAMPING: Key = Key {
    name: "damping",
    reads: EFFORT_PER_RATE,
    needed: false,
    about: "b, viscous friction; 0 without it",
};

impl EffectKind for Stribeck {
    fn keyword(&self) -> &'static str {
        "stribeck"
    }

    fn family(&self) -> &'static str {
        "friction"
    }

    fn summary(&self) -> &'static str {
        "Stribeck friction: τ = −[F_c + (F_s − F_c) exp(−(s/v_s)²)] tanh(s/w) − b s, s = q̇ − ṙ"
    }

    fn symbol(&self) -> &'static str {
        "R"
    }

    fn reads_position(&self) -> bool {
        false
    }

    fn keys(&self) -> &'static [Key] {
        &[
            KINETIC,
            STATIC,
            STRIBECK_SPEED,
            WIDTH,
            DAMPING,
            JOINT,
            REFERENCE,
        ]
    }

    fn check_values(&self, check: &mut ValueCheck<'_>) {
        check.not_negative(&[KINETIC, DAMPING], Help::FrictionOpposes);
        check.ordered(&KINETIC, &STATIC, Help::RestHoldsMore);
        check.positive(&[STRIBECK_SPEED], Help::CurveIsOptional);
        check.positive(&[WIDTH], Help::WidthOfJump);
        let [width, speed] = [WIDTH, STRIBECK_SPEED].map(|key| check.value_or(&key, 0.0));
        if speed > 0.0 && width > speed {
            let location = check.location(&WIDTH);
            let text = |key| check.number(key).map_or("", |q| q.text.as_str());
            let (width, speed) = (text(&WIDTH), text(&STRIBECK_SPEED));
            check.report(wording::width_above_stribeck_speed(&location, width, speed));
        }
    }

    fn declare(&self, element: &Element, layout: &mut StateLayout) {
        slip::declare(element, layout);
    }
}

impl Effect for Stribeck {
    fn elements(&self, element: &Element, _: &[Element], network: &mut BondNetwork) {
        nodes::add_acting(element, NodeKind::Resistor, network);
    }

    fn law(&self, element: &Element, sums: &mut EffortSums<'_, '_>) {
        slip::resist(element, sums, |sums, s| {
            let number = |key| sums.number(element, key);
            let friction = curve(element, sums, s) * (s / number(&WIDTH)).tanh();
            -(friction + number(&DAMPING) * s)
        });
    }
}

/// Returns F_c + (F_s − F_c) exp(−(s/v_s)²); F_c without the key `static`.
pub(super) fn curve<'g>(element: &Element, sums: &EffortSums<'g, '_>, slip: Expr<'g>) -> Expr<'g> {
    let kinetic = sums.number(element, &KINETIC);
    let [rest, speed] = [&STATIC, &STRIBECK_SPEED].map(|key| sums.optional(element, key));
    match (rest, speed) {
        (Some(rest), Some(speed)) => {
            let ratio = slip / speed;
            kinetic + (rest - kinetic) * (-(ratio * ratio)).exp()
        }
        _ => kinetic,
    }
}
