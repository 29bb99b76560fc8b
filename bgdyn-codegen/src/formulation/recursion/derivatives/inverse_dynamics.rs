//! Derivatives of the joint efforts by positions and rates, from composite bodies.
//!
//! A change of q_k moves everything outboard of joint k as one rigid body. So ∂τ/∂q_k and ∂τ/∂v_k need no
//! derivative of the motion of a single body. They need the inertia P of the composite body, the flow Q of
//! its mass relative to the body before the joint, and the force and moment R of its relative
//! accelerations. With W = (U, a) the motion of the body before the joint and V its velocity, both as 4 ×
//! 4 matrices, force and moment are those of W P + 2 V Q + R. With Z the field of a unit rate of joint k,
//! - q_k changes them by those of W (Z P + P Zᵀ) + 2 V (Z Q + Q Zᵀ) + Z R + R Zᵀ,
//! - v_k by those of 2 (V Z P + Z Q).
//!
//! Transformed to the base like the momenta of the mass matrix, these two give column k of the derivatives
//! from its diagonal upwards. Below the diagonal are the efforts of joints i outboard of k. They change by
//! the fields Z̈_k s + 2 Ż_k v and 2 (Ż_k s + Z_k v) of accelerations: with the axis's rates ω × z and U z
//! they are dot products with the momentum of a unit rate of joint i, and with 2 ∫ v × δ_i dm of the same
//! rate (see [`super::outboard_joint`]).
//!
//! In a group of parallel axes the fields of two joints differ by a translation, and so do their entries;
//! results of the next joint can be reused ([`super::joint_partials`]).
//!
//! ∂τ/∂v = 2 C with Christoffel symbols C, and C + Cᵀ = Ṁ: two entries whose position in M is constant are
//! the negatives of each other.
//!
//! A rotor whose axis is fixed to a body is a flow of that body's mass without displacement, and a
//! momentum of the joint that drives it, for any position of that joint (see
//! [`crate::formulation::recursion::rotors`]).
//!
//! Carpentier and Mansard (2018), and Singh, Russell and Wensing (2022), also group the derivatives of the
//! Newton-Euler recursion by composite bodies, in spatial vectors.

use bgdyn_runtime::Dd;

use super::joint_partials::{JointContext, JointPartials, Subtree};
use super::outboard_joint::{OutboardJoint, PartialEntries};
use crate::expr::{Builder, Expr};
use crate::formulation::recursion::frames::{BodyFrame, Frames};
use crate::formulation::recursion::motion::{GravityField, Moving, Spin, motions};
use crate::formulation::recursion::plan::PartialsPlan;
use crate::math::Vec3;
use crate::mechanism::Motion;

/// (∂τ/∂q, ∂τ/∂v), row by row: entry (i, j) is the derivative of effort i by coordinate j.
pub(in crate::formulation::recursion) struct EffortDerivatives<'g> {
    pub by_position: Vec<Vec<Expr<'g>>>,
    pub by_rate: Vec<Vec<Expr<'g>>>,
}

/// Returns the Coriolis matrix C of Christoffel symbols, half of ∂bias/∂v because the bias is quadratic in
/// v, row by row.
pub(in crate::formulation::recursion) fn coriolis_matrix<'g>(
    b: &'g Builder,
    frames: &Frames<'g>,
    views: &[PartialsPlan],
) -> Vec<Vec<Expr<'g>>> {
    pass(
        b,
        frames,
        views,
        &motions(b, frames, GravityField::Zero),
        Dd::ONE,
    )
    .by_rate
}

/// Returns the derivatives with the rates and accelerations in `frames`; with gravity if `active`.
pub(in crate::formulation::recursion) fn effort_derivatives<'g>(
    b: &'g Builder,
    frames: &Frames<'g>,
    views: &[PartialsPlan],
    active: bool,
) -> EffortDerivatives<'g> {
    let field = if active {
        GravityField::Gravity
    } else {
        GravityField::Zero
    };
    let moving = motions(b, frames, field);
    pass(b, frames, views, &moving, Dd::from_f64(2.0))
}

