//! Sweeps of forward dynamics by articulated bodies: inertia and wrenches inboard, accelerations outboard.
//!
//! Accelerations are relative to those of the motion with q̈ = 0, whose wrenches the recursion has
//! computed: so no velocity enters here, and the joint accelerations are linear in the wrenches.

use bgdyn_runtime::Dd;

use super::inertia::{ArticulatedInertia, InertiaColumn};
use crate::expr::{Bound, Builder, ErrorBound, Expr};
use crate::formulation::recursion::frames::{BodyFrame, Frames};
use crate::formulation::recursion::inertia::{turn, turn_back};
use crate::formulation::recursion::inverse_dynamics::name_wrenches;
use crate::formulation::recursion::inverse_dynamics::{BodyWrench, Load};
use crate::math::{Mat3, Vec3};
use crate::mechanism::Motion;

/// A pivot's rounding error in units of eps/2, times this factor, is the magnitude that
/// [`bgdyn_runtime::Scalar::checked_pivot`] compares with: the least accepted pivot is 64 eps times it, a
/// factor of four for effects that the bound omits.
const MAGNITUDE: f64 = 1.0 / 32.0;

/// Returns the magnitude of the terms subtracted in a pivot, from its rounding error; zero if the error is
/// always a small fraction of the pivot.
fn magnitude<'g>(b: &'g Builder, bounds: &mut ErrorBound, pivot: Expr<'g>) -> Expr<'g> {
    let pivot = pivot.signed();
    match b.with_graph(|g| bounds.of(g, pivot)) {
        Bound::Relative(_) => b.zero(),
        Bound::Absolute(bound) => b.expr(bound) * Dd::from_f64(MAGNITUDE),
    }
}

/// A joint between a body and its parent.
struct Hinge<'g> {
    column: InertiaColumn<'g>,
    /// Whether the column is in the body's own axes; otherwise in those of its basis.
    own: bool,
}

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

    /// Adds the joint's acceleration.
    fn with(mut self, motion: Motion, along: Expr<'g>) -> Self {
        let part = match motion {
            Motion::Rotation => &mut self.angular,
            _ => &mut self.linear,
        };
        part.0[2] = part.0[2] + along;
        self
    }

    /// Returns the power of a wrench at this acceleration.
    fn under(self, wrench: &BodyWrench<'g>) -> Expr<'g> {
        self.angular.dot(wrench.moment) + self.linear.dot(wrench.force)
    }
}

impl<'g, 'f> Sweep<'g, 'f> {
    /// Computes articulated-body inertias from the tips to the base; if `careful`, without avoidable
    /// subtractions. The pivots of the `guarded` joints must exceed their rounding error.
    pub fn new(b: &'g Builder, frames: &'f Frames<'g>, careful: bool, guarded: &[bool]) -> Self {
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
            let armature = frames.rotors.armature(j) * (Dd::ONE / (frame.effort * frame.effort));
            let along = inner.along(frame.motion) + basis[j].along(frame.motion);
            let magnitude = if guarded[j] {
                magnitude(b, &mut bounds, along)
            } else {
                b.zero()
            };
            // A rotor adds to the inertia of the joint, so that the projection is not complete.
            let pivot = (along + armature).pivot(magnitude, j);
            pivot.named(|| format!("pivot_{}", frame.joint));
            let (hinge, rest) = if basis[j].is_zero() {
                // The rotation about the joint's axis and the projection along it commute: the projection
                // first, which leaves a row and a column of zeros.
                let column = inner.column(b, frame.motion, pivot, armature);
                let rest = inner.projected(b, frame.motion, &column);
                // A rigid body's column is constant and rotated once; another's is not rotated.
                let hinge = if own[j].is_zero() {
                    let column = column.map(|v| turn(v, frame.turn));
                    Hinge { column, own: false }
                } else {
                    Hinge { column, own: true }
                };
                (hinge, rest.turned(frame.turn, careful))
            } else {
                let whole = inner.turned(frame.turn, careful).plus(&basis[j]);
                whole.name(&format!("at_{}", frame.joint));
                let column = whole.column(b, frame.motion, pivot, armature);
                let rest = whole.projected(b, frame.motion, &column);
                (Hinge { column, own: false }, rest)
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
        let mut drives = vec![self.b.zero(); n];
        for j in (0..n).rev() {
            let (frame, hinge) = (&self.frames.bodies[j], &self.hinges[j]);
            self.b.section(|| {
                format!(
                    "{}: force and moment that its joint passes on; what is left of `tau_{}`",
                    frame.name, frame.joint
                )
            });
            let (mut inner, mut outer) = (loads[j].own.plus(own[j]), loads[j].basis.plus(basis[j]));
            let along = match frame.motion {
                Motion::Rotation => inner.moment.0[2] + outer.moment.0[2],
                _ => inner.force.0[2] + outer.force.0[2],
            };
            let drive = tau[j] * (self.b.number(1.0) / self.b.constant(frame.effort)) - along;
            drive.named(|| format!("u_{}", frame.joint));
            drives[j] = drive * hinge.column.inverse;
            let Some(p) = frame.parent else { continue };
            // The joint transmits the drive completely; the rest of the wrench in proportion to it.
            let given = |w: Vec3<Expr<'g>>| w.scale(drive);
            let given = hinge.column.share.map(given);
            if hinge.own {
                inner = inner.plus(given);
            } else {
                outer = outer.plus(given);
            }
            let whole = outer.plus(inner.map(|v| turn(v, frame.turn)));
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
        let mut found = Vec::new();
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
            let turned = carried.map(|v| turn_back(v, frame.turn));
            let felt = if hinge.own { turned } else { carried };
            let along = drives[j] - felt.under(&hinge.column.share);
            own.push(turned.with(frame.motion, along));
            basis.push(carried.with(frame.motion, along));
            let acceleration = along * (self.b.number(1.0) / self.b.constant(frame.effort));
            found.push(acceleration.named(|| format!("a_{}", frame.joint)));
        }
        found
    }

    /// Returns the parent's acceleration at the body's origin, in twisted axes.
    fn twisted(&self, frame: &BodyFrame<'g>, parent: Acceleration<'g>) -> Acceleration<'g> {
        let back: Mat3<Expr<'g>> = frame.twist.transpose().map(|x| self.b.constant(x));
        parent.at(frame.position_in_parent).map(|v| back * v)
    }
}
