//! The oracle's own mechanism: bodies of a tree, parsed from the file's text.

use std::collections::BTreeMap;

use bgdyn_runtime::Dd;
use serde_yaml::Value;

use super::contact::{Contact, contacts};
use super::vector::{
    M3, V3, add, apply, cross, dd, identity, norm, scale, times, transposed, turn,
};
use super::yaml::{
    Origin, decimal, direction, list, number, number_or, origin, tensor, text, vector,
};

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    Fixed,
    Turns,
    Slides,
}

/// Mass, centre of mass, tensor about it, in the axes of a link.
#[derive(Clone, Copy, Debug)]
pub struct Mass {
    pub mass: Dd,
    pub com: V3,
    pub tensor: M3,
}

#[derive(Clone, Debug)]
pub struct Body {
    pub name: String,
    pub parent: Option<usize>,
    pub joint: String,
    pub kind: Kind,
    pub axis: V3,
    pub origin: Origin,
    /// The link's own mass, and its payloads.
    pub masses: Vec<Mass>,
}

/// A site on a body, or in the world.
#[derive(Clone, Copy, Debug)]
pub struct Place {
    pub body: Option<usize>,
    pub origin: Origin,
}

#[derive(Clone, Debug)]
pub struct Mechanism {
    /// Parents before children.
    pub bodies: Vec<Body>,
    pub places: BTreeMap<String, Place>,
    pub contacts: Vec<Contact>,
    pub gravity: V3,
}

impl Mechanism {
    pub fn read(text_of_file: &str) -> Self {
        let file: Value = serde_yaml::from_str(text_of_file).expect("YAML");
        let down = [Dd::ZERO, Dd::ZERO, decimal("-9.81")];
        let gravity = file.get("gravity").map_or(down, |g| vector(Some(g)));
        let mut read = Mechanism {
            bodies: vec![],
            places: BTreeMap::new(),
            contacts: vec![],
            gravity,
        };
        let here = Origin {
            rotation: identity(),
            place: [Dd::ZERO; 3],
        };
        read.places.insert(
            "world".into(),
            Place {
                body: None,
                origin: here,
            },
        );
        for link in list(&file["links"]) {
            let body = body(link, &read);
            let place = Place {
                body: Some(read.bodies.len()),
                origin: here,
            };
            read.places.insert(body.name.clone(), place);
            read.bodies.push(body);
        }
        for frame in file.get("frames").map_or(&[][..], list) {
            let on = read.places[text(frame, "link").expect("a link")].body;
            let place = Place {
                body: on,
                origin: origin(frame.get("origin")),
            };
            read.places
                .insert(text(frame, "name").expect("a name").into(), place);
        }
        read.contacts = contacts(&file, &read.places);
        read
    }

    pub fn contact(&self, name: &str) -> &Contact {
        let found = self.contacts.iter().find(|c| c.name == name);
        found.unwrap_or_else(|| panic!("no contact {name}"))
    }

    pub fn body_of_joint(&self, joint: &str) -> usize {
        let found = self.bodies.iter().position(|b| b.joint == joint);
        found.unwrap_or_else(|| panic!("no joint {joint}"))
    }
}

fn body(link: &Value, read: &Mechanism) -> Body {
    let joint = link.get("joint").unwrap_or(&Value::Null);
    let parent = text(link, "parent").map(|p| read.places[p].body.expect("a link"));
    let kind = match text(joint, "type") {
        Some("revolute" | "continuous") => Kind::Turns,
        Some("prismatic") => Kind::Slides,
        _ => Kind::Fixed,
    };
    let own = Mass {
        mass: number_or(link, "mass", 0.0),
        com: vector(link.get("com")),
        tensor: tensor(link.get("inertia")),
    };
    Body {
        name: text(link, "name").expect("a name").into(),
        parent,
        joint: text(joint, "name").unwrap_or_default().into(),
        kind,
        axis: direction(joint.get("axis")),
        origin: origin(joint.get("origin")),
        masses: vec![own],
    }
}

/// Returns the mass of a payload; `place` is its pose on the body.
pub fn carried(effect: &Value, place: Place) -> Mass {
    let Origin {
        rotation,
        place: at,
    } = place.origin;
    let own = tensor(effect.get("inertia"));
    Mass {
        mass: number(&effect["mass"]),
        com: add(at, apply(rotation, vector(effect.get("com")))),
        tensor: times(rotation, times(own, transposed(rotation))),
    }
}

/// A body's motion in world axes.
#[derive(Clone, Copy, Debug)]
pub struct Motion {
    /// Columns are the body's axes.
    pub rotation: M3,
    pub place: V3,
    /// The axis of its joint.
    pub axis: V3,
    pub turning: V3,
    pub velocity: V3,
    pub turning_rate: V3,
    pub acceleration: V3,
}

/// A body at rest in the world's axes.
pub const REST: fn() -> Motion = || Motion {
    rotation: identity(),
    place: [Dd::ZERO; 3],
    axis: [Dd::ZERO; 3],
    turning: [Dd::ZERO; 3],
    velocity: [Dd::ZERO; 3],
    turning_rate: [Dd::ZERO; 3],
    acceleration: [Dd::ZERO; 3],
};

impl Motion {
    /// Returns the velocity of a point fixed to the body, given relative to its origin in world axes.
    pub fn velocity_at(&self, arm: V3) -> V3 {
        add(self.velocity, cross(self.turning, arm))
    }

