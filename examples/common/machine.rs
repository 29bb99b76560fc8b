//! The arm as its spec says: what the report and the plot need beyond the generated methods.

use bgdyn::nalgebra::{Matrix3, Point3, Rotation3, Unit, Vector3};
use bgdyn::runtime::Dd;
use bgdyn_codegen::expr::Operations;
use bgdyn_codegen::math::{Mat3, Vec3};
use bgdyn_codegen::mechanism::{CoordinateId, LinkId, Mechanism, Motion, Pose};
use bgdyn_codegen::model::{Model, Options};

/// A joint's name, units and limits.
pub struct Joint {
    /// Its name.
    pub name: String,
    /// Whether it turns; otherwise it slides.
    pub turns: bool,
    /// Largest effort, N·m or N.
    pub effort: f64,
    /// Largest speed, rad/s or m/s.
    pub speed: f64,
    /// Smallest and largest coordinate, rad or m.
    pub range: (f64, f64),
}

impl Joint {
    /// The factor and the unit in which people read positions.
    pub fn position_unit(&self) -> (f64, &'static str) {
        if self.turns {
            (1f64.to_degrees(), "°")
        } else {
            (1e3, "mm")
        }
    }

    /// The factor and the unit in which people read errors.
    pub fn error_unit(&self) -> (f64, &'static str) {
        if self.turns {
            (1e3, "mrad")
        } else {
            (1e3, "mm")
        }
    }

    /// The unit of efforts.
    pub fn effort_unit(&self) -> &'static str {
        if self.turns { "N·m" } else { "N" }
    }
}

/// A checked spec.
pub struct Machine {
    mechanism: Mechanism,
    joints: Vec<Joint>,
    operations: Vec<(&'static str, Operations)>,
}

impl Machine {
    /// Reads the spec `text` of the file `name.yaml`, by the generator the macro calls.
    pub fn read(name: &str, text: &str) -> Result<Self, String> {
        let (mechanism, faults) = bgdyn_codegen::read(text, Some(name));
        let mechanism = mechanism.ok_or_else(|| faults.render(name, text))?;
        let model = Model::new(mechanism, &Options::default());
        let joints = (0..model.mechanism.nv())
            .map(|i| {
                let joint = model.mechanism.joint(CoordinateId(i));
                let limits = joint.limits;
                Joint {
                    name: joint.name.replace('_', " "),
                    turns: joint.kind.motion == Motion::Rotation,
                    effort: limits.effort.unwrap_or(f64::INFINITY),
                    speed: limits.velocity.unwrap_or(f64::INFINITY),
                    range: (
                        limits.lower.unwrap_or(f64::NEG_INFINITY),
                        limits.upper.unwrap_or(f64::INFINITY),
                    ),
                }
            })
            .collect();
        let operations = model
            .functions
            .iter()
            .map(|f| (f.name(), f.operations()))
            .collect();
        Ok(Machine {
            mechanism: model.mechanism,
            joints,
            operations,
        })
    }

    /// The joint of coordinate `i`.
    pub fn joint(&self, i: usize) -> &Joint {
        &self.joints[i]
    }

    /// Operations of one call of the generated method.
    pub fn operations(&self, method: &str) -> Option<&Operations> {
        let found = self.operations.iter().find(|(name, _)| *name == method);
        found.map(|(_, operations)| operations)
    }

    /// Where the frame `tool` is, in world axes, m.
    pub fn tool(&self, q: &[f64]) -> Point3<f64> {
        let tool = self.mechanism.frames().iter().find(|f| f.name == "tool");
        tool.map_or(Point3::origin(), |frame| {
            self.to_world(frame.link, q, point(&frame.origin))
        })
    }

    /// A point given in the axes of `link`, in world axes: from link to parent, down to the base.
    fn to_world(&self, link: Option<LinkId>, q: &[f64], point: Point3<f64>) -> Point3<f64> {
        let Some(LinkId(index)) = link else {
            return point;
        };
        let link = &self.mechanism.links()[index];
        let joint = &link.joint;
        let coordinate = joint.coordinate.map_or(0.0, |CoordinateId(i)| q[i]);
        let axis = Unit::new_unchecked(vector(joint.axis));
        let moved = match joint.kind.motion {
            Motion::None => point,
            Motion::Rotation => Rotation3::from_axis_angle(&axis, coordinate) * point,
            Motion::Translation => point + axis.into_inner() * coordinate,
        };
        let in_parent = rotation(joint.origin.rotation) * moved + vector(joint.origin.translation);
        self.to_world(link.parent, q, in_parent)
    }
}

fn vector(v: Vec3<Dd>) -> Vector3<f64> {
    Vector3::from(v.0.map(Dd::to_f64))
}

fn rotation(m: Mat3<Dd>) -> Matrix3<f64> {
    Matrix3::from_fn(|row, column| m.0[row][column].to_f64())
}

fn point(pose: &Pose) -> Point3<f64> {
    Point3::from(vector(pose.translation))
}
