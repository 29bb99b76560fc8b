//! Kinetic and potential energy, in the frames of the recursion.

use bgdyn_runtime::Dd;

use super::frames::{BodyFrame, Frames};
use super::inertia::BodyInertia;
use super::joint_columns::ColumnDirection;
use super::names::name_vector;
use crate::expr::{Builder, Expr};
use crate::math::Vec3;

/// Angular velocity of a body, and velocity of its origin.
#[derive(Clone, Copy)]
pub(super) struct BodyVelocity<'g> {
    /// ω
    pub omega: Vec3<Expr<'g>>,
    /// u
    pub origin: Vec3<Expr<'g>>,
}

/// Returns T = ½ Σ [ m u·u + 2 u·(ω × h) + ω·J ω ] with the velocity u of each body's origin, own axes.
pub(super) fn kinetic_energy<'g>(b: &'g Builder, frames: &Frames<'g>) -> Expr<'g> {
    let mut twice = b.zero();
    let title = |frame: &BodyFrame<'g>| {
        format!(
            "{}: ω, velocity u of its origin; m u·u + 2 u·(ω × h) + ω·J ω",
            frame.name
        )
    };
    let mut omega: Vec<Vec3<Expr<'g>>> = Vec::new();
    velocities(b, frames, title, |_, frame, own, _| {
        omega.push(own.omega);
        twice = twice + twice_kinetic_energy(&frame.inertia, own.omega, own.origin);
    });
    (twice + frames.rotors.twice_kinetic_energy(b, &omega)) * Dd::from_f64(0.5)
}

/// Computes the velocities of the bodies outwards, and gives `at` those of each body in own axes and in those of its basis;
/// the latter are those of the body for a joint with an axis.
pub(super) fn velocities<'g>(
    b: &'g Builder,
    frames: &Frames<'g>,
    title: impl Fn(&BodyFrame<'g>) -> String,
    mut at: impl FnMut(usize, &BodyFrame<'g>, BodyVelocity<'g>, BodyVelocity<'g>),
) {
    let zero = Vec3([b.zero(); 3]);
    let mut own: Vec<BodyVelocity<'g>> = Vec::new();
    let mut basis: Vec<BodyVelocity<'g>> = Vec::new();
    for (j, frame) in frames.bodies.iter().enumerate() {
        b.section(|| title(frame));
        let (mut omega, mut u) = match frame.parent {
            None => (zero, zero),
            Some(p) if frame.continues => {
                let p = basis[p];
                (p.omega, p.origin + p.omega.cross(frame.position))
            }
            Some(p) => {
                let back = frame.twist.transpose().map(|x| b.constant(x));
                let p = own[p];
                let u = p.origin + p.omega.cross(frame.position_in_parent);
                (back * p.omega, back * u)
            }
        };
        if frame.axial {
            match frame.columns[0].direction {
                ColumnDirection::About(_) => omega.0[2] = omega.0[2] + frame.rate,
                ColumnDirection::Along(_) => u.0[2] = u.0[2] + frame.rate,
                ColumnDirection::Screw(pitch) => {
                    omega.0[2] = omega.0[2] + frame.rate;
                    u.0[2] = u.0[2] + frame.rate * pitch;
                }
            }
        }
        let in_basis = BodyVelocity { omega, origin: u };
        basis.push(in_basis);
        let (mut omega, mut u) = (frame.turn.apply_back(omega), frame.turn.apply_back(u));
        if let Some([velocity, _]) = &frame.relative {
            (omega, u) = (omega + velocity.angular, u + velocity.linear);
        }
        name_vector(&omega, "omega", &frame.name);
        name_vector(&u, "v", &frame.name);
        let in_own = BodyVelocity { omega, origin: u };
        own.push(in_own);
        at(j, frame, in_own, in_basis);
    }
}

fn twice_kinetic_energy<'g>(
    inertia: &BodyInertia<'g>,
    omega: Vec3<Expr<'g>>,
    u: Vec3<Expr<'g>>,
) -> Expr<'g> {
    let two = Dd::from_f64(2.0);
    let d = |i, j| inertia.d(i, j);
    let [x, y, z] = omega.0;
    // J = tr(D)·1 − D
    let squares = (d(1, 1) + d(2, 2)) * (x * x)
        + (d(0, 0) + d(2, 2)) * (y * y)
        + (d(0, 0) + d(1, 1)) * (z * z);
    let products = d(0, 1) * two * (x * y) + d(0, 2) * two * (x * z) + d(1, 2) * two * (y * z);
    let swept = omega.cross(inertia.first);
    u.dot(inertia.weigh(u)) + u.dot(swept) * two + (squares - products)
}

/// Returns V = −g · Σ m r, with first moments summed from the tips.
pub(super) fn potential_energy<'g>(b: &'g Builder, frames: &Frames<'g>) -> Expr<'g> {
    let mut energy = frames.constant_energy;
    sum_first_moments(b, frames, |j, frame, [_, _, whole]| {
        if frame.parent.is_none() {
            energy = energy - frames.gravity[j].dot(whole.first + whole.weigh(frame.position));
        }
    });
    energy
}

/// Sums masses and first moments from the tips, and gives `at` those of each body with all it carries, about its origin: the
/// part in own axes, the part in those of the basis, and the whole in the latter.
pub(super) fn sum_first_moments<'g>(
    b: &'g Builder,
    frames: &Frames<'g>,
    mut at: impl FnMut(usize, &BodyFrame<'g>, [&BodyInertia<'g>; 3]),
) {
    let n = frames.bodies.len();
    let mut own = vec![BodyInertia::zero(b); n];
    let mut basis = vec![BodyInertia::zero(b); n];
    for j in (0..n).rev() {
        let frame = &frames.bodies[j];
        b.section(|| format!("{}: first moment with all it carries", frame.name));
        // Masses and first moments only: they do not depend on D.
        let inner = frame.inertia.plus(&own[j]);
        let mut whole = inner;
        whole.first = frame.turn.apply(whole.first);
        whole = whole.plus(&basis[j]);
        at(j, frame, [&inner, &basis[j], &whole]);
        let Some(p) = frame.parent else { continue };
        whole.first = whole.first + whole.weigh(frame.position);
        if frame.continues {
            basis[p] = basis[p].plus(&whole);
        } else {
            whole.first = frame.twist.map(|x| b.constant(x)) * whole.first;
            own[p] = own[p].plus(&whole);
        }
    }
}
