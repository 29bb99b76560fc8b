//! The recursions of the textbooks for any tree, with loops over its bodies, as written without a
//! generator. The reference of the benchmarks, not part of bgdyn.
//!
//! Spatial vectors in body axes and about body origins (Featherstone 2008, *Rigid Body Dynamics
//! Algorithms*): inverse dynamics by table 5.1, mass matrix by 6.2, forward dynamics by 7.1, with Plücker
//! transforms stored as a rotation and a point, and inertias as mass, first moment and tensor. Nothing is
//! allocated. `no_std` without the feature `mechanism`.
#![no_std]
#![forbid(unsafe_code)]

mod articulated;
mod body;
mod composite;
mod jacobian;
#[cfg(feature = "mechanism")]
pub mod mechanism;
mod newton_euler;
mod spatial;

use nalgebra::{RealField, Vector3, convert};

pub use body::{Body, Placement};

use articulated::ArticulatedInertia;
use spatial::{Force, Inertia, Joint, Motion, Transform};

/// A tree of up to `N` bodies, with memory for the recursions' intermediate results.
#[derive(Clone, Debug)]
pub struct Textbook<T: RealField + Copy, const N: usize> {
    joints: usize,
    parent: [Option<usize>; N],
    joint: [Joint<T>; N],
    inertia: [Inertia<T>; N],
    /// The upward acceleration of the base that represents gravity: −g.
    base: Motion<T>,
    sine: fn(T) -> (T, T),
    // Intermediate results of each body.
    transform: [Transform<T>; N],
    velocity: [Motion<T>; N],
    acceleration: [Motion<T>; N],
    force: [Force<T>; N],
    composite: [Inertia<T>; N],
    articulated: [ArticulatedInertia<T>; N],
    bias: [Motion<T>; N],
    reaction: [Force<T>; N],
    pivot: [T; N],
    effort: [T; N],
    world: [Transform<T>; N],
}

impl<T: RealField + Copy, const N: usize> Textbook<T, N> {
    /// Returns the tree of these bodies, parents before children; `gravity` in world axes, m/s².
    ///
    /// # Panics
    /// If there are more than `N` bodies.
    pub fn new(bodies: &[Body], gravity: Vector3<f64>) -> Self {
        let still = Motion::zero();
        let mut tree = Textbook {
            joints: bodies.len(),
            parent: [None; N],
            joint: [Joint::none(); N],
            inertia: [Inertia::zero(); N],
            base: Motion {
                angular: Vector3::zeros(),
                linear: -gravity.map(convert::<f64, T>),
            },
            sine: T::sin_cos,
            transform: [Transform::identity(); N],
            velocity: [still; N],
            acceleration: [still; N],
            force: [Force::zero(); N],
            composite: [Inertia::zero(); N],
            articulated: [ArticulatedInertia::zero(); N],
            bias: [still; N],
            reaction: [Force::zero(); N],
            pivot: [T::zero(); N],
            effort: [T::zero(); N],
            world: [Transform::identity(); N],
        };
        for (i, body) in bodies.iter().enumerate() {
            tree.parent[i] = body.parent;
            tree.joint[i] = Joint::of(body);
            tree.inertia[i] = Inertia::of(body);
        }
        tree
    }

    /// Returns the same tree with another sine and cosine than those of the scalar.
    pub fn with_sine(self, sine: fn(T) -> (T, T)) -> Self {
        Textbook { sine, ..self }
    }

    /// Returns the number of joints.
    pub fn joints(&self) -> usize {
        self.joints
    }

    /// Returns the pose of joint `i`'s body at this coordinate.
    fn placed(&self, i: usize, q: T) -> Transform<T> {
        self.joint[i].place(q, self.sine)
    }
}
