//! Checks one effect: converts its declared values to an element with valid names and numbers.

use bgdyn_runtime::Dd;

use super::{Declaration, EffectKind, Element, ElementValue, NameScope, Quantity, ValueCheck};
use crate::fault::{Fault, Faults, Location, wording};
use crate::format::{Dimension, Key, Located, Number, ParsedValue, Reads, check_unit};
use crate::mechanism::Motion;
use crate::name::is_identifier;

impl Declaration {
    /// Returns the element if its names are known and its numbers obey its rules.
    pub fn element(&self, context: &NameScope, faults: &mut Faults) -> Option<Element> {
        let before = faults.count();
        let joint = self.joint();
        // An effect along a line acts on a length.
        let motion = joint.map_or(Some(Motion::Translation), |joint| context.motion_of(joint));
        let mut element = Element {
            name: self.name.value.clone(),
            effect: self.effect,
            location: self.name.location.clone(),
            values: Vec::new(),
        };
        for key in self.effect.keys() {
            match self.fields.get(key) {
                Some(Located {
                    value: ParsedValue::Group(numbers),
                    ..
                }) => {
                    for (name, number) in numbers {
                        let fit = dimensions(key.reads);
                        let checked =
                            quantity(&number.value, &number.location, fit, motion, faults);
                        let checked = checked.map(ElementValue::Number);
                        element.values.extend(checked.map(|c| (*name, c)));
                    }
                }
                Some(entry) => {
                    let checked = self.checked(key, entry, motion, context, faults);
                    element.values.extend(checked.map(|c| (key.name, c)));
                }
                None if key.needed => {
                    let (location, name) = (&self.name.location, &self.name.value);
                    faults.push(wording::effect_key_missing(
                        location, name, key.name, key.about,
                    ));
                }
                None => {
                    let limit = context.limit_for(self.effect, joint, key);
                    let quantity = limit.map(|limit| self.limit(key, limit, motion));
                    let checked = quantity.map(|q| (key.name, ElementValue::Number(q)));
                    element.values.extend(checked);
                }
            }
        }
        if faults.count() > before {
            return None;
        }
        self.effect.check_values(&mut ValueCheck {
            element: &element,
            faults,
        });
        (faults.count() == before).then_some(element)
    }

    /// Returns a joint's limit as a number of the effect.
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
            location: self.name.location.clone(),
        }
    }

    fn checked(
        &self,
        key: &Key,
        entry: &Located<ParsedValue>,
        joint: Option<Motion>,
        context: &NameScope,
        faults: &mut Faults,
    ) -> Option<ElementValue> {
        let location = &entry.location;
        match (&entry.value, key.reads) {
            (ParsedValue::Number(number), Reads::Number(fit)) => {
                quantity(number, location, fit, joint, faults).map(ElementValue::Number)
            }
            (ParsedValue::Text(word), reads) => {
                let known = known(reads, self.effect, context);
                if let Some(known) = known.filter(|known| !known.contains(&word.as_str())) {
                    faults.push(unknown(key, word, location, &known, context));
                    return None;
                }
                if let Some(fault) = self.unserved(key, word, location, context) {
                    faults.push(fault);
                    return None;
                }
                if reads == Reads::Input && !is_identifier(word) {
                    faults.push(wording::not_identifier(location, word));
                }
                Some(ElementValue::Name(word.clone()))
            }
            (ParsedValue::Pair(names), _) => {
                let known = known(Reads::Site, self.effect, context).unwrap_or_default();
                for name in names.iter().filter(|n| !known.contains(&n.value.as_str())) {
                    faults.push(unknown(key, &name.value, &name.location, &known, context));
                }
                let [a, b] = names.each_ref().map(|name| name.value.as_str());
                let distance = context.sites.constant_distance(a, b);
                if let Some(distance) = distance.filter(|_| self.effect.acts_along_line()) {
                    faults.push(wording::constant_distance(
                        location,
                        &self.name.value,
                        [a, b],
                        distance,
                    ));
                }
                Some(ElementValue::Names(
                    names.each_ref().map(|n| n.value.clone()),
                ))
            }
            (ParsedValue::Vector(vector), _) => Some(ElementValue::Vector(
                vector.each_ref().map(|n| n.value.value),
            )),
            (ParsedValue::Words(words), reads) => {
                let known = known(reads, self.effect, context).unwrap_or_default();
                for word in words.iter().filter(|w| !known.contains(&w.value.as_str())) {
                    faults.push(unknown(key, &word.value, &word.location, &known, context));
                }
                Some(ElementValue::Words(
                    words.iter().map(|w| w.value.clone()).collect(),
                ))
            }
            (ParsedValue::Number(_) | ParsedValue::Coefficients(_) | ParsedValue::Group(_), _) => {
                None
            }
        }
    }
}

