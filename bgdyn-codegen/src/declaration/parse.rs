//! Parses the effects that a mechanism's file declares, and those that a scene includes.

use super::each::keys_declared;
use super::{Declaration, EffectKind, EffectKinds};
use crate::fault::{Faults, Location, wording};
use crate::format::{Fields, Key, Located, Raw, Reads};
use crate::name::is_identifier;

/// The key for the type of an effect.
pub(crate) const TYPE: Key = Key {
    name: "type",
    reads: Reads::Word(&[]),
    needed: true,
    about: "what it is",
};

/// Parses the effect that a file declares under a name.
pub fn parse_declaration(
    raw: &Raw,
    kinds: &EffectKinds,
    faults: &mut Faults,
) -> Option<Declaration> {
    identifier(&raw.name, faults);
    let Some(word) = raw.peek(TYPE.name) else {
        let name = &raw.name.value;
        faults.push(wording::effect_without_type(
            &raw.location,
            name,
            &types(kinds),
        ));
        return None;
    };
    let effect = of_type(&word, kinds, faults)?;
    fields_of(raw, effect, faults).map(|fields| Declaration {
        name: raw.name.clone(),
        effect,
        fields,
    })
}

/// Returns the effects of one entry of a scene's list; the mechanism declares `known`.
pub fn resolve_call(
    raw: &Raw,
    known: &[Declaration],
    kinds: &EffectKinds,
    faults: &mut Faults,
) -> Vec<Declaration> {
    let name = &raw.name.value;
    let own = known.iter().find(|d| d.name.value == *name);
    if let Some(own) = own {
        return with_overrides(raw, own, faults).into_iter().collect();
    }
    if let Some(effect) = kinds.named(name).filter(|e| e.built_in()) {
        let fields = fields_of(raw, effect, faults);
        let one = |fields| Declaration {
            name: raw.name.clone(),
            effect,
            fields,
        };
        return fields.map(one).into_iter().collect();
    }
    if raw.is_mapping() {
        return parse_declaration(raw, kinds, faults).into_iter().collect();
    }
    let of_kind = |d: &&Declaration| d.effect.family() == name || d.effect.keyword() == name;
    let kin: Vec<Declaration> = known
        .iter()
        .filter(of_kind)
        .map(|d| d.clone().located_at(&raw.name.location))
        .collect();
    if kin.is_empty() || !raw.is_bare() {
        let names = callable(known, kinds);
        faults.push(wording::unknown_effect(&raw.name.location, name, &names));
        return vec![];
    }
    kin
}

/// Returns the mechanism's effect with the scene's values in place of its own.
fn with_overrides(raw: &Raw, own: &Declaration, faults: &mut Faults) -> Option<Declaration> {
    let own = own.clone().located_at(&raw.name.location);
    if raw.is_bare() {
        return Some(own);
    }
    if let Some(word) = raw.peek(TYPE.name)
        && word.value != own.effect.keyword()
    {
        let types = (own.effect.keyword(), word.value.as_str());
        let name = &raw.name.value;
        faults.push(wording::type_of_mechanism_differs(
            &word.location,
            name,
            types,
        ));
        return None;
    }
    let fields = fields_of(raw, own.effect, faults)?;
    Some(Declaration {
        name: raw.name.clone(),
        effect: own.effect,
        fields: own.fields_with(fields),
    })
}

/// Returns the words by which a scene may include effects.
fn callable<'a>(known: &'a [Declaration], kinds: &EffectKinds) -> Vec<&'a str> {
    let mut words: Vec<&str> = known.iter().map(|d| d.name.value.as_str()).collect();
    words.extend(kinds.iter().filter(|e| e.built_in()).map(|e| e.keyword()));
    let families: Vec<&str> = known.iter().map(|d| d.effect.family()).collect();
    words.extend(families);
    words.dedup();
    words
}

/// Returns the valid words for `type`.
fn types(kinds: &EffectKinds) -> Vec<&'static str> {
    let types = kinds.iter().filter(|e| !e.built_in());
    types.map(EffectKind::keyword).collect()
}

fn of_type(
    word: &Located<String>,
    kinds: &EffectKinds,
    faults: &mut Faults,
) -> Option<&'static dyn EffectKind> {
    let found = kinds.named(&word.value).filter(|e| !e.built_in());
    if found.is_none() {
        let known = types(kinds);
        faults.push(wording::unknown_effect_type(
            &word.location,
            &word.value,
            &known,
        ));
    }
    found
}

fn fields_of(raw: &Raw, effect: &'static dyn EffectKind, faults: &mut Faults) -> Option<Fields> {
    let mut keys = keys_declared(effect);
    if !effect.built_in() {
        keys.push(TYPE);
    }
    let example = format!("`{}`", example(effect));
    raw.fields(("an effect's keys", &example), &keys, faults)
}

/// Returns an example of the effect in the syntax of a file.
pub(crate) fn example(effect: &dyn EffectKind) -> String {
    let needed = effect.keys().iter().filter(|k| k.needed);
    let keys: Vec<String> = needed.map(|k| format!("{}: …", k.name)).collect();
    match (effect.built_in(), keys.is_empty()) {
        (true, _) => effect.keyword().to_owned(),
        (false, true) => format!("{{ type: {} }}", effect.keyword()),
        (false, false) => format!("{{ type: {}, {} }}", effect.keyword(), keys.join(", ")),
    }
}

fn identifier(name: &Located<String>, faults: &mut Faults) {
    if !is_identifier(&name.value) {
        faults.push(wording::not_identifier(&name.location, &name.value));
    }
}

impl Declaration {
    /// Moves its location to that of the scene's entry, because the mechanism is in another file.
    fn located_at(mut self, location: &Location) -> Self {
        self.name.location = location.clone();
        self.fields = self.fields.placed(location);
        self
    }
}
