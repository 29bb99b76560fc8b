//! Effects of a spec that the predicted efforts do not contain.

use bgdyn_codegen::declaration::Declaration;
use bgdyn_identification::{JointPart, LogFault};

use crate::identify::{EffectNumber, word};

/// Families that are not part of the effort that a motion needs: they supply it.
const DRIVES: [&str; 4] = ["motors", "gears", "elasticity", "hydraulics"];

/// Returns lines about effects that efforts do not contain, where no limit is concerned. `effects` are those of one
/// joint each or of sites, `counted` the numbers that the efforts contain.
///
/// # Errors
/// Such effects at joints with a limit of effort: the limit cannot be checked. An effect between or at links concerns
/// all joints.
pub(crate) fn missing_effects(
    effects: &[Declaration],
    counted: &[EffectNumber],
    joints: &[JointPart],
) -> Result<Vec<String>, Vec<LogFault>> {
    let (mut lines, mut faults) = (Vec::new(), Vec::new());
    for effect in effects.iter().filter(|effect| !is_none(effect, counted)) {
        let (name, word) = (&effect.name.value, effect.effect.keyword());
        let limited: Vec<&str> = concerned(effect, joints)
            .filter(|joint| joint.effort.is_some())
            .map(|joint| joint.name.as_str())
            .collect();
        let what = format!("the efforts do not contain the effect `{name}` ({word})");
        if limited.is_empty() {
            lines.push(what);
            continue;
        }
        let message = format!(
            "{what}, so that limits of effort cannot be checked: joints {}",
            limited.join(", ")
        );
        faults.push(LogFault::whole("effort-incomplete", message).with_help(
            "take `effort` out of the limits of these joints, or the effect out of the file, for the plan",
        ));
    }
    match faults.is_empty() {
        true => Ok(lines),
        false => Err(faults),
    }
}

/// Returns whether nothing of an effect is missing: it is counted, it is a drive, or it is a stop at the limits of its
/// joint, which the motion does not reach.
fn is_none(effect: &Declaration, counted: &[EffectNumber]) -> bool {
    let kind = effect.effect;
    let has = |key: &str| effect.fields.get(kind.key(key)).is_some();
    let stop = kind.family() == "stops" && !has("lower") && !has("upper");
    let own = counted.iter().any(|own| own.name == effect.name.value);
    kind.built_in() || stop || own || DRIVES.contains(&kind.family())
}

/// Returns the joints that an effect acts on; all of them where it acts elsewhere.
fn concerned<'a>(
    effect: &Declaration,
    joints: &'a [JointPart],
) -> impl Iterator<Item = &'a JointPart> {
    let own = effect
        .effect
        .joint_key()
        .and_then(|key| word(effect, key.name));
    let own = own.filter(|name| joints.iter().any(|joint| joint.name == *name));
    joints
        .iter()
        .filter(move |joint| own.as_ref().is_none_or(|own| *own == joint.name))
}
