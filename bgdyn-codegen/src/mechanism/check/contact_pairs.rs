//! Reads the entries of `contacts`: spheres, capsules and boxes, and what they may touch.

use bgdyn_runtime::Dd;

use super::loops::{Context, Planes, find_site, plane};
use crate::fault::wording::expected;
use crate::fault::{Faults, Location, wording};
use crate::format::{Dimension, Fields, Key, Located, ParsedValue, Raw, Reads, check_unit};
use crate::math::{Mat3, Vec3};
use crate::mechanism::{ContactPair, ContactPartner, ContactSphere, LinkId, Pose};
use crate::name::is_identifier;

/// The keys of an entry of `contacts`.
pub const CONTACT_KEYS: [Key; 9] = [LINK, AT, RADIUS, TO, SIZE, ON, WITH, WITH_AT, WITH_RADIUS];

const LENGTH: &[Dimension] = &[Dimension::Length];

const LINK: Key = Key {
    name: "link",
    reads: Reads::Site,
    needed: true,
    about: "what may touch something: a link, or a frame on it",
};
const AT: Key = Key {
    name: "at",
    reads: Reads::Vector(LENGTH),
    needed: false,
    about: "the centre of the sphere or the box in these axes; the origin without it",
};
const RADIUS: Key = Key {
    name: "radius",
    reads: Reads::Number(LENGTH),
    needed: false,
    about: "the radius of the sphere, of the capsule's ends, or of the box's corners; points without it",
};
const TO: Key = Key {
    name: "to",
    reads: Reads::Vector(LENGTH),
    needed: false,
    about: "the centre of a second sphere: both are the ends of a capsule",
};
const SIZE: Key = Key {
    name: "size",
    reads: Reads::Vector(LENGTH),
    needed: false,
    about: "the edges of a box along these axes, whose eight corners may touch",
};
const ON: Key = Key {
    name: "on",
    reads: Reads::Plane,
    needed: false,
    about: "the plane, one of `planes`; the world's x–y plane without it",
};
const WITH: Key = Key {
    name: "with",
    reads: Reads::Site,
    needed: false,
    about: "the link or frame of another sphere, instead of a plane",
};
const WITH_AT: Key = Key {
    name: "with_at",
    reads: Reads::Vector(LENGTH),
    needed: false,
    about: "the centre of the other sphere in those axes; the origin without it",
};
const WITH_RADIUS: Key = Key {
    name: "with_radius",
    reads: Reads::Number(LENGTH),
    needed: false,
    about: "the radius of the other sphere; a point without it",
};

/// The cosine above which a normal is close to x.
const CLOSE: f64 = 0.9;

/// Reads the entries of `contacts`. `None` if a rule is broken.
pub(super) fn contact_pairs(
    context: Context<'_>,
    planes: &Planes<'_>,
    faults: &mut Faults,
) -> Option<Vec<ContactPair>> {
    let before = faults.count();
    let raws = context.0.contacts.value().map_or(&[][..], Vec::as_slice);
    let mut pairs: Vec<(ContactPair, Location)> = Vec::new();
    for raw in raws {
        for pair in read(raw, context, planes, faults).unwrap_or_default() {
            if pairs.iter().any(|(known, _)| known.name == pair.name) {
                let fault = wording::contact_pair_named_twice(&raw.name.location, &pair.name);
                faults.push(fault);
            }
            pairs.push((pair, raw.location.clone()));
        }
    }
    (faults.count() == before).then(|| pairs.into_iter().map(|(pair, _)| pair).collect())
}

/// Reads the pairs of one entry.
fn read(
    raw: &Raw,
    context: Context<'_>,
    planes: &Planes<'_>,
    faults: &mut Faults,
) -> Option<Vec<ContactPair>> {
    let name = &raw.name;
    if !is_identifier(&name.value) {
        faults.push(wording::not_identifier(&name.location, &name.value));
    }
    let before = faults.count();
    let fields = raw.fields(expected::CONTACT, &CONTACT_KEYS, faults)?;
    if fields.get(&LINK).is_none() {
        let key = (LINK.name, LINK.about);
        faults.push(wording::contact_without_key(
            &raw.location,
            &name.value,
            key,
        ));
    }
    let mut reader = ContactReader {
        fields: &fields,
        context,
        faults,
    };
    let place = reader.site(&LINK);
    let centres = reader.centres(&name.value);
    let radius = reader.radius(&RADIUS, &name.value);
    let partner = reader.partner(planes, raw);
    if faults.count() > before {
        return None;
    }
    let ((link, pose), radius, partner) = (place?, radius?, partner?);
    if let ContactPartner::Sphere(other) = partner
        && other.radius + radius == Dd::ZERO
    {
        faults.push(wording::contact_of_points(&raw.location, &name.value));
        return None;
    }
    let centres = centres?;
    let several = centres.len() > 1;
    let pair = |(k, at): (usize, Vec3<Dd>)| ContactPair {
        name: match several {
            true => format!("{}_{}", name.value, k + 1),
            false => name.value.clone(),
        },
        entry: name.value.clone(),
        sphere: ContactSphere {
            link,
            centre: pose.translation + pose.rotation * at,
            radius,
        },
        partner,
    };
    Some(centres.into_iter().enumerate().map(pair).collect())
}

/// Reads the keys of one entry.
struct ContactReader<'a> {
    fields: &'a Fields,
    context: Context<'a>,
    faults: &'a mut Faults,
}

