//! The bodies, joints, rotors and sites of a mechanism, as the recursion reads them.

use std::collections::BTreeSet;

use bgdyn_runtime::{Dd, Scalar};

use crate::math::{Mat3, Vec3};
use crate::mechanism::joint::{Column, DoubleDouble, JointConstants};
use crate::mechanism::{
    BaseMotion, ContactPair, CoordinateId, Degrees, Inertial, LinkId, Motion, Parameter, Pose,
    Value,
};

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
    pub pose: Pose,
    /// Whether the spec names it as a frame, or it is the frame of a tip. Methods are generated for these
    /// sites by default.
    pub exported_by_default: bool,
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
    /// The coordinate of a rotation or translation that follows no other joint.
    pub coordinate: Option<CoordinateId>,
    /// Positions and velocities of a joint of any type.
    pub degrees: Degrees,
    /// Whether it is the link without mass between two joints in series.
    pub hidden: bool,
    /// Centre of mass in link axes, m.
    pub com: Vec3<Value>,
    /// The axes of the inertia tensor, as columns in the link's axes.
    pub tensor_axes: Mat3<Dd>,
}

impl LinkFrame {
    /// Returns the constants of the joint's motion.
    pub fn constants(&self) -> JointConstants {
        self.degrees.constants(self.axis)
    }

    /// Returns the columns of the joint's motion subspace, link axes at the link's origin.
    pub fn columns(&self) -> Vec<(CoordinateId, Column<Dd>)> {
        self.degrees.columns(self.motion, self.axis)
    }
}

/// A generalized coordinate: a component of v.
#[derive(Clone, Debug, PartialEq)]
pub struct Coordinate {
    /// Name of its joint; with an ending if the joint has several.
    pub name: String,
    /// The link outboard of its joint.
    pub link: LinkId,
    /// The motion of its joint.
    pub motion: Motion,
    /// Whether its unit is m/s, not rad/s.
    pub linear: bool,
}

impl Coordinate {
    /// Returns the unit of the velocity.
    pub fn velocity_unit(&self) -> &'static str {
        if self.linear { "m/s" } else { "rad/s" }
    }
}

/// A component of q.
#[derive(Clone, Debug, PartialEq)]
pub struct PositionVariable {
    /// Name of its joint; with an ending if the joint has several.
    pub name: String,
    /// The link outboard of its joint.
    pub link: LinkId,
    /// Its unit; empty for a component of a quaternion.
    pub unit: &'static str,
    /// The coordinate whose velocity is its rate; `None` if q̇ = N(q) v couples several.
    pub coordinate: Option<CoordinateId>,
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
    /// Generalized coordinates, in the order of v.
    pub coordinates: Vec<Coordinate>,
    /// Positions, in the order of q.
    pub positions: Vec<PositionVariable>,
    /// Frames of the links, parents before children.
    pub frames: Vec<LinkFrame>,
    /// Mass, centre of mass and tensor of each link.
    pub inertials: Vec<Inertial>,
    /// Gravity, m/s², fixed axes.
    pub gravity: Vec3<Dd>,
    /// The motion of the base, if it is given at run time; then the first frame is that of the base.
    pub base: Option<BaseMotion>,
    /// Rotors behind gears.
    pub rotors: Vec<Rotor>,
    /// Whether the transformers' rates are included: Coriolis, centrifugal and gyroscopic efforts.
    pub velocity_products: bool,
    /// Run-time parameters that values refer to.
    pub parameters: Vec<Parameter>,
    /// The sites: the frames of the links, then the named frames.
    pub sites: Vec<Site>,
    /// The pairs that may touch, in the file's order.
    pub contacts: Vec<ContactPair>,
}

impl Multibody {
    /// Returns the coordinate of the joint with this name.
    pub fn coordinate_named(&self, name: &str) -> Option<CoordinateId> {
        let found = self.coordinates.iter().position(|c| c.name == name);
        found.map(CoordinateId)
    }

    /// Returns whether every joint is a rotation or a translation with a position and a velocity of its own,
    /// on a base at rest: then q and v have the same components, and the efforts depend on nothing else.
    pub fn plain(&self) -> bool {
        self.first_compound().is_none()
    }

    /// Returns whether q̇ = v for every position that a joint has for itself.
    pub fn rates_are_velocities(&self) -> bool {
        let of_joint = |frame: &LinkFrame| match frame.motion {
            Motion::Compound(motion) => motion.manifold.is_empty(),
            _ => true,
        };
        self.frames.iter().all(of_joint)
    }

