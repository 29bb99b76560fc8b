//! Sweeps of forward dynamics by articulated bodies: inertia and wrenches inboard, accelerations outboard.
//!
//! Accelerations are relative to those of the motion with q̈ = 0, whose wrenches the recursion has
//! computed: so no velocity enters here, and the joint accelerations are linear in the wrenches.

use super::hinge::{Hinge, HingeColumn, axial_hinge, compound_hinge};
use super::inertia::ArticulatedInertia;
use crate::expr::{Builder, ErrorBound, Expr};
use crate::formulation::recursion::frames::{BodyFrame, Frames};
use crate::formulation::recursion::inverse_dynamics::{BodyWrench, Load, name_wrenches};
use crate::formulation::recursion::joint_columns::ColumnDirection;
use crate::math::{Mat3, Vec3};

/// The joints' columns, from the tips to the base (Featherstone 2008, ch. 7).
pub(super) struct Sweep<'g, 'f> {
    b: &'g Builder,
    frames: &'f Frames<'g>,
    hinges: Vec<Hinge<'g>>,
}

/// Acceleration of a body relative to that of the motion with q̈ = 0.
#[derive(Clone, Copy)]
struct Acceleration<'g> {
    angular: Vec3<Expr<'g>>,
    /// Acceleration of the origin.
    linear: Vec3<Expr<'g>>,
}

