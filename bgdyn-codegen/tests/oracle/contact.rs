//! Contacts of a mechanism, as in the format: what may touch what, and how it meets in a state.

use std::collections::BTreeMap;

use bgdyn_runtime::Dd;
use serde_yaml::Value;

use super::mechanism::{Motion, Place, seen};
use super::vector::{V3, add, apply, cross, dd, dot, identity, norm, scale, sub};
use super::yaml::{Origin, direction, number, number_or, text, vector};

/// A sphere on a body, and what it may touch.
#[derive(Clone, Debug)]
pub struct Contact {
    pub name: String,
    /// The entry of the file that it belongs to: a capsule or a box has several.
    pub entry: String,
    pub shape: &'static str,
    pub centre: Place,
    pub radius: Dd,
    pub partner: Partner,
}

#[derive(Clone, Copy, Debug)]
pub enum Partner {
    /// The points x with normal · x = offset, in the axes of a body.
    Plane {
        /// Without it the world's.
        named: bool,
        body: Option<usize>,
        normal: V3,
        offset: Dd,
    },
    Sphere {
        centre: Place,
        radius: Dd,
    },
}

/// The contacts in a mechanism's file.
pub fn contacts(file: &Value, places: &BTreeMap<String, Place>) -> Vec<Contact> {
    let mut found = Vec::new();
    let entries = file.get("contacts").and_then(Value::as_mapping);
    for (name, keys) in entries.into_iter().flatten() {
        let entry = name.as_str().expect("a name");
        let on = places[text(keys, "link").expect("a link")];
        let partner = partner(file, keys, places);
        let centres = centres(keys);
        for (i, &at) in centres.iter().enumerate() {
            found.push(Contact {
                name: match centres.len() {
                    1 => entry.to_owned(),
                    _ => format!("{entry}_{}", i + 1),
                },
                entry: entry.to_owned(),
                shape: match (centres.len(), keys.get("radius").map(number)) {
                    (8, _) => "box",
                    (2, _) => "capsule",
                    (_, Some(r)) if r > Dd::ZERO => "sphere",
                    _ => "point",
                },
                centre: shifted(on, at),
                radius: number_or(keys, "radius", 0.0),
                partner,
            });
        }
    }
    found
}

/// The centre of a sphere, the two of a capsule, the corners of a box: x changes first, then y, then z.
fn centres(keys: &Value) -> Vec<V3> {
    let at = vector(keys.get("at"));
    if let Some(end) = keys.get("to") {
        return vec![at, vector(Some(end))];
    }
    let Some(size) = keys.get("size") else {
        return vec![at];
    };
    let half = scale(vector(Some(size)), dd(0.5));
    let corner = |i: usize| {
        let side = |k: usize| dd(if i >> k & 1 == 1 { 1.0 } else { -1.0 });
        add(at, std::array::from_fn(|k| side(k) * half[k]))
    };
    (0..8).map(corner).collect()
}

/// Returns the place with its origin moved, along its own axes.
pub fn shifted(place: Place, by: V3) -> Place {
    let Origin { rotation, place: o } = place.origin;
    let origin = Origin {
        rotation,
        place: add(o, apply(rotation, by)),
    };
    Place { origin, ..place }
}

fn partner(file: &Value, keys: &Value, places: &BTreeMap<String, Place>) -> Partner {
    if let Some(with) = text(keys, "with") {
        return Partner::Sphere {
            centre: shifted(places[with], vector(keys.get("with_at"))),
            radius: number_or(keys, "with_radius", 0.0),
        };
    }
    let plane = text(keys, "on").map_or(&Value::Null, |on| &file["planes"][on]);
    Partner::Plane {
        named: keys.get("on").is_some(),
        body: text(plane, "link").and_then(|link| places[link].body),
        normal: direction(plane.get("normal")),
        offset: number_or(plane, "offset", 0.0),
    }
}

/// A contact in a state, in world axes.
pub struct Meeting {
    pub gap: Dd,
    /// From the partner to the sphere.
    pub normal: V3,
    /// The contact point.
    pub at: V3,
    /// Velocity of the sphere's body there, less that of the partner's.
    pub velocity: V3,
    /// Axes x and y of the plane; of two spheres any.
    pub axes: [V3; 2],
}

impl Contact {
    pub fn partner_body(&self) -> Option<usize> {
        match self.partner {
            Partner::Plane { body, .. } => body,
            Partner::Sphere { centre, .. } => centre.body,
        }
    }

    /// g = n·(p − p₀) − r with c = p − r n, or g = |p₁ − p₂| − r₁ − r₂ with c in the middle of the overlap;
    /// γ = v₁ + ω₁ × (c − o₁) − v₂ − ω₂ × (c − o₂).
    pub fn meeting(&self, motions: &[Motion]) -> Meeting {
        let centre = |place: Place| {
            let (arm, _, carrier) = seen(place, motions);
            add(carrier.place, arm)
        };
        let p = centre(self.centre);
        let (gap, normal, at, axes) = match self.partner {
            Partner::Plane {
                body,
                normal,
                offset,
                ..
            } => {
                let carrier = carrier(body, motions);
                let turned = |x: V3| apply(carrier.rotation, x);
                let n = turned(normal);
                let gap = dot(n, sub(p, carrier.place)) - offset - self.radius;
                let at = sub(p, scale(n, self.radius));
                (gap, n, at, tangents(normal).map(turned))
            }
            Partner::Sphere {
                centre: other,
                radius,
            } => {
                let apart = sub(p, centre(other));
                let length = norm(apart);
                let n = scale(apart, Dd::ONE / length);
                let gap = length - self.radius - radius;
                // From p to the surface, and half of the gap farther.
                let at = sub(p, scale(n, self.radius + gap * dd(0.5)));
                (gap, n, at, tangents(n))
            }
        };
        let of = |body| {
            let m = carrier(body, motions);
            m.velocity_at(sub(at, m.place))
        };
        let velocity = sub(of(self.centre.body), of(self.partner_body()));
        Meeting {
            gap,
            normal,
            at,
            velocity,
            axes,
        }
    }
}

fn carrier(body: Option<usize>, motions: &[Motion]) -> Motion {
    let here = Place {
        body,
        origin: super::yaml::origin(None),
    };
    seen(here, motions).2
}

/// Axes x and y of a plane with this normal n: x is the direction of the projection of the link's x, y = n × x; where
/// |n_x| > 0.9, y is that of the link's y, and x = y × n.
fn tangents(n: V3) -> [V3; 2] {
    let projected = |k: usize| {
        let across = sub(identity()[k], scale(n, n[k]));
        scale(across, Dd::ONE / norm(across))
    };
    if n[0].abs().to_f64() > 0.9 {
        let y = projected(1);
        return [cross(y, n), y];
    }
    let x = projected(0);
    [x, cross(n, x)]
}
