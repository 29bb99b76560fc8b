//! Writes the spec with the numbers found: in place, with deviations and old numbers beside them.

use bgdyn_identification::model::{BODY_PARAMETERS, JOINT_COLUMNS, Model, Parameters, Unknown};
use bgdyn_identification::{Identification, pseudo_inertia::to_centre};
use nalgebra::SMatrix;

use super::IdentifiedMachine;
use super::edits::{Edits, NewNumber, digits, end_of_line, written};
use super::json::number;
use super::spans::{Place, PlaceShape, spans};

/// Entries of a tensor in the spec with their rows and columns.
const ENTRIES: [(&str, usize, usize); 6] = [
    ("xx", 0, 0),
    ("yy", 1, 1),
    ("zz", 2, 2),
    ("xy", 0, 1),
    ("xz", 0, 2),
    ("yz", 1, 2),
];

/// A product of inertia below this part of its moments is a rounding error of a zero.
const ROUNDING: f64 = 1e-13;

/// A spec with numbers found.
pub(crate) struct Written(String);

impl Written {
    /// Returns the text for a file of this stem: a `name` in it must be the stem.
    pub(crate) fn named(&self, stem: &str) -> String {
        let name = spans(&self.0).and_then(|root| root.get("name").map(|name| name.bytes.clone()));
        let mut text = self.0.clone();
        if let Some(bytes) = name {
            text.replace_range(bytes, stem.split('.').next().unwrap_or(stem));
        }
        text
    }
}

/// Returns the spec with the numbers found.
///
/// # Errors
/// All values that cannot be replaced in place.
pub(crate) fn write(
    text: &str,
    machine: &IdentifiedMachine,
    found: &Identification,
) -> Result<Written, String> {
    let model = machine.model();
    let root = spans(text).ok_or("no YAML")?;
    let mut writer = Writer {
        text,
        edits: Edits::new(text),
        faults: Vec::new(),
        found,
        model: &model,
    };
    let links = root.get("links").map_or(&[][..], Place::items);
    for (l, link) in model.links.iter().enumerate().filter(|(_, link)| link.free) {
        match links
            .iter()
            .find(|place| place.get("name").and_then(Place::text) == Some(&link.name))
        {
            Some(place) => writer.link(l, place),
            None => writer
                .faults
                .push(format!("link `{}` is not written out", link.name)),
        }
    }
    writer.effects(machine, &root);
    match writer.faults.is_empty() {
        true => Ok(Written(writer.edits.apply())),
        false => Err(writer.faults.join("\nbgdyn: ")),
    }
}

struct Writer<'a> {
    text: &'a str,
    edits: Edits<'a>,
    faults: Vec<String>,
    found: &'a Identification,
    model: &'a Model<'a>,
}

/// Mass, centre and tensor as the spec has them: m, x, y, z, xx, yy, zz, xy, xz, yz.
fn in_spec(p: &Parameters) -> Parameters {
    let (mass, c, tensor) = to_centre(p);
    let mut own = Parameters::zeros();
    own[0] = mass;
    own.fixed_rows_mut::<3>(1).copy_from(&c);
    for (at, (_, i, k)) in ENTRIES.iter().enumerate() {
        let rounding = ROUNDING * (tensor[(*i, *i)] + tensor[(*k, *k)]);
        let entry = tensor[(*i, *k)];
        own[4 + at] = if entry.abs() < rounding { 0.0 } else { entry };
    }
    own
}

