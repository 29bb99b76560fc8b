//! Quantities of a joint from which inboard joints compute the derivatives of their efforts by its coordinate.
//!
//! Accelerations due to velocities have a factor of 2. The Coriolis matrix is half of ∂τ/∂v: for it the
//! factor is 1 in all equations, and ∂τ/∂q is not valid.

use bgdyn_runtime::Dd;

use super::axis_changes::{
    JointAxis, across, rotation_by_position, rotation_by_rate, rotation_swirl, translation,
};
use super::composite_flow::CompositeFlow;
use crate::expr::{Builder, Expr};
use crate::formulation::recursion::frames::BodyFrame;
use crate::formulation::recursion::inertia::BodyInertia;
use crate::formulation::recursion::inverse_dynamics::BodyWrench;
use crate::formulation::recursion::mass_matrix::Momentum;
use crate::formulation::recursion::motion::Spin;
use crate::formulation::recursion::rotation::Rotation;
use crate::formulation::recursion::rotors::FullRotor;
use crate::math::Vec3;
use crate::mechanism::Motion;

/// A joint, expressed in the frame of an inboard body.
#[derive(Clone, Copy)]
pub(in crate::formulation::recursion) struct OutboardJoint<'g> {
    /// Momentum of all outboard bodies per unit rate.
    pub momentum: Momentum<'g>,
    /// Factor · ∫ v × δ dm, with δ the velocity of a unit rate and v the true velocity relative to the
    /// reference point, in axes that do not rotate.
    swirl: Vec3<Expr<'g>>,
    /// ∂/∂q of force and moment on all outboard bodies.
    by_position: BodyWrench<'g>,
    /// Factor / 2 · ∂/∂v of the same.
    by_rate: BodyWrench<'g>,
    /// The displacement from the body's origin to the reference point, and factor times the velocity of
    /// that point relative to the origin: nonzero only in a group of parallel axes.
    offset: Vec3<Expr<'g>>,
    drift: Vec3<Expr<'g>>,
    /// Entries with the last rotation passed in the group, and the position of its origin relative to this
    /// one.
    last: Option<(PartialEntries<'g>, Vec3<Expr<'g>>)>,
    /// The forces in the axes of the last body of the group, if they are needed there.
    met: Option<Met<'g>>,
}

/// Derivatives of force in the axes of a body.
#[derive(Clone, Copy)]
struct Met<'g> {
    /// The forces of `by_position` and `by_rate`.
    forces: [Vec3<Expr<'g>>; 2],
    /// Cosine and sine of the angle from the basis to the body's axes.
    angle: (Expr<'g>, Expr<'g>),
}

/// A rotation of a group, with the bodies that it moves, for the previous rotation of the group.
#[derive(Clone, Copy)]
pub(in crate::formulation::recursion) struct GroupNeighbour<'g> {
    /// The rotation, about its own origin.
    pub joint: OutboardJoint<'g>,
    /// Inertia of all bodies that it moves, about the same origin.
    pub inertia: BodyInertia<'g>,
    /// Factor · ∫ v dm, with v the true velocity relative to that origin, in axes that do not rotate.
    pub flow: Vec3<Expr<'g>>,
    /// The force on these bodies.
    pub force: Vec3<Expr<'g>>,
    /// Displacement of that origin from the origin of the body before.
    pub offset: Vec3<Expr<'g>>,
}

/// The four derivatives that couple a joint and an outboard one.
#[derive(Clone, Copy)]
pub(in crate::formulation::recursion) struct PartialEntries<'g> {
    /// Derivatives of the joint's effort by position and rate of the outboard one.
    pub own: (Expr<'g>, Expr<'g>),
    /// Derivatives of the outboard joint's effort by this joint's position and rate.
    pub beyond: (Expr<'g>, Expr<'g>),
}