    /// Returns the first link whose joint has several degrees of freedom or a lead, is coupled, or is prescribed;
    /// the base if its motion is given.
    pub fn first_compound(&self) -> Option<&LinkFrame> {
        let plain = |f: &&LinkFrame| f.coordinate.is_some() || f.motion == Motion::None;
        self.frames.iter().find(|frame| !plain(frame))
    }

    /// Returns the links that joints move, without those between two joints in series: with the links fixed to each they
    /// are the bodies of regressors.
    pub fn moving_links(&self) -> Vec<LinkId> {
        let moves = |f: &LinkFrame| f.motion != Motion::None && !f.motion.is_given() && !f.hidden;
        let frames = self.frames.iter().enumerate();
        frames
            .filter(|(_, frame)| moves(frame))
            .map(|(i, _)| LinkId(i))
            .collect()
    }

    /// Returns the links that are not fixed to the world: those that joints move, with the links fixed to them, and those of
    /// a base whose motion is given.
    pub fn links_that_move(&self) -> Vec<LinkId> {
        let mut moving: Vec<bool> = Vec::new();
        for frame in &self.frames {
            let carried = frame.parent.is_some_and(|parent| moving[parent.0]);
            moving.push(carried || frame.motion != Motion::None);
        }
        let links = moving.into_iter().enumerate();
        links
            .filter(|(_, moves)| *moves)
            .map(|(i, _)| LinkId(i))
            .collect()
    }

    /// Returns the number of velocities that move a site.
    pub fn velocities_of(&self, site: &Site) -> usize {
        let mut moving = BTreeSet::new();
        let mut on_path = site.link;
        while let Some(link) = on_path {
            let frame = &self.frames[link.0];
            moving.extend(
                frame
                    .columns()
                    .into_iter()
                    .map(|(coordinate, _)| coordinate),
            );
            on_path = frame.parent;
        }
        moving.len()
    }

    /// Returns whether one of [`Multibody::links_that_move`] has a mass, or may have one at run time.
    pub fn moves_mass(&self) -> bool {
        let has_mass = |link: LinkId| match self.inertial(link).mass {
            Value::Fixed(mass) => mass.hi() != 0.0,
            Value::Parameter(_) => true,
        };
        self.links_that_move().into_iter().any(has_mass)
    }

    /// Returns the first link whose joint is prescribed.
    pub fn first_prescribed(&self) -> Option<&LinkFrame> {
        let mut frames = self.frames.iter().skip(usize::from(self.base.is_some()));
        frames.find(|frame| frame.motion.is_given())
    }

    /// Scales every quaternion to length 1; one of length 0 becomes the identity.
    pub fn normalize<T: Scalar>(&self, q: &mut [T]) {
        for frame in self.frames.iter().filter(|f| f.degrees.own_positions()) {
            let Motion::Compound(motion) = frame.motion else {
                continue;
            };
            let Some(first) = motion.quaternion() else {
                continue;
            };
            let at = frame.degrees.positions[first].0;
            let own = &mut q[at..at + 4];
            let zero = T::from_f64(0.0);
            let square = own.iter().fold(zero, |sum, &x| sum + x * x);
            if square == zero {
                own[3] = T::from_f64(1.0);
            } else {
                let length = square.sqrt();
                own.iter_mut().for_each(|x| *x = *x / length);
            }
        }
    }

    /// Returns q̇ = N(q) v.
    pub fn position_rates(&self, q: &[Dd], v: &[Dd]) -> Vec<Dd> {
        let mut rates = vec![Dd::ZERO; self.positions.len()];
        for frame in self.frames.iter().filter(|f| f.degrees.own_positions()) {
            let positions = &frame.degrees.positions;
            let own = frame.degrees.velocities_of(|j| v[j.0]);
            let own = match frame.motion {
                Motion::Compound(motion) => {
                    let q: Vec<Dd> = positions.iter().map(|p| q[p.0]).collect();
                    motion.position_rates(&frame.constants(), (&q, &own), &DoubleDouble)
                }
                _ => own,
            };
            for (p, rate) in positions.iter().zip(own) {
                rates[p.0] = rate;
            }
        }
        rates
    }

    /// Returns mass, centre of mass and tensor of a link.
    pub fn inertial(&self, i: LinkId) -> Inertial {
        self.inertials[i.0]
    }
}
