//! Motion of the bodies: angular velocity and accelerations from the base to the tips.
//!
//! A body's motion is ω, the acceleration `a` of its origin minus gravity, and U = [ω̇]× + [ω]×[ω]×: the
//! point s of the body has the acceleration a + U s.

use bgdyn_runtime::Dd;

use super::frames::{BodyFrame, Frames};
use super::joint_columns::ColumnDirection;
use super::names::{name_matrix, name_vector};
use super::rotation::{Rotation, permutation};
use crate::expr::{Builder, Expr};
use crate::math::{Mat3, Vec3};
use crate::mechanism::Motion;
use crate::mechanism::joint::Column;

/// Angular motion in one set of axes.
#[derive(Clone, Copy)]
pub(super) struct Spin<'g> {
    /// ω
    pub omega: Vec3<Expr<'g>>,
    pub omega_dot: Vec3<Expr<'g>>,
    /// U
    pub u: Mat3<Expr<'g>>,
    /// U_zz − U_yy, U_xx − U_zz, U_yy − U_xx
    pub differences: Vec3<Expr<'g>>,
}

impl Spin<'_> {
    /// Returns the number of zero entries of ω and U.
    pub fn zeros(&self) -> usize {
        let all = self.u.0.into_iter().flatten().chain(self.omega.0);
        all.filter(|e| e.is_zero()).count()
    }
}

/// The gravity that accelerations include.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum GravityField {
    /// None.
    Zero,
    /// That of the mechanism.
    Gravity,
    /// That of the mechanism, except on trees with a root that translates freely: seen from axes that
    /// accelerate with the root, nothing on the tree depends on the acceleration.
    SetAside,
}

/// Motion of a body.
pub(super) struct Moving<'g> {
    /// Angular motion of the twisted axes at the start of the basis, before any angle of the group.
    pub basis: Spin<'g>,
    /// Ω, Ω̇: summed rates of the group's joints.
    rate: (Expr<'g>, Expr<'g>),
    /// Angular motion of the body, in the axes of the basis.
    pub in_basis: Spin<'g>,
    /// Acceleration of the origin, in the axes of the basis.
    pub a_basis: Vec3<Expr<'g>>,
    /// Angular motion of the body in its own axes.
    pub own: Spin<'g>,
    /// Acceleration of the origin in own axes.
    pub a_own: Vec3<Expr<'g>>,
    /// The uniform acceleration that `a_own` leaves out, in own axes.
    pub set_aside: Option<Vec3<Expr<'g>>>,
}

/// Returns the motion of every body with the rates and accelerations in `frames`.
pub(super) fn motions<'g>(
    b: &'g Builder,
    frames: &Frames<'g>,
    field: GravityField,
) -> Vec<Moving<'g>> {
    let mut moving: Vec<Moving<'g>> = Vec::new();
    for (j, frame) in frames.bodies.iter().enumerate() {
        let parent = frame.parent.map(|p| &moving[p]);
        let gravity = match field {
            GravityField::Zero => zero(b),
            _ if frame.given => zero(b),
            GravityField::Gravity | GravityField::SetAside => frames.gravity[j],
        };
        b.section(|| {
            format!(
                "{}: ω, U = [ω̇]× + [ω]×[ω]×, acceleration a of its origin less gravity",
                frame.name
            )
        });
        let mut step = outwards(b, frame, parent, gravity);
        if field == GravityField::SetAside && frame.parent.is_none() {
            set_aside(b, frame, &mut step);
        }
        name(frame, &step);
        moving.push(step);
    }
    moving
}

/// Sets the acceleration of a root aside, in the directions in which its joint translates.
fn set_aside<'g>(b: &'g Builder, frame: &BodyFrame<'g>, step: &mut Moving<'g>) {
    let mut aside = zero(b);
    for column in frame.columns.iter().filter(|_| !frame.axial) {
        if let ColumnDirection::Along(k) = column.direction {
            aside.0[k] = step.a_own.0[k];
            step.a_own.0[k] = b.zero();
            step.set_aside = Some(aside);
        }
    }
}

