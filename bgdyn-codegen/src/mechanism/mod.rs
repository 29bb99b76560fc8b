//! The checked mechanism: always valid, with parent links before their children.
//!
//! Only [`crate::machine::check`] can construct a [`Mechanism`]; no later step checks again or fails
//! because of the user's input. PoseNumbers are double-double, parsed from the spec's decimals.

mod base_motion;
mod check;
pub mod closure;
mod contact_pair;
mod contacts;
mod degrees;
mod dependents;
mod id;
pub mod joint;
mod lock;
mod locked_tree;
mod numbering;
mod parallel_loop;
mod places;
mod pose;
mod prescribed;
mod released;
mod symbolic;

use std::fmt;

use bgdyn_runtime::Dd;

use crate::fault::Location;
use crate::math::{Mat3, Vec3};
pub use base_motion::{BASE_PARAMETERS, BaseMotion, base_parameter_names};
pub(crate) use check::check;
pub use check::{CONTACT_KEYS, PLANE_KEYS, constraint_types};
pub(crate) use check::{check_locked, check_tensor};
use closure::Closure;
pub use contact_pair::{ContactPair, ContactPartner, ContactSphere};
pub use degrees::{Coupling, Degrees, Leader};
pub use dependents::DependentVelocity;
pub use id::{CoordinateId, LinkId, ParameterId, PositionId};
pub use joint::{JointType, Motion};
pub(crate) use locked_tree::LockedTree;
pub use parallel_loop::ParallelLoop;
pub(crate) use places::SiteOrigins;
pub use pose::Pose;
pub use prescribed::{PRESCRIBED_PARAMETERS, PrescribedJoint, prescribed_parameter_names};
pub use symbolic::{NumberSymbol, SymbolicMechanism};

/// A number of the spec: folded into the code, or a public field of the generated struct.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Value {
    /// Known at generation time.
    Fixed(Dd),
    /// Set by the caller at run time.
    Parameter(ParameterId),
}

/// A number the caller may change at run time.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// Field name in the generated struct.
    pub name: String,
    /// Its meaning: "mass of link `tool`"; several meanings are joined with "and".
    pub meaning: String,
    /// The spec's value, which is that of `Default`.
    pub default: Dd,
    /// SI unit, for the documentation (`kg`, `m`, …).
    pub unit: &'static str,
}

impl fmt::Display for Parameter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}, {}", self.meaning, self.unit)
    }
}

/// Inertial parameters of a link.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inertial {
    /// Mass, kg.
    pub mass: Value,
    /// Centre of mass in link axes, m.
    pub com: Vec3<Value>,
    /// Tensor about the centre of mass.
    pub inertia: Tensor,
}

impl Inertial {
    /// Returns whether any of them is a run-time parameter.
    pub fn varies(&self) -> bool {
        let mut values = self.com.0.iter().chain(&self.inertia.entries);
        let varies = |value: &Value| matches!(value, Value::Parameter(_));
        varies(&self.mass) || values.any(varies)
    }
}

/// An inertia tensor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tensor {
    /// xx, yy, zz, xy, xz, yz (tensor entries), kg·m².
    pub entries: [Value; 6],
    /// Columns: the axes of the entries in the link's axes. The identity unless an entry is a run-time
    /// parameter: the check rotates numbers.
    pub axes: Mat3<Dd>,
}

/// Limits of a joint in the spec; generated code does not enforce them.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Limits {
    /// Smallest coordinate, rad or m.
    pub lower: Option<f64>,
    /// Largest coordinate, rad or m.
    pub upper: Option<f64>,
    /// Largest speed, rad/s or m/s.
    pub velocity: Option<f64>,
    /// Largest effort, N·m or N.
    pub effort: Option<f64>,
}

/// The joint between a link and its parent.
#[derive(Clone, Debug, PartialEq)]
pub struct Joint {
    /// Its name.
    pub name: String,
    /// Its original name elsewhere.
    pub label: Option<String>,
    /// Its type.
    pub kind: &'static JointType,
    /// Unit vector of its axis, in link axes.
    pub axis: Vec3<Dd>,
    /// Pose of the link's axes in the parent's axes at coordinate zero.
    pub origin: Pose,
    /// Limits of the spec.
    pub limits: Limits,
    /// The coordinate of a rotation or a translation that follows no other joint: its position and velocity
    /// are this joint's alone. `None` for other joints.
    pub coordinate: Option<CoordinateId>,
    /// The positions and velocities of a joint of any type.
    pub degrees: Degrees,
}

impl Joint {
    /// Returns the constants of its motion.
    pub fn constants(&self) -> joint::JointConstants {
        self.degrees.constants(self.axis)
    }
}

/// A rigid link and the joint to its parent.
#[derive(Clone, Debug, PartialEq)]
pub struct Link {
    /// Its name.
    pub name: String,
    /// Its original name elsewhere.
    pub label: Option<String>,
    /// The parent link; `None` for the fixed world. Always a smaller id.
    pub parent: Option<LinkId>,
    /// The joint to the parent.
    pub joint: Joint,
    /// Mass, centre of mass, inertia.
    pub inertial: Inertial,
    /// Whether it is the massless link between two joints that the spec has as one: it has no methods.
    pub hidden: bool,
}

