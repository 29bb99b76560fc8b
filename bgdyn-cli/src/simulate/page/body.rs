//! What of a mechanism is drawn: its moving bodies with the places on them.

use bgdyn_codegen::declaration::Element;
use bgdyn_codegen::math::{Mat3, Vec3};
use bgdyn_codegen::mechanism::{Link, LinkId, Mechanism, Motion, Value};
use bgdyn_codegen::scene::Scene;
use serde::Serialize;

use super::stops::{Stop, stops};

/// The world, or a link with all that is welded to it, in that link's axes.
#[derive(Serialize)]
pub(super) struct Body {
    pub(super) name: String,
    /// How it moves; the world does not.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) joint: Option<Joint>,
    pub(super) points: Vec<Point>,
    /// Origins at all rows, three whole numbers each; nothing for the world.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) place: Option<Vec<i64>>,
    /// Attitudes at all rows: quaternions w, x, y, z as whole numbers.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) turn: Option<Vec<i64>>,
    /// The link whose pose it has.
    #[serde(skip)]
    pub(super) link: Option<usize>,
}

/// The joint that carries a body.
#[derive(Serialize)]
pub(super) struct Joint {
    name: String,
    #[serde(rename = "type")]
    kind: &'static str,
    /// In the body's own axes.
    axis: [f64; 3],
    /// The body that carries it.
    on: usize,
    /// In the axes of that body: the axis, and the joint's place at the ends of its travel.
    along: [f64; 3],
    from: [f64; 3],
    to: [f64; 3],
    #[serde(skip_serializing_if = "Vec::is_empty")]
    stops: Vec<Stop>,
    /// Where it is on that body.
    #[serde(skip)]
    placed: Placed,
}

/// A place on a body.
#[derive(Serialize)]
pub(super) struct Point {
    at: [f64; 3],
    #[serde(skip_serializing_if = "String::is_empty")]
    name: String,
    /// Whether a beam leads to it, from here.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    beam: bool,
    from: [f64; 3],
    /// Axes of a frame, column by column.
    #[serde(skip_serializing_if = "Option::is_none")]
    axes: Option<[[f64; 3]; 3]>,
    /// Whether it leaves a trail.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    tip: bool,
    /// Mass of the link whose centre of mass it is, kg.
    #[serde(skip_serializing_if = "Option::is_none")]
    mass: Option<f64>,
    /// Whether that is a payload, which has a name.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    load: bool,
}

/// A place on a body, for what hangs between two of them.
#[derive(Clone, Copy, Serialize)]
pub(super) struct End {
    pub(super) body: usize,
    pub(super) at: [f64; 3],
}

/// A frame in another: x ↦ R x + o.
#[derive(Clone, Copy)]
pub(super) struct Placed {
    r: Mat3<f64>,
    o: [f64; 3],
}

impl Placed {
    const HERE: Placed = Placed {
        r: Mat3([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]),
        o: [0.0; 3],
    };

    fn of(pose: &bgdyn_codegen::mechanism::Pose) -> Self {
        Placed {
            r: pose.rotation.map(|x| x.to_f64()),
            o: pose.translation.map(|x| x.to_f64()).0,
        }
    }

    pub(super) fn turned(&self, x: [f64; 3]) -> [f64; 3] {
        std::array::from_fn(|i| self.r.row(i).dot(Vec3(x)))
    }

    pub(super) fn point(&self, x: [f64; 3]) -> [f64; 3] {
        let turned = self.turned(x);
        std::array::from_fn(|i| turned[i] + self.o[i])
    }

    fn then(&self, inner: &Placed) -> Self {
        Placed {
            r: Mat3::from_fn(|i, j| self.turned(inner.r.column(j).0)[i]),
            o: self.point(inner.o),
        }
    }

    fn axes(&self) -> [[f64; 3]; 3] {
        std::array::from_fn(|j| self.r.column(j).0)
    }
}

/// The bodies of a scene, and where its links stand on them.
pub(super) struct Bodies {
    pub(super) all: Vec<Body>,
    on: Vec<(usize, Placed)>,
}

