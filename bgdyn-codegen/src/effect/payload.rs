//! A body carried by a link. It becomes a link of the mechanism, fixed at the site, before the graph is
//! built. Its known parameters become part of the base parameters of its carrier; a run-time parameter
//! attaches it, and detaches it if set to 0.

use bgdyn_runtime::Dd;

use super::Effect;
use super::wrench::{AT, moves};
use crate::bond_graph::BondNetwork;
use crate::declaration::{EffectKind, Element, SceneContext, ValueCheck};
use crate::fault::Faults;
use crate::format::{Dimension, Key, Reads};
use crate::math::Vec3;
use crate::mechanism::{Inertial, Mechanism, Pose, Tensor, Value, check_tensor};

pub(super) struct Payload;

const COM: [&str; 3] = ["com.x", "com.y", "com.z"];
const INERTIA: [&str; 6] = [
    "inertia.xx",
    "inertia.yy",
    "inertia.zz",
    "inertia.xy",
    "inertia.xz",
    "inertia.yz",
];

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
        &[
            Key {
                name: "mass",
                reads: Reads::Number(&[Dimension::Mass]),
                needed: true,
                about: "its mass",
            },
            AT,
            Key {
                name: "com",
                reads: Reads::Group(&COM, &[Dimension::Length]),
                needed: false,
                about: "its centre of mass in the axes of the place; the origin without it",
            },
            Key {
                name: "inertia",
                reads: Reads::Group(&INERTIA, &[Dimension::Inertia]),
                needed: false,
                about: "its tensor about the centre of mass in the axes of the place; a point mass without it",
            },
        ]
    }

    fn check_values(&self, check: &mut ValueCheck<'_>) {
        check.not_negative(&["mass"], "no body has it");
        let entries = INERTIA.map(|key| check.number(key).map_or(Dd::ZERO, |q| q.value));
        let first = INERTIA.into_iter().find(|key| check.number(key).is_some());
        if let Some(first) = first {
            let location = check.location(first);
            check_tensor(&location, &entries, check.faults);
        }
    }

    fn check_in_scene(&self, element: &Element, beside: &SceneContext<'_>, faults: &mut Faults) {
        moves(element, beside, faults);
    }

    fn modify_mechanism(&self, element: &Element, mechanism: &mut Mechanism) {
        let mut value = |key: &str| match element.quantity(key) {
            None => Value::Fixed(Dd::ZERO),
            Some(q) => match &q.parameter {
                None => Value::Fixed(q.value),
                Some(name) => {
                    let (meaning, unit) = (element.meaning(key), q.dimension.si());
                    mechanism.parameter(name, meaning, q.value, unit)
                }
            },
        };
        let inertial = Inertial {
            mass: value("mass"),
            com: Vec3(COM.map(&mut value)),
            inertia: Tensor {
                entries: INERTIA.map(&mut value),
                axes: Pose::IDENTITY.rotation,
            },
        };
        mechanism.carry(
            &element.name,
            element.name(AT.name).unwrap_or_default(),
            inertial,
        );
    }
}

impl Effect for Payload {
    fn elements(&self, _: &Element, _: &[Element], _: &mut BondNetwork) {
        // It is a link of the mechanism.
    }
}
