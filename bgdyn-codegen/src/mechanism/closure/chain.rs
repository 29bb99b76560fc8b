//! The joints of a loop in series: the motion of its place b relative to its place a, in the axes of a.
//!
//! From a inward to the link that carries both sides, and outward to b. A step inward goes through a joint from
//! the joint's link to its parent: the twist of the parent relative to the link is −Σ column · v. With s, the
//! segment from one frame's origin to the next, and w, l the twist of a joint:
//!
//! - outward: ω' = ω + w, α' = α + ω × w, a' = a + α × s + ω × (ω × s + l) + ω' × l
//! - inward: ω' = ω + w, α' = α + ω × w, a' = a + ω × l + α' × s + ω' × (l + ω' × s)
//!
//! The numbers are double-doubles in the check, and expressions in formulations.

use std::ops::Mul;

use bgdyn_runtime::Dd;

use crate::math::{Mat3, Ring, Vec3, rodrigues};
use crate::mechanism::joint::{Column, PoseNumbers};
use crate::mechanism::{CoordinateId, Degrees, LinkId, Motion, Pose};

/// A joint on the way from place a to place b.
#[derive(Clone, Debug, PartialEq)]
pub struct ChainStep {
    /// The link of the joint.
    pub link: LinkId,
    /// Whether the step goes from the parent to the link.
    pub outward: bool,
    /// Pose of the joint's origin in the parent.
    pub origin: Pose,
    /// The motion that the joint allows.
    pub motion: Motion,
    /// Unit vector of its axis in link axes.
    pub axis: Vec3<Dd>,
    /// Its positions and velocities in the open tree.
    pub degrees: Degrees,
    /// A constant angle that is added to that of its rotation, rad.
    pub phase: Dd,
    /// The columns of other velocities in place of those of its joint, in link axes at the link's origin.
    pub columns: Option<Vec<(CoordinateId, Column<Dd>)>>,
}

/// The joints of a loop in series, and its places on the first and the last link.
#[derive(Clone, Debug, PartialEq)]
pub struct LoopChain {
    /// Place a on its link.
    pub start: Pose,
    /// The joints from a to b.
    pub steps: Vec<ChainStep>,
    /// Place b on its link.
    pub end: Pose,
}

/// The point of place b at which its twists are given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TwistPoint {
    /// The one at the origin of place a.
    A,
    /// Its origin.
    B,
    /// Its origin, which coincides with that of place a: levers on the side of a are those to place a.
    Both,
}

/// The frames of a chain's links at one position, in the axes of place a.
pub struct ChainFrames<E> {
    /// Link axes: that of the first link, then after each step.
    rotations: Vec<Mat3<E>>,
    /// From place a to the first link's origin, to the origins after each step, to place b; m.
    segments: Vec<Vec3<E>>,
    zero: E,
}

/// The motion of place b relative to place a, in the axes of a.
pub struct RelativePlace<E> {
    /// The axes of b.
    pub rotation: Mat3<E>,
    /// The origin of b, m.
    pub position: Vec3<E>,
    /// The twist of b for a unit velocity of the open tree, at the origin of b.
    pub columns: Vec<(CoordinateId, Column<E>)>,
}

/// The velocity of place b relative to place a, and its acceleration if no joint accelerates.
pub struct RelativeRates<E> {
    /// ω and the velocity of the origin.
    pub velocity: Column<E>,
    /// α and the acceleration of the origin.
    pub bias: Column<E>,
}

impl ChainStep {
    /// Returns the pose of the joint's link in the parent.
    fn pose<E: Ring + Mul<Dd, Output = E>>(
        &self,
        q: &[E],
        numbers: &impl PoseNumbers<E>,
    ) -> (Mat3<E>, Vec3<E>) {
        let constant = |x: Dd| numbers.constant(x);
        let fixed = self.origin.rotation.map(constant);
        let origin = self.origin.translation.map(constant);
        let own = self.positions(q, numbers);
        match self.motion {
            Motion::None => (fixed, origin),
            Motion::Rotation => {
                let angle = numbers.cos_sin_from(own[0], self.phase);
                let turned = rodrigues(self.axis, angle, constant);
                (fixed * turned, origin)
            }
            Motion::Translation => {
                let axis = self.origin.rotation * self.axis;
                (fixed, origin + axis.map(constant).scale(own[0]))
            }
            Motion::Compound(motion) => {
                let (turned, shift) =
                    motion.pose(&self.degrees.constants(self.axis), &own, numbers);
                (fixed * turned, origin + fixed * shift)
            }
        }
    }

