//! A body carried by a link.
//!
//! It becomes a link of the mechanism, fixed at the site, before the graph is built. Its known parameters become
//! part of the base parameters of its carrier; a run-time parameter attaches it, and detaches it if set to 0.

use bgdyn_runtime::Dd;

use super::Effect;
use super::keys::AT;
use super::wrench::moves;
use crate::bond_graph::BondNetwork;
use crate::declaration::{EffectKind, Element, Quantity, SceneContext, ValueCheck};
use crate::fault::{Faults, Help};
use crate::format::{Dimension, Key, Reads};
use crate::math::Vec3;
use crate::mechanism::{Inertial, Mechanism, Pose, Tensor, Value, check_tensor};

pub(super) struct Payload;

const COM_NAMES: [&str; 3] = ["com.x", "com.y", "com.z"];
const INERTIA_NAMES: [&str; 6] = [
    "inertia.xx",
    "inertia.yy",
    "inertia.zz",
    "inertia.xy",
    "inertia.xz",
    "inertia.yz",
];

const MASS: Key = Key {
    name: "mass",
    reads: Reads::Number(&[Dimension::Mass]),
    needed: true,
    about: "its mass",
};
const COM: Key = Key {
    name: "com",
    reads: Reads::Group(&COM_NAMES, &[Dimension::Length]),
    needed: false,
    about: "its centre of mass in the axes of the place; the origin without it",
};
const INERTIA: Key = Key {
    name: "inertia",
    reads: Reads::Group(&INERTIA_NAMES, &[Dimension::Inertia]),
    needed: false,
    about: "its tensor about the centre of mass in the axes of the place; a point mass without it",
};

impl EffectKind for Payload {
    fn keyword(&self) -> &'static str {
        "payload"
    }

    fn family(&self) -> &'static str {
        "payloads"
    }

    fn summary(&self) -> &'static str {
        "carried body: mass, centre of mass and tensor join those of its link"
    }

    fn symbol(&self) -> &'static str {
        "I"
    }

    fn keys(&self) -> &'static [Key] {
        &[MASS, AT, COM, INERTIA]
    }

    fn check_values(&self, check: &mut ValueCheck<'_>) {
        check.not_negative(&[MASS], Help::NoBodyHasIt);
        let given: [_; 6] = check.element.group(&INERTIA);
        let entries = given.map(|(_, entry)| entry.map_or(Dd::ZERO, |q| q.value));
        if let Some(first) = given.into_iter().find_map(|(_, entry)| entry) {
            check_tensor(&first.location, &entries, check.faults);
        }
    }

    fn check_in_scene(&self, element: &Element, beside: &SceneContext<'_>, faults: &mut Faults) {
        moves(element, beside, faults);
    }

    fn modify_mechanism(&self, element: &Element, mechanism: &mut Mechanism) {
        let mut value = |(name, quantity): (&str, Option<&Quantity>)| match quantity {
            None => Value::Fixed(Dd::ZERO),
            Some(q) => match &q.parameter {
                None => Value::Fixed(q.value),
                Some(parameter) => {
                    let (meaning, unit) = (element.meaning(name), q.dimension.si());
                    mechanism.parameter(parameter, meaning, q.value, unit)
                }
            },
        };
        let inertial = Inertial {
            mass: value((MASS.name, element.quantity(&MASS))),
            com: Vec3(element.group(&COM).map(&mut value)),
            inertia: Tensor {
                entries: element.group(&INERTIA).map(&mut value),
                axes: Pose::IDENTITY.rotation,
            },
        };
        mechanism.carry(&element.name, element.needed_name(&AT), inertial);
    }
}

impl Effect for Payload {
    fn elements(&self, _: &Element, _: &[Element], _: &mut BondNetwork) {
        // It is a link of the mechanism.
    }
}
