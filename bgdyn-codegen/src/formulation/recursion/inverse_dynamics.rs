//! Inverse dynamics in link axes: accelerations outboard, forces and moments inboard.
//!
//! With a body's motion ω, a, U of [`super::motion`], its force is F = m a + U h and its moment
//! about the origin N = h × a + the skew part of U·D, which is K̇ = J ω̇ + ω × J ω of equation (6),
//! term for term.

use super::frames::{BodyFrame, Frames};
use super::inertia::{BodyInertia, Point};
use super::joint_columns::JointColumn;
use super::motion::{Moving, Spin, zero};
use super::names::name_vector;
use super::plan::Plan;
use crate::expr::{Builder, Expr};
use crate::math::Vec3;

/// Force and moment about the body's origin.
#[derive(Clone, Copy)]
pub(super) struct BodyWrench<'g> {
    /// N in units of the plan.
    pub force: Vec3<Expr<'g>>,
    /// N·m
    pub moment: Vec3<Expr<'g>>,
}

impl<'g> BodyWrench<'g> {
    /// Returns zero force and moment.
    pub fn zero(b: &'g Builder) -> Self {
        BodyWrench {
            force: zero(b),
            moment: zero(b),
        }
    }

    /// Returns the sum.
    pub fn plus(self, b: Self) -> Self {
        BodyWrench {
            force: self.force + b.force,
            moment: self.moment + b.moment,
        }
    }

    /// Applies `f`, a change of axes.
    pub fn map(self, f: impl Fn(Vec3<Expr<'g>>) -> Vec3<Expr<'g>>) -> Self {
        BodyWrench {
            force: f(self.force),
            moment: f(self.moment),
        }
    }

    /// Returns the wrench about a point from which the present origin is displaced by p.
    pub fn carried(self, p: Vec3<Expr<'g>>) -> Self {
        BodyWrench {
            force: self.force,
            moment: self.moment + p.cross(self.force),
        }
    }

    /// Returns the component in the direction of a column.
    pub fn along(&self, column: &JointColumn) -> Expr<'g> {
        column.direction.component(self.moment, self.force)
    }
}

/// The wrench that a body's motion requires, by equation (6), in its own axes or in those of its basis.
#[derive(Clone, Copy)]
pub(super) struct Load<'g> {
    /// In own axes.
    pub own: BodyWrench<'g>,
    /// In the axes of the basis.
    pub basis: BodyWrench<'g>,
}

/// Returns joint efforts for the motions of the bodies.
pub(super) fn efforts<'g>(
    b: &'g Builder,
    frames: &Frames<'g>,
    plan: &Plan,
    moving: &[Moving<'g>],
) -> Vec<Expr<'g>> {
    let loads = loads(b, frames, plan, moving);
    let mut efforts = inwards(b, frames, &loads);
    let omega_dot: Vec<_> = moving.iter().map(|motion| motion.own.omega_dot).collect();
    frames.rotors.add_efforts(&omega_dot, &mut efforts);
    efforts
}

/// Returns the forces and moments that move each body.
pub(super) fn loads<'g>(
    b: &'g Builder,
    frames: &Frames<'g>,
    plan: &Plan,
    moving: &[Moving<'g>],
) -> Vec<Load<'g>> {
    let bodies = frames.bodies.iter().zip(moving).zip(&plan.in_basis);
    bodies
        .enumerate()
        .map(|(j, ((frame, motion), &in_basis))| {
            let mut load = load(b, frame, motion, in_basis, plan.short_moment);
            if let Some(moment) = frames.rotors.moment(j, motion.own.omega) {
                load.own.moment = load.own.moment + moment;
            }
            load
        })
        .collect()
}

fn load<'g>(
    b: &'g Builder,
    frame: &BodyFrame<'g>,
    motion: &Moving<'g>,
    in_basis: bool,
    short: bool,
) -> Load<'g> {
    b.section(|| format!("{}: F = m a + U h, N = h × a + skew(U D)", frame.name));
    // A rotation about z does not change J_zz.
    let rest = &frame.rest;
    let j_zz = rest.d(0, 0) + rest.d(1, 1);
    let points = frame.points.iter();
    if in_basis {
        let inertia = rest.turned(frame.turn);
        let (spin, a) = (&motion.in_basis, motion.a_basis);
        let load = dynamics(&inertia, j_zz, spin, a, short);
        let turned = points.map(|p| dynamics_of_point(&p.turned(frame.turn), spin, a));
        Load {
            own: BodyWrench::zero(b),
            basis: turned.fold(load, |sum, p| p.plus(sum)),
        }
    } else {
        let (spin, a) = (&motion.own, motion.a_own);
        let load = dynamics(rest, j_zz, spin, a, short);
        let own = points.map(|p| dynamics_of_point(p, spin, a));
        Load {
            own: own.fold(load, |sum, p| p.plus(sum)),
            basis: BodyWrench::zero(b),
        }
    }
}

