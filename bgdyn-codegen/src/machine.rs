//! A machine: a mechanism and the effects that its file declares for scenes.

use bgdyn_runtime::Dd;

use crate::declaration::{
    Declaration, EachOf, EffectKinds, NameScope, RejectedEffects, check_unique_names,
    parse_declaration,
};
use crate::fault::{Faults, wording};
use crate::format::Spec;
use crate::mechanism::closure::Unreached;
use crate::mechanism::{self, LinkId, LockedTree, Mechanism};

/// A mechanism that passed every check, with its declared effects.
#[derive(Clone, Debug, PartialEq)]
pub struct Machine {
    /// Links, joints, frames.
    pub mechanism: Mechanism,
    /// The declared effects, in the file's order.
    pub effects: Vec<Declaration>,
    /// The file, if it has loops: with locked joints they are closed anew.
    closed_spec: Option<Box<Spec>>,
}

/// The reason why joints cannot be locked.
#[derive(Clone, Debug, PartialEq)]
pub enum NotLocked {
    /// The loops do not close with the joints at these positions.
    Unreached(Unreached),
    /// The mechanism with locked joints breaks rules.
    Refused(Faults),
}

impl Machine {
    /// Returns the mechanism with the joints of these links locked at these positions, rad or m. Loops are closed
    /// anew, on the branch of the mechanism; joints that the loops hold then are locked as well.
    ///
    /// # Errors
    /// If the loops do not close there, or their rows contradict each other.
    pub fn locked(&self, locks: &[(LinkId, Dd)]) -> Result<Mechanism, NotLocked> {
        let (Some(spec), false) = (&self.closed_spec, locks.is_empty()) else {
            return Ok(self.mechanism.locked(locks));
        };
        let locked = LockedTree::new(&self.mechanism, locks).map_err(NotLocked::Unreached)?;
        mechanism::check_locked(spec, &locked).map_err(NotLocked::Refused)
    }
}

/// Checks a spec against every rule. `stem` is the file's name without its extension, if there is a file;
/// only the part before its first dot is used. `methods` are the names of generated methods, which no
/// run-time parameter may have; `kinds` are all effects.
///
/// The machine is returned exactly if no fault refuses the spec.
pub fn check(
    spec: &Spec,
    stem: Option<&str>,
    methods: &[String],
    kinds: &EffectKinds,
) -> (Option<Machine>, Faults) {
    let mut faults = Faults::default();
    let mechanism = mechanism::check(spec, stem, methods, &mut faults);
    let machine = match mechanism {
        None => {
            alone(spec, kinds, &mut faults);
            None
        }
        Some(mechanism) => Some(Machine {
            effects: effects(spec, &mechanism, kinds, &mut faults),
            closed_spec: mechanism.closure().map(|_| Box::new(spec.clone())),
            mechanism,
        }),
    };
    let still = machine.as_ref().is_some_and(|m| m.mechanism.nv() == 0) && !faults.any_fault();
    if let Some(links) = spec.links.given().filter(|_| still) {
        faults.push(wording::no_coordinates(&links.location));
    }
    faults.sort();
    let sound = spec.complete && !faults.any_fault();
    faults.forget_following();
    (machine.filter(|_| sound), faults)
}

/// Checks the effects as far as possible without the mechanism.
fn alone(spec: &Spec, kinds: &EffectKinds, faults: &mut Faults) {
    for raw in spec.effects.value().into_iter().flatten() {
        parse_declaration(raw, kinds, faults);
    }
}

/// Checks each effect separately.
fn effects(
    spec: &Spec,
    mechanism: &Mechanism,
    kinds: &EffectKinds,
    faults: &mut Faults,
) -> Vec<Declaration> {
    let raws = spec.effects.value().map_or(&[][..], Vec::as_slice);
    if raws.is_empty() {
        return Vec::new();
    }
    let (mut found, mut refused) = (Vec::new(), RejectedEffects::default());
    for raw in raws {
        match parse_declaration(raw, kinds, faults) {
            Some(effect) => found.push(effect),
            None => refused.call(raw, &[], kinds),
        }
    }
    let all = mechanism.one_degree_names();
    let all: Vec<&str> = all.iter().map(String::as_str).collect();
    let each_of = EachOf {
        joints: &all,
        contacts: mechanism.contact_pairs(),
    };
    let each = found.iter().cloned();
    let each: Vec<Declaration> = each.flat_map(|d| d.of_each(&each_of, faults)).collect();
    let mut context = NameScope::of(mechanism, Vec::new()).with(each.iter());
    context.refused = refused;
    check_unique_names(&each, mechanism, faults);
    for effect in &each {
        effect.element(&context, faults);
    }
    found
}