impl Bodies {
    /// With the joints' travel by coordinate.
    pub(super) fn new(scene: &Scene, travel: &[(f64, f64)]) -> Self {
        let mechanism = &scene.mechanism;
        let mut bodies = Bodies {
            all: vec![Body::new("world", None)],
            on: Vec::new(),
        };
        for (i, link) in mechanism.links().iter().enumerate() {
            bodies.link(i, link, travel);
        }
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

    fn carrier(&self, link: Option<LinkId>) -> (usize, Placed) {
        link.map_or((0, Placed::HERE), |l| self.on[l.0])
    }

    fn link(&mut self, i: usize, link: &Link, travel: &[(f64, f64)]) {
        let (carrier, place) = self.carrier(link.parent);
        let joint = place.then(&Placed::of(&link.joint.origin));
        self.all[carrier].beam(place.o, joint.o);
        let Some(coordinate) = link.joint.coordinate else {
            self.on.push((carrier, joint));
            return;
        };
        let axis = link.joint.axis.map(|x| x.to_f64()).0;
        let along = joint.turned(axis);
        let slides = link.joint.kind.motion == Motion::Translation;
        let (low, high) = if slides {
            travel[coordinate.0]
        } else {
            (0.0, 0.0)
        };
        let moved = |s: f64| std::array::from_fn(|k| joint.o[k] + s * along[k]);
        let mut body = Body::new(&link.name, Some(i));
        body.joint = Some(Joint {
            name: link.joint.name.clone(),
            kind: if slides { "prismatic" } else { "revolute" },
            axis,
            on: carrier,
            along,
            from: moved(low),
            to: moved(high),
            stops: Vec::new(),
            placed: joint,
        });
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
        self.all[body].points.push(Point {
            name: match load {
                true => link.name.clone(),
                false => String::new(),
            },
            mass: Some(mass),
            load,
            from,
            ..Point::at(at)
        });
    }

    fn frames(&mut self, mechanism: &Mechanism) {
        for frame in mechanism.frames() {
            let (body, place) = self.carrier(frame.link);
            let placed = place.then(&Placed::of(&frame.origin));
            let from = self.all[body].nearest(placed.o);
            let moving = body != 0;
            self.all[body].points.push(Point {
                name: frame.name.clone(),
                axes: Some(placed.axes()),
                beam: moving && from != placed.o,
                from,
                ..Point::at(placed.o)
            });
        }
    }

    /// Of a body that carries no other the outermost frame leaves a trail; without one its own, or
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
            let far = |p: &&mut Point| p.at.iter().map(|x| x * x).sum::<f64>();
            let further = |a: &&mut Point, b: &&mut Point| far(a).total_cmp(&far(b));
            let frames = points.iter_mut().filter(|p| p.axes.is_some());
            if let Some(tip) = frames.max_by(further) {
                tip.tip = true;
                continue;
            }
            let at = points.iter_mut().max_by(further).map_or([0.0; 3], |p| p.at);
            points.push(Point {
                name: name.unwrap_or_default(),
                axes: Some(Placed::HERE.axes()),
                tip: true,
                ..Point::at(at)
            });
        }
    }

    /// A link's or a frame's origin.
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

impl Body {
    fn new(name: &str, link: Option<usize>) -> Self {
        Body {
            name: name.to_owned(),
            joint: None,
            points: Vec::new(),
            place: None,
            turn: None,
            link,
        }
    }

    /// The axis of its joint, in its own axes.
    pub(super) fn axis(&self) -> [f64; 3] {
        self.joint.as_ref().map_or([0.0, 0.0, 1.0], |j| j.axis)
    }

    /// All places on it.
    pub(super) fn places(&self) -> impl Iterator<Item = [f64; 3]> {
        self.points.iter().map(|p| p.at)
    }

    fn beam(&mut self, from: [f64; 3], at: [f64; 3]) {
        if from != at {
            self.points.push(Point {
                beam: true,
                from,
                ..Point::at(at)
            });
        }
    }

    /// The point of its beams that is nearest to a place: where a bracket to it begins.
    fn nearest(&self, place: [f64; 3]) -> [f64; 3] {
        let sub = |a: [f64; 3], b: [f64; 3]| std::array::from_fn::<f64, 3, _>(|k| a[k] - b[k]);
        let dot = |a: [f64; 3], b: [f64; 3]| (0..3).map(|k| a[k] * b[k]).sum::<f64>();
        let of = |beam: &Point| {
            let way = sub(beam.at, beam.from);
            let part = (dot(sub(place, beam.from), way) / dot(way, way)).clamp(0.0, 1.0);
            std::array::from_fn(|k| beam.from[k] + part * way[k])
        };
        let off = |p: &[f64; 3]| dot(sub(place, *p), sub(place, *p));
        let beams = self.points.iter().filter(|p| p.beam).map(of);
        beams
            .min_by(|a, b| off(a).total_cmp(&off(b)))
            .unwrap_or([0.0; 3])
    }
}

impl Point {
    fn at(at: [f64; 3]) -> Self {
        Point {
            at,
            name: String::new(),
            beam: false,
            from: [0.0; 3],
            axes: None,
            tip: false,
            mass: None,
            load: false,
        }
    }
}
