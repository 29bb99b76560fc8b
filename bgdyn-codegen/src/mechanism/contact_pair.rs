//! Pairs that may touch: a sphere or a point of a link, and a plane or another sphere.
//!
//! The gap of a pair is the distance of its two surfaces, negative where they overlap. The contact point is on the
//! line of the normal, in the middle of the overlap of two spheres, and on the sphere against a plane. The normal
//! points from the partner to the sphere.

use bgdyn_runtime::Dd;

use super::{LinkId, Pose};
use crate::math::Vec3;

/// A sphere on a link; a point if its radius is 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactSphere {
    /// The link; `None` for the world.
    pub link: Option<LinkId>,
    /// Its centre in link axes, m.
    pub centre: Vec3<Dd>,
    /// Its radius, m.
    pub radius: Dd,
}

/// What a sphere may touch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ContactPartner {
    /// A plane.
    Plane {
        /// The link that it is fixed to; `None` for the world.
        link: Option<LinkId>,
        /// A place on the plane in link axes, with z along the normal, towards the sphere.
        pose: Pose,
    },
    /// Another sphere.
    Sphere(ContactSphere),
}

impl ContactPartner {
    /// Returns its link; `None` for the world.
    pub fn link(&self) -> Option<LinkId> {
        match self {
            ContactPartner::Plane { link, .. } => *link,
            ContactPartner::Sphere(sphere) => sphere.link,
        }
    }
}

/// A sphere and what it may touch.
#[derive(Clone, Debug, PartialEq)]
pub struct ContactPair {
    /// Its name: that of its entry in the file, with a number if the entry has several pairs.
    pub name: String,
    /// The name of its entry in the file.
    pub entry: String,
    /// The sphere.
    pub sphere: ContactSphere,
    /// What it may touch.
    pub partner: ContactPartner,
}
