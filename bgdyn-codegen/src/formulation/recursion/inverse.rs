//! Inverse dynamics in link axes: accelerations outwards, forces and moments inwards.
//!
//! A body's motion is ω, the acceleration `a` of its origin less gravity, and
//! U = [ω̇]× + [ω]×[ω]×: the point s of the body accelerates by a + U s. So its force is
//! F = m a + U h and its moment about the origin N = h × a + the skew part of U·D, which is
//! K̇ = J ω̇ + ω × J ω of equation (6), term for term.

use bgdyn_runtime::Dd;

use super::frames::{Frame, Frames, Plan};
use super::inertia::{Inertia, Point, turn, turn_back};
use crate::expr::{Builder, Ex};
use crate::math::{Mat3, Vec3};
use crate::mechanism::Motion;

/// Angular motion in one set of axes.
#[derive(Clone, Copy)]
pub(super) struct Spin<'g> {
    /// ω
    pub omega: Vec3<Ex<'g>>,
    omega_dot: Vec3<Ex<'g>>,
    /// U
    pub u: Mat3<Ex<'g>>,
    /// U_zz − U_yy, U_xx − U_zz, U_yy − U_xx
    differences: Vec3<Ex<'g>>,
}

/// Motion of a body.
pub(super) struct Moving<'g> {
    /// Of the twisted axes in which the basis began, before any angle of the group.
    pub basis: Spin<'g>,
    /// Ω, Ω̇: summed rates of the group's joints.
    rate: (Ex<'g>, Ex<'g>),
    /// Angular motion of the body, in the basis's axes.
    pub in_basis: Spin<'g>,
    /// Acceleration of the origin in the basis's axes.
    pub a_basis: Vec3<Ex<'g>>,
    /// Angular motion of the body in its own axes.
    pub own: Spin<'g>,
    /// Acceleration of the origin in own axes.
    pub a_own: Vec3<Ex<'g>>,
}

/// Force and moment about the body's origin.
#[derive(Clone, Copy)]
pub(super) struct Wrench<'g> {
    /// N in units of the plan.
    pub force: Vec3<Ex<'g>>,
    /// N·m
    pub moment: Vec3<Ex<'g>>,
}

impl<'g> Wrench<'g> {
    /// No force, no moment.
    pub fn zero(b: &'g Builder) -> Self {
        Wrench {
            force: zero(b),
            moment: zero(b),
        }
    }

    /// Of both.
    pub fn plus(self, b: Self) -> Self {
        Wrench {
            force: self.force + b.force,
            moment: self.moment + b.moment,
        }
    }

    /// In other axes.
    pub fn map(self, f: impl Fn(Vec3<Ex<'g>>) -> Vec3<Ex<'g>>) -> Self {
        Wrench {
            force: f(self.force),
            moment: f(self.moment),
        }
    }

    /// About a point from which this one's origin is displaced by p.
    pub fn carried(self, p: Vec3<Ex<'g>>) -> Self {
        Wrench {
            force: self.force,
            moment: self.moment + p.cross(self.force),
        }
    }

    /// Its share in the direction of a joint.
    pub fn along(&self, frame: &Frame<'g>) -> Ex<'g> {
        match frame.motion {
            Motion::Rotation => self.moment.0[2],
            _ => self.force.0[2],
        }
    }
}

/// What a body's motion takes, by equation (6): computed in its own axes or in its basis's.
#[derive(Clone, Copy)]
pub(super) struct Load<'g> {
    /// In own axes.
    pub own: Wrench<'g>,
    /// In the basis's axes.
    pub basis: Wrench<'g>,
}

/// Joint efforts for the rates and accelerations in `frames`.
pub(super) fn efforts<'g>(
    b: &'g Builder,
    frames: &Frames<'g>,
    plan: &Plan,
    active: bool,
) -> Vec<Ex<'g>> {
    inwards(b, frames, &loads(b, frames, plan, active))
}

/// Forces and moments that move each body with the rates and accelerations in `frames`.
pub(super) fn loads<'g>(
    b: &'g Builder,
    frames: &Frames<'g>,
    plan: &Plan,
    active: bool,
) -> Vec<Load<'g>> {
    let moving = motions(b, frames, active);
    let bodies = frames.bodies.iter().zip(&moving).zip(&plan.in_basis);
    bodies
        .map(|((frame, motion), &in_basis)| load(b, frame, motion, in_basis, plan.short_moment))
        .collect()
}

