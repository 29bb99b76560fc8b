//! From what stands in a file to a checked element: its type, its keys, its names, its rules.

use super::joints::keys_declared;
use bgdyn_runtime::Dd;

use super::{Checked, Declaration, Declared, Element, Given, Kinds, Quantity, Refused};
use crate::fault::{Fault, Faults, Place, unknown_name, wording};
use crate::mechanism::{Limits, Motion, Places};
use crate::name::is_identifier;
use crate::spec::{Dimension, Entry, Fields, Key, Located, Number, Raw, Reads, misfit};

/// The key that says what an effect is.
const TYPE: Key = Key {
    name: "type",
    reads: Reads::Word(&[]),
    needed: true,
    about: "what it is",
};

/// The names that an effect may refer to.
#[derive(Clone, Debug, Default)]
pub struct Context {
    /// Moving joints and the coordinates that effects add, with the dimension pair's index: 0 for
    /// a rotation, 1 for a translation.
    pub coordinates: Vec<(String, Motion)>,
    /// Limits of the joints that have any.
    pub limits: Vec<(String, Limits)>,
    /// Those of the coordinates that are no joints.
    pub added: Vec<String>,
    /// Joints that a scene locks.
    pub locked: Vec<String>,
    /// Links and frames.
    pub(crate) places: Places,
    /// Hydraulic nodes.
    pub nodes: Vec<String>,
    /// What effects that were refused may have brought.
    pub refused: Refused,
}

impl Context {
    /// The same with what these effects add.
    pub fn with<'a>(mut self, declared: impl Iterator<Item = &'a Declared> + Clone) -> Self {
        for d in declared.clone().filter(|d| d.effect.adds_coordinate()) {
            let on = match d.fields.get("joint").map(|j| &j.value) {
                Some(Entry::Text(joint)) => self.motion_of(joint),
                _ => None,
            };
            let motion = on.unwrap_or(Motion::Rotation);
            self.coordinates.push((d.name.value.clone(), motion));
            self.added.push(d.name.value.clone());
        }
        self.nodes.extend(declared.flat_map(Declared::nodes));
        self
    }

    /// What an effect on a joint takes from the joint's limits for a key that it lacks.
    fn limit_for(&self, effect: &dyn Declaration, joint: Option<&str>, key: &Key) -> Option<f64> {
        let (_, limits) = self
            .limits
            .iter()
            .find(|(name, _)| Some(name.as_str()) == joint)?;
        effect.limit_for(key.name, limits)
    }

    fn motion_of(&self, coordinate: &str) -> Option<Motion> {
        let found = self.coordinates.iter().find(|(name, _)| name == coordinate);
        found.map(|(_, motion)| *motion)
    }
}

/// The effect that a file declares under a name.
pub fn declared(raw: &Raw, kinds: &Kinds, faults: &mut Faults) -> Option<Declared> {
    identifier(&raw.name, faults);
    let Some(word) = raw.peek(TYPE.name) else {
        let message = format!("the effect `{}` has no type", raw.name.value);
        let known: Vec<&str> = types(kinds).map(Declaration::keyword).collect();
        let help = format!("add `type: …`: one of {}", known.join(", "));
        let fault = Fault::new(&raw.place, "effect-type", message);
        faults.push(fault.with_help(help));
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
        faults.push(unknown_call(raw, known, kinds));
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
        let message = format!(
            "`{}` is of type `{}` in the mechanism, not `{}`",
            raw.name.value,
            own.effect.keyword(),
            word.value
        );
        let fault = Fault::new(&word.place, "effect-type", message);
        faults.push(fault.with_help("leave `type` out, or give the new effect another name"));
        return None;
    }
    let fields = fields_of(raw, own.effect, faults)?;
    Some(Declared {
        name: raw.name.clone(),
        effect: own.effect,
        fields: Declared::over(fields, &own.fields),
    })
}

fn unknown_call(raw: &Raw, known: &[Declared], kinds: &Kinds) -> Fault {
    let mut words: Vec<&str> = known.iter().map(|d| d.name.value.as_str()).collect();
    words.extend(kinds.iter().filter(|e| e.built_in()).map(|e| e.keyword()));
    let families: Vec<&str> = known.iter().map(|d| d.effect.family()).collect();
    words.extend(families);
    words.dedup();
    let message = unknown_name("effect", &raw.name.value, &words, &words.join(", "));
    let new = "a new one is written with its type: `- push: { type: wrench, … }`";
    Fault::new(&raw.name.place, "unknown-effect", message).with_help(new)
}

