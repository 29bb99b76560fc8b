//! Motions other than rotation about, or translation along, one axis.
//!
//! A compound motion is data: elementary [`Step`]s that give the pose of the link as a function of the
//! positions, and one constant twist in link axes for each velocity (the columns of the motion subspace).
//! Everything else follows: position rates q̇ = N(q) v, units, names. A joint whose motion subspace varies
//! in link axes is written as a chain of joints instead ([`super::ChainMember`]).

use std::ops::Mul;

use bgdyn_runtime::Dd;

use crate::math::{Mat3, Ring, Vec3, rodrigues};

/// A motion described by data.
#[derive(Debug, PartialEq, Eq)]
pub struct CompoundMotion {
    /// The module of `bgdyn_runtime::manifold` with its integration; empty if q̇ = v.
    pub manifold: &'static str,
    /// Elementary motions, from the joint's origin outward.
    pub steps: &'static [Step],
    /// Its positions.
    pub positions: &'static [PositionPart],
    /// Its velocities.
    pub velocities: &'static [VelocityPart],
    /// Whether it needs an axis.
    pub axial: bool,
}

/// An elementary motion. PoseNumbers are indices of the joint's positions.
#[derive(Debug, PartialEq, Eq)]
pub enum Step {
    /// Displacement by positions along x, y and z.
    Shift([Option<usize>; 3]),
    /// Rotation about z by a position.
    TurnZ(usize),
    /// Rotation about the axis by a position, and displacement along it by the advance per radian.
    Screw(usize),
    /// Rotation by a quaternion x, y, z, w; the first of its positions.
    Quaternion(usize),
}

/// A position.
#[derive(Debug, PartialEq, Eq)]
pub struct PositionPart {
    /// The end of its name; empty for the only one.
    pub suffix: &'static str,
    /// Its unit; empty for a pure number.
    pub unit: &'static str,
    /// Its value, 0 or 1, in the neutral configuration.
    pub neutral: u8,
}

/// A velocity.
#[derive(Debug, PartialEq, Eq)]
pub struct VelocityPart {
    /// The end of its name; empty for the only one.
    pub suffix: &'static str,
    /// Its column of the motion subspace.
    pub twist: Twist,
}

/// The twist of a link, relative to its parent, for a unit velocity: link axes, at the link's origin.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Twist {
    /// Unit velocity along x, y or z.
    Linear(usize),
    /// Unit angular velocity about x, y or z.
    Angular(usize),
    /// Unit angular velocity about the axis, and the advance per radian along it.
    Screw,
}

/// A column of a motion subspace: link axes, at the link's origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Column<T> {
    /// Angular velocity per unit velocity.
    pub angular: Vec3<T>,
    /// Velocity of the link's origin per unit velocity.
    pub linear: Vec3<T>,
}

/// The constants of a joint that its motion depends on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointConstants {
    /// Unit vector of the axis.
    pub axis: Vec3<Dd>,
    /// Advance along the axis, m/rad.
    pub advance: Dd,
    /// Whether quaternions of any length are accepted.
    pub any_length: bool,
}

/// The functions of the numbers that poses are computed with.
pub trait PoseNumbers<E> {
    /// Returns a constant.
    fn constant(&self, x: Dd) -> E;
    /// Returns cosine and sine.
    fn cos_sin(&self, angle: E) -> (E, E);
    /// Returns cosine and sine of the sum of an angle and a constant.
    fn cos_sin_from(&self, angle: E, phase: Dd) -> (E, E)
    where
        E: Ring,
    {
        match phase == Dd::ZERO {
            true => self.cos_sin(angle),
            false => self.cos_sin(angle + self.constant(phase)),
        }
    }
    /// Returns 2 / (x² + y² + z² + w²).
    fn twice_inverse(&self, squares: E) -> E;
}

/// Double-double numbers.
pub struct DoubleDouble;

impl PoseNumbers<Dd> for DoubleDouble {
    fn constant(&self, x: Dd) -> Dd {
        x
    }