/// Runs the pass from the tips to the base; `factor` is that of [`super::axis_changes::JointAxis`].
fn pass<'g>(
    b: &'g Builder,
    frames: &Frames<'g>,
    views: &[PartialsPlan],
    moving: &[Moving<'g>],
    factor: Dd,
) -> EffortDerivatives<'g> {
    let n = frames.bodies.len();
    let mut own = vec![Subtree::nothing(b); n];
    let mut basis = own.clone();
    let mut derivatives = EffortDerivatives {
        by_position: vec![vec![b.zero(); n]; n],
        by_rate: vec![vec![b.zero(); n]; n],
    };
    for j in (0..n).rev() {
        let frame = &frames.bodies[j];
        b.section(|| {
            format!(
                "{}: all it carries as one body; derivatives by `{}` and by the joints beyond",
                frame.name, frame.joint
            )
        });
        let context = JointContext {
            b,
            index: j,
            frame,
            moving: &moving[j],
            before: spin_before(frames, j, moving),
            factor,
            view: views[j],
        };
        let axis = context.axis_of_body();
        for rotor in frames.rotors.on(j) {
            let seen = OutboardJoint::of_rotor(b, rotor, &axis);
            own[j].beyond.push(seen);
        }
        for rotor in frames.rotors.on(j) {
            own[j].whole.add_rotor(b, rotor, factor);
        }
        let mut beyond = derivatives.enter_beyond(&context, frames, &own[j], &basis[j]);
        let partials = JointPartials::new(&context, &own[j], &basis[j]);
        let diagonal = partials.joint.diagonal(frame);
        derivatives.add(frames, (j, j), diagonal.own);
        beyond.push(partials.joint.entered(b, frame.motion, diagonal));

        let Some(p) = frame.parent else { continue };
        let home = if frame.continues {
            &mut basis[p]
        } else {
            &mut own[p]
        };
        let handed = partials.before.handed_on(b, frame);
        home.whole = home.whole.plus(&handed);
        if frame.continues && frame.motion == Motion::Rotation {
            home.next.push(partials.next);
        } else {
            home.others = home.others.plus(&handed);
        }
        let drift = drift(frame, context.before, factor);
        let twist = frame.twist.map(|x| b.constant(x));
        home.beyond.extend(beyond.into_iter().map(|joint| {
            let moved = joint.moved(frame.position, drift);
            if frame.continues {
                moved
            } else {
                moved.settled(b).map(|v| twist * v)
            }
        }));
    }
    derivatives
}

impl<'g> EffortDerivatives<'g> {
    /// Adds the entries of a joint with all outboard joints, and returns these in the axes of its basis.
    fn enter_beyond(
        &mut self,
        context: &JointContext<'_, 'g>,
        frames: &Frames<'g>,
        inner: &Subtree<'g>,
        outer: &Subtree<'g>,
    ) -> Vec<OutboardJoint<'g>> {
        let (b, j, frame) = (context.b, context.index, context.frame);
        let (own, basis) = (context.axis_of_body(), context.axis_in_basis());
        let mut beyond = Vec::new();
        for joint in &inner.beyond {
            let entries = joint.entries(b, frame, &own);
            self.enter(frames, j, joint, entries);
            let turned = joint.turned(frame.turn.angle(), context.view.keep_body_axes);
            beyond.push(turned.entered(b, frame.motion, entries));
        }
        for &joint in &outer.beyond {
            let (joint, entries) = match (frame.motion, joint.entries_from_last(b, &basis)) {
                (Motion::Rotation, Some(entries)) => (joint, entries),
                (Motion::Rotation, None) => {
                    let joint = joint.settled(b);
                    (joint, joint.entries(b, frame, &basis))
                }
                // Forces do not depend on the reference point.
                _ => (joint, joint.entries(b, frame, &basis)),
            };
            self.enter(frames, j, &joint, entries);
            beyond.push(joint.entered(b, frame.motion, entries));
        }
        beyond
    }

    /// Adds the entries of joints j and `joint`: those of a rotor and those of the joint that drives it
    /// are added in sequence.
    fn enter(
        &mut self,
        frames: &Frames<'g>,
        j: usize,
        joint: &OutboardJoint<'g>,
        entries: PartialEntries<'g>,
    ) {
        let k = joint.momentum.joint;
        let PartialEntries { own, mut beyond } = entries;
        if j != k && joint.mass(&frames.bodies[j]).as_constant().is_some() {
            beyond.1 = -own.1;
        }
        self.add(frames, (k, j), beyond);
        self.add(frames, (j, k), own);
    }

    /// Adds to the derivatives of effort i by position and rate of joint j.
    fn add(
        &mut self,
        frames: &Frames<'g>,
        (i, j): (usize, usize),
        (by_position, by_rate): (Expr<'g>, Expr<'g>),
    ) {
        let factor = frames.bodies[i].effort * frames.bodies[j].effort;
        let (position, rate) = (&mut self.by_position[i][j], &mut self.by_rate[i][j]);
        *position = *position + by_position * factor;
        *rate = *rate + by_rate * factor;
    }
}

/// Returns the angular motion of the body before joint j, in the axes of the joint's basis.
fn spin_before<'m, 'g>(frames: &Frames<'g>, j: usize, moving: &'m [Moving<'g>]) -> &'m Spin<'g> {
    match frames.bodies[j].parent {
        Some(p) if frames.bodies[j].continues => &moving[p].in_basis,
        _ => &moving[j].basis,
    }
}

/// Returns the factor times the velocity of a body's origin relative to its parent's, in the axes of the
/// basis.
fn drift<'g>(frame: &BodyFrame<'g>, before: &Spin<'g>, factor: Dd) -> Vec3<Expr<'g>> {
    let mut drift = before.omega.map(|x| x * factor).cross(frame.position);
    if frame.motion != Motion::Rotation {
        drift.0[2] = drift.0[2] + frame.rate * factor;
    }
    drift
}
