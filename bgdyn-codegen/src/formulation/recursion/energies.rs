//! Kinetic and potential energy, in the frames of the recursion.

use bgdyn_runtime::Dd;

use super::frames::Frames;
use super::inertia::BodyInertia;
use super::joint_columns::ColumnDirection;
use super::names::name_vector;
use crate::expr::{Builder, Expr};
use crate::math::Vec3;

/// Returns T = ½ Σ [ m u·u + 2 u·(ω × h) + ω·J ω ] with the velocity u of each body's origin, own axes.
pub(super) fn kinetic_energy<'g>(b: &'g Builder, frames: &Frames<'g>) -> Expr<'g> {
    let zero = Vec3([b.zero(); 3]);
    // (ω, u) in own axes, and in those of the basis.
    let mut own: Vec<(Vec3<Expr<'g>>, Vec3<Expr<'g>>)> = Vec::new();
    let mut basis: Vec<(Vec3<Expr<'g>>, Vec3<Expr<'g>>)> = Vec::new();
    let mut twice = b.zero();
    for frame in &frames.bodies {
        b.section(|| {
            format!(
                "{}: ω, velocity u of its origin; m u·u + 2 u·(ω × h) + ω·J ω",
                frame.name
            )
        });
        let (mut omega, mut u) = match frame.parent {
            None => (zero, zero),
            Some(p) if frame.continues => {
                (basis[p].0, basis[p].1 + basis[p].0.cross(frame.position))
            }
            Some(p) => {
                let back = frame.twist.transpose().map(|x| b.constant(x));
                let (omega, u) = (
                    own[p].0,
                    own[p].1 + own[p].0.cross(frame.position_in_parent),
                );
                (back * omega, back * u)
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
        basis.push((omega, u));
        let (mut omega, mut u) = (frame.turn.apply_back(omega), frame.turn.apply_back(u));
        if let Some([velocity, _]) = &frame.relative {
            (omega, u) = (omega + velocity.angular, u + velocity.linear);
        }
        name_vector(&omega, "omega", &frame.name);
        name_vector(&u, "v", &frame.name);
        own.push((omega, u));
        twice = twice + twice_kinetic_energy(&frame.inertia, omega, u);
    }
    let omega: Vec<Vec3<Expr<'g>>> = own.iter().map(|(omega, _)| *omega).collect();
    (twice + frames.rotors.twice_kinetic_energy(b, &omega)) * Dd::from_f64(0.5)
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
    let n = frames.bodies.len();
    let mut own = vec![BodyInertia::zero(b); n];
    let mut basis = vec![BodyInertia::zero(b); n];
    let mut energy = frames.constant_energy;
    for j in (0..n).rev() {
        let frame = &frames.bodies[j];
        b.section(|| format!("{}: first moment with all it carries", frame.name));
        // Masses and first moments only: the weight does not depend on D.
        let mut whole = frame.inertia.plus(&own[j]);
        whole.first = frame.turn.apply(whole.first);
        whole = whole.plus(&basis[j]);
        whole.first = whole.first + whole.weigh(frame.position);
        match frame.parent {
            None => energy = energy - frames.gravity[j].dot(whole.first),
            Some(p) if frame.continues => basis[p] = basis[p].plus(&whole),
            Some(p) => {
                whole.first = frame.twist.map(|x| b.constant(x)) * whole.first;
                own[p] = own[p].plus(&whole);
            }
        }
    }
    energy
}
