//! The rotor of a drive behind a gear.
//!
//! It is a reflected inertia N²·J on the joint's junction, or the full rotor that also rotates with the link that
//! carries it.

use bgdyn_runtime::Dd;

use super::keys::{INERTIA, RATIO};
use super::{Effect, nodes};
use crate::bond_graph::{BondGraph, BondNetwork, Gyrostat, Rotor as RotorStore};
use crate::declaration::{EffectKind, Element, SceneContext, ValueCheck};
use crate::fault::{Faults, Help, wording};
use crate::format::{Dimension, Key, Reads};
use crate::math::Vec3;
use crate::mechanism::{CoordinateId, Mechanism, Parameter, ParameterId, Value};

pub(super) struct RotorEffect;

const JOINT: Key = Key {
    name: "joint",
    reads: Reads::Joint,
    needed: true,
    about: "the joint; the rotor of a `series_elastic` is its own `inertia`",
};
const ON: Key = Key {
    name: "on",
    reads: Reads::Site,
    needed: false,
    about: "the link or frame that the motor sits on: the full rotor, with its gyroscopic terms",
};
const AXIS: Key = Key {
    name: "axis",
    reads: Reads::Vector(&[Dimension::One]),
    needed: false,
    about: "with `on`: the rotor's axis in that frame's axes; z without it",
};

impl EffectKind for RotorEffect {
    fn keyword(&self) -> &'static str {
        "rotor"
    }

    fn family(&self) -> &'static str {
        "rotors"
    }

    fn summary(&self) -> &'static str {
        "rotor behind a gear: N² J on the joint; on a link also its gyroscopic moment N J d(q̇ e)/dt"
    }

    fn symbol(&self) -> &'static str {
        "I"
    }

    fn keys(&self) -> &'static [Key] {
        &[INERTIA, JOINT, RATIO, ON, AXIS]
    }

    fn check_values(&self, check: &mut ValueCheck<'_>) {
        check.not_negative(&[INERTIA], Help::NoBodyHasIt);
        if check.element.vector(&AXIS).is_some() && check.element.name(&ON).is_none() {
            check.report(wording::rotor_axis_without_link(&check.element.location));
        }
    }

    fn check_in_scene(&self, element: &Element, beside: &SceneContext<'_>, faults: &mut Faults) {
        let joint = element.needed_name(&JOINT);
        let mut followers = beside.mechanism.followers();
        let Some((_, coupling, _)) = followers.find(|(own, ..)| own.name == joint) else {
            return;
        };
        let leaders = beside.mechanism.leaders(coupling);
        let [leader] = leaders.as_slice() else {
            let location = &element.location;
            let keyword = self.keyword();
            faults.push(wording::effect_on_follower_of_several(
                location, keyword, joint, &leaders,
            ));
            return;
        };
        if let Some(ratio) = element.quantity(&RATIO).filter(|q| q.parameter.is_some()) {
            let location = &ratio.location;
            faults.push(wording::rotor_ratio_on_follower(location, joint, leader));
        }
    }

    /// Adds its run-time parameters to those of the mechanism, which the graph refers to.
    fn modify_mechanism(&self, element: &Element, mechanism: &mut Mechanism) {
        for (key, quantity) in element.quantities() {
            if let Some(name) = &quantity.parameter {
                let (meaning, unit) = (element.meaning(key), quantity.dimension.si());
                mechanism.parameter(name, meaning, quantity.value, unit);
            }
        }
    }
}

/// Returns the coordinate that a joint follows, and the ratio of the two.
fn follower(mechanism: &Mechanism, joint: &str) -> Option<(CoordinateId, Dd)> {
    let mut followers = mechanism.followers();
    let (own, coupling, _) = followers.find(|(own, ..)| own.name == joint)?;
    let leader = coupling.velocities.first()?;
    Some((*own.degrees.velocities.first()?, leader.ratio))
}

impl Effect for RotorEffect {
    fn modify_graph(&self, element: &Element, mechanism: &Mechanism, graph: &mut BondGraph) {
        let value = |key: &Key, usual: f64| {
            let Some(quantity) = element.quantity(key) else {
                return Value::Fixed(Dd::from_f64(usual));
            };
            let own = |p: &Parameter| Some(&p.name) == quantity.parameter.as_ref();
            match mechanism.parameters().iter().position(own) {
                Some(p) => Value::Parameter(ParameterId(p)),
                None => Value::Fixed(quantity.value),
            }
        };
        let joint = element.needed_name(&JOINT);
        let (coordinate, factor) = match follower(mechanism, joint) {
            Some((leader, factor)) => (Some(leader), factor),
            None => (graph.coordinate_named(joint), Dd::ONE),
        };
        let Some(coordinate) = coordinate else {
            return;
        };
        // Turns of the rotor per turn of the leader.
        let ratio = match value(&RATIO, 1.0) {
            Value::Fixed(ratio) => Value::Fixed(ratio * factor),
            parameter => parameter,
        };
        let carrier = element.name(&ON).and_then(|name| {
            let site = graph.sites.iter().find(|s| s.name == name)?;
            let z = [Dd::ZERO, Dd::ZERO, Dd::ONE];
            let axis = Vec3(element.vector(&AXIS).unwrap_or(z));
            let length = axis.dot(axis).sqrt();
            let axis = site.pose.rotation * axis.map(|x| x / length);
            site.link.map(|link| Gyrostat { link, axis })
        });
        graph.multibody.rotors.push(RotorStore {
            coordinate,
            inertia: value(&INERTIA, 0.0),
            ratio,
            carrier,
        });
    }

    fn elements(&self, element: &Element, _: &[Element], network: &mut BondNetwork) {
        let joint = nodes::port(element, network);
        let rotor = nodes::add_rotor(element, joint, network);
        // Its energy is included in that of the links.
        network.set_powers(rotor, &[]);
        let more = |link| format!("its spin also acts on {link}, which is not drawn");
        network.set_more(rotor, element.name(&ON).map(more));
    }
}