impl<'g> Acceleration<'g> {
    fn map(self, f: impl Fn(Vec3<Expr<'g>>) -> Vec3<Expr<'g>>) -> Self {
        Acceleration {
            angular: f(self.angular),
            linear: f(self.linear),
        }
    }

    /// Returns the acceleration of the body's point p.
    fn at(self, p: Vec3<Expr<'g>>) -> Self {
        Acceleration {
            linear: self.linear + self.angular.cross(p),
            ..self
        }
    }

    /// Adds an acceleration of the joint.
    fn with(mut self, direction: ColumnDirection, along: Expr<'g>) -> Self {
        match direction {
            ColumnDirection::About(k) => self.angular.0[k] = self.angular.0[k] + along,
            ColumnDirection::Along(k) => self.linear.0[k] = self.linear.0[k] + along,
            ColumnDirection::Screw(pitch) => {
                self.angular.0[2] = self.angular.0[2] + along;
                self.linear.0[2] = self.linear.0[2] + along * pitch;
            }
        }
        self
    }

    /// Returns the power of a wrench at this acceleration.
    fn under(self, wrench: &BodyWrench<'g>) -> Expr<'g> {
        self.angular.dot(wrench.moment) + self.linear.dot(wrench.force)
    }
}

impl<'g, 'f> Sweep<'g, 'f> {
    /// Computes articulated-body inertias from the tips to the base; if `careful`, without avoidable
    /// subtractions. The pivots of the `guarded` joints must exceed their rounding error. Of a joint with
    /// several velocities the linear or the angular ones are eliminated first.
    pub fn new(
        b: &'g Builder,
        frames: &'f Frames<'g>,
        careful: bool,
        (guarded, linear_first): (&[bool], bool),
    ) -> Self {
        let n = frames.bodies.len();
        let mut bounds = ErrorBound::default();
        // Contributions of the outboard bodies: in own axes, and in those of the basis.
        let mut own = vec![ArticulatedInertia::zero(b); n];
        let mut basis = own.clone();
        let mut hinges = Vec::new();
        for j in (0..n).rev() {
            let frame = &frames.bodies[j];
            b.section(|| {
                format!(
                    "{}: articulated inertia, with the joints beyond free; pivot of `{}`",
                    frame.name, frame.joint
                )
            });
            let inner = ArticulatedInertia::rigid(b, &frame.inertia).plus(&own[j]);
            if basis[j].is_zero() {
                inner.name(&frame.name);
            }
            let (hinge, rest) = if frame.axial {
                let bounds = guarded[j].then_some(&mut bounds);
                let carries = !own[j].is_zero();
                axial_hinge(b, frames, j, (inner, basis[j], carries), (careful, bounds))
            } else {
                let (hinge, rest) = compound_hinge(b, frames, frame, inner, linear_first);
                match frame.parent {
                    Some(_) => (hinge, rest.turned(frame.turn, careful)),
                    None => (hinge, rest),
                }
            };
            hinges.push(hinge);
            let Some(p) = frame.parent else { continue };
            let rest = rest.shifted(b, frame.position);
            if frame.continues {
                basis[p] = basis[p].plus(&rest);
            } else {
                own[p] = own[p].plus(&rest.twisted(b, frame.twist, careful));
            }
        }
        hinges.reverse();
        Sweep { b, frames, hinges }
    }

    /// Returns the joint accelerations under the efforts `tau`, where the motion with q̈ = 0 requires
    /// `loads`.
    pub fn accelerations(&self, loads: &[Load<'g>], tau: &[Expr<'g>]) -> Vec<Expr<'g>> {
        let drives = self.inwards(loads, tau);
        self.outwards(&drives)
    }

    /// Returns, for each joint, the effort that remains for its own acceleration, divided by its pivot.
    fn inwards(&self, loads: &[Load<'g>], tau: &[Expr<'g>]) -> Vec<Expr<'g>> {
        let n = self.hinges.len();
        let mut own = vec![BodyWrench::zero(self.b); n];
        let mut basis = own.clone();
        let mut drives = vec![self.b.zero(); tau.len()];
        for j in (0..n).rev() {
            let (frame, hinge) = (&self.frames.bodies[j], &self.hinges[j]);
            self.b.section(|| {
                format!(
                    "{}: force and moment that its joint passes on; what is left of `tau_{}`",
                    frame.name, frame.joint
                )
            });
            let (mut inner, mut outer) = (loads[j].own.plus(own[j]), loads[j].basis.plus(basis[j]));
            for HingeColumn {
                index,
                direction,
                column,
            } in &hinge.columns
            {
                let of = &frame.columns[*index];
                let along = direction.component(inner.moment, inner.force)
                    + direction.component(outer.moment, outer.force);
                let tau = tau[of.coordinate] * (self.b.number(1.0) / self.b.constant(of.effort));
                let drive = tau - along;
                drive.named(|| format!("u_{}", of.name));
                drives[of.coordinate] = drive * column.inverse;
                // The joint transmits the drive completely; the rest of the wrench in proportion to it.
                let given = column.share.map(|w: Vec3<Expr<'g>>| w.scale(drive));
                if hinge.own {
                    inner = inner.plus(given);
                } else {
                    outer = outer.plus(given);
                }
            }
            let Some(p) = frame.parent else { continue };
            let whole = outer.plus(inner.map(|v| frame.turn.apply(v)));
            name_wrenches(["fa", "na"], frame, &inner, &outer, &whole);
            let carried = whole.carried(frame.position);
            if frame.continues {
                basis[p] = basis[p].plus(carried);
            } else {
                let twist = frame.twist.map(|x| self.b.constant(x));
                own[p] = own[p].plus(carried.map(|v| twist * v));
            }
        }
        drives
    }

    fn outwards(&self, drives: &[Expr<'g>]) -> Vec<Expr<'g>> {
        // Accelerations in own axes, and in those of the basis.
        let mut own: Vec<Acceleration<'g>> = Vec::new();
        let mut basis: Vec<Acceleration<'g>> = Vec::new();
        let mut found = vec![self.b.zero(); drives.len()];
        for (j, hinge) in self.hinges.iter().enumerate() {
            let frame = &self.frames.bodies[j];
            self.b
                .section(|| format!("{}: acceleration of `{}`", frame.name, frame.joint));
            let carried = match frame.parent {
                None => {
                    let still = Vec3([self.b.zero(); 3]);
                    Acceleration {
                        angular: still,
                        linear: still,
                    }
                }
                Some(p) if frame.continues => basis[p].at(frame.position),
                Some(p) => self.twisted(frame, own[p]),
            };
            let mut turned = carried.map(|v| frame.turn.apply_back(v));
            let mut at_basis = carried;
            // The velocity eliminated last depends on the parent's acceleration only.
            for HingeColumn {
                index,
                direction,
                column,
            } in hinge.columns.iter().rev()
            {
                let of = &frame.columns[*index];
                let felt = if hinge.own { turned } else { at_basis };
                let along = drives[of.coordinate] - felt.under(&column.share);
                turned = turned.with(*direction, along);
                at_basis = at_basis.with(*direction, along);
                let acceleration = along * (self.b.number(1.0) / self.b.constant(of.effort));
                found[of.coordinate] = acceleration.named(|| format!("a_{}", of.name));
            }
            own.push(turned);
            basis.push(at_basis);
        }
        found
    }

    /// Returns the parent's acceleration at the body's origin, in twisted axes.
    fn twisted(&self, frame: &BodyFrame<'g>, parent: Acceleration<'g>) -> Acceleration<'g> {
        let back: Mat3<Expr<'g>> = frame.twist.transpose().map(|x| self.b.constant(x));
        parent.at(frame.position_in_parent).map(|v| back * v)
    }
}
