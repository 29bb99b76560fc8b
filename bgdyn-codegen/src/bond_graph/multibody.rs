//! The bodies, joints, rotors and sites of a mechanism, as the recursion reads them.

use bgdyn_runtime::Dd;

use crate::math::{Mat3, Vec3};
use crate::mechanism::{CoordinateId, Inertial, LinkId, Motion, Parameter, Pose, Value};

/// An index into [`Multibody::sites`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct SiteId(pub usize);

/// A named site with methods for its motion: a link's frame, or a frame named in the spec.
#[derive(Clone, Debug, PartialEq)]
pub struct Site {
    /// Name of the link or of the frame.
    pub name: String,
    /// The link it is fixed to; `None` for the world.
    pub link: Option<LinkId>,
    /// Its pose in the link's axes.
    pub place: Pose,
    /// Whether the spec names it as a frame, or it is the frame of a tip. Methods are generated for these
    /// sites by default.
    pub prominent: bool,
}

/// Pose of a link's frame; the moduli are functions of these poses.
#[derive(Clone, Debug, PartialEq)]
pub struct LinkFrame {
    /// The link's name.
    pub name: String,
    /// The parent link.
    pub parent: Option<LinkId>,
    /// Pose of the link's axes in the parent's axes at coordinate zero.
    pub origin: Pose,
    /// The motion that the joint allows.
    pub motion: Motion,
    /// Unit vector of the joint's axis in link axes.
    pub axis: Vec3<Dd>,
    /// The coordinate of the joint.
    pub coordinate: Option<CoordinateId>,
    /// Centre of mass in link axes, m.
    pub com: Vec3<Value>,
    /// The axes of the inertia tensor, as columns in the link's axes.
    pub tensor_axes: Mat3<Dd>,
}

/// A generalized coordinate.
#[derive(Clone, Debug, PartialEq)]
pub struct Coordinate {
    /// Name of its joint.
    pub name: String,
    /// The link outboard of its joint.
    pub link: LinkId,
    /// Rotation or translation.
    pub motion: Motion,
}

/// An inertial store on the junction of a generalized velocity: a rotor behind a gear.
#[derive(Clone, Debug, PartialEq)]
pub struct Rotor {
    /// The velocity q̇_j.
    pub coordinate: CoordinateId,
    /// J, kg·m² (kg for a displacement).
    pub inertia: Value,
    /// N, turns of the rotor per unit of the joint.
    pub ratio: Value,
    /// The link that carries the rotor, if it is a full rotor.
    pub carrier: Option<Gyrostat>,
}

/// The placement of a rotor on a link: a unit rate of the joint gives the momentum N J e on the link.
#[derive(Clone, Debug, PartialEq)]
pub struct Gyrostat {
    /// The link.
    pub link: LinkId,
    /// e, its axis in the link's axes.
    pub axis: Vec3<Dd>,
}

/// A tree of rigid bodies with joints, rotors behind gears, and gravity.
#[derive(Clone, Debug, PartialEq)]
pub struct Multibody {
    /// Generalized coordinates, in the order of q.
    pub coordinates: Vec<Coordinate>,
    /// Frames of the links, parents before children.
    pub frames: Vec<LinkFrame>,
    /// Mass, centre of mass and tensor of each link.
    pub inertials: Vec<Inertial>,
    /// Gravity, m/s², fixed axes.
    pub gravity: Vec3<Dd>,
    /// Rotors behind gears.
    pub rotors: Vec<Rotor>,
    /// Whether the transformers' rates are included: Coriolis, centrifugal and gyroscopic efforts.
    pub velocity_products: bool,
    /// Run-time parameters that values refer to.
    pub parameters: Vec<Parameter>,
    /// The sites: the frames of the links, then the named frames.
    pub sites: Vec<Site>,
}

impl Multibody {
    /// Returns the coordinate of the joint with this name.
    pub fn coordinate_named(&self, name: &str) -> Option<CoordinateId> {
        let found = self.coordinates.iter().position(|c| c.name == name);
        found.map(CoordinateId)
    }

    /// Returns mass, centre of mass and tensor of a link.
    pub fn inertial(&self, i: LinkId) -> Inertial {
        self.inertials[i.0]
    }
}