    fn positions<E: Ring + Mul<Dd, Output = E>>(
        &self,
        q: &[E],
        numbers: &impl PoseNumbers<E>,
    ) -> Vec<E> {
        let read = self.degrees.positions.iter().map(|p| q[p.0]);
        if self.degrees.coupling.is_none() {
            return read.collect();
        }
        let start = numbers.constant(self.degrees.offset());
        let terms = read.zip(self.degrees.position_ratios());
        vec![terms.fold(start, |sum, (q, ratio)| sum + q * ratio)]
    }
}

impl LoopChain {
    /// Returns the chain from b to a.
    pub fn reversed(&self) -> Self {
        let turned = self.steps.iter().rev().map(|step| ChainStep {
            outward: !step.outward,
            ..step.clone()
        });
        LoopChain {
            start: self.end,
            steps: turned.collect(),
            end: self.start,
        }
    }

    /// Returns the frames of the links at a position of the open tree.
    pub fn frames<E: Ring + Mul<Dd, Output = E>>(
        &self,
        q: &[E],
        numbers: &impl PoseNumbers<E>,
    ) -> ChainFrames<E> {
        let constant = |x: Dd| numbers.constant(x);
        let inverse = self.start.rotation.transpose();
        let mut rotation = inverse.map(constant);
        let mut rotations = vec![rotation];
        let mut segments = vec![(-(inverse * self.start.translation)).map(constant)];
        for step in &self.steps {
            let (turned, shift) = step.pose(q, numbers);
            if step.outward {
                segments.push(rotation * shift);
                rotation = rotation * turned;
            } else {
                rotation = rotation * turned.transpose();
                segments.push(-(rotation * shift));
            }
            rotations.push(rotation);
        }
        segments.push(rotation * self.end.translation.map(constant));
        ChainFrames {
            rotations,
            segments,
            zero: constant(Dd::ZERO),
        }
    }

    /// Returns the motion of place b, with its twists at one of its points.
    pub fn place<E: Ring + Mul<Dd, Output = E>>(
        &self,
        frames: &ChainFrames<E>,
        point: TwistPoint,
        numbers: &impl PoseNumbers<E>,
    ) -> RelativePlace<E> {
        let last = frames.rotations[self.steps.len()];
        let sum = |segments: &[Vec3<E>]| {
            let zero = Vec3([frames.zero; 3]);
            segments.iter().fold(zero, |sum, s| sum + *s)
        };
        let mut columns: Vec<(CoordinateId, Column<E>)> = Vec::new();
        for (k, step) in self.steps.iter().enumerate() {
            let own = step.columns(&frames.rotations[k..=k + 1], numbers);
            if own.is_empty() {
                continue;
            }
            // The column is that of the link's origin.
            let lever = match (step.outward, point) {
                (true, TwistPoint::A) => -sum(&frames.segments[..=k + 1]),
                (true, _) => sum(&frames.segments[k + 2..]),
                (false, TwistPoint::B) => sum(&frames.segments[k + 1..]),
                (false, _) => -sum(&frames.segments[..=k]),
            };
            for (j, column) in own {
                let linear = column.linear + column.angular.cross(lever);
                match columns.iter_mut().find(|(k, _)| *k == j) {
                    Some((_, sum)) => {
                        sum.angular = sum.angular + column.angular;
                        sum.linear = sum.linear + linear;
                    }
                    None => columns.push((
                        j,
                        Column {
                            angular: column.angular,
                            linear,
                        },
                    )),
                }
            }
        }
        RelativePlace {
            rotation: last * self.end.rotation.map(|x| numbers.constant(x)),
            position: sum(&frames.segments),
            columns,
        }
    }

    /// Returns the twist of place b at the fixed point of the axes of a that is their origin, and its derivative in
    /// these axes without accelerations of joints: the spatial acceleration. The columns of a joint turn and move
    /// with the links before it: their derivative is the product V × S (Featherstone 2008).
    pub fn spatial_rates<E: Ring + Mul<Dd, Output = E>>(
        &self,
        frames: &ChainFrames<E>,
        v: &[E],
        numbers: &impl PoseNumbers<E>,
    ) -> RelativeRates<E> {
        let zero = Vec3([frames.zero; 3]);
        let still = || Column {
            angular: zero,
            linear: zero,
        };
        let (mut velocity, mut bias) = (still(), still());
        let mut origin = frames.segments[0];
        for (k, step) in self.steps.iter().enumerate() {
            let next = origin + frames.segments[k + 1];
            let lever = if step.outward { -next } else { -origin };
            let mut twist = still();
            for (j, column) in step.columns(&frames.rotations[k..=k + 1], numbers) {
                let linear = column.linear + column.angular.cross(lever);
                twist.angular = twist.angular + column.angular.scale(v[j.0]);
                twist.linear = twist.linear + linear.scale(v[j.0]);
            }
            let (w, l) = (twist.angular, twist.linear);
            bias.angular = bias.angular + velocity.angular.cross(w);
            bias.linear = bias.linear + velocity.angular.cross(l) + velocity.linear.cross(w);
            velocity.angular = velocity.angular + w;
            velocity.linear = velocity.linear + l;
            origin = next;
        }
        RelativeRates { velocity, bias }
    }

