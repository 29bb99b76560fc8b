//! Drag of a medium at rest on a site of a link.
//!
//! It is f = −(c₁ + c₂ |v|) v against the velocity v of its origin, m = −c_ω ω against its angular velocity. c₁
//! is Stokes' drag, c₂ = ½ ρ C_d A Newton's.

use super::keys::{AT, optional_number};
use super::wrench::{act, moves, twist};
use super::{Effect, nodes};
use crate::bond_graph::{BondNetwork, NodeKind};
use crate::declaration::{EffectKind, Element, SceneContext, ValueCheck};
use crate::effort_sums::EffortSums;
use crate::fault::{Faults, Help, wording};
use crate::format::{Dimension, Key};
use crate::math::Vec3;

pub(super) struct Drag;

const QUADRATIC: Key = optional_number(
    "quadratic",
    &[Dimension::QuadraticDamping],
    "c₂, force per square of the speed: ½ ρ C_d A",
);
const ANGULAR: Key = optional_number(
    "angular",
    &[Dimension::AngularDamping],
    "c_ω, moment per angular speed",
);
const LINEAR: Key = optional_number("linear", &[Dimension::Damping], "c₁, force per speed");

static KEYS: [Key; 4] = [AT, LINEAR, QUADRATIC, ANGULAR];

impl EffectKind for Drag {
    fn keyword(&self) -> &'static str {
        "drag"
    }

    fn family(&self) -> &'static str {
        "drag"
    }

    fn summary(&self) -> &'static str {
        "drag: f = −(c₁ + c₂ |v|) v, m = −c_ω ω"
    }

    fn symbol(&self) -> &'static str {
        "R"
    }

    fn keys(&self) -> &'static [Key] {
        &KEYS
    }

    fn check_values(&self, check: &mut ValueCheck<'_>) {
        let numbers = [LINEAR, QUADRATIC, ANGULAR];
        check.not_negative(&numbers, Help::DragDrivesLink);
        if numbers.iter().all(|key| check.number(key).is_none()) {
            check.report(wording::no_drag(
                &check.element.location,
                &check.element.name,
            ));
        }
    }

    fn check_in_scene(&self, element: &Element, beside: &SceneContext<'_>, faults: &mut Faults) {
        moves(element, beside, faults);
    }
}

impl Effect for Drag {
    fn elements(&self, element: &Element, _: &[Element], network: &mut BondNetwork) {
        let site = nodes::site(element, network);
        network.add_on(site, NodeKind::Resistor, nodes::label(element));
    }

    fn law(&self, element: &Element, sums: &mut EffortSums<'_, '_>) {
        let site = sums.site(element.needed_name(&AT));
        let jacobian = sums.jacobian(site);
        let [wx, wy, wz, vx, vy, vz] = twist(&jacobian, sums);
        let (omega, v) = (Vec3([wx, wy, wz]), Vec3([vx, vy, vz]));
        let [linear, angular] = [&LINEAR, &ANGULAR].map(|key| sums.number(element, key));
        let factor = match sums.optional(element, &QUADRATIC) {
            Some(quadratic) => linear + quadratic * v.dot(v).sqrt(),
            None => linear,
        };
        let ([mx, my, mz], [fx, fy, fz]) = (omega.scale(-angular).0, v.scale(-factor).0);
        act(&jacobian, &[mx, my, mz, fx, fy, fz], sums);
        sums.dissipate(factor * v.dot(v) + angular * omega.dot(omega));
    }
}