/// Motion of every body with the rates and accelerations in `frames`; where `active`, against
/// gravity.
pub(super) fn motions<'g>(b: &'g Builder, frames: &Frames<'g>, active: bool) -> Vec<Moving<'g>> {
    let mut moving: Vec<Moving<'g>> = Vec::new();
    for (j, frame) in frames.bodies.iter().enumerate() {
        let parent = frame.parent.map(|p| &moving[p]);
        let gravity = if active { frames.gravity[j] } else { zero(b) };
        b.section(format!(
            "{}: ω, U = [ω̇]× + [ω]×[ω]×, acceleration a of its origin less gravity",
            frame.name
        ));
        let step = outwards(b, frame, parent, gravity);
        name(frame, &step);
        moving.push(step);
    }
    moving
}

fn load<'g>(
    b: &'g Builder,
    frame: &Frame<'g>,
    motion: &Moving<'g>,
    in_basis: bool,
    short: bool,
) -> Load<'g> {
    b.section(format!(
        "{}: F = m a + U h, N = h × a + skew(U D)",
        frame.name
    ));
    // Turning about z leaves J_zz as it is.
    let rest = &frame.rest;
    let j_zz = rest.d(0, 0) + rest.d(1, 1);
    let points = frame.points.iter();
    if in_basis {
        let inertia = if rest.round() {
            *rest
        } else {
            rest.turned(frame.turn)
        };
        let (spin, a) = (&motion.in_basis, motion.a_basis);
        let load = dynamics(&inertia, j_zz, spin, a, short);
        let turned = points.map(|p| dynamics_of_point(&p.turned(frame.turn), spin, a));
        Load {
            own: Wrench::zero(b),
            basis: turned.fold(load, |sum, p| p.plus(sum)),
        }
    } else {
        let (spin, a) = (&motion.own, motion.a_own);
        let load = dynamics(rest, j_zz, spin, a, short);
        let own = points.map(|p| dynamics_of_point(p, spin, a));
        Load {
            own: own.fold(load, |sum, p| p.plus(sum)),
            basis: Wrench::zero(b),
        }
    }
}

fn zero(b: &Builder) -> Vec3<Ex<'_>> {
    Vec3([b.zero(); 3])
}

fn name(frame: &Frame<'_>, step: &Moving<'_>) {
    for (k, axis) in ["x", "y", "z"].into_iter().enumerate() {
        step.own.omega.0[k].named(|| format!("omega_{axis}_{}", frame.name));
        step.a_own.0[k].named(|| format!("a_{axis}_{}", frame.name));
    }
}

/// Motion of a body from its parent's.
fn outwards<'g>(
    b: &'g Builder,
    frame: &Frame<'g>,
    parent: Option<&Moving<'g>>,
    gravity: Vec3<Ex<'g>>,
) -> Moving<'g> {
    let (basis, mut rate, mut a_basis) = match parent {
        // The base stands still; gravity acts as an acceleration of the base upwards.
        None => (still(b), (b.zero(), b.zero()), -gravity),
        Some(p) if frame.continues => (p.basis, p.rate, p.a_basis + p.in_basis.u * frame.position),
        Some(p) => {
            let basis = twisted(b, &p.own, frame.twist);
            (
                basis,
                (b.zero(), b.zero()),
                twisted_acceleration(b, p, frame, &basis),
            )
        }
    };
    match frame.motion {
        Motion::Rotation => rate = (rate.0 + frame.rate, rate.1 + frame.acceleration),
        // 2 ω × ẑ ṡ + ẑ s̈
        _ => {
            let twice = frame.rate * Dd::from_f64(2.0);
            let [x, y, _] = basis.omega.0;
            a_basis = a_basis + Vec3([y * twice, -(x * twice), frame.acceleration]);
        }
    }
    let in_basis = spun(&basis, rate);
    let own = own_spin(&basis, rate, frame.turn);
    let a_own = turn_back(a_basis, frame.turn);
    Moving {
        basis,
        rate,
        in_basis,
        a_basis,
        own,
        a_own,
    }
}

fn still(b: &Builder) -> Spin<'_> {
    Spin {
        omega: zero(b),
        omega_dot: zero(b),
        u: Mat3([[b.zero(); 3]; 3]),
        differences: zero(b),
    }
}