    pub fn acceleration_at(&self, arm: V3) -> V3 {
        let centripetal = cross(self.turning, cross(self.turning, arm));
        add(
            add(self.acceleration, cross(self.turning_rate, arm)),
            centripetal,
        )
    }
}

/// The motion of all bodies for the coordinate, rate and acceleration of each one's joint.
pub fn motions(mechanism: &Mechanism, joint: impl Fn(usize) -> [Dd; 3]) -> Vec<Motion> {
    let mut all: Vec<Motion> = Vec::new();
    for (i, body) in mechanism.bodies.iter().enumerate() {
        let base = body.parent.map_or_else(REST, |p| all[p]);
        let arm = apply(base.rotation, body.origin.place);
        let mut moved = Motion {
            rotation: times(base.rotation, body.origin.rotation),
            place: add(base.place, arm),
            velocity: base.velocity_at(arm),
            acceleration: base.acceleration_at(arm),
            ..base
        };
        let axis = apply(moved.rotation, body.axis);
        moved.axis = axis;
        let [q, rate, acceleration] = joint(i);
        match body.kind {
            Kind::Fixed => {}
            Kind::Turns => {
                moved.rotation = times(moved.rotation, turn(body.axis, q));
                moved.turning = add(base.turning, scale(axis, rate));
                let carried = cross(base.turning, scale(axis, rate));
                let own = add(scale(axis, acceleration), carried);
                moved.turning_rate = add(base.turning_rate, own);
            }
            Kind::Slides => {
                let arm = add(arm, scale(axis, q));
                moved.place = add(base.place, arm);
                moved.velocity = add(base.velocity_at(arm), scale(axis, rate));
                let coriolis = scale(cross(base.turning, axis), rate + rate);
                let own = add(scale(axis, acceleration), coriolis);
                moved.acceleration = add(base.acceleration_at(arm), own);
            }
        }
        all.push(moved);
    }
    all
}

/// Returns a site's origin relative to its body's, its axes, its motion: all in world axes.
pub fn seen(place: Place, motions: &[Motion]) -> (V3, M3, Motion) {
    let carrier = place.body.map_or_else(REST, |b| motions[b]);
    let arm = apply(carrier.rotation, place.origin.place);
    (arm, times(carrier.rotation, place.origin.rotation), carrier)
}

/// Returns the unit vector from one site to another, their distance, and its rate.
pub fn line(a: Place, b: Place, motions: &[Motion]) -> (V3, Dd, Dd) {
    let [(from, start), (to, end)] = [a, b].map(|p| {
        let (arm, _, m) = seen(p, motions);
        (add(m.place, arm), m.velocity_at(arm))
    });
    let apart = super::vector::sub(to, from);
    let length = norm(apart);
    let unit = scale(apart, Dd::ONE / length);
    let rate = super::vector::dot(unit, super::vector::sub(end, start));
    (unit, length, rate)
}

/// A force at a point and a moment that act on a body, world axes.
#[derive(Clone, Copy, Debug)]
pub struct Wrench {
    pub body: usize,
    pub at: V3,
    pub force: V3,
    pub moment: V3,
}

/// Newton–Euler: returns the effort at each body's joint for the motion, under external wrenches.
pub fn efforts(
    mechanism: &Mechanism,
    motions: &[Motion],
    gravity: V3,
    extended: bool,
    wrenches: &[Wrench],
) -> Vec<Dd> {
    let zero = [Dd::ZERO; 3];
    // Force transmitted by each joint, and its moment about the world's origin.
    let mut handed = vec![(zero, zero); motions.len()];
    let mut give = |body: usize, at: V3, force: V3, moment: V3| {
        let (f, m) = &mut handed[body];
        *f = add(*f, force);
        *m = add(*m, add(moment, cross(at, force)));
    };
    for (i, (body, m)) in mechanism.bodies.iter().zip(motions).enumerate() {
        for mass in &body.masses {
            let arm = apply(m.rotation, mass.com);
            let free = super::vector::sub(m.acceleration_at(arm), gravity);
            let spin = if extended {
                let tensor = times(m.rotation, times(mass.tensor, transposed(m.rotation)));
                let gyroscopic = cross(m.turning, apply(tensor, m.turning));
                add(apply(tensor, m.turning_rate), gyroscopic)
            } else {
                zero
            };
            give(i, add(m.place, arm), scale(free, mass.mass), spin);
        }
    }
    for w in wrenches {
        give(
            w.body,
            w.at,
            scale(w.force, dd(-1.0)),
            scale(w.moment, dd(-1.0)),
        );
    }
    let mut efforts = vec![Dd::ZERO; motions.len()];
    for i in (0..motions.len()).rev() {
        let (force, moment) = handed[i];
        let m = &motions[i];
        let about = super::vector::sub(moment, cross(m.place, force));
        efforts[i] = match mechanism.bodies[i].kind {
            Kind::Fixed => Dd::ZERO,
            Kind::Turns => super::vector::dot(m.axis, about),
            Kind::Slides => super::vector::dot(m.axis, force),
        };
        if let Some(p) = mechanism.bodies[i].parent {
            handed[p] = (add(handed[p].0, force), add(handed[p].1, moment));
        }
    }
    efforts
}
