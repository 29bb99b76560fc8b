//! Names that refused effects may have defined, so that their uses are not reported as unknown.

use super::{Declaration, EffectKinds, TYPE};
use crate::format::{Key, ParsedValue, Raw, Reads};

/// The names and families of refused effects.
#[derive(Clone, Debug, Default)]
pub struct RejectedEffects {
    /// Prefixes of the names that they may have defined.
    words: Vec<String>,
    /// Their families; `None` if the type is unknown.
    families: Vec<Option<&'static str>>,
    /// Whether some refused effects have no known name.
    unread: bool,
}

impl RejectedEffects {
    /// Records that effects of any kind and name may be missing.
    pub(crate) fn unread(&mut self) {
        self.unread = true;
    }

    /// Records an entry of a scene's list that gave no effect; the mechanism declares `known`.
    pub(crate) fn call(&mut self, raw: &Raw, known: &[Declaration], kinds: &EffectKinds) {
        let name = &raw.name.value;
        let own = known.iter().find(|d| d.name.value == *name);
        let word = raw.peek(TYPE.name).map_or(name.clone(), |word| word.value);
        let family = match own {
            Some(own) => Some(own.effect.family()),
            None => kinds.named(&word).map(|effect| effect.family()),
        };
        let keys = kinds.iter().flat_map(|kind| inputs(kind.keys()));
        let inputs = keys.filter_map(|key| raw.peek(key.name));
        self.words.extend(inputs.map(|input| input.value));
        self.words.push(name.clone());
        // An unknown word may refer to any effect of the mechanism.
        let meant = |d: &&Declaration| own.is_none_or(|own| own.name.value == d.name.value);
        if own.is_some() || !raw.is_mapping() {
            for declared in known.iter().filter(meant) {
                self.words_of(declared);
            }
        }
        self.families.push(family);
    }

    /// Records an effect that breaks a rule.
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

    /// Returns whether a name may belong to a refused effect.
    pub(crate) fn may_bring(&self, name: &str) -> bool {
        let begins = |word: &String| !word.is_empty() && name.starts_with(word.as_str());
        self.unread || self.words.iter().any(begins)
    }

    /// Returns whether a refused effect may be of this family.
    pub(crate) fn may_be(&self, family: &str) -> bool {
        let of = |found: &Option<&str>| found.is_none_or(|found| found == family);
        self.unread || self.families.iter().any(of)
    }

    /// Returns whether no effect was refused.
    pub(crate) fn is_empty(&self) -> bool {
        !self.unread && self.families.is_empty()
    }
}

/// Returns the keys whose values are names of inputs.
fn inputs(keys: &'static [Key]) -> impl Iterator<Item = &'static Key> {
    keys.iter().filter(|key| key.reads == Reads::Input)
}