impl<'g> OutboardJoint<'g> {
    /// Returns the quantities of a joint from its composite body, relative to a body with the motion
    /// `spin`, and from the force `force` on it.
    pub fn new(
        b: &'g Builder,
        motion: Motion,
        momentum: Momentum<'g>,
        axis: &JointAxis<'g>,
        (spin, whole): (&Spin<'g>, &CompositeFlow<'g>),
        force: Vec3<Expr<'g>>,
    ) -> Self {
        let zero = Vec3([b.zero(); 3]);
        let (swirl, by_position, by_rate) = match motion {
            Motion::Rotation => (
                rotation_swirl(b, whole, axis),
                rotation_by_position(b, whole, spin, axis),
                rotation_by_rate(b, whole, spin, axis.factor),
            ),
            _ => translation(b, whole, axis, force),
        };
        OutboardJoint {
            momentum,
            swirl,
            by_position,
            by_rate,
            offset: zero,
            drift: zero,
            last: None,
            met: None,
        }
    }

    /// Returns a rotor, relative to its carrier, in the carrier's own axes: a unit
    /// rate gives it only the momentum h, which the carrier's ω rotates, so that it requires the moment ω
    /// × h. The position has no influence. The dot products of [`OutboardJoint::entries`] give the changes
    /// h · z̈ + ω × h · ż and 2 h · ż + ω × h · z of the effort h · ω̇ with its swirl ω × h.
    pub fn of_rotor(b: &'g Builder, rotor: &FullRotor<'g>, axis: &JointAxis<'g>) -> Self {
        let h = rotor.unit_momentum();
        let zero = Vec3([b.zero(); 3]);
        let half = axis.factor * Dd::from_f64(0.5);
        let whirl = axis.spin.omega.cross(h).map(|x| x * half);
        OutboardJoint {
            momentum: Momentum {
                joint: rotor.joint,
                effort: rotor.effort,
                linear: zero,
                angular: h,
            },
            swirl: whirl,
            by_position: BodyWrench::zero(b),
            by_rate: BodyWrench {
                force: zero,
                moment: whirl,
            },
            offset: zero,
            drift: zero,
            last: None,
            met: None,
        }
    }

    /// Applies `f`, a change of axes.
    pub fn map(self, f: impl Fn(Vec3<Expr<'g>>) -> Vec3<Expr<'g>>) -> Self {
        OutboardJoint {
            momentum: self.momentum.map(&f),
            swirl: f(self.swirl),
            by_position: self.by_position.map(&f),
            by_rate: self.by_rate.map(&f),
            ..self
        }
    }

    /// Returns it rotated by Rz; with `meet`, the forces are also stored in the present axes.
    pub fn turned(self, angle: (Expr<'g>, Expr<'g>), meet: bool) -> Self {
        let forces = [self.by_position.force, self.by_rate.force];
        OutboardJoint {
            met: meet.then_some(Met { forces, angle }),
            ..self.map(|v| Rotation::AboutZ(angle).apply(v))
        }
    }

    /// Adds the contribution of another part of the outboard mass; the momentum is already that of all.
    pub fn with(self, part: &Self) -> Self {
        OutboardJoint {
            swirl: self.swirl + part.swirl,
            by_position: self.by_position.plus(part.by_position),
            by_rate: self.by_rate.plus(part.by_rate),
            ..self
        }
    }

    /// Returns the contribution to a rotation of the bodies that the next rotation of the group moves. The
    /// two fields differ by the translation d = z × r, which is fixed in the body with `axis` between
    /// them: it adds m d̈ to ∂F/∂q, h × d̈ + d × F to ∂M/∂q and, with ḋ, 2 m ḋ and 2 h × ḋ to those by the
    /// rate.
    pub fn from_neighbour(b: &'g Builder, next: &GroupNeighbour<'g>, axis: &JointAxis<'g>) -> Self {
        let twice = axis.spin.omega.map(|x| x * axis.factor);
        let d = across(b, next.offset);
        let h = next.inertia.first;
        let field = |v: Vec3<Expr<'g>>| BodyWrench {
            force: next.inertia.weigh(v),
            moment: h.cross(v),
        };
        let mut by_position = field(axis.spin.u * d);
        by_position.moment = by_position.moment + d.cross(next.force);
        let (joint, momentum) = (next.joint, field(d));
        let translated = OutboardJoint {
            momentum: Momentum {
                linear: joint.momentum.linear + momentum.force,
                angular: joint.momentum.angular + momentum.moment,
                ..joint.momentum
            },
            swirl: joint.swirl + next.flow.cross(d),
            by_position: joint.by_position.plus(by_position),
            by_rate: joint.by_rate.plus(field(twice.cross(d))),
            ..joint
        };
        translated
            .moved(next.offset, twice.cross(next.offset))
            .settled(b)
    }