/// Adds the accelerations set aside to the accelerations found without them.
pub(super) fn add_set_aside<'g>(
    frames: &Frames<'g>,
    moving: &[Moving<'g>],
    accelerations: &mut [Expr<'g>],
) {
    for (frame, step) in frames.bodies.iter().zip(moving) {
        let Some(aside) = step.set_aside else {
            continue;
        };
        for column in &frame.columns {
            if let ColumnDirection::Along(k) = column.direction {
                let own = &mut accelerations[column.coordinate];
                *own = *own - aside.0[k] * (Dd::ONE / column.effort);
            }
        }
    }
}

pub(super) fn zero(b: &Builder) -> Vec3<Expr<'_>> {
    Vec3([b.zero(); 3])
}

fn name(frame: &BodyFrame<'_>, step: &Moving<'_>) {
    let (name, spin) = (&frame.name, &step.own);
    name_vector(&spin.omega, "omega", name);
    name_vector(&step.a_own, "a", name);
    name_vector(&spin.omega_dot, "alpha", name);
    name_matrix(&spin.u, "u", name);
}

/// Returns the motion of a body from its parent's.
fn outwards<'g>(
    b: &'g Builder,
    frame: &BodyFrame<'g>,
    parent: Option<&Moving<'g>>,
    gravity: Vec3<Expr<'g>>,
) -> Moving<'g> {
    let (basis, mut rate, mut a_basis) = match parent {
        // The base is at rest; gravity is an upward acceleration of the base.
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
    if let Some([velocity, change]) = &frame.relative {
        return outwards_several(b, frame, (basis, a_basis), velocity, change);
    }
    // 2 ω × ẑ ṡ + ẑ s̈ along the axis
    let along = |factor: Option<Dd>| {
        let scaled = |x: Expr<'g>| factor.map_or(x, |pitch| x * pitch);
        let twice = scaled(frame.rate) * Dd::from_f64(2.0);
        let [x, y, _] = basis.omega.0;
        Vec3([y * twice, -(x * twice), scaled(frame.acceleration)])
    };
    if frame.motion != Motion::Translation {
        rate = (rate.0 + frame.rate, rate.1 + frame.acceleration);
    }
    match frame.columns[0].direction {
        ColumnDirection::About(_) => {}
        ColumnDirection::Along(_) => a_basis = a_basis + along(None),
        ColumnDirection::Screw(pitch) => a_basis = a_basis + along(Some(pitch)),
    }
    let in_basis = spun(&basis, rate);
    let own = own_spin(&basis, rate, frame.turn);
    let a_own = frame.turn.apply_back(a_basis);
    Moving {
        basis,
        rate,
        in_basis,
        a_basis,
        own,
        a_own,
        set_aside: None,
    }
}

/// Returns the motion of a body whose joint has several velocities: the twist `velocity` relative to the
/// parent, in own axes, and its rate `change` for constant columns.
///
/// ω = Rᵀω_p + ω_J, ω̇ = Rᵀω̇_p + (Rᵀω_p) × ω_J + ω̇_J, a = Rᵀa_p + (2 Rᵀω_p + ω_J) × v_J + v̇_J
fn outwards_several<'g>(
    b: &'g Builder,
    frame: &BodyFrame<'g>,
    (basis, a_basis): (Spin<'g>, Vec3<Expr<'g>>),
    velocity: &Column<Expr<'g>>,
    change: &Column<Expr<'g>>,
) -> Moving<'g> {
    let back = |v: Vec3<Expr<'g>>| frame.turn.apply_back(v);
    let carried = back(basis.omega);
    let omega = carried + velocity.angular;
    let omega_dot = back(basis.omega_dot) + carried.cross(velocity.angular) + change.angular;
    let coupled = (carried + omega).cross(velocity.linear);
    let a_own = back(a_basis) + coupled + change.linear;
    let u = u_of(omega, omega_dot);
    let own = Spin {
        omega,
        omega_dot,
        u,
        differences: differences(&u),
    };
    // No body continues its basis: its own axes take the place of the basis.
    Moving {
        basis: own,
        rate: (b.zero(), b.zero()),
        in_basis: own,
        a_basis: a_own,
        own,
        a_own,
        set_aside: None,
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

/// Returns the parent's angular motion in twisted axes.
fn twisted<'g>(b: &'g Builder, parent: &Spin<'g>, twist: Mat3<Dd>) -> Spin<'g> {
    let back = twist.transpose().map(|x| b.constant(x));
    let (omega, omega_dot) = (back * parent.omega, back * parent.omega_dot);
    let Some(indices) = permutation(twist) else {
        // For a general rotation, computing U again costs less than rotating it.
        let u = u_of(omega, omega_dot);
        return Spin {
            omega,
            omega_dot,
            u,
            differences: differences(&u),
        };
    };
    let u = back * parent.u * back.transpose();
    // Each difference is a difference of the parent, with the sign of the permutation of its two axes.
    let difference = |k: usize| {
        let (upper, lower) = (indices[(k + 2) % 3], indices[(k + 1) % 3]);
        let kept = (lower + 1) % 3 == upper;
        let d = parent.differences.0[indices[k]];
        if kept { d } else { -d }
    };
    Spin {
        omega,
        omega_dot,
        u,
        differences: Vec3(std::array::from_fn(difference)),
    }
}

/// Returns the acceleration of the new origin in twisted axes, by the product U p if that costs less.
fn twisted_acceleration<'g>(
    b: &'g Builder,
    parent: &Moving<'g>,
    frame: &BodyFrame<'g>,
    basis: &Spin<'g>,
) -> Vec3<Expr<'g>> {
    let back = frame.twist.transpose().map(|x| b.constant(x));
    if permutation(frame.twist).is_some() {
        back * parent.a_own + basis.u * frame.position
    } else {
        back * (parent.a_own + parent.own.u * frame.position_in_parent)
    }
}

