//! Reads the planes that wheels and other contacts touch.

use bgdyn_runtime::Dd;

use super::placed::turn_to_axis;
use super::tree::{Tree, find_link};
use crate::fault::wording::expected;
use crate::fault::{Faults, Location, wording};
use crate::format::{Dimension, Key, Located, ParsedValue, Raw, Reads, Spec, check_unit};
use crate::math::Vec3;
use crate::mechanism::check::direction::Directions;
use crate::mechanism::{LinkId, Pose};

/// The keys of a plane in the file.
pub const PLANE_KEYS: [Key; 3] = [NORMAL, OFFSET, LINK];

const NORMAL: Key = Key {
    name: "normal",
    reads: Reads::Axis,
    needed: false,
    about: "its normal in the link's axes, towards what touches it; z without it",
};
const OFFSET: Key = Key {
    name: "offset",
    reads: Reads::Number(&[Dimension::Length]),
    needed: false,
    about: "its distance from the link's origin along the normal; 0 without it",
};
const LINK: Key = Key {
    name: "link",
    reads: Reads::Site,
    needed: false,
    about: "the link that it is fixed to; the world without it",
};

/// A plane: its link, and a place on it with z along its normal.
pub type Plane = (Option<LinkId>, Pose);

/// The planes of the file by name; `None` for one that breaks a rule.
pub type Planes<'a> = Vec<(&'a str, Option<Plane>)>;

/// Reads the planes of the file, also those that nothing touches.
pub fn planes<'a>(spec: &'a Spec, of: (Tree<'_>, &Directions), faults: &mut Faults) -> Planes<'a> {
    let raws = spec.planes.value().map_or(&[][..], Vec::as_slice);
    let named = |raw: &'a Raw| (raw.name.value.as_str(), read(raw, of, faults));
    raws.iter().map(named).collect()
}

/// Returns the plane of this name; the world's x–y plane for none.
pub fn plane(
    name: Option<&Located<String>>,
    planes: &Planes<'_>,
    faults: &mut Faults,
) -> Option<Plane> {
    let Some(name) = name else {
        return Some((None, Directions::identity()));
    };
    match planes.iter().find(|(known, _)| *known == name.value) {
        Some((_, plane)) => *plane,
        None => {
            let known: Vec<&str> = planes.iter().map(|(known, _)| *known).collect();
            faults.push(wording::unknown_plane(&name.location, &name.value, &known));
            None
        }
    }
}

fn read(
    raw: &Raw,
    (tree, directions): (Tree<'_>, &Directions),
    faults: &mut Faults,
) -> Option<Plane> {
    let what = expected::PLANE;
    let fields = raw.fields(what, &PLANE_KEYS, faults)?;
    let link = match fields.get(&LINK) {
        Some(Located {
            value: ParsedValue::Text(name),
            location,
        }) => find_link(name, location, tree, faults),
        _ => Some(None),
    };
    let up = Vec3([Dd::ZERO, Dd::ZERO, Dd::ONE]);
    let normal = match fields.get(&NORMAL) {
        Some(Located {
            value: ParsedValue::Vector(vector),
            location,
        }) => {
            let axis = Located {
                value: (**vector).clone(),
                location: location.clone(),
            };
            directions.axis(&axis, faults)
        }
        _ => Some(up),
    };
    let offset = match fields.get(&OFFSET) {
        Some(entry) => offset(&entry.value, &entry.location, faults),
        None => Some(Dd::ZERO),
    };
    let (link, normal, offset) = (link?, normal?, offset?);
    let rotation = match normal == up {
        true => Directions::identity().rotation,
        false => turn_to_axis(normal),
    };
    let translation = normal.scale(offset);
    Some((
        link,
        Pose {
            rotation,
            translation,
        },
    ))
}

fn offset(value: &ParsedValue, location: &Location, faults: &mut Faults) -> Option<Dd> {
    let ParsedValue::Number(number) = value else {
        return None;
    };
    let number = Located {
        value: number.clone(),
        location: location.clone(),
    };
    if let Some(fault) = check_unit(&number, &[Dimension::Length]) {
        faults.push(fault);
        return None;
    }
    Some(number.value.value)
}
