//! The drawing of a moving body: its joint, the joint's stops, its points.

use bgdyn_codegen::math::{Mat3, Vec3};
use serde::Serialize;

/// The world, or a link with all links welded to it, in that link's axes.
#[derive(Serialize)]
pub(super) struct Body {
    pub(super) name: String,
    /// Its joint; `None` for the world.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) joint: Option<BodyJoint>,
    pub(super) points: Vec<BodyPoint>,
    /// Lines of its surface where it may touch.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) edges: Vec<[[f64; 3]; 2]>,
    /// Origins at all rows, three integers each; empty for the world.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) place: Option<Vec<i64>>,
    /// Orientations at all rows: quaternions w, x, y, z as integers.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) turn: Option<Vec<i64>>,
    /// The link whose pose it has.
    #[serde(skip)]
    pub(super) link: Option<usize>,
}

/// The joint of a body.
#[derive(Serialize)]
pub(super) struct BodyJoint {
    pub(super) name: String,
    #[serde(rename = "type")]
    pub(super) kind: &'static str,
    /// In the body's own axes.
    pub(super) axis: [f64; 3],
    /// The parent body.
    pub(super) on: usize,
    /// In the axes of that body: the axis, and the joint's position at the ends of its travel.
    pub(super) along: [f64; 3],
    pub(super) from: [f64; 3],
    pub(super) to: [f64; 3],
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) stops: Vec<Stop>,
    /// Its pose on that body.
    #[serde(skip)]
    pub(super) placed: Placed,
}

/// An end of a joint's travel, in the axes of the parent body.
#[derive(Serialize)]
pub(super) struct Stop {
    pub(super) name: String,
    /// Prismatic joint: the joint's position at the stop. Else the joint's position, m.
    pub(super) at: [f64; 3],
    /// Prismatic joint: the unit vector of its travel. Else the unit vector from the axis to the point of
    /// the body that touches the stop, at contact.
    pub(super) way: [f64; 3],
    /// The side of the body at contact: −1 at the lower end, +1 at the upper one.
    pub(super) side: f64,
}

/// A point on a body.
#[derive(Serialize)]
pub(super) struct BodyPoint {
    pub(super) at: [f64; 3],
    #[serde(skip_serializing_if = "String::is_empty")]
    pub(super) name: String,
    /// The start of the beam to it, if it has one.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub(super) beam: bool,
    pub(super) from: [f64; 3],
    /// Axes of a frame, column by column.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) axes: Option<[[f64; 3]; 3]>,
    /// Whether it leaves a trail.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub(super) tip: bool,
    /// Mass of the link whose centre of mass it is, kg.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) mass: Option<f64>,
    /// Whether that is a payload, which has a name.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub(super) load: bool,
}

/// A point on a body, for an element between two points.
#[derive(Clone, Copy, Serialize)]
pub(super) struct End {
    pub(super) body: usize,
    pub(super) at: [f64; 3],
}

/// The pose of a frame in another: x ↦ R x + o.
#[derive(Clone, Copy)]
pub(super) struct Placed {
    pub(super) r: Mat3<f64>,
    pub(super) o: [f64; 3],
}

impl Placed {
    pub(super) const HERE: Placed = Placed {
        r: Mat3([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]),
        o: [0.0; 3],
    };

    pub(super) fn of(pose: &bgdyn_codegen::mechanism::Pose) -> Self {
        Placed {
            r: pose.rotation.map(|x| x.to_f64()),
            o: pose.translation.map(|x| x.to_f64()).0,
        }
    }

    pub(super) fn rotate(&self, x: [f64; 3]) -> [f64; 3] {
        std::array::from_fn(|i| self.r.row(i).dot(Vec3(x)))
    }

    pub(super) fn point(&self, x: [f64; 3]) -> [f64; 3] {
        let turned = self.rotate(x);
        std::array::from_fn(|i| turned[i] + self.o[i])
    }

    pub(super) fn then(&self, inner: &Placed) -> Self {
        Placed {
            r: Mat3::from_fn(|i, j| self.rotate(inner.r.column(j).0)[i]),
            o: self.point(inner.o),
        }
    }

    pub(super) fn axes(&self) -> [[f64; 3]; 3] {
        std::array::from_fn(|j| self.r.column(j).0)
    }
}

impl Body {
    pub(super) fn new(name: &str, link: Option<usize>) -> Self {
        Body {
            name: name.to_owned(),
            joint: None,
            points: Vec::new(),
            edges: Vec::new(),
            place: None,
            turn: None,
            link,
        }
    }

    /// Returns the axis of its joint, in its own axes.
    pub(super) fn axis(&self) -> [f64; 3] {
        self.joint.as_ref().map_or([0.0, 0.0, 1.0], |j| j.axis)
    }

    /// Returns all points on it.
    pub(super) fn places(&self) -> impl Iterator<Item = [f64; 3]> {
        self.points.iter().map(|p| p.at)
    }

    pub(super) fn beam(&mut self, from: [f64; 3], at: [f64; 3]) {
        if from != at {
            self.points.push(BodyPoint {
                beam: true,
                from,
                ..BodyPoint::at(at)
            });
        }
    }

    /// Returns the point of its beams that is nearest to a point: the start of a bracket to it.
    pub(super) fn nearest(&self, place: [f64; 3]) -> [f64; 3] {
        let sub = |a: [f64; 3], b: [f64; 3]| std::array::from_fn::<f64, 3, _>(|k| a[k] - b[k]);
        let dot = |a: [f64; 3], b: [f64; 3]| (0..3).map(|k| a[k] * b[k]).sum::<f64>();
        let of = |beam: &BodyPoint| {
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

impl BodyPoint {
    pub(super) fn at(at: [f64; 3]) -> Self {
        BodyPoint {
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
