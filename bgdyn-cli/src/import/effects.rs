//! What acts at joints, as effects that the mechanism declares.

use super::model::{JointEffects, Model};
use super::naming::free_name;
use super::number::Num;
use super::writing::Effect;
use std::collections::HashSet;

impl JointEffects {
    /// Returns whether nothing acts.
    pub(super) fn is_empty(&self) -> bool {
        let parts = [&self.damping, &self.friction, &self.stiffness, &self.rotor];
        parts.into_iter().all(Option::is_none)
    }

    /// Returns the effects.
    fn list(&self) -> Vec<JointEffect<'_>> {
        let rest = self.rest.as_ref().filter(|rest| !rest.is_zero());
        let parts = [
            ("damping", "viscous", "damping", &self.damping, None),
            ("friction", "coulomb", "kinetic", &self.friction, None),
            ("spring", "spring", "stiffness", &self.stiffness, rest),
            ("rotor", "rotor", "inertia", &self.rotor, None),
        ];
        let parts = parts
            .into_iter()
            .filter_map(|(ending, kind, key, value, rest)| {
                let first = (key, value.as_ref()?);
                let rest = rest.map(|rest| ("rest", rest));
                Some(JointEffect {
                    ending,
                    kind,
                    keys: std::iter::once(first).chain(rest).collect(),
                })
            });
        parts.collect()
    }
}

/// One thing that acts at a joint.
struct JointEffect<'a> {
    /// The ending of its name.
    ending: &'static str,
    kind: &'static str,
    keys: Vec<(&'static str, &'a Num)>,
}

/// Returns the effects at the joints with these names. `taken` are the names in use.
pub(super) fn effects<'a>(
    model: &'a Model,
    names: &'a [String],
    mut taken: HashSet<String>,
) -> Vec<Effect<'a>> {
    let mut effects = Vec::new();
    for (joint, joint_name) in model.joints.iter().zip(names) {
        for JointEffect { ending, kind, keys } in joint.effects.list() {
            let name = free_name(&format!("{joint_name}_{ending}"), &taken);
            taken.insert(name.clone());
            effects.push(Effect {
                name,
                kind,
                joint: joint_name,
                keys,
            });
        }
    }
    effects
}
