//! Reads the effects that a mechanism's file declares, and the ones that a scene calls for.

use super::joints::keys_declared;
use super::{Declaration, Declared, Kinds};
use crate::fault::{Faults, Place, wording};
use crate::format::{Fields, Key, Located, Raw, Reads};
use crate::name::is_identifier;

/// The key that says what an effect is.
const TYPE: Key = Key {
    name: "type",
    reads: Reads::Word(&[]),
    needed: true,
    about: "what it is",
};

/// The effect that a file declares under a name.
pub fn declared(raw: &Raw, kinds: &Kinds, faults: &mut Faults) -> Option<Declared> {
    identifier(&raw.name, faults);
    let Some(word) = raw.peek(TYPE.name) else {
        let name = &raw.name.value;
        faults.push(wording::effect_without_type(
            &raw.place,
            name,
            &types(kinds),
        ));
        return None;
    };
    let effect = of_type(&word, kinds, faults)?;
    fields_of(raw, effect, faults).map(|fields| Declared {
        name: raw.name.clone(),
        effect,
        fields,
    })
}

/// The effects that a scene calls for by one entry of its list; the mechanism declares `known`.
pub fn called(raw: &Raw, known: &[Declared], kinds: &Kinds, faults: &mut Faults) -> Vec<Declared> {
    let name = &raw.name.value;
    let own = known.iter().find(|d| d.name.value == *name);
    if let Some(own) = own {
        return varied(raw, own, faults).into_iter().collect();
    }
    if let Some(effect) = kinds.named(name).filter(|e| e.built_in()) {
        let fields = fields_of(raw, effect, faults);
        let one = |fields| Declared {
            name: raw.name.clone(),
            effect,
            fields,
        };
        return fields.map(one).into_iter().collect();
    }
    if raw.is_mapping() {
        return declared(raw, kinds, faults).into_iter().collect();
    }
    let of_kind = |d: &&Declared| d.effect.family() == name || d.effect.keyword() == name;
    let kin: Vec<Declared> = known
        .iter()
        .filter(of_kind)
        .map(|d| d.clone().called_at(&raw.name.place))
        .collect();
    if kin.is_empty() || !raw.is_bare() {
        let names = callable(known, kinds);
        faults.push(wording::unknown_effect(&raw.name.place, name, &names));
        return vec![];
    }
    kin
}

/// The mechanism's effect, with the scene's values in place of its own.
fn varied(raw: &Raw, own: &Declared, faults: &mut Faults) -> Option<Declared> {
    let own = own.clone().called_at(&raw.name.place);
    if raw.is_bare() {
        return Some(own);
    }
    if let Some(word) = raw.peek(TYPE.name)
        && word.value != own.effect.keyword()
    {
        let types = (own.effect.keyword(), word.value.as_str());
        let name = &raw.name.value;
        faults.push(wording::type_of_mechanism_differs(&word.place, name, types));
        return None;
    }
    let fields = fields_of(raw, own.effect, faults)?;
    Some(Declared {
        name: raw.name.clone(),
        effect: own.effect,
        fields: Declared::over(fields, &own.fields),
    })
}

/// The words by which a scene may call for effects.
fn callable<'a>(known: &'a [Declared], kinds: &Kinds) -> Vec<&'a str> {
    let mut words: Vec<&str> = known.iter().map(|d| d.name.value.as_str()).collect();
    words.extend(kinds.iter().filter(|e| e.built_in()).map(|e| e.keyword()));
    let families: Vec<&str> = known.iter().map(|d| d.effect.family()).collect();
    words.extend(families);
    words.dedup();
    words
}

/// The words that may follow `type`.
fn types(kinds: &Kinds) -> Vec<&'static str> {
    let types = kinds.iter().filter(|e| !e.built_in());
    types.map(Declaration::keyword).collect()
}

fn of_type(
    word: &Located<String>,
    kinds: &Kinds,
    faults: &mut Faults,
) -> Option<&'static dyn Declaration> {
    let found = kinds.named(&word.value).filter(|e| !e.built_in());
    if found.is_none() {
        let known = types(kinds);
        faults.push(wording::unknown_effect_type(
            &word.place,
            &word.value,
            &known,
        ));
    }
    found
}

fn fields_of(raw: &Raw, effect: &'static dyn Declaration, faults: &mut Faults) -> Option<Fields> {
    let mut keys = keys_declared(effect);
    if !effect.built_in() {
        keys.push(TYPE);
    }
    let example = format!("`{}`", example(effect));
    raw.fields(("an effect's keys", &example), &keys, faults)
}

/// How the effect is written.
pub(crate) fn example(effect: &dyn Declaration) -> String {
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
        faults.push(wording::not_identifier(&name.place, &name.value));
    }
}

impl Declared {
    /// The same with faults reported where a scene calls for it: the mechanism's file is another.
    fn called_at(mut self, place: &Place) -> Self {
        self.name.place = place.clone();
        self.fields = self.fields.placed(place);
        self
    }
}