    fn cos_sin(&self, angle: Dd) -> (Dd, Dd) {
        let (sin, cos) = angle.sin_cos();
        (cos, sin)
    }

    fn twice_inverse(&self, squares: Dd) -> Dd {
        Dd::from_f64(2.0) / squares
    }
}

impl CompoundMotion {
    /// Returns the pose of the link in the joint's origin: the rotation from link axes to origin axes, and
    /// the link's origin.
    pub fn pose<E: Ring + Mul<Dd, Output = E>>(
        &self,
        joint: &JointConstants,
        q: &[E],
        numbers: &impl PoseNumbers<E>,
    ) -> (Mat3<E>, Vec3<E>) {
        let constant = |x: Dd| numbers.constant(x);
        let zero = constant(Dd::ZERO);
        let one = |i, j| constant(if i == j { Dd::ONE } else { Dd::ZERO });
        let (mut rotation, mut origin) = (Mat3::from_fn(one), Vec3([zero; 3]));
        for step in self.steps {
            match *step {
                Step::Shift(along) => {
                    origin = origin + rotation * Vec3(along.map(|p| p.map_or(zero, |p| q[p])));
                }
                Step::TurnZ(p) => {
                    let z = Vec3([Dd::ZERO, Dd::ZERO, Dd::ONE]);
                    rotation = rotation * rodrigues(z, numbers.cos_sin(q[p]), constant);
                }
                Step::Screw(p) => {
                    let along = joint.axis.map(constant).scale(q[p] * joint.advance);
                    origin = origin + rotation * along;
                    rotation = rotation * rodrigues(joint.axis, numbers.cos_sin(q[p]), constant);
                }
                Step::Quaternion(p) => {
                    let quaternion = [q[p], q[p + 1], q[p + 2], q[p + 3]];
                    rotation = rotation * turned(quaternion, joint.any_length, numbers);
                }
            }
        }
        (rotation, origin)
    }

    /// Returns the columns of the motion subspace, one for each velocity.
    pub fn columns(&self, joint: &JointConstants) -> Vec<Column<Dd>> {
        let zero = Vec3([Dd::ZERO; 3]);
        let column = |part: &VelocityPart| match part.twist {
            Twist::Linear(k) => Column {
                angular: zero,
                linear: unit(k),
            },
            Twist::Angular(k) => Column {
                angular: unit(k),
                linear: zero,
            },
            Twist::Screw => Column {
                angular: joint.axis,
                linear: joint.axis.scale(joint.advance),
            },
        };
        self.velocities.iter().map(column).collect()
    }

    /// Returns q̇ = N(q) v. A displacement changes by the link's velocity, rotated to origin axes; a
    /// quaternion by ½ q∘ω.
    pub fn position_rates<E: Ring + Mul<Dd, Output = E>>(
        &self,
        joint: &JointConstants,
        (q, v): (&[E], &[E]),
        numbers: &impl PoseNumbers<E>,
    ) -> Vec<E> {
        let zero = numbers.constant(Dd::ZERO);
        let (mut linear, mut angular) = (Vec3([zero; 3]), Vec3([zero; 3]));
        let mut screw = zero;
        for (part, &rate) in self.velocities.iter().zip(v) {
            match part.twist {
                Twist::Linear(k) => linear.0[k] = rate,
                Twist::Angular(k) => angular.0[k] = rate,
                Twist::Screw => screw = rate,
            }
        }
        let mut rates = vec![zero; self.positions.len()];
        for step in self.steps {
            match *step {
                Step::Shift(along) => {
                    let (rotation, _) = self.pose(joint, q, numbers);
                    let velocity = rotation * linear;
                    for (p, rate) in along.into_iter().zip(velocity.0) {
                        p.into_iter().for_each(|p| rates[p] = rate);
                    }
                }
                Step::TurnZ(p) => rates[p] = angular.0[2],
                Step::Screw(p) => rates[p] = screw,
                Step::Quaternion(p) => {
                    let half = Dd::from_f64(0.5);
                    let vector = Vec3([q[p], q[p + 1], q[p + 2]]);
                    let (w, turning) = (q[p + 3], vector.cross(angular));
                    for k in 0..3 {
                        rates[p + k] = (angular.0[k] * w + turning.0[k]) * half;
                    }
                    rates[p + 3] = -(vector.dot(angular) * half);
                }
            }
        }
        rates
    }