impl ContactReader<'_> {
    /// Returns link and pose of the link or frame that a key names.
    fn site(&mut self, key: &Key) -> Option<(Option<LinkId>, Pose)> {
        let entry = self.fields.get(key)?;
        let ParsedValue::Text(name) = &entry.value else {
            return None;
        };
        let name = Located {
            value: name.clone(),
            location: entry.location.clone(),
        };
        find_site(&name, self.context.1, self.faults)
    }

    /// Returns the vector of a key; `None` without one.
    fn vector(&self, key: &Key) -> Option<Vec3<Dd>> {
        let ParsedValue::Vector(vector) = &self.fields.get(key)?.value else {
            return None;
        };
        Some(Vec3(vector.each_ref().map(|number| number.value.value)))
    }

    /// Returns the centres of the spheres: one, the ends of a capsule, or the corners of a box.
    fn centres(&mut self, name: &str) -> Option<Vec<Vec3<Dd>>> {
        let at = self.vector(&AT).unwrap_or(Vec3([Dd::ZERO; 3]));
        if let Some(size) = self.fields.get(&SIZE) {
            if let Some(to) = self.fields.get(&TO) {
                self.faults
                    .push(wording::capsule_with_size(&to.location, name));
            }
            let edges = self.vector(&SIZE)?;
            if edges.0.iter().any(|edge| *edge <= Dd::ZERO) {
                let edges = edges.0.map(Dd::to_f64);
                let fault = wording::box_edge_not_positive(&size.location, name, &edges);
                self.faults.push(fault);
                return None;
            }
            return Some(corners(at, edges));
        }
        let to = self.vector(&TO);
        if let (Some(to), Some(entry)) = (to, self.fields.get(&TO))
            && to == at
        {
            let fault = wording::capsule_without_length(&entry.location, name);
            self.faults.push(fault);
        }
        Some([Some(at), to].into_iter().flatten().collect())
    }

    /// Returns the radius of a key; 0 without one.
    fn radius(&mut self, key: &Key, name: &str) -> Option<Dd> {
        let Some(entry) = self.fields.get(key) else {
            return Some(Dd::ZERO);
        };
        let ParsedValue::Number(number) = &entry.value else {
            return None;
        };
        let located = Located {
            value: number.clone(),
            location: entry.location.clone(),
        };
        let fault = match &number.parameter {
            Some(_) => Some(wording::contact_radius_is_parameter(&entry.location, name)),
            None if number.value < Dd::ZERO => Some(wording::contact_radius_negative(
                &entry.location,
                (key.name, name),
                &number.text,
            )),
            None => check_unit(&located, LENGTH),
        };
        if let Some(fault) = fault {
            self.faults.push(fault);
            return None;
        }
        Some(number.value)
    }

    /// Returns what the spheres may touch: a plane, or the sphere of `with`.
    fn partner(&mut self, planes: &Planes<'_>, raw: &Raw) -> Option<ContactPartner> {
        let name = &raw.name.value;
        if self.fields.get(&WITH).is_some() {
            if let Some(on) = self.fields.get(&ON) {
                self.faults
                    .push(wording::contact_on_and_with(&on.location, name));
            }
            let place = self.site(&WITH);
            let radius = self.radius(&WITH_RADIUS, name);
            let at = self.vector(&WITH_AT).unwrap_or(Vec3([Dd::ZERO; 3]));
            let ((link, pose), radius) = (place?, radius?);
            return Some(ContactPartner::Sphere(ContactSphere {
                link,
                centre: pose.translation + pose.rotation * at,
                radius,
            }));
        }
        for key in [&WITH_AT, &WITH_RADIUS] {
            if let Some(entry) = self.fields.get(key) {
                self.faults
                    .push(wording::contact_key_without_with(&entry.location, key.name));
            }
        }
        let on = match self.fields.get(&ON) {
            Some(Located {
                value: ParsedValue::Text(name),
                location,
            }) => Some(Located {
                value: name.clone(),
                location: location.clone(),
            }),
            _ => None,
        };
        let (link, pose) = plane(on.as_ref(), planes, self.faults)?;
        let pose = Pose {
            rotation: axes(pose.rotation.column(2)),
            ..pose
        };
        let given_base = self
            .context
            .0
            .base
            .value()
            .is_some_and(|word| word == "given");
        if given_base && link.is_none() {
            self.faults
                .push(wording::contact_of_given_base(&raw.location, name));
            return None;
        }
        Some(ContactPartner::Plane { link, pose })
    }
}

/// Returns the axes of a plane with this normal: x is along the projection of the link's x, or y along that of the link's
/// y where the normal is close to x. They are continuous where the normal is close to z.
fn axes(normal: Vec3<Dd>) -> Mat3<Dd> {
    let projected = |k: usize| {
        let mut axis = Vec3([Dd::ZERO; 3]);
        axis.0[k] = Dd::ONE;
        if normal.0[k] == Dd::ZERO {
            return axis;
        }
        let across = axis - normal.scale(normal.0[k]);
        across.scale(Dd::ONE / across.dot(across).sqrt())
    };
    let (x, y) = match normal.0[0].to_f64().abs() > CLOSE {
        true => (projected(1).cross(normal), projected(1)),
        false => (projected(0), normal.cross(projected(0))),
    };
    Mat3::from_fn(|i, j| [x, y, normal][j].0[i])
}

/// Returns the corners of a box: x changes first, then y, then z.
fn corners(centre: Vec3<Dd>, edges: Vec3<Dd>) -> Vec<Vec3<Dd>> {
    let half = edges.scale(Dd::from_f64(0.5));
    let corner = |k: usize| {
        let side = |i: usize| match k >> i & 1 {
            0 => -half.0[i],
            _ => half.0[i],
        };
        centre + Vec3([side(0), side(1), side(2)])
    };
    (0..8).map(corner).collect()
}