fn types(kinds: &Kinds) -> impl Iterator<Item = &'static dyn Declaration> {
    kinds.iter().filter(|e| !e.built_in())
}

fn of_type(
    word: &Located<String>,
    kinds: &Kinds,
    faults: &mut Faults,
) -> Option<&'static dyn Declaration> {
    let found = kinds.named(&word.value).filter(|e| !e.built_in());
    if found.is_none() {
        let known: Vec<&str> = types(kinds).map(Declaration::keyword).collect();
        let message = unknown_name("type of effect", &word.value, &known, &known.join(", "));
        let fault = Fault::new(&word.place, "effect-type", message);
        faults.push(fault.with_help(format!("the types are {}", known.join(", "))));
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

    /// The element, if its names are known and its numbers obey its rules.
    pub fn element(&self, context: &Context, faults: &mut Faults) -> Option<Element> {
        let before = faults.count();
        let joint = match self.fields.get("joint").map(|e| &e.value) {
            Some(Entry::Text(joint)) => Some(joint.as_str()),
            _ => None,
        };
        // What acts along a line acts on a length.
        let motion = joint.map_or(Some(Motion::Translation), |joint| context.motion_of(joint));
        let mut element = Element {
            name: self.name.value.clone(),
            effect: self.effect,
            place: self.name.place.clone(),
            values: Vec::new(),
        };
        for key in self.effect.keys() {
            match self.fields.get(key.name) {
                Some(Located {
                    value: Entry::Group(numbers),
                    ..
                }) => {
                    for (name, number) in numbers {
                        let fit = dimensions(key.reads);
                        let checked = quantity(&number.value, &number.place, fit, motion, faults);
                        let checked = checked.map(Checked::Number);
                        element.values.extend(checked.map(|c| (*name, c)));
                    }
                }
                Some(entry) => {
                    let checked = self.checked(key, entry, motion, context, faults);
                    element.values.extend(checked.map(|c| (key.name, c)));
                }
                None if key.needed => faults.push(self.missing(key)),
                None => {
                    let limit = context.limit_for(self.effect, joint, key);
                    let quantity = limit.map(|limit| self.limit(key, limit, motion));
                    let checked = quantity.map(|q| (key.name, Checked::Number(q)));
                    element.values.extend(checked);
                }
            }
        }
        if faults.count() > before {
            return None;
        }
        self.effect.rules(&mut Given {
            element: &element,
            faults,
        });
        (faults.count() == before).then_some(element)
    }

    /// A joint's limit in place of a number.
    fn limit(&self, key: &Key, limit: f64, motion: Option<Motion>) -> Quantity {
        let dimension = match key.reads {
            Reads::Number(fit) => of_motion(fit, motion)[0],
            _ => Dimension::One,
        };
        Quantity {
            value: Dd::from_f64(limit),
            parameter: None,
            dimension,
            text: format!("{limit} {}", dimension.si()),
            place: self.name.place.clone(),
        }
    }

    fn missing(&self, key: &Key) -> Fault {
        let message = format!("`{}` has no `{}`: {}", self.name.value, key.name, key.about);
        let help = match key.name {
            "joint" => "add `joint: …`, or `joints: all` for one effect at each".to_owned(),
            name => format!("add `{name}: …`"),
        };
        Fault::new(&self.name.place, "missing-key", message).with_help(help)
    }

    fn checked(
        &self,
        key: &Key,
        entry: &Located<Entry>,
        joint: Option<Motion>,
        context: &Context,
        faults: &mut Faults,
    ) -> Option<Checked> {
        let place = &entry.place;
        match (&entry.value, key.reads) {
            (Entry::Number(number), Reads::Number(fit)) => {
                quantity(number, place, fit, joint, faults).map(Checked::Number)
            }
            (Entry::Text(word), reads) => {
                let known = known(reads, context);
                if let Some(known) = known.filter(|known| !known.contains(&word.as_str())) {
                    faults.push(unknown(key, word, place, &known, context));
                    return None;
                }
                if reads == Reads::Input && !is_identifier(word) {
                    faults.push(wording::not_identifier(place, word));
                }
                Some(Checked::Name(word.clone()))
            }
            (Entry::Pair(names), _) => {
                let known = known(Reads::Place, context).unwrap_or_default();
                for name in names.iter().filter(|n| !known.contains(&n.value.as_str())) {
                    faults.push(unknown(key, &name.value, &name.place, &known, context));
                }
                let [a, b] = names.each_ref().map(|name| name.value.as_str());
                if let Some(distance) = context.places.constant_distance(a, b) {
                    faults.push(wording::constant_distance(
                        place,
                        &self.name.value,
                        [a, b],
                        distance,
                    ));
                }
                Some(Checked::Names(names.each_ref().map(|n| n.value.clone())))
            }
            (Entry::Vector(vector), _) => {
                Some(Checked::Vector(vector.each_ref().map(|n| n.value.value)))
            }
            (Entry::Words(words), reads) => {
                let known = known(reads, context).unwrap_or_default();
                for word in words.iter().filter(|w| !known.contains(&w.value.as_str())) {
                    faults.push(unknown(key, &word.value, &word.place, &known, context));
                }
                Some(Checked::Words(
                    words.iter().map(|w| w.value.clone()).collect(),
                ))
            }
            (Entry::Number(_) | Entry::Group(_), _) => None,
        }
    }
}

