//! The recursions of the textbooks for any tree, with loops over its bodies: what one writes without
//! a generator. The yardstick of the benchmarks, not part of bgdyn.
//!
//! Spatial vectors in body axes and about body origins (Featherstone 2008, *Rigid Body Dynamics
//! Algorithms*): inverse dynamics by table 5.1, mass matrix by 6.2, forward dynamics by 7.1, with
//! Plücker transforms kept as a rotation and a point, and inertias as mass, first moment and tensor.
//! Nothing is allocated in a call.

mod articulated;
mod composite;
mod jacobian;
mod newton_euler;
mod spatial;

use nalgebra::{RealField, Vector3, convert};

use crate::body::Body;
use articulated::ArticulatedInertia;
use spatial::{Force, Inertia, Joint, Motion, Transform};

/// A tree of bodies, with room for the recursions' intermediate results.
#[derive(Clone, Debug)]
pub struct Textbook<T: RealField + Copy> {
    parent: Vec<Option<usize>>,
    joint: Vec<Joint<T>>,
    inertia: Vec<Inertia<T>>,
    /// The acceleration of a world at rest in which everything falls: −g.
    base: Motion<T>,
    /// As many zeros as there are joints.
    zeros: Vec<T>,
    // What the recursions keep of each body.
    transform: Vec<Transform<T>>,
    velocity: Vec<Motion<T>>,
    acceleration: Vec<Motion<T>>,
    force: Vec<Force<T>>,
    composite: Vec<Inertia<T>>,
    articulated: Vec<ArticulatedInertia<T>>,
    bias: Vec<Motion<T>>,
    reaction: Vec<Force<T>>,
    pivot: Vec<T>,
    effort: Vec<T>,
    world: Vec<Transform<T>>,
}

impl<T: RealField + Copy> Textbook<T> {
    /// The tree of these bodies, which stand behind their carriers; `gravity` in world axes, m/s².
    pub fn new(bodies: &[Body], gravity: Vector3<f64>) -> Self {
        let n = bodies.len();
        let still = Motion::zero();
        Textbook {
            parent: bodies.iter().map(|b| b.parent).collect(),
            joint: bodies.iter().map(Joint::of).collect(),
            inertia: bodies.iter().map(Inertia::of).collect(),
            base: Motion {
                angular: Vector3::zeros(),
                linear: -gravity.map(convert::<f64, T>),
            },
            zeros: vec![T::zero(); n],
            transform: vec![Transform::identity(); n],
            velocity: vec![still; n],
            acceleration: vec![still; n],
            force: vec![Force::zero(); n],
            composite: vec![Inertia::zero(); n],
            articulated: vec![ArticulatedInertia::zero(); n],
            bias: vec![still; n],
            reaction: vec![Force::zero(); n],
            pivot: vec![T::zero(); n],
            effort: vec![T::zero(); n],
            world: vec![Transform::identity(); n],
        }
    }

    /// Number of joints.
    pub fn joints(&self) -> usize {
        self.parent.len()
    }
}
