//! The moving bodies of a mechanism and the points on them, for the page.

use bgdyn_codegen::declaration::Element;
use bgdyn_codegen::mechanism::closure::{ContactShape, PlaneContact};
use bgdyn_codegen::mechanism::{Link, LinkId, Mechanism, Motion, Pose, Value};
use bgdyn_codegen::scene::Scene;

use super::body::{Body, BodyJoint, BodyPoint, End, Placed};
use super::stops::stops;

/// Returns the word by which the page draws a joint.
fn drawn_as(motion: Motion) -> &'static str {
    match motion {
        Motion::Translation => "prismatic",
        Motion::None | Motion::Rotation => "revolute",
        Motion::Compound(motion) if motion.manifold.is_empty() => "revolute",
        Motion::Compound(motion) => motion.manifold,
    }
}

/// Returns the least and the largest position of a joint of one degree.
fn own_travel(link: &Link, travel: &[(f64, f64)]) -> (f64, f64) {
    let degrees = &link.joint.degrees;
    let start = (degrees.offset().to_f64(), degrees.offset().to_f64());
    let terms = degrees.positions.iter().zip(degrees.position_ratios());
    terms.fold(start, |(low, high), (p, ratio)| {
        let own = travel.get(p.0).copied().unwrap_or_default();
        let (a, b) = (ratio.to_f64() * own.0, ratio.to_f64() * own.1);
        (low + a.min(b), high + a.max(b))
    })
}

/// Corners of the polygon that is drawn as the rim of a wheel.
const RIM: usize = 24;

/// Returns two unit vectors that are perpendicular to a unit vector and to each other.
fn across(axle: [f64; 3]) -> [[f64; 3]; 2] {
    let cross = |a: [f64; 3], b: [f64; 3]| -> [f64; 3] {
        std::array::from_fn(|i| {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            a[j] * b[k] - a[k] * b[j]
        })
    };
    let smallest = (0..3).min_by(|&i, &j| axle[i].abs().total_cmp(&axle[j].abs()));
    let mut other = [0.0; 3];
    other[smallest.unwrap_or(0)] = 1.0;
    let first = cross(axle, other);
    let length = first.iter().map(|x| x * x).sum::<f64>().sqrt();
    let first = first.map(|x| x / length);
    [first, cross(axle, first)]
}

/// The bodies of a scene, and the poses of its links on them.
pub(super) struct Bodies {
    pub(super) all: Vec<Body>,
    on: Vec<(usize, Placed)>,
}

impl Bodies {
    /// Returns the bodies, with the joints' travel by coordinate.
    pub(super) fn new(scene: &Scene, travel: &[(f64, f64)]) -> Self {
        let mechanism = &scene.mechanism;
        let mut bodies = Bodies {
            all: vec![Body::new("world", None)],
            on: Vec::new(),
        };
        for (i, link) in mechanism.links().iter().enumerate() {
            bodies.link(i, link, travel);
        }
        bodies.closings(mechanism);
        for (i, link) in mechanism.links().iter().enumerate() {
            bodies.mass(i, link, scene);
        }
        bodies.frames(mechanism);
        bodies.tips(mechanism);
        bodies.stops(scene);
        bodies
    }

    fn stops(&mut self, scene: &Scene) {
        for body in &mut self.all {
            let found = body.joint.as_ref().map(|joint| {
                let slides = joint.kind == "prismatic";
                stops(scene, &joint.name, &joint.placed, body, slides)
            });
            if let (Some(joint), Some(found)) = (&mut body.joint, found) {
                joint.stops = found;
            }
        }
    }

    /// Returns the body of a link, and the pose of the link on it.
    pub(super) fn carrier(&self, link: Option<LinkId>) -> (usize, Placed) {
        link.map_or((0, Placed::HERE), |l| self.on[l.0])
    }