/// The names that may stand behind a key; `None` where any may.
fn known(reads: Reads, context: &Context) -> Option<Vec<&str>> {
    Some(match reads {
        Reads::Word([]) => return None,
        Reads::Word(words) | Reads::Words(words) => words.to_vec(),
        Reads::Coordinate => context
            .coordinates
            .iter()
            .map(|(n, _)| n.as_str())
            .collect(),
        Reads::Joint => {
            let joints = context.coordinates.iter().map(|(n, _)| n);
            let own = joints.filter(|n| !context.added.contains(n));
            own.map(String::as_str).collect()
        }
        Reads::Place | Reads::Places => context.places.names().iter().map(String::as_str).collect(),
        Reads::Node => context.nodes.iter().map(String::as_str).collect(),
        Reads::Joints | Reads::Input | Reads::Number(_) | Reads::Vector(_) | Reads::Group(..) => {
            return None;
        }
    })
}

/// What the numbers behind a key may measure.
fn dimensions(reads: Reads) -> &'static [Dimension] {
    match reads {
        Reads::Number(fit) | Reads::Vector(fit) | Reads::Group(_, fit) => fit,
        _ => &[],
    }
}

fn unknown(key: &Key, word: &str, place: &Place, known: &[&str], context: &Context) -> Fault {
    if context.locked.iter().any(|joint| joint == word) {
        let message = format!("the joint `{word}` is locked in this scene: nothing acts on it");
        return Fault::new(place, "locked-joint", message)
            .with_help("leave this effect out of the scene, or do not lock the joint");
    }
    let what = match key.reads {
        Reads::Coordinate | Reads::Joint => "moving joint",
        Reads::Place | Reads::Places => "link or frame",
        Reads::Node => "hydraulic node",
        _ => "choice",
    };
    let all = match known {
        [] => "none".to_owned(),
        known => known.join(", "),
    };
    let message = unknown_name(what, word, known, &all);
    let help = format!("`{}`: {}", key.name, key.about);
    let fault = Fault::new(place, "unknown-name", message).with_help(help);
    let brought = matches!(key.reads, Reads::Coordinate | Reads::Node);
    match brought && context.refused.may_bring(word) {
        true => fault.following(),
        false => fault,
    }
}

/// Two dimensions are those of a rotation and of a translation.
fn of_motion(fit: &'static [Dimension], motion: Option<Motion>) -> &'static [Dimension] {
    match (fit, motion) {
        ([turning, _], Some(Motion::Rotation)) => std::slice::from_ref(turning),
        ([_, sliding], Some(_)) => std::slice::from_ref(sliding),
        (fit, _) => fit,
    }
}

fn quantity(
    number: &Number,
    place: &Place,
    fit: &'static [Dimension],
    joint: Option<Motion>,
    faults: &mut Faults,
) -> Option<Quantity> {
    let fit = of_motion(fit, joint);
    let located = Located {
        value: number.clone(),
        place: place.clone(),
    };
    if let Some(fault) = misfit(&located, fit) {
        faults.push(fault);
        return None;
    }
    if let Some(parameter) = &number.parameter
        && !is_identifier(&parameter.value)
    {
        faults.push(wording::parameter_not_identifier(
            &parameter.place,
            &parameter.value,
        ));
    }
    Some(Quantity {
        value: number.value,
        parameter: number.parameter.as_ref().map(|p| p.value.clone()),
        dimension: fit[0],
        text: number.text.clone(),
        place: place.clone(),
    })
}