impl Writer<'_> {
    /// Returns the ten numbers of a link as the spec has them, with deviations by the derivatives of these in the
    /// parameters.
    fn numbers(&self, l: usize) -> [NewNumber; BODY_PARAMETERS] {
        let values = Parameters::from_fn(|k, _| {
            number(self.found, Unknown::Link(l, k)).map_or(0.0, |n| n.value)
        });
        let first = self
            .found
            .numbers
            .iter()
            .position(|n| n.unknown == Unknown::Link(l, 0))
            .unwrap_or(0);
        let cov = self.found.covariance.fixed_view::<10, 10>(first, first);
        let jacobian =
            SMatrix::<f64, 10, 10>::from_columns(&std::array::from_fn::<_, 10, _>(|k| {
                let step = 1e-6 * values[k].abs().max(1e-3 * values[0]);
                let (mut above, mut below) = (values, values);
                above[k] += step;
                below[k] -= step;
                (in_spec(&above) - in_spec(&below)) / (2.0 * step)
            }));
        let variances = (jacobian * cov * jacobian.transpose()).diagonal();
        let (new, was) = (in_spec(&values), in_spec(&self.model.links[l].file));
        let share = |k: usize| {
            let group = match k {
                0 => 0..1,
                1..=3 => 1..4,
                _ => 4..10,
            };
            let own = group
                .clone()
                .filter_map(|k| number(self.found, Unknown::Link(l, k)));
            own.map(|n| n.from_log).sum::<f64>() / group.len() as f64
        };
        std::array::from_fn(|k| NewNumber {
            value: new[k],
            deviation: variances[k].max(0.0).sqrt(),
            was: digits(was[k], 7),
            from_log: share(k),
        })
    }

    fn link(&mut self, l: usize, place: &Place) {
        let mut numbers = self.numbers(l).map(Some);
        let mut after = None;
        for (key, range) in [("mass", 0..1), ("com", 1..4), ("inertia", 4..10)] {
            let own: Vec<NewNumber> = numbers[range].iter_mut().filter_map(Option::take).collect();
            match place.get(key) {
                Some(value) => {
                    self.value(key, value, own);
                    after = place.key(key).map(|k| (k.bytes.start, value.bytes.end));
                }
                None => self.insert(key, place, after, &own),
            }
        }
    }

    /// Replaces the value of a key.
    fn value(&mut self, key: &str, value: &Place, numbers: Vec<NewNumber>) {
        let anchored = value.shared && !matches!(value.shape, PlaceShape::Alias);
        if anchored {
            let at = &self.text[value.bytes.clone()];
            self.faults.push(format!(
                "`{key}: {at}` has an anchor that others may refer to: write the numbers out"
            ));
            return;
        }
        let singly: Option<Vec<&Place>> = match (&value.shape, key) {
            (_, "mass") => Some(vec![value]),
            (PlaceShape::List(items), _) => Some(items.iter().collect()),
            (PlaceShape::Map(_), _) => {
                let known = |k: &&str| ENTRIES.iter().any(|(name, ..)| name == k);
                let all = ENTRIES
                    .iter()
                    .filter_map(|(name, ..)| value.get(name))
                    .collect::<Vec<_>>();
                (value.keys().iter().all(known) && all.len() == ENTRIES.len()).then_some(all)
            }
            _ => None,
        };
        match singly {
            Some(places) => {
                for (place, number) in places.into_iter().zip(numbers) {
                    // A run-time parameter keeps its name.
                    let place = place.get("value").unwrap_or(place);
                    self.edits.number(place.bytes.clone(), number);
                }
            }
            None if parameters(value) => {
                let at = &self.text[value.bytes.clone()];
                self.faults.push(format!("`{key}: {at}` has run-time parameters and not all entries: write xx, yy, zz, xy, xz, yz"));
            }
            None => {
                self.edits
                    .text(value.bytes.clone(), collection(key, &numbers));
                numbers
                    .into_iter()
                    .for_each(|n| self.edits.comment(value.bytes.end, n));
            }
        }
    }

    /// Writes a key that the link does not have, after one that it has.
    fn insert(
        &mut self,
        key: &str,
        place: &Place,
        after: Option<(usize, usize)>,
        numbers: &[NewNumber],
    ) {
        let name = place.key("name").zip(place.get("name"));
        let after = after.or(name.map(|(k, v)| (k.bytes.start, v.bytes.end)));
        let Some((start, end)) = after else { return };
        let value = collection(key, numbers);
        if self.text[place.bytes.clone()].starts_with('{') {
            self.edits.text(end..end, format!(", {key}: {value}"));
            return;
        }
        let line = self.text[..start].rfind('\n').map_or(0, |n| n + 1);
        let indent = " ".repeat(self.text[line..start].chars().count());
        let end = end_of_line(self.text, end);
        self.edits.text(
            end..end,
            format!("\n{indent}{key}: {value} # was not given"),
        );
    }

    /// Writes friction and rotors as effects, and offsets as remarks.
    fn effects(&mut self, machine: &IdentifiedMachine, root: &Place) {
        let declared = root.get("effects");
        let (mut new, mut offsets) = (Vec::new(), Vec::new());
        for (j, joint) in self.model.joints.iter().enumerate() {
            for (c, column) in JOINT_COLUMNS.iter().enumerate() {
                let Some(n) = number(self.found, Unknown::Joint(c, j)) else {
                    continue;
                };
                let mut own = machine
                    .effects
                    .iter()
                    .filter(|e| e.joint == joint.name && e.column == c);
                let (value, deviation) = (written(n.value), digits(n.deviation, 2));
                match (own.next(), *column) {
                    (_, "offset") => offsets.push(format!("{} {value} ± {deviation}", joint.name)),
                    (Some(effect), _) => {
                        let others: f64 = own.map(|e| e.value * e.factor).sum();
                        let place = declared.and_then(|d| d.get(&effect.name)).and_then(|e| e.get(effect.key));
                        let Some(place) = place else {
                            self.faults.push(format!("effect `{}` is written for several joints at once: write one for each joint, so that each can have its number", effect.name));
                            continue;
                        };
                        let place = place.get("value").unwrap_or(place);
                        let was = self.text[place.bytes.clone()].to_owned();
                        let number = NewNumber {
                            value: ((n.value - others) / effect.factor).max(0.0),
                            deviation: n.deviation / effect.factor,
                            was,
                            from_log: 1.0,
                        };
                        self.edits.number(place.bytes.clone(), number);
                    }
                    (None, "rotor") => new.push(format!("{0}_rotor: {{ type: rotor, joint: {0}, inertia: {value} }} # ± {deviation}; identified", joint.name)),
                    (None, "viscous") => new.push(format!("{0}_viscous: {{ type: viscous, joint: {0}, damping: {value} }} # ± {deviation}; identified", joint.name)),
                    (None, _) => new.push(format!("{0}_coulomb: {{ type: coulomb, joint: {0}, kinetic: {value} }} # ± {deviation}; identified", joint.name)),
                }
            }
        }
        let remarks = offsets
            .iter()
            .map(|o| format!("# Offset of the measured effort, N*m or N: {o}\n"));
        let remarks: String = remarks.collect();
        self.append(declared, &new, &remarks);
    }

    fn append(&mut self, declared: Option<&Place>, new: &[String], remarks: &str) {
        let end = self.text.len();
        let gap = if self.text.ends_with('\n') { "" } else { "\n" };
        let lines = |indent: &str| {
            new.iter()
                .map(|line| format!("{indent}{line}\n"))
                .collect::<String>()
        };
        match declared {
            _ if new.is_empty() => self.edits.text(end..end, format!("{gap}{remarks}")),
            None => self.edits.text(
                end..end,
                format!("{gap}\neffects:\n{}{remarks}", lines("  ")),
            ),
            Some(place) if self.text[place.bytes.clone()].starts_with('{') => {
                self.faults.push(
                    "`effects: {…}` is written in one line: write each effect on a line of its own"
                        .into(),
                );
            }
            Some(place) => {
                let start = place.bytes.start;
                let line = self.text[..start].rfind('\n').map_or(0, |n| n + 1);
                let indent = " ".repeat(start - line);
                let at = end_of_line(self.text, place.bytes.end);
                let text = new.iter().map(|line| format!("\n{indent}{line}")).collect();
                self.edits.text(at..at, text);
                self.edits.text(end..end, format!("{gap}{remarks}"));
            }
        }
    }
}

/// Returns whether a value has run-time parameters.
fn parameters(value: &Place) -> bool {
    value.get("parameter").is_some()
        || match &value.shape {
            PlaceShape::Map(entries) => entries.iter().any(|(_, v)| parameters(v)),
            PlaceShape::List(items) => items.iter().any(parameters),
            _ => false,
        }
}

fn collection(key: &str, numbers: &[NewNumber]) -> String {
    let values: Vec<String> = numbers.iter().map(|n| written(n.value)).collect();
    match key {
        "mass" => values[0].clone(),
        "com" => format!("[{}]", values.join(", ")),
        _ => {
            let entries = ENTRIES
                .iter()
                .zip(values)
                .map(|((name, ..), value)| format!("{name}: {value}"));
            format!("{{ {} }}", entries.collect::<Vec<_>>().join(", "))
        }
    }
}