    fn link(&mut self, i: usize, link: &Link, travel: &[(f64, f64)]) {
        let (carrier, place) = self.carrier(link.parent);
        let joint = place.then(&Placed::of(&link.joint.origin));
        let motion = link.joint.kind.motion;
        let kind = drawn_as(motion);
        // A joint with displacements in several directions has no place on its carrier.
        if !matches!(kind, "floating" | "planar") {
            self.all[carrier].beam(place.o, joint.o);
        }
        if motion == Motion::None {
            self.on.push((carrier, joint));
            return;
        }
        let axis = match motion.has_axis() {
            true => link.joint.axis.map(|x| x.to_f64()).0,
            false => [0.0, 0.0, 1.0],
        };
        let along = joint.rotate(axis);
        let (low, high) = match kind {
            "prismatic" => own_travel(link, travel),
            _ => (0.0, 0.0),
        };
        let moved = |s: f64| std::array::from_fn(|k| joint.o[k] + s * along[k]);
        let mut body = Body::new(&link.name, Some(i));
        body.joint = Some(BodyJoint {
            name: link.joint.name.clone(),
            kind,
            axis,
            on: carrier,
            along,
            from: moved(low),
            to: moved(high),
            stops: Vec::new(),
            placed: joint,
        });
        if kind == "floating" {
            body.points.push(BodyPoint {
                name: link.name.clone(),
                axes: Some(Placed::HERE.axes()),
                ..BodyPoint::at([0.0; 3])
            });
        }
        self.all.push(body);
        self.on.push((self.all.len() - 1, Placed::HERE));
    }

    fn mass(&mut self, i: usize, link: &Link, scene: &Scene) {
        let number = |value: &Value| match value {
            Value::Fixed(x) => x.to_f64(),
            Value::Parameter(p) => scene.parameters[p.0].default.to_f64(),
        };
        let (body, place) = self.on[i];
        let mass = number(&link.inertial.mass);
        if mass <= 0.0 || body == 0 {
            return;
        }
        let at = place.point(link.inertial.com.0.each_ref().map(number));
        let bare = !self.all[body].points.iter().any(|p| p.beam);
        if bare {
            self.all[body].beam(place.o, at);
        }
        let from = self.all[body].nearest(at);
        let is_load = |e: &Element| e.effect.keyword() == "payload" && e.name == link.name;
        let load = scene.elements.iter().any(is_load);
        self.all[body].points.push(BodyPoint {
            name: match load {
                true => link.name.clone(),
                false => String::new(),
            },
            mass: Some(mass),
            load,
            from,
            ..BodyPoint::at(at)
        });
    }

    /// Adds the places at which loops close, with beams to them, and the rims of wheels and balls.
    fn closings(&mut self, mechanism: &Mechanism) {
        for one in mechanism.closure().into_iter().flat_map(|c| &c.loops) {
            if let Some(contact) = &one.contact {
                let (body, place) = self.carrier(one.links[0]);
                self.rims(body, &place.then(&Placed::of(&contact.place)), contact);
                continue;
            }
            let places = [&one.chain.start, &one.chain.end];
            self.pin(&one.name, one.links, places);
        }
        for one in mechanism.parallel_loops() {
            self.pin(&one.name, one.links, one.places.each_ref());
        }
    }

    /// Adds the two places at which a loop closes.
    fn pin(&mut self, name: &str, links: [Option<LinkId>; 2], places: [&Pose; 2]) {
        let names = [name, ""];
        for ((link, pose), name) in links.into_iter().zip(places).zip(names) {
            let (body, place) = self.carrier(link);
            let at = place.point(Placed::of(pose).o);
            let from = self.all[body].nearest(at);
            self.all[body].points.push(BodyPoint {
                name: name.to_owned(),
                beam: body != 0 && from != at,
                from,
                ..BodyPoint::at(at)
            });
        }
    }