    /// Returns the velocity of place b and its acceleration without accelerations of joints; `v` are the
    /// velocities of the open tree.
    pub fn rates<E: Ring + Mul<Dd, Output = E>>(
        &self,
        frames: &ChainFrames<E>,
        v: &[E],
        numbers: &impl PoseNumbers<E>,
    ) -> RelativeRates<E> {
        let zero = Vec3([frames.zero; 3]);
        let (mut omega, mut alpha) = (zero, zero);
        let (mut velocity, mut acceleration) = (zero, zero);
        for (k, step) in self.steps.iter().enumerate() {
            let s = frames.segments[k + 1];
            let own = step.columns(&frames.rotations[k..=k + 1], numbers);
            let mut twist = Column {
                angular: zero,
                linear: zero,
            };
            for (j, column) in own {
                twist.angular = twist.angular + column.angular.scale(v[j.0]);
                twist.linear = twist.linear + column.linear.scale(v[j.0]);
            }
            let (w, l) = (twist.angular, twist.linear);
            let (before, alpha_before) = (omega, alpha);
            omega = omega + w;
            alpha = alpha + before.cross(w);
            if step.outward {
                let along = before.cross(s);
                velocity = velocity + along + l;
                acceleration =
                    acceleration + alpha_before.cross(s) + before.cross(along + l) + omega.cross(l);
            } else {
                let along = l + omega.cross(s);
                velocity = velocity + along;
                acceleration = acceleration + before.cross(l) + alpha.cross(s) + omega.cross(along);
            }
        }
        let s = frames.segments[self.steps.len() + 1];
        let along = omega.cross(s);
        RelativeRates {
            velocity: Column {
                angular: omega,
                linear: velocity + along,
            },
            bias: Column {
                angular: alpha,
                linear: acceleration + alpha.cross(s) + omega.cross(along),
            },
        }
    }
}

impl ChainStep {
    /// Returns the twist of the frame after the step relative to the one before, per unit velocity, in the axes
    /// of place a, at the origin of the joint's link. `rotations` are those before and after.
    fn columns<E: Ring + Mul<Dd, Output = E>>(
        &self,
        rotations: &[Mat3<E>],
        numbers: &impl PoseNumbers<E>,
    ) -> Vec<(CoordinateId, Column<E>)> {
        let link = rotations[usize::from(self.outward)];
        let own = || self.degrees.columns(self.motion, self.axis);
        let all = self.columns.clone().unwrap_or_else(own).into_iter();
        all.map(|(j, column)| {
            let turned = |v: Vec3<Dd>| {
                let v = if self.outward { v } else { -v };
                link * v.map(|x| numbers.constant(x))
            };
            let column = Column {
                angular: turned(column.angular),
                linear: turned(column.linear),
            };
            (j, column)
        })
        .collect()
    }
}

impl<E: Ring> ChainFrames<E> {
    /// Returns the origins of the first and the last link, m.
    pub fn pivots(&self) -> [Vec3<E>; 2] {
        let zero = Vec3([self.zero; 3]);
        let last = self.segments.len() - 1;
        let end = self.segments[..last].iter().fold(zero, |sum, s| sum + *s);
        [self.segments[0], end]
    }

    /// Returns the axes and the origin of the link after this many steps.
    pub fn link(&self, steps: usize) -> (Mat3<E>, Vec3<E>) {
        let zero = Vec3([self.zero; 3]);
        let origin = self.segments[..=steps].iter().fold(zero, |sum, s| sum + *s);
        (self.rotations[steps], origin)
    }

    /// Returns a segment: 0 from place a to the first link's origin, the last one to place b, m.
    pub fn segment(&self, k: usize) -> Vec3<E> {
        self.segments[k]
    }

    /// Returns the origin of place b.
    pub fn end(&self) -> Vec3<E> {
        let zero = Vec3([self.zero; 3]);
        self.segments.iter().fold(zero, |sum, s| sum + *s)
    }

    /// Returns the axes of the last link.
    pub fn last_axes(&self) -> Mat3<E> {
        self.rotations[self.rotations.len() - 1]
    }

    /// Returns the axes of the first link.
    pub fn first_axes(&self) -> Mat3<E> {
        self.rotations[0]
    }
}