    /// Returns the names of the functions that read and set its pose, or its rotation if it does not
    /// translate, for a joint of this name; `None` without a quaternion.
    pub fn access_names(&self, joint: &str) -> Option<[String; 2]> {
        self.quaternion()?;
        let kind = self.access_kind();
        Some([format!("{joint}_{kind}"), format!("set_{joint}_{kind}")])
    }

    /// Returns `pose`, or `rotation` if a quaternion is all of its positions.
    pub fn access_kind(&self) -> &'static str {
        match self.quaternion() {
            Some(0) => "rotation",
            _ => "pose",
        }
    }

    /// Returns the first position of its quaternion, if it has one.
    pub fn quaternion(&self) -> Option<usize> {
        let first = |step: &Step| match step {
            Step::Quaternion(p) => Some(*p),
            _ => None,
        };
        self.steps.iter().find_map(first)
    }
}

/// Returns the rotation of a quaternion x, y, z, w: 1 + 2 w [u]× + 2 [u]×[u]×, with u = (x, y, z). For a
/// quaternion of any length, 2 is replaced by 2 / (x² + y² + z² + w²).
fn turned<E: Ring + Mul<Dd, Output = E>>(
    [x, y, z, w]: [E; 4],
    any_length: bool,
    numbers: &impl PoseNumbers<E>,
) -> Mat3<E> {
    let one = numbers.constant(Dd::ONE);
    let squares = x * x + y * y + z * z + w * w;
    let twice = |e: E| match any_length {
        true => e * numbers.twice_inverse(squares),
        false => e * Dd::from_f64(2.0),
    };
    let [x2, y2, z2] = [x, y, z].map(twice);
    let (xx, yy, zz) = (x2 * x, y2 * y, z2 * z);
    let (xy, xz, yz) = (x2 * y, x2 * z, y2 * z);
    let (wx, wy, wz) = (x2 * w, y2 * w, z2 * w);
    Mat3([
        [one - (yy + zz), xy - wz, xz + wy],
        [xy + wz, one - (xx + zz), yz - wx],
        [xz - wy, yz + wx, one - (xx + yy)],
    ])
}

/// Returns a unit vector.
fn unit(k: usize) -> Vec3<Dd> {
    let at = |i: usize| if i == k { Dd::ONE } else { Dd::ZERO };
    Vec3([at(0), at(1), at(2)])
}

/// A position of a displacement, m.
pub(super) const fn length(suffix: &'static str) -> PositionPart {
    PositionPart {
        suffix,
        unit: "m",
        neutral: 0,
    }
}

/// A position of an angle, rad.
pub(super) const fn angle(suffix: &'static str) -> PositionPart {
    PositionPart {
        suffix,
        unit: "rad",
        neutral: 0,
    }
}

/// A component of a quaternion, with its value in the neutral configuration.
pub(super) const fn component(suffix: &'static str, neutral: u8) -> PositionPart {
    PositionPart {
        suffix,
        unit: "",
        neutral,
    }
}

/// A velocity along an axis of the link.
pub(super) const fn linear(suffix: &'static str, axis: usize) -> VelocityPart {
    VelocityPart {
        suffix,
        twist: Twist::Linear(axis),
    }
}

/// A velocity about an axis of the link.
pub(super) const fn angular(suffix: &'static str, axis: usize) -> VelocityPart {
    VelocityPart {
        suffix,
        twist: Twist::Angular(axis),
    }
}

impl VelocityPart {
    /// Returns its unit.
    pub fn unit(&self) -> &'static str {
        match self.twist {
            Twist::Linear(_) => "m/s",
            Twist::Angular(_) | Twist::Screw => "rad/s",
        }
    }
}