    /// Adds the rim of a wheel, three circles of a tyre, or three sections of a ball or an ellipsoid.
    fn rims(&mut self, body: usize, centre: &Placed, contact: &PlaneContact) {
        let unit = |k: usize| std::array::from_fn(|i| f64::from(u8::from(i == k)));
        let (radius, crown) = (contact.radius.to_f64(), contact.crown.to_f64());
        let mut stretch = [radius; 3];
        // Axles, radii, and distances along the axles.
        let circles: Vec<([f64; 3], f64, f64)> = match contact.shape {
            ContactShape::Disc(axle) => {
                stretch = [1.0; 3];
                let axle = axle.map(|x| x.to_f64()).0;
                match crown > 0.0 {
                    false => vec![(axle, radius, 0.0)],
                    true => vec![
                        (axle, radius + crown, 0.0),
                        (axle, radius, crown),
                        (axle, radius, -crown),
                    ],
                }
            }
            ContactShape::Sphere => (0..3).map(|k| (unit(k), 1.0, 0.0)).collect(),
            ContactShape::Ellipsoid(half_axes) => {
                stretch = half_axes.map(|x| x.to_f64());
                (0..3).map(|k| (unit(k), 1.0, 0.0)).collect()
            }
            ContactShape::Edge(_) => vec![],
        };
        for (axle, radius, beside) in circles {
            let across = across(axle);
            let corner = |k: usize| {
                let (sin, cos) = (k as f64 * std::f64::consts::TAU / RIM as f64).sin_cos();
                let along = |i: usize| {
                    let round = radius * (cos * across[0][i] + sin * across[1][i]);
                    stretch[i] * (round + beside * axle[i])
                };
                centre.point(std::array::from_fn(along))
            };
            for k in 0..RIM {
                self.all[body].beam(corner(k), corner(k + 1));
            }
        }
    }

    fn frames(&mut self, mechanism: &Mechanism) {
        for frame in mechanism.frames() {
            let (body, place) = self.carrier(frame.link);
            let placed = place.then(&Placed::of(&frame.origin));
            let from = self.all[body].nearest(placed.o);
            let moving = body != 0;
            self.all[body].points.push(BodyPoint {
                name: frame.name.clone(),
                axes: Some(placed.axes()),
                beam: moving && from != placed.o,
                from,
                ..BodyPoint::at(placed.o)
            });
        }
    }

    /// For a body without children, the outermost frame leaves a trail; without a frame its own origin, or
    /// its centre of mass.
    fn tips(&mut self, mechanism: &Mechanism) {
        let carries = |body: usize, all: &[Body]| {
            let on = |b: &Body| b.joint.as_ref().is_some_and(|j| j.on == body);
            all.iter().any(on)
        };
        for i in 1..self.all.len() {
            if carries(i, &self.all) {
                continue;
            }
            let name = self.all[i].link.map(|l| mechanism.links()[l].name.clone());
            let points = &mut self.all[i].points;
            let far = |p: &&mut BodyPoint| p.at.iter().map(|x| x * x).sum::<f64>();
            let further = |a: &&mut BodyPoint, b: &&mut BodyPoint| far(a).total_cmp(&far(b));
            let frames = points.iter_mut().filter(|p| p.axes.is_some());
            if let Some(tip) = frames.max_by(further) {
                tip.tip = true;
                continue;
            }
            let at = points.iter_mut().max_by(further).map_or([0.0; 3], |p| p.at);
            points.push(BodyPoint {
                name: name.unwrap_or_default(),
                axes: Some(Placed::HERE.axes()),
                tip: true,
                ..BodyPoint::at(at)
            });
        }
    }

    /// Returns the origin of a link or a frame.
    pub(super) fn end(&self, mechanism: &Mechanism, name: &str) -> Option<End> {
        if let Some(frame) = mechanism.frames().iter().find(|f| f.name == name) {
            let (body, place) = self.carrier(frame.link);
            let at = place.point(Placed::of(&frame.origin).o);
            return Some(End { body, at });
        }
        let link = mechanism.links().iter().position(|l| l.name == name)?;
        let (body, place) = self.on[link];
        Some(End { body, at: place.o })
    }
}