/// Returns U = [ω̇]× + [ω]×[ω]×.
fn u_of<'g>(omega: Vec3<Expr<'g>>, omega_dot: Vec3<Expr<'g>>) -> Mat3<Expr<'g>> {
    let ([x, y, z], [dx, dy, dz]) = (omega.0, omega_dot.0);
    let (xx, yy, zz, xy, xz, yz) = (x * x, y * y, z * z, x * y, x * z, y * z);
    Mat3([
        [-(yy + zz), xy - dz, xz + dy],
        [xy + dz, -(xx + zz), yz - dx],
        [xz - dy, yz + dx, -(xx + yy)],
    ])
}

fn differences<'g>(u: &Mat3<Expr<'g>>) -> Vec3<Expr<'g>> {
    let [xx, yy, zz] = [u.0[0][0], u.0[1][1], u.0[2][2]];
    Vec3([zz - yy, xx - zz, yy - xx])
}

/// Returns the angular motion after the group's rates Ω, Ω̇ about z, in axes that do not rotate with them:
/// with σ = Ω (2 ω⁰_z + Ω), U = U⁰ + [[−σ, −Ω̇, 0], [Ω̇, −σ, 0], [2Ω ω⁰_x, 2Ω ω⁰_y, 0]].
fn spun<'g>(basis: &Spin<'g>, (rate, acceleration): (Expr<'g>, Expr<'g>)) -> Spin<'g> {
    let ([x, y, z], [dx, dy, dz]) = (basis.omega.0, basis.omega_dot.0);
    let (total, total_dot) = (z + rate, dz + acceleration);
    let sigma = rate * (total + z);
    let twice = rate * Dd::from_f64(2.0);
    let [[xx, xy, xz], [yx, yy, yz], [zx, zy, zz]] = basis.u.0;
    let [dzy, dxz, dyx] = basis.differences.0;
    // A body that rotates about z only has U_xx = U_yy = −ω_z².
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
    // ω̇_x and ω̇_y in axes that do not rotate: ω̇⁰ + Ω (ω⁰_y, −ω⁰_x)
    let omega_dot = Vec3([dx + rate * y, dy - rate * x, total_dot]);
    Spin {
        omega: Vec3([x, y, total]),
        omega_dot,
        u,
        differences: Vec3([dzy, dxz, dyx]),
    }
}

/// Returns the angular motion in own axes by the common-axis method: the points of the joint's axis have
/// the same acceleration in both bodies, so the column of U along it is common to both. It is rotated,
/// where the usual recursion rotates ω̇ and computes U again.
fn own_spin<'g>(
    basis: &Spin<'g>,
    (rate, acceleration): (Expr<'g>, Expr<'g>),
    turn: Rotation<'g>,
) -> Spin<'g> {
    let straight = match turn {
        Rotation::AboutZ((cos, _)) => cos.as_constant() == Some(Dd::ONE),
        Rotation::General(_) => false,
    };
    if rate.is_zero() && acceleration.is_zero() && straight {
        return *basis;
    }
    let [x, y, _] = turn.apply_back(basis.omega).0;
    let z = basis.omega.0[2] + rate;
    let [ux, uy, uz] = turn.apply_back(basis.u.column(2)).0;
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