impl Declaration {
    /// Returns the fault of a quasi-velocity for an effect that needs its position.
    fn unserved(
        &self,
        key: &Key,
        word: &str,
        location: &Location,
        context: &NameScope,
    ) -> Option<Fault> {
        if !matches!(key.reads, Reads::Coordinate | Reads::Joint) || !self.effect.reads_position() {
            return None;
        }
        let mut all = context.quasi_velocities.iter();
        let (_, kind) = all.find(|(name, _)| name == word)?;
        let effect = (self.name.value.as_str(), self.effect.keyword());
        Some(wording::no_position(location, effect, word, kind))
    }
}

/// Returns the valid names for a key; `None` if every name is valid.
fn known<'a>(
    reads: Reads,
    effect: &dyn EffectKind,
    context: &'a NameScope,
) -> Option<Vec<&'a str>> {
    let followers = context.followers.iter().map(|(name, ..)| name.as_str());
    let dependents = context.dependents.iter().map(|(name, _)| name.as_str());
    let followers = followers
        .chain(dependents)
        .filter(|_| effect.acts_on_followers());
    Some(match reads {
        Reads::Word([]) => return None,
        Reads::Word(words) | Reads::Words(words) => words.to_vec(),
        Reads::Coordinate => context
            .coordinates
            .iter()
            .map(|(n, _)| n.as_str())
            .chain(followers)
            .collect(),
        Reads::Joint => {
            let joints = context.coordinates.iter().map(|(n, _)| n);
            let own = joints.filter(|n| !context.added.contains(n));
            own.map(String::as_str).chain(followers).collect()
        }
        Reads::Site | Reads::Sites => context.sites.names().iter().map(String::as_str).collect(),
        Reads::Contact => context.contacts.iter().map(String::as_str).collect(),
        Reads::Node => context.nodes.iter().map(String::as_str).collect(),
        Reads::Joints
        | Reads::Contacts
        | Reads::Input
        | Reads::Number(_)
        | Reads::Vector(_)
        | Reads::Axis
        | Reads::Plane
        | Reads::Coefficients(_)
        | Reads::Group(..) => return None,
    })
}

/// Returns the valid dimensions of numbers for a key.
fn dimensions(reads: Reads) -> &'static [Dimension] {
    match reads {
        Reads::Number(fit) | Reads::Vector(fit) | Reads::Group(_, fit) => fit,
        _ => &[],
    }
}

fn unknown(
    key: &Key,
    word: &str,
    location: &Location,
    known: &[&str],
    context: &NameScope,
) -> Fault {
    if context.locked.iter().any(|joint| joint == word) {
        return wording::joint_is_locked(location, word);
    }
    if context.prescribed.iter().any(|joint| joint == word) {
        return wording::effect_on_prescribed(location, word);
    }
    let mut followers = context.followers.iter();
    let follower = followers.find(|(name, ..)| name == word);
    if let (Some((_, leaders, _)), Reads::Coordinate | Reads::Joint) = (follower, key.reads) {
        return wording::effect_on_follower(location, word, leaders);
    }
    if context.dependents.iter().any(|(name, _)| name == word)
        && matches!(key.reads, Reads::Coordinate | Reads::Joint)
    {
        return wording::effect_on_dependent(location, word);
    }
    let what = match key.reads {
        Reads::Coordinate | Reads::Joint => "moving joint",
        Reads::Site | Reads::Sites => "link or frame",
        Reads::Contact => "contact",
        Reads::Node => "hydraulic node",
        _ => "choice",
    };
    let fault = wording::unknown_reference(location, (what, word), known, (key.name, key.about));
    let brought = matches!(key.reads, Reads::Coordinate | Reads::Node);
    match brought && context.refused.may_bring(word) {
        true => fault.following(),
        false => fault,
    }
}

/// Selects one of two dimensions: that of a rotation or that of a translation.
fn of_motion(fit: &'static [Dimension], motion: Option<Motion>) -> &'static [Dimension] {
    match (fit, motion) {
        ([turning, _], Some(Motion::Rotation)) => std::slice::from_ref(turning),
        ([_, sliding], Some(_)) => std::slice::from_ref(sliding),
        (fit, _) => fit,
    }
}

fn quantity(
    number: &Number,
    location: &Location,
    fit: &'static [Dimension],
    joint: Option<Motion>,
    faults: &mut Faults,
) -> Option<Quantity> {
    let fit = of_motion(fit, joint);
    let located = Located {
        value: number.clone(),
        location: location.clone(),
    };
    if let Some(fault) = check_unit(&located, fit) {
        faults.push(fault);
        return None;
    }
    if let Some(parameter) = &number.parameter
        && !is_identifier(&parameter.value)
    {
        faults.push(wording::parameter_not_identifier(
            &parameter.location,
            &parameter.value,
        ));
    }
    Some(Quantity {
        value: number.value,
        parameter: number.parameter.as_ref().map(|p| p.value.clone()),
        dimension: fit[0],
        text: number.text.clone(),
        location: location.clone(),
    })
}
