//! The names that refused effects may have defined, so that uses of them are not reported as well.

use super::{Declaration, EffectKinds};
use crate::format::{Key, ParsedValue, Raw, Reads};

/// What effects that were refused may have brought.
#[derive(Clone, Debug, Default)]
pub struct RejectedEffects {
    /// Beginnings of the names that they may have brought.
    words: Vec<String>,
    /// Their families; `None` for one whose type is not known.
    families: Vec<Option<&'static str>>,
    /// Whether there are effects of which not even the name is known.
    unread: bool,
}

impl RejectedEffects {
    /// That effects of any kind and name are missing.
    pub(crate) fn unread(&mut self) {
        self.unread = true;
    }

    /// An entry of a scene's list from which there is no effect; the mechanism declares `known`.
    pub(crate) fn call(&mut self, raw: &Raw, known: &[Declaration], kinds: &EffectKinds) {
        let name = &raw.name.value;
        let own = known.iter().find(|d| d.name.value == *name);
        let word = raw.peek("type").map_or(name.clone(), |word| word.value);
        let family = match own {
            Some(own) => Some(own.effect.family()),
            None => kinds.named(&word).map(|effect| effect.family()),
        };
        let keys = kinds.iter().flat_map(|kind| inputs(kind.keys()));
        let inputs = keys.filter_map(|key| raw.peek(key));
        self.words.extend(inputs.map(|input| input.value));
        self.words.push(name.clone());
        // A word that is none may be meant for any of the mechanism's.
        let meant = |d: &&Declaration| own.is_none_or(|own| own.name.value == d.name.value);
        if own.is_some() || !raw.is_mapping() {
            for declared in known.iter().filter(meant) {
                self.words_of(declared);
            }
        }
        self.families.push(family);
    }

    /// An effect that breaks a rule.
    pub(crate) fn effect(&mut self, declared: &Declaration) {
        self.words_of(declared);
        self.families.push(Some(declared.effect.family()));
    }

    fn words_of(&mut self, declared: &Declaration) {
        self.words.push(declared.name.value.clone());
        for key in inputs(declared.effect.keys()) {
            if let Some(ParsedValue::Text(input)) = declared.fields.get(key).map(|e| &e.value) {
                self.words.push(input.clone());
            }
        }
    }

    /// Whether a name may be of a part that was to come from one of them.
    pub(crate) fn may_bring(&self, name: &str) -> bool {
        let begins = |word: &String| !word.is_empty() && name.starts_with(word.as_str());
        self.unread || self.words.iter().any(begins)
    }

    /// Whether one of them may be of this family.
    pub(crate) fn may_be(&self, family: &str) -> bool {
        let of = |found: &Option<&str>| found.is_none_or(|found| found == family);
        self.unread || self.families.iter().any(of)
    }

    /// Whether there are none.
    pub(crate) fn is_empty(&self) -> bool {
        !self.unread && self.families.is_empty()
    }
}

/// The keys behind which an effect names inputs.
fn inputs(keys: &'static [Key]) -> impl Iterator<Item = &'static str> {
    let inputs = keys.iter().filter(|key| key.reads == Reads::Input);
    inputs.map(|key| key.name)
}