/// A named pose on a link, or in the world (`link: None`).
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// Its name.
    pub name: String,
    /// Its original name elsewhere.
    pub label: Option<String>,
    /// The link it is fixed to.
    pub link: Option<LinkId>,
    /// Pose of the frame's axes in the link's axes.
    pub origin: Pose,
}

/// Changes of a spec's directions by snapping: angles and axes that were rounded to the exact ones and
/// differed by more than the rounding of an `f64`, 1e-15.
#[derive(Clone, Debug, PartialEq)]
pub struct Snapped {
    /// Number of rotations and axes.
    pub count: usize,
    /// The largest change of a number: rad, or relative to an axis's length.
    pub most: f64,
    /// Its location.
    pub location: Location,
}

/// A mechanism that passed every check.
#[derive(Clone, Debug, PartialEq)]
pub struct Mechanism {
    name: String,
    label: Option<String>,
    description: Option<String>,
    gravity: Vec3<Dd>,
    links: Vec<Link>,
    frames: Vec<Frame>,
    parameters: Vec<Parameter>,
    base: Option<BaseMotion>,
    prescribed: Vec<PrescribedJoint>,
    coordinates: Vec<LinkId>,
    positions: Vec<LinkId>,
    snapped: Option<Snapped>,
    parallel: Vec<ParallelLoop>,
    closure: Option<Closure>,
    contact_pairs: Vec<ContactPair>,
}

impl Mechanism {
    /// Returns its name: a snake_case identifier, the module's name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Returns its original name elsewhere.
    pub fn label(&self) -> Option<&str> {
        self.label.as_deref()
    }

    /// Returns the description in the spec.
    pub fn description(&self) -> Option<&str> {
        self.description.as_deref()
    }

    /// Returns the acceleration of free fall in world axes, m/s².
    pub fn gravity(&self) -> Vec3<Dd> {
        self.gravity
    }

    /// Returns the links, parents before children.
    pub fn links(&self) -> &[Link] {
        &self.links
    }

    /// Returns the named frames, in the file's order.
    pub fn frames(&self) -> &[Frame] {
        &self.frames
    }

    /// Returns the run-time parameters, in the file's order.
    pub fn parameters(&self) -> &[Parameter] {
        &self.parameters
    }

    /// Returns the motion of the base, if it is given at run time.
    pub fn base(&self) -> Option<&BaseMotion> {
        self.base.as_ref()
    }

    /// Returns, for each coordinate, the link of its joint.
    pub fn coordinates(&self) -> &[LinkId] {
        &self.coordinates
    }

    /// Returns the changes of directions by snapping; `None` if all were exact to 1e-15 or were not
    /// changed.
    pub fn snapped(&self) -> Option<&Snapped> {
        self.snapped.as_ref()
    }

    /// Returns its loops on their parallel branch, which are closed by joints that follow.
    pub fn parallel_loops(&self) -> &[ParallelLoop] {
        &self.parallel
    }

    /// Returns the names of the joints of a loop that follow others, from place a to place b.
    pub fn followers_of(&self, one: &ParallelLoop) -> Vec<&str> {
        let joints = one.joints.iter().map(|link| &self.links[link.0].joint);
        let following = joints.filter(|joint| joint.degrees.coupling.is_some());
        following.map(|joint| joint.name.as_str()).collect()
    }

    /// Returns its other loops.
    pub fn closure(&self) -> Option<&Closure> {
        self.closure.as_ref()
    }

    /// Adds a body of this name, fixed to a link or at a frame on one. A site in the world adds nothing.
    pub fn carry(&mut self, name: &str, at: &str, inertial: Inertial) {
        let frame = self.frames.iter().find(|f| f.name == at);
        let link = self.links.iter().position(|l| l.name == at).map(LinkId);
        let (parent, origin) = match frame {
            Some(frame) => (frame.link, frame.origin),
            None => (link, Pose::IDENTITY),
        };
        if parent.is_none() {
            return;
        }
        self.links.push(Link {
            name: name.to_owned(),
            label: None,
            parent,
            joint: Joint {
                name: format!("{name}_mount"),
                label: None,
                kind: joint::fixed(),
                axis: Vec3([Dd::ZERO, Dd::ZERO, Dd::ONE]),
                origin,
                limits: Limits::default(),
                coordinate: None,
                degrees: Degrees::default(),
            },
            inertial,
            hidden: false,
        });
    }

    /// Returns the run-time parameter of this name, after adding it if it is new.
    pub fn parameter(
        &mut self,
        name: &str,
        meaning: String,
        default: Dd,
        unit: &'static str,
    ) -> Value {
        let known = self.parameters.iter().position(|p| p.name == name);
        let p = known.unwrap_or(self.parameters.len());
        if known.is_none() {
            self.parameters.push(Parameter {
                name: name.to_owned(),
                meaning,
                default,
                unit,
            });
        }
        Value::Parameter(ParameterId(p))
    }
}
