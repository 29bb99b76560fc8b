//! What acts at joints, as effects that the mechanism declares.

use super::mimic::{Relation, relation};
use super::model::{JointEffects, Model};
use super::naming::{free_name, shown};
use super::number::Num;
use super::writing::Effect;
use bgdyn_runtime::Dd;
use std::collections::HashSet;

impl JointEffects {
    /// Returns whether nothing acts.
    pub(super) fn is_empty(&self) -> bool {
        let parts = [&self.damping, &self.friction, &self.stiffness, &self.rotor];
        parts.into_iter().all(Option::is_none)
    }

    /// Returns the same effects at the leader of a follower: their power is the same for every motion.
    fn at_leader(&self, relation: &Relation) -> JointEffects {
        let Relation { ratio, offset, .. } = *relation;
        let scaled = |number: &Option<Num>, by: Dd| {
            let number = number.as_ref();
            number.map(|number| Num::computed((number.exact() * by).to_f64()))
        };
        let square = ratio * ratio;
        let rest = self.rest.as_ref().map_or(Dd::ZERO, Num::exact);
        let rest = (rest - offset) / ratio;
        JointEffects {
            damping: scaled(&self.damping, square),
            friction: scaled(&self.friction, ratio.abs()),
            stiffness: scaled(&self.stiffness, square),
            rest: Some(Num::computed(rest.to_f64())),
            rotor: scaled(&self.rotor, square),
        }
    }

    /// Returns the effects.
    fn list(self) -> Vec<JointEffect> {
        let rest = self.rest.filter(|rest| !rest.is_zero());
        let parts = [
            ("damping", "viscous", "damping", self.damping, None),
            ("friction", "coulomb", "kinetic", self.friction, None),
            ("spring", "spring", "stiffness", self.stiffness, rest),
            ("rotor", "rotor", "inertia", self.rotor, None),
        ];
        let parts = parts.into_iter();
        let parts = parts.filter_map(|(ending, kind, key, value, rest)| {
            let rest = rest.map(|rest| ("rest", rest));
            Some(JointEffect {
                ending,
                kind,
                keys: std::iter::once((key, value?)).chain(rest).collect(),
            })
        });
        parts.collect()
    }
}

/// One thing that acts at a joint.
struct JointEffect {
    /// The ending of its name.
    ending: &'static str,
    kind: &'static str,
    keys: Vec<(&'static str, Num)>,
}

/// Returns the effects at the joints with these names; those of followers act at their leaders. `taken` are
/// the names in use.
pub(super) fn effects<'a>(
    model: &Model,
    names: &'a [String],
    mut taken: HashSet<String>,
) -> Vec<Effect<'a>> {
    let mut effects = Vec::new();
    for (joint, own_name) in model.joints.iter().zip(names) {
        let relation = relation(model, joint);
        let (acting, at) = match &relation {
            Some(relation) => (joint.effects.at_leader(relation), &names[relation.leader]),
            None => (joint.effects.clone(), own_name),
        };
        for JointEffect { ending, kind, keys } in acting.list() {
            let name = free_name(&format!("{own_name}_{ending}"), &taken);
            taken.insert(name.clone());
            effects.push(Effect {
                name,
                kind,
                joint: at,
                keys,
            });
        }
    }
    effects
}

/// Returns a line that names the followers whose effects act at their leaders.
pub(super) fn moved(model: &Model) -> Option<String> {
    let joints = model.joints.iter();
    let moved = joints.filter(|joint| joint.mimic.is_some() && !joint.effects.is_empty());
    let names: Vec<String> = moved
        .map(|joint| format!("`{}`", shown(&joint.name)))
        .collect();
    (!names.is_empty()).then(|| {
        let names = names.join(", ");
        format!("what acts at followers acts at their leaders, with the ratio in it: {names}")
    })
}
