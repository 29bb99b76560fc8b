//! The motion of the bodies with two velocities: the symmetric bilinear form of the velocity products.
//!
//! M a_r + C(q, v) v_r + g with Christoffel's C is (6) with (x y' + x' y) / 2 in place of each product x y of two
//! velocities (Slotine and Li 1987).

use bgdyn_runtime::Dd;

use super::super::frames::{BodyFrame, Frames};
use super::super::motion::zero;
use super::directions::{BodyTwist, of_joint};
use super::wrenches::Angular;
use crate::expr::{Builder, Expr};
use crate::math::{Mat3, Vec3};
use crate::mechanism::Motion;

/// Motion of a body with two velocities, in its axes.
pub(super) struct Bilinear<'g> {
    /// U and ω̇.
    pub angular: Angular<'g>,
    /// Acceleration of its origin less gravity.
    pub a: Vec3<Expr<'g>>,
}

/// Returns the motion of every body. `own` are the frames with v and a_r, `twists` the velocities of the bodies at v and
/// at v_r, `rates` those of the joints.
pub(super) fn motions<'g>(
    b: &'g Builder,
    frames: &Frames<'g>,
    [first, second]: [&[BodyTwist<'g>]; 2],
    rates: [&[Expr<'g>]; 2],
    accelerations: &[Expr<'g>],
) -> Vec<Bilinear<'g>> {
    let mut moving: Vec<Bilinear<'g>> = Vec::new();
    for (j, frame) in frames.bodies.iter().enumerate() {
        b.section(|| {
            format!(
                "{}: U and acceleration a of its origin less gravity, with two velocities",
                frame.name
            )
        });
        let at_rest = || (zero(b), Mat3([[b.zero(); 3]; 3]));
        let ((omega_dot, u), a, omegas) = match frame.parent {
            None if frame.given => (at_rest(), zero(b), [zero(b); 2]),
            None => {
                let twist = frame.twist.map(|x| b.constant(x));
                (at_rest(), twist * -frames.gravity[j], [zero(b); 2])
            }
            Some(p) => {
                let parent = &moving[p];
                let omegas = [first[p].angular, second[p].angular];
                (
                    (parent.angular.omega_dot, parent.angular.u),
                    parent.a,
                    omegas,
                )
            }
        };
        let before = Before {
            omega_dot,
            u,
            a,
            omegas,
        };
        let after = [first[j].angular, second[j].angular];
        let joint = JointMotion {
            velocities: rates.map(|rates| joint_velocity(b, frame, rates)),
            change: joint_change(b, frame, accelerations),
        };
        moving.push(outwards(b, frame, &before, after, &joint));
    }
    moving
}

/// Motion of a body relative to its parent, in its axes: two velocities, and the acceleration.
struct JointMotion<'g> {
    velocities: [BodyTwist<'g>; 2],
    change: BodyTwist<'g>,
}

/// Motion of a parent, in its axes.
struct Before<'g> {
    omega_dot: Vec3<Expr<'g>>,
    u: Mat3<Expr<'g>>,
    a: Vec3<Expr<'g>>,
    omegas: [Vec3<Expr<'g>>; 2],
}

/// Returns the motion of a body from that of its parent, its own two angular velocities, and the rates.
///
/// With ω = c + ω_J, the velocity c of the parent and ω_J, v_J of the joint:
/// ω̇ = Rᵀω̇_p + c × ω_J + ω̇_J, a = Rᵀ(a_p + U_p p) + (2 c + ω_J) × v_J + v̇_J.
fn outwards<'g>(
    b: &'g Builder,
    frame: &BodyFrame<'g>,
    before: &Before<'g>,
    omegas: [Vec3<Expr<'g>>; 2],
    joint: &JointMotion<'g>,
) -> Bilinear<'g> {
    let back = frame.twist.transpose().map(|x| b.constant(x));
    let turned = |v: Vec3<Expr<'g>>| frame.turn.apply_back(back * v);
    let JointMotion { velocities, change } = joint;
    let carried = before.omegas.map(turned);
    // The joint's axis in the parent's axes.
    let u_along_axis = before.u * frame.twist.map(|x| b.constant(x)).column(2);
    let coupled = half_sum(
        carried[0].cross(velocities[1].angular),
        carried[1].cross(velocities[0].angular),
    );
    let omega_dot = turned(before.omega_dot) + coupled + change.angular;
    let across = |k: usize| (carried[k] + omegas[k]).cross(velocities[1 - k].linear);
    let a = turned(before.a + before.u * frame.position_in_parent)
        + half_sum(across(0), across(1))
        + change.linear;
    let angular = match frame.axial && frame.motion != Motion::Translation {
        true => angular_about_z(omegas, turned(u_along_axis), omega_dot.0[2]),
        false => angular(omegas, omega_dot),
    };
    Bilinear { angular, a }
}

/// Returns U with its parts by the common-axis method: the points of the joint's axis have the same acceleration in both
/// bodies, so the column `u` of U along it is that of the parent, also with two velocities.
fn angular_about_z<'g>(
    omegas: [Vec3<Expr<'g>>; 2],
    u: Vec3<Expr<'g>>,
    dz: Expr<'g>,
) -> Angular<'g> {
    let Products {
        xx, zz, xy, xz, yz, ..
    } = products(omegas);
    let [ux, uy, uz] = u.0;
    let (dx, dy) = (yz - uy, ux - xz);
    let across = xx - zz;
    let (u_xx, u_yy) = (uz + across, -(xx + zz));
    Angular {
        u: Mat3([
            [u_xx, xy - dz, ux],
            [xy + dz, u_yy, uy],
            [xz - dy, yz + dx, uz],
        ]),
        differences: Vec3([uz - u_yy, across, u_yy - u_xx]),
        omega_dot: Vec3([dx, dy, dz]),
        products: Vec3([yz, xz, xy]),
    }
}

/// The symmetric products of the components of two velocities.
struct Products<'g> {
    xx: Expr<'g>,
    yy: Expr<'g>,
    zz: Expr<'g>,
    xy: Expr<'g>,
    xz: Expr<'g>,
    yz: Expr<'g>,
}

