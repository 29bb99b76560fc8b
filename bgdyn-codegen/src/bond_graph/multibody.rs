//! The bodies, joints, rotors and places of a mechanism, as the recursion reads them.

use bgdyn_runtime::Dd;

use crate::math::{Mat3, Vec3};
use crate::mechanism::{CoordinateId, Inertial, LinkId, Motion, Parameter, Pose, Value};

/// A place of [`Multibody::sites`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct SiteId(pub usize);

/// A named place whose motion can be asked for: a link's frame, or a frame named in the spec.
#[derive(Clone, Debug, PartialEq)]
pub struct Site {
    /// The link's or the frame's name.
    pub name: String,
    /// The link it is fixed to; `None` for the world.
    pub link: Option<LinkId>,
    /// Its axes and origin in the link's axes.
    pub place: Pose,
    /// Whether the spec names it as a frame, or no other link hangs on it: what a user asks for
    /// who asks for nothing in particular.
    pub prominent: bool,
}

/// Placement of a link's frame: what the moduli are functions of.
#[derive(Clone, Debug, PartialEq)]
pub struct LinkFrame {
    /// The link's name.
    pub name: String,
    /// The link that carries it.
    pub parent: Option<LinkId>,
    /// Link axes in the parent's at coordinate zero.
    pub origin: Pose,
    /// What the joint lets it do.
    pub motion: Motion,
    /// Unit vector of the joint's axis in link axes.
    pub axis: Vec3<Dd>,
    /// The coordinate that moves it.
    pub coordinate: Option<CoordinateId>,
    /// Centre of mass in link axes, m.
    pub com: Vec3<Value>,
    /// Columns: axes of the inertia tensor's entries in the link's.
    pub tensor_axes: Mat3<Dd>,
}

/// A generalized coordinate.
#[derive(Clone, Debug, PartialEq)]
pub struct Coordinate {
    /// Its joint's name.
    pub name: String,
    /// The link that its joint carries.
    pub link: LinkId,
    /// Angle or displacement.
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
    /// What it turns with, if it is a full rotor.
    pub carrier: Option<Gyrostat>,
}

/// How a rotor sits on a link: per unit rate of the joint it has the momentum N J e there.
#[derive(Clone, Debug, PartialEq)]
pub struct Gyrostat {
    /// The link.
    pub link: LinkId,
    /// e, its axis in the link's axes.
    pub axis: Vec3<Dd>,
}

/// A tree of rigid bodies with joints, rotors behind gears, and what gravity they are in.
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
    /// Whether the transformers' rates count: Coriolis, centrifugal and gyroscopic efforts.
    pub velocity_products: bool,
    /// Run-time parameters that values refer to.
    pub parameters: Vec<Parameter>,
    /// The links' frames, then the named ones.
    pub sites: Vec<Site>,
}

impl Multibody {
    /// The coordinate of the joint with this name.
    pub fn coordinate_named(&self, name: &str) -> Option<CoordinateId> {
        let found = self.coordinates.iter().position(|c| c.name == name);
        found.map(CoordinateId)
    }

    /// Mass, centre of mass and tensor of a link.
    pub fn inertial(&self, i: LinkId) -> Inertial {
        self.inertials[i.0]
    }
}
