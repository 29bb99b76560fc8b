//! `rolling`: a wheel, a ball or an ellipsoid rolls on a plane without slipping.

use bgdyn_runtime::Dd;

use super::constraint_type::{ConstraintType, ReadConstraint};
use super::contact::{ContactEntry, ContactKind, RollingSize, Slip};
use super::row::RowReader;
use crate::fault::wording;
use crate::format::{Dimension, Fields, Key, Located, Number, ParsedValue, Reads};

/// The type `rolling`.
pub(super) struct Rolling;

const LINK: Key = Key {
    name: "link",
    reads: Reads::Site,
    needed: true,
    about: "what rolls: a link, or a frame on it, with its centre at the origin",
};

const AXIS: Key = Key {
    name: "axis",
    reads: Reads::Axis,
    needed: false,
    about: "the direction of a wheel's axle in these axes; without it a ball or an ellipsoid",
};

const RADIUS: Key = Key {
    name: "radius",
    reads: Reads::Number(&[Dimension::Length]),
    needed: false,
    about: "the radius of a wheel or a ball; of a tyre to the middles of its sections",
};

const CROWN_RADIUS: Key = Key {
    name: "crown_radius",
    reads: Reads::Number(&[Dimension::Length]),
    needed: false,
    about: "the radius of a tyre's sections; without it the wheel is a thin disc",
};

const RADII: Key = Key {
    name: "radii",
    reads: Reads::Vector(&[Dimension::Length]),
    needed: false,
    about: "the half-axes of an ellipsoid along x, y and z, instead of `radius`",
};

const ON: Key = Key {
    name: "on",
    reads: Reads::Plane,
    needed: false,
    about: "the plane, one of `planes`; the world's x–y plane without it",
};

/// The words of `rows`.
const WORDS: [&str; 2] = ["longitudinal", "lateral"];

const ROWS: Key = Key {
    name: "rows",
    reads: Reads::Words(&WORDS),
    needed: false,
    about: "the directions in which a wheel does not slip; both without it",
};

impl ConstraintType for Rolling {
    fn keyword(&self) -> &'static str {
        "rolling"
    }

    fn keys(&self) -> &'static [Key] {
        &[LINK, AXIS, RADIUS, CROWN_RADIUS, RADII, ON, ROWS]
    }

    fn read(&self, fields: &Fields, reader: &mut RowReader<'_>) -> Option<ReadConstraint> {
        let at = reader.text(fields, &LINK)?;
        let size = size(fields, reader)?;
        let axle = match fields.get(&AXIS) {
            None => None,
            Some(_) => Some(reader.axis(fields, &AXIS)?),
        };
        let slip = slip(fields, reader, axle.is_some())?;
        let kind = ContactKind::Rolling {
            axle,
            size,
            slip,
            on: reader.text(fields, &ON),
        };
        Some(ReadConstraint::Contact(Box::new(ContactEntry {
            name: reader.name.value.clone(),
            location: reader.location.clone(),
            at,
            kind,
        })))
    }
}

/// Returns the size, from one of `radius` and `radii`.
fn size(fields: &Fields, reader: &mut RowReader<'_>) -> Option<RollingSize> {
    let given = |key: &Key| fields.get(key);
    if let Some(radii) = given(&RADII) {
        let others = [&RADIUS, &CROWN_RADIUS, &AXIS];
        if let Some((key, other)) = others.iter().find_map(|key| Some((key.name, given(key)?))) {
            let fault = wording::key_beside_radii(&other.location, key);
            reader.faults.push(fault);
            return None;
        }
        let ParsedValue::Vector(numbers) = &radii.value else {
            return None;
        };
        let each = |number: &Located<Number>| {
            let entry = Located {
                value: ParsedValue::Number(number.value.clone()),
                location: number.location.clone(),
            };
            length(&entry, "half-axis", reader)
        };
        // All, so that each mistake is reported.
        let [a, b, c] = numbers.each_ref().map(each);
        return Some(RollingSize::HalfAxes([a?, b?, c?]));
    }
    let Some(radius) = given(&RADIUS) else {
        let key = (RADIUS.name, RADIUS.about);
        let fault = wording::constraint_without_key(reader.location, &reader.name.value, key);
        reader.faults.push(fault);
        return None;
    };
    let radius = length(radius, "radius", reader);
    let crown = match given(&CROWN_RADIUS) {
        None => Some(Dd::ZERO),
        Some(crown) if given(&AXIS).is_none() => {
            let fault = wording::crown_of_ball(&crown.location);
            reader.faults.push(fault);
            None
        }
        Some(crown) => length(crown, "crown radius", reader),
    };
    Some(RollingSize::Radius(radius?, crown?))
}

/// Returns a length, which must be positive.
fn length(entry: &Located<ParsedValue>, what: &str, reader: &mut RowReader<'_>) -> Option<Dd> {
    let name = &reader.name.value;
    if let ParsedValue::Number(number) = &entry.value
        && number.parameter.is_some()
    {
        let fault = wording::radius_is_parameter(&entry.location, (what, name));
        reader.faults.push(fault);
        return None;
    }
    let length = reader.number(entry, Dimension::Length)?;
    if length > Dd::ZERO {
        return Some(length);
    }
    let fault = wording::radius_not_positive(&entry.location, (what, name), length.to_f64());
    reader.faults.push(fault);
    None
}

/// Returns which of the rows along the plane hold.
fn slip(fields: &Fields, reader: &mut RowReader<'_>, wheel: bool) -> Option<Slip> {
    let Some(Located {
        value: ParsedValue::Words(words),
        location,
    }) = fields.get(&ROWS)
    else {
        return Some(Slip::NONE);
    };
    if !wheel {
        reader.faults.push(wording::rows_of_ball(location));
        return None;
    }
    let unknown = words
        .iter()
        .find(|word| !WORDS.contains(&word.value.as_str()));
    if let Some(word) = unknown {
        let fault = wording::unknown_row(&word.location, &word.value, &WORDS);
        reader.faults.push(fault);
        return None;
    }
    if words.is_empty() {
        reader.faults.push(wording::no_rows(location, &WORDS));
        return None;
    }
    let has = |name: &str| words.iter().any(|word| word.value == name);
    Some(Slip {
        longitudinal: !has(WORDS[0]),
        lateral: !has(WORDS[1]),
    })
}