fn products<'g>([w, r]: [Vec3<Expr<'g>>; 2]) -> Products<'g> {
    let half = Dd::from_f64(0.5);
    let product = |i: usize, k: usize| match i == k {
        true => w.0[i] * r.0[i],
        false => (w.0[i] * r.0[k] + r.0[i] * w.0[k]) * half,
    };
    Products {
        xx: product(0, 0),
        yy: product(1, 1),
        zz: product(2, 2),
        xy: product(0, 1),
        xz: product(0, 2),
        yz: product(1, 2),
    }
}

/// Returns U = [ω̇]× + sym([ω]×[ω']×) with its parts.
fn angular<'g>(omegas: [Vec3<Expr<'g>>; 2], omega_dot: Vec3<Expr<'g>>) -> Angular<'g> {
    let [dx, dy, dz] = omega_dot.0;
    let Products {
        xx,
        yy,
        zz,
        xy,
        xz,
        yz,
    } = products(omegas);
    Angular {
        u: Mat3([
            [-(yy + zz), xy - dz, xz + dy],
            [xy + dz, -(xx + zz), yz - dx],
            [xz - dy, yz + dx, -(xx + yy)],
        ]),
        differences: Vec3([zz - yy, xx - zz, yy - xx]),
        omega_dot,
        products: Vec3([yz, xz, xy]),
    }
}

fn half_sum<'g>(x: Vec3<Expr<'g>>, y: Vec3<Expr<'g>>) -> Vec3<Expr<'g>> {
    (x + y).map(|e| e * Dd::from_f64(0.5))
}

/// Returns the velocity of a body relative to its parent, in its axes.
fn joint_velocity<'g>(b: &'g Builder, frame: &BodyFrame<'g>, rates: &[Expr<'g>]) -> BodyTwist<'g> {
    match (frame.given, &frame.relative) {
        (true, Some([velocity, _])) => velocity.into(),
        _ => of_joint(b, frame, rates),
    }
}

/// Returns the acceleration of a body relative to its parent that its joint's accelerations give, in its axes.
fn joint_change<'g>(
    b: &'g Builder,
    frame: &BodyFrame<'g>,
    accelerations: &[Expr<'g>],
) -> BodyTwist<'g> {
    match &frame.relative {
        Some([_, change]) => change.into(),
        None => of_joint(b, frame, accelerations),
    }
}
