//! `rolling`: a thin wheel, or a ball, rolls on a plane without slipping.

use bgdyn_runtime::Dd;

use super::constraint_type::{ConstraintType, ReadConstraint};
use super::contact::{ContactEntry, ContactKind, Slip};
use super::row::RowReader;
use crate::fault::wording;
use crate::format::{Dimension, Fields, Key, Located, ParsedValue, Reads};

/// The type `rolling`.
pub(super) struct Rolling;

const LINK: Key = Key {
    name: "link",
    reads: Reads::Site,
    needed: true,
    about: "the wheel or ball: a link, or a frame on it, with its centre at the origin",
};

const AXIS: Key = Key {
    name: "axis",
    reads: Reads::Axis,
    needed: false,
    about: "the direction of a wheel's axle in these axes; without it a ball",
};

const RADIUS: Key = Key {
    name: "radius",
    reads: Reads::Number(&[Dimension::Length]),
    needed: true,
    about: "its radius",
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
        &[LINK, AXIS, RADIUS, ON, ROWS]
    }

    fn read(&self, fields: &Fields, reader: &mut RowReader<'_>) -> Option<ReadConstraint> {
        let at = reader.text(fields, &LINK)?;
        let radius = radius(fields, reader)?;
        let axle = match fields.get(&AXIS) {
            None => None,
            Some(_) => Some(reader.axis(fields, &AXIS)?),
        };
        let slip = slip(fields, reader, axle.is_some())?;
        let kind = ContactKind::Rolling {
            axle,
            radius,
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

fn radius(fields: &Fields, reader: &mut RowReader<'_>) -> Option<Dd> {
    let entry = fields.get(&RADIUS)?;
    if let ParsedValue::Number(number) = &entry.value
        && number.parameter.is_some()
    {
        let fault = wording::radius_is_parameter(&entry.location, &reader.name.value);
        reader.faults.push(fault);
        return None;
    }
    let radius = reader.number(entry, Dimension::Length)?;
    if radius > Dd::ZERO {
        return Some(radius);
    }
    let fault = wording::radius_not_positive(&entry.location, &reader.name.value, radius.to_f64());
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