    /// Changes the reference origin to one from which the present one is displaced by r and relative to
    /// which it moves, times the factor, at `drift`; [`OutboardJoint::settled`] evaluates the
    /// consequences.
    pub fn moved(self, r: Vec3<Expr<'g>>, drift: Vec3<Expr<'g>>) -> Self {
        OutboardJoint {
            offset: self.offset + r,
            drift: self.drift + drift,
            last: self.last.map(|(entries, since)| (entries, since + r)),
            ..self
        }
    }

    /// Returns it about the body's origin.
    pub fn settled(self, b: &'g Builder) -> Self {
        let zero = Vec3([b.zero(); 3]);
        OutboardJoint {
            momentum: self.momentum.carried(self.offset),
            swirl: self.swirl + self.drift.cross(self.momentum.linear),
            by_position: self.by_position.carried(self.offset),
            by_rate: self.by_rate.carried(self.offset),
            offset: zero,
            drift: zero,
            last: None,
            met: None,
        }
    }

    /// Returns the same, after its entries with a joint whose axis may continue the group.
    pub fn entered(self, b: &'g Builder, motion: Motion, entries: PartialEntries<'g>) -> Self {
        let here = Vec3([b.zero(); 3]);
        let last = match motion {
            Motion::Rotation => Some((entries, here)),
            _ => self.last,
        };
        OutboardJoint { last, ..self }
    }

    /// Returns the entry of the mass matrix with an inboard joint.
    pub fn mass(&self, frame: &BodyFrame<'g>) -> Expr<'g> {
        self.momentum.carried(self.offset).along(&frame.columns[0])
    }

    /// Returns the entries with itself.
    pub fn diagonal(&self, frame: &BodyFrame<'g>) -> PartialEntries<'g> {
        let own = (
            self.by_position.along(&frame.columns[0]),
            self.by_rate.along(&frame.columns[0]),
        );
        PartialEntries { own, beyond: own }
    }

    /// Returns the entries with an inboard joint, whose origin is the reference point.
    pub fn entries(
        &self,
        b: &'g Builder,
        frame: &BodyFrame<'g>,
        axis: &JointAxis<'g>,
    ) -> PartialEntries<'g> {
        let (p, l) = (self.momentum.linear, self.momentum.angular);
        let (rate, second_rate) = (axis.rate(b), axis.second_rate());
        let rates = rate.map(|x| x * axis.factor);
        let beyond = match frame.motion {
            Motion::Rotation => {
                let pull = p.0[0] * axis.a.0[1] - p.0[1] * axis.a.0[0];
                (
                    l.dot(second_rate) + pull + self.swirl.dot(rate),
                    l.dot(rates) + self.swirl.0[2],
                )
            }
            _ => (p.dot(second_rate), p.dot(rates)),
        };
        let own = (
            self.by_position.along(&frame.columns[0]),
            self.by_rate.along(&frame.columns[0]),
        );
        PartialEntries { own, beyond }
    }

    /// Returns the entries with a rotation of the same group as the last one passed, whose field differs
    /// by the translation z × r; `None` if there was no such joint.
    pub fn entries_from_last(
        &self,
        b: &'g Builder,
        axis: &JointAxis<'g>,
    ) -> Option<PartialEntries<'g>> {
        let (last, since) = self.last?;
        let [x, y, _] = since.0;
        let step = Vec3([-y, x, b.zero()]);
        let forces = [self.by_position.force, self.by_rate.force];
        let ([by_position, by_rate], met_step) = match self.met {
            Some(met) => (met.forces, Rotation::AboutZ(met.angle).apply_back(step)),
            None => (forces, step),
        };
        let step_rate = axis.spin.omega.map(|x| x * axis.factor).cross(step);
        let p = self.momentum.linear;
        Some(PartialEntries {
            own: (
                last.own.0 + met_step.dot(by_position),
                last.own.1 + met_step.dot(by_rate),
            ),
            beyond: (
                last.beyond.0 + p.dot(axis.spin.u * step),
                last.beyond.1 + p.dot(step_rate),
            ),
        })
    }
}
