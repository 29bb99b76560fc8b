//! The contribution of one joint to the derivatives of the joint efforts.
//!
//! It follows from the composite body that the joint moves, and is linear in it. So the parts of that body
//! can be expressed in different axes: parts known in the body's own axes in those axes, where its inertia
//! is constant and sparse; parts that continue its basis in the basis. The next rotation of the group has
//! already computed its contribution, and its field differs by a translation only.

use bgdyn_runtime::Dd;

use super::axis_changes::JointAxis;
use super::composite_flow::CompositeFlow;
use super::outboard_joint::{GroupNeighbour, OutboardJoint};
use crate::expr::{Builder, Expr};
use crate::formulation::recursion::frames::BodyFrame;
use crate::formulation::recursion::mass_matrix::{Momentum, unit_momentum};
use crate::formulation::recursion::motion::{Moving, Spin};
use crate::formulation::recursion::plan::{PartialsPlan, SeenFrom};
use crate::math::Vec3;
use crate::mechanism::Motion;

/// A joint, and its motion.
pub(super) struct JointContext<'a, 'g> {
    pub b: &'g Builder,
    /// Its index in the order of the coordinates.
    pub index: usize,
    pub frame: &'a BodyFrame<'g>,
    /// Motion of the body after the joint.
    pub moving: &'a Moving<'g>,
    /// Angular motion of the body before it, in the axes of the joint's basis.
    pub before: &'a Spin<'g>,
    /// The factor of [`JointAxis`].
    pub factor: Dd,
    pub view: PartialsPlan,
}

/// The sum of outboard bodies, in one set of axes.
#[derive(Clone)]
pub(super) struct Subtree<'g> {
    /// All of them as one body.
    pub whole: CompositeFlow<'g>,
    /// Their joints.
    pub beyond: Vec<OutboardJoint<'g>>,
    /// The rotations that continue the body's basis.
    pub next: Vec<GroupNeighbour<'g>>,
    /// The same as `whole`, without the bodies of those rotations.
    pub others: CompositeFlow<'g>,
}

impl<'g> Subtree<'g> {
    /// Returns an empty sum.
    pub fn nothing(b: &'g Builder) -> Self {
        Subtree {
            whole: CompositeFlow::zero(b),
            beyond: Vec::new(),
            next: Vec::new(),
            others: CompositeFlow::zero(b),
        }
    }
}

/// A joint's contribution to the derivatives.
pub(super) struct JointPartials<'g> {
    pub joint: OutboardJoint<'g>,
    /// The composite body, relative to the body before it.
    pub before: CompositeFlow<'g>,
    /// The same for the previous rotation of its group.
    pub next: GroupNeighbour<'g>,
}

impl<'g> JointPartials<'g> {
    /// Computes it from the outboard bodies in the body's own axes and in those of its basis.
    pub fn new(context: &JointContext<'_, 'g>, own: &Subtree<'g>, basis: &Subtree<'g>) -> Self {
        let (frame, axis) = (context.frame, context.axis_in_basis());
        let carried = CompositeFlow {
            inertia: frame.inertia.plus(&own.whole.inertia),
            ..own.whole
        };
        let (after, momentum) = context.joined(&carried, &basis.whole);
        let (omega, h) = (axis.spin.omega, after.inertia.first);
        let force = axis.spin.u * h
            + after.inertia.weigh(axis.a)
            + omega.cross(after.flow.linear)
            + after.rest.force;
        let mut joint = if context.view.reuse_neighbour && frame.motion == Motion::Rotation {
            let share = context.share(&carried, &basis.others, force);
            let taken = basis.next.iter();
            let taken = taken.map(|next| OutboardJoint::from_neighbour(context.b, next, &axis));
            taken.fold(share, |sum, part| sum.with(&part))
        } else {
            context.share(&carried, &basis.whole, force)
        };
        joint.momentum = momentum;
        let next = GroupNeighbour {
            joint,
            inertia: after.inertia,
            flow: after.flow.linear + omega.map(|x| x * context.factor).cross(h),
            force,
            offset: frame.position,
        };
        JointPartials {
            joint,
            before: context.before(&after, &momentum),
            next,
        }
    }
}

impl<'g> JointContext<'_, 'g> {
    /// Returns the axis in the body's axes.
    pub fn axis_of_body(&self) -> JointAxis<'g> {
        JointAxis {
            spin: self.moving.own,
            a: self.moving.a_own,
            factor: self.factor,
        }
    }

    /// Returns the axis in the axes of its basis.
    pub fn axis_in_basis(&self) -> JointAxis<'g> {
        JointAxis {
            spin: self.moving.in_basis,
            a: self.moving.a_basis,
            factor: self.factor,
        }
    }

    /// Returns the bodies in own axes and `outer` as one body in the axes of the basis, relative to the
    /// body after the joint, and the momentum that a unit rate gives to it.
    fn joined(
        &self,
        carried: &CompositeFlow<'g>,
        outer: &CompositeFlow<'g>,
    ) -> (CompositeFlow<'g>, Momentum<'g>) {
        let after = carried.turned(self.frame.turn.angle()).plus(outer);
        // A rotation about z does not change J_zz.
        let j_zz = (carried.inertia.d(0, 0) + carried.inertia.d(1, 1))
            + (outer.inertia.d(0, 0) + outer.inertia.d(1, 1));
        let momentum = unit_momentum(self.b, &self.frame.columns[0], &after.inertia, Some(j_zz));
        (after, momentum)
    }

    /// Returns the same relative to the body before it.
    fn before(&self, after: &CompositeFlow<'g>, momentum: &Momentum<'g>) -> CompositeFlow<'g> {
        after.before(self.b, self.frame, momentum, self.factor != Dd::ONE)
    }

    /// Returns the joint's contribution from the bodies in own axes and `outer`.
    fn share(
        &self,
        carried: &CompositeFlow<'g>,
        outer: &CompositeFlow<'g>,
        force: Vec3<Expr<'g>>,
    ) -> OutboardJoint<'g> {
        let (after, momentum) = self.joined(carried, outer);
        let before = self.before(&after, &momentum);
        let (motion, axis) = (self.frame.motion, self.axis_in_basis());
        let seen = |axis: &JointAxis<'g>, spin: &Spin<'g>, whole: &CompositeFlow<'g>| {
            OutboardJoint::new(self.b, motion, momentum, axis, (spin, whole), force)
        };
        let spin = &self.moving.in_basis;
        let sparser = || {
            let after = after.zeros() + spin.zeros();
            self.frame.continues || after > before.zeros() + self.before.zeros()
        };
        match self.view.seen_from {
            SeenFrom::Own if motion == Motion::Rotation => {
                let body = self.axis_of_body();
                let own = seen(&body, &body.spin, carried);
                let turned = own.map(|v| self.frame.turn.apply(v));
                turned.with(&seen(&axis, spin, outer))
            }
            SeenFrom::Before => seen(&axis, self.before, &before),
            SeenFrom::Sparser if !sparser() => seen(&axis, self.before, &before),
            _ => seen(&axis, spin, &after),
        }
    }
}