/// The parent's angular motion in twisted axes.
fn twisted<'g>(b: &'g Builder, parent: &Spin<'g>, twist: Mat3<Dd>) -> Spin<'g> {
    let back = twist.transpose().map(|x| b.constant(x));
    let (omega, omega_dot) = (back * parent.omega, back * parent.omega_dot);
    let Some(places) = permutation(twist) else {
        // In general directions U is cheaper made anew than turned.
        let u = u_of(omega, omega_dot);
        return Spin {
            omega,
            omega_dot,
            u,
            differences: differences(&u),
        };
    };
    let u = back * parent.u * back.transpose();
    // Each difference is one of the parent's, with the sign of the permutation of its two axes.
    let difference = |k: usize| {
        let (upper, lower) = (places[(k + 2) % 3], places[(k + 1) % 3]);
        let kept = (lower + 1) % 3 == upper;
        let d = parent.differences.0[places[k]];
        if kept { d } else { -d }
    };
    Spin {
        omega,
        omega_dot,
        u,
        differences: Vec3(std::array::from_fn(difference)),
    }
}

/// For a rotation by quarter turns: which of the parent's axes each new one lies along.
fn permutation(twist: Mat3<Dd>) -> Option<[usize; 3]> {
    // A turn of 1e-17 from a quarter has ones, but no zeros.
    let only = |k: usize, i: usize| (0..3).all(|l| l == i || twist.0[l][k] == Dd::ZERO);
    let place = |k: usize| (0..3).find(|&i| only(k, i));
    Some([place(0)?, place(1)?, place(2)?])
}

/// Acceleration of the new origin in twisted axes: the product U p where it costs less.
fn twisted_acceleration<'g>(
    b: &'g Builder,
    parent: &Moving<'g>,
    frame: &Frame<'g>,
    basis: &Spin<'g>,
) -> Vec3<Ex<'g>> {
    let back = frame.twist.transpose().map(|x| b.constant(x));
    if permutation(frame.twist).is_some() {
        back * parent.a_own + basis.u * frame.position
    } else {
        back * (parent.a_own + parent.own.u * frame.position_in_parent)
    }
}

/// U = [ω̇]× + [ω]×[ω]×
fn u_of<'g>(omega: Vec3<Ex<'g>>, omega_dot: Vec3<Ex<'g>>) -> Mat3<Ex<'g>> {
    let ([x, y, z], [dx, dy, dz]) = (omega.0, omega_dot.0);
    let (xx, yy, zz, xy, xz, yz) = (x * x, y * y, z * z, x * y, x * z, y * z);
    Mat3([
        [-(yy + zz), xy - dz, xz + dy],
        [xy + dz, -(xx + zz), yz - dx],
        [xz - dy, yz + dx, -(xx + yy)],
    ])
}

fn differences<'g>(u: &Mat3<Ex<'g>>) -> Vec3<Ex<'g>> {
    let [xx, yy, zz] = [u.0[0][0], u.0[1][1], u.0[2][2]];
    Vec3([zz - yy, xx - zz, yy - xx])
}

/// Angular motion after the group's rates Ω, Ω̇ about z, in axes that do not turn with them:
/// with σ = Ω (2 ω⁰_z + Ω), U = U⁰ + [[−σ, −Ω̇, 0], [Ω̇, −σ, 0], [2Ω ω⁰_x, 2Ω ω⁰_y, 0]].
fn spun<'g>(basis: &Spin<'g>, (rate, acceleration): (Ex<'g>, Ex<'g>)) -> Spin<'g> {
    let ([x, y, z], [dx, dy, dz]) = (basis.omega.0, basis.omega_dot.0);
    let (total, total_dot) = (z + rate, dz + acceleration);
    let sigma = rate * (total + z);
    let twice = rate * Dd::from_f64(2.0);
    let [[xx, xy, xz], [yx, yy, yz], [zx, zy, zz]] = basis.u.0;
    let [dzy, dxz, dyx] = basis.differences.0;
    // A body that turns about z only has U_xx = U_yy = −ω_z².
    let (xx, yy, dzy, dxz) = if x.is_zero() && y.is_zero() {
        let square = total * total;
        (-square, -square, zz + square, -square - zz)
    } else {
        (xx - sigma, yy - sigma, dzy + sigma, dxz - sigma)
    };
    let u = Mat3([
        [xx, xy - acceleration, xz],
        [yx + acceleration, yy, yz],
        [zx + twice * x, zy + twice * y, zz],
    ]);
    // ω̇_x and ω̇_y in axes that stay behind: ω̇⁰ + Ω (ω⁰_y, −ω⁰_x)
    let omega_dot = Vec3([dx + rate * y, dy - rate * x, total_dot]);
    Spin {
        omega: Vec3([x, y, total]),
        omega_dot,
        u,
        differences: Vec3([dzy, dxz, dyx]),
    }
}