/// Returns F = m a + U h and N = skew(U D) + h × a of a body.
pub(super) fn dynamics<'g>(
    inertia: &BodyInertia<'g>,
    j_zz: Expr<'g>,
    spin: &Spin<'g>,
    a: Vec3<Expr<'g>>,
    short: bool,
) -> BodyWrench<'g> {
    let (u, h) = (&spin.u.0, inertia.first);
    let d = |i, j| inertia.d(i, j);
    let [dzy, dxz, dyx] = spin.differences.0;
    // Returns k₁ x − k₂ y, merged if k₁ = ±k₂.
    let pair = |k1: Expr<'g>, x: Expr<'g>, k2: Expr<'g>, y: Expr<'g>| {
        if k1 == k2 {
            k1 * (x - y)
        } else if k1 == -k2 {
            k1 * (x + y)
        } else {
            k1 * x - k2 * y
        }
    };
    let nx = pair(d(1, 1), u[2][1], d(2, 2), u[1][2])
        + d(1, 2) * dzy
        + (d(0, 1) * u[2][0] - d(0, 2) * u[1][0]);
    let ny = pair(d(2, 2), u[0][2], d(0, 0), u[2][0])
        + d(0, 2) * dxz
        + (d(1, 2) * u[0][1] - d(0, 1) * u[2][1]);
    let products = d(0, 1) * dyx + (d(0, 2) * u[1][2] - d(1, 2) * u[0][2]);
    let nz = if short {
        let [x, y, _] = spin.omega.0;
        j_zz * spin.omega_dot.0[2] + ((d(0, 0) - d(1, 1)) * (x * y) + products)
    } else {
        pair(d(0, 0), u[1][0], d(1, 1), u[0][1]) + products
    };
    BodyWrench {
        force: spin.u * h + inertia.weigh(a),
        moment: Vec3([nx, ny, nz]) + h.cross(a),
    }
}

/// Returns F = m (a + U s) and N = s × F of a point mass.
fn dynamics_of_point<'g>(point: &Point<'g>, spin: &Spin<'g>, a: Vec3<Expr<'g>>) -> BodyWrench<'g> {
    let force = (a + spin.u * point.position).scale(point.mass);
    BodyWrench {
        force,
        moment: point.position.cross(force),
    }
}

/// Sums forces and moments from the tips to the base, and returns the component along each joint.
fn inwards<'g>(b: &'g Builder, frames: &Frames<'g>, loads: &[Load<'g>]) -> Vec<Expr<'g>> {
    let mut efforts = vec![b.zero(); frames.rotors.coordinates()];
    let effort = effort_name(frames);
    let title = |frame: &BodyFrame<'g>| {
        format!(
            "{}: forces and moments summed from the tips; effort of `{}`",
            frame.name, frame.joint
        )
    };
    sum_loads(
        b,
        frames,
        loads,
        title,
        |_, frame, [inner, outer, whole]| {
            // The columns are constant in the axes of the basis for a joint with an axis, and in own axes.
            let at_joint = if frame.axial { whole } else { inner };
            for column in &frame.columns {
                let own = at_joint.along(column) * column.effort;
                let j = column.coordinate;
                efforts[j] = (efforts[j] + own).named(|| format!("{effort}_{}", column.name));
            }
            name_wrenches(["f", "n"], frame, inner, outer, whole);
        },
    );
    efforts
}

/// Sums loads from the tips to the base, and gives `at` the sums over each body and all it carries, about its origin: the
/// part in own axes, the part in those of the basis, and the whole in the latter.
pub(super) fn sum_loads<'g>(
    b: &'g Builder,
    frames: &Frames<'g>,
    loads: &[Load<'g>],
    title: impl Fn(&BodyFrame<'g>) -> String,
    mut at: impl FnMut(usize, &BodyFrame<'g>, [&BodyWrench<'g>; 3]),
) {
    let n = frames.bodies.len();
    // Contributions of the outboard bodies: in own axes, and in those of the basis.
    let mut own = vec![BodyWrench::zero(b); n];
    let mut basis = own.clone();
    for j in (0..n).rev() {
        let frame = &frames.bodies[j];
        b.section(|| title(frame));
        let (inner, outer) = (loads[j].own.plus(own[j]), loads[j].basis.plus(basis[j]));
        let whole = outer.plus(inner.map(|v| frame.turn.apply(v)));
        at(j, frame, [&inner, &outer, &whole]);
        let Some(p) = frame.parent else { continue };
        let carried = whole.carried(frame.position);
        if frame.continues {
            basis[p] = basis[p].plus(carried);
        } else {
            let twist = frame.twist.map(|x| b.constant(x));
            own[p] = own[p].plus(carried.map(|v| twist * v));
        }
    }
}

/// Returns the name of the efforts of this motion: `gravity` at rest, `bias` without accelerations.
fn effort_name(frames: &Frames<'_>) -> &'static str {
    let zero = |accelerated| frames.bodies.iter().all(|f| f.at_rest(accelerated));
    match (zero(true), zero(false)) {
        (true, true) => "gravity",
        (true, false) => "bias",
        (false, _) => "tau",
    }
}

/// Names force and moment on a composite body: outboard of its joint in the body's axes, `inner`, if that
/// is the total; and at the joint, in the axes before its rotation.
pub(super) fn name_wrenches(
    [force, moment]: [&str; 2],
    frame: &BodyFrame<'_>,
    inner: &BodyWrench<'_>,
    outer: &BodyWrench<'_>,
    whole: &BodyWrench<'_>,
) {
    let zero = |v: &Vec3<Expr<'_>>| v.0.iter().all(|x| x.is_zero());
    if zero(&outer.force) && zero(&outer.moment) {
        name_vector(&inner.force, force, &frame.name);
        name_vector(&inner.moment, moment, &frame.name);
    }
    let at = format!("at_{}", frame.joint);
    name_vector(&whole.force, force, &at);
    name_vector(&whole.moment, moment, &at);
}