/// Angular motion in own axes by the common-axis trick: the points of the joint's axis have the
/// same acceleration in both bodies, so the column of U along it is shared, and rotated where the
/// usual recursion rotates ω̇ and forms U anew.
fn own_spin<'g>(
    basis: &Spin<'g>,
    (rate, acceleration): (Ex<'g>, Ex<'g>),
    angle: (Ex<'g>, Ex<'g>),
) -> Spin<'g> {
    let straight = angle.0.as_constant() == Some(Dd::ONE);
    if rate.is_zero() && acceleration.is_zero() && straight {
        return *basis;
    }
    let [x, y, _] = turn_back(basis.omega, angle).0;
    let z = basis.omega.0[2] + rate;
    let [ux, uy, uz] = turn_back(basis.u.column(2), angle).0;
    let (xy, xz, yz) = (x * y, x * z, y * z);
    // ω̇_x = ω_y ω_z − u_y, ω̇_y = u_x − ω_x ω_z
    let (dx, dy, dz) = (yz - uy, ux - xz, basis.omega_dot.0[2] + acceleration);
    let (xx, zz) = (x * x, z * z);
    let across = xx - zz;
    let (u_yy, u_xx) = (-(xx + zz), uz + across);
    Spin {
        omega: Vec3([x, y, z]),
        omega_dot: Vec3([dx, dy, dz]),
        u: Mat3([
            [u_xx, xy - dz, ux],
            [xy + dz, u_yy, uy],
            [xz - dy, yz + dx, uz],
        ]),
        differences: Vec3([uz - u_yy, across, u_yy - u_xx]),
    }
}

/// F = m a + U h and N = skew(U D) + h × a of a body.
pub(super) fn dynamics<'g>(
    inertia: &Inertia<'g>,
    j_zz: Ex<'g>,
    spin: &Spin<'g>,
    a: Vec3<Ex<'g>>,
    short: bool,
) -> Wrench<'g> {
    let (u, h) = (&spin.u.0, inertia.first);
    let d = |i, j| inertia.d(i, j);
    let [dzy, dxz, dyx] = spin.differences.0;
    // k₁ x − k₂ y, merged where k₁ = ±k₂
    let pair = |k1: Ex<'g>, x: Ex<'g>, k2: Ex<'g>, y: Ex<'g>| {
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
    Wrench {
        force: spin.u * h + inertia.weigh(a),
        moment: Vec3([nx, ny, nz]) + h.cross(a),
    }
}

/// F = m (a + U s) and N = s × F of a point mass.
fn dynamics_of_point<'g>(point: &Point<'g>, spin: &Spin<'g>, a: Vec3<Ex<'g>>) -> Wrench<'g> {
    let force = (a + spin.u * point.place).scale(point.mass);
    Wrench {
        force,
        moment: point.place.cross(force),
    }
}

/// Forces and moments summed from the tips, and the joints' share of them.
fn inwards<'g>(b: &'g Builder, frames: &Frames<'g>, loads: &[Load<'g>]) -> Vec<Ex<'g>> {
    let n = frames.bodies.len();
    // What the bodies beyond hand over: in own axes, and in the basis's.
    let mut own = vec![Wrench::zero(b); n];
    let mut basis = own.clone();
    let mut efforts = vec![b.zero(); n];
    for j in (0..n).rev() {
        let frame = &frames.bodies[j];
        b.section(format!(
            "{}: forces and moments summed from the tips; effort of `{}`",
            frame.name, frame.joint
        ));
        let (inner, outer) = (loads[j].own.plus(own[j]), loads[j].basis.plus(basis[j]));
        let whole = outer.plus(inner.map(|v| turn(v, frame.turn)));
        efforts[j] = (whole.along(frame) * frame.effort).named(|| format!("tau_{}", frame.joint));
        let Some(p) = frame.parent else { continue };
        let carried = whole.carried(frame.position);
        if frame.continues {
            basis[p] = basis[p].plus(carried);
        } else {
            let twist = frame.twist.map(|x| b.constant(x));
            own[p] = own[p].plus(carried.map(|v| twist * v));
        }
    }
    efforts
}
