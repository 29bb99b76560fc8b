//! The momentum about the centre of mass, and its rate: loads on the bodies, summed from the tips.
//!
//! The momentum of a body is m u + ω × h, and J ω + h × u about its origin; or that of composite bodies is summed for the
//! rates of all joints. The rate is the load that the motion needs where q̈ = 0, without gravity. About the centre of mass
//! c a sum F, N about the origin o of a body on the base is F, N − (c − o) × F: ċ × m ċ = 0.

use bgdyn_runtime::Dd;

use super::super::energies::{BodyVelocity, velocities};
use super::super::frames::{BodyFrame, Frames};
use super::super::inertia::BodyInertia;
use super::super::inverse_dynamics::{BodyWrench, Load, sum_loads};
use super::super::mass_matrix::{Momentum, composites};
use super::super::plan::Plan;
use super::masses::{Masses, is_zero};
use crate::expr::{Builder, Expr};
use crate::math::Vec3;

/// Returns the momenta of the bodies.
pub(super) fn of_bodies<'g>(b: &'g Builder, frames: &Frames<'g>, plan: &Plan) -> Vec<Load<'g>> {
    let none = BodyWrench::zero(b);
    let mut loads: Vec<Load<'g>> = Vec::new();
    let title = |frame: &BodyFrame<'g>| {
        format!(
            "{}: ω, velocity u of its origin; momentum m u + ω × h, J ω + h × u",
            frame.name
        )
    };
    velocities(b, frames, title, |j, frame, own, in_basis| {
        let mut load = match plan.in_basis[j] && frame.axial {
            true => Load {
                own: none,
                basis: momentum(&frame.inertia.turned(frame.turn), in_basis),
            },
            false => Load {
                own: momentum(&frame.inertia, own),
                basis: none,
            },
        };
        for rotor in frames.rotors.on(j) {
            load.own.moment = load.own.moment + rotor.momentum();
        }
        loads.push(load);
    });
    loads
}

fn momentum<'g>(inertia: &BodyInertia<'g>, velocity: BodyVelocity<'g>) -> BodyWrench<'g> {
    let BodyVelocity { omega, origin } = velocity;
    let h = inertia.first;
    BodyWrench {
        force: inertia.weigh(origin) + omega.cross(h),
        moment: inertia.tensor() * omega + h.cross(origin),
    }
}

/// Returns the momenta that the rate of each joint gives to all bodies beyond it.
pub(super) fn of_composites<'g>(
    b: &'g Builder,
    frames: &Frames<'g>,
    v: &[Expr<'g>],
) -> Vec<Load<'g>> {
    let none = BodyWrench::zero(b);
    let units = composites(b, frames).into_iter().zip(&frames.bodies);
    let of = |(j, (units, frame)): (usize, (Vec<Momentum<'g>>, &BodyFrame<'g>))| {
        let whole = units.iter().fold(none, |sum, unit| {
            let rate = v[unit.joint] * unit.effort;
            sum.plus(BodyWrench {
                force: unit.linear.scale(rate),
                moment: unit.angular.scale(rate),
            })
        });
        let mut load = match frame.axial {
            true => Load {
                own: none,
                basis: whole,
            },
            false => Load {
                own: whole,
                basis: none,
            },
        };
        for rotor in frames.rotors.on(j) {
            load.own.moment = load.own.moment + rotor.momentum();
        }
        load
    };
    units.enumerate().map(of).collect()
}

/// Returns the sum of loads about the centre of mass in the world, angular part first.
pub(super) fn about_centre<'g>(
    b: &'g Builder,
    frames: &Frames<'g>,
    plan: &Plan,
    (masses, loads): (&Masses<'g>, &[Load<'g>]),
) -> Vec<Expr<'g>> {
    let title = |frame: &BodyFrame<'g>| format!("{}: momenta summed from the tips", frame.name);
    let arms = masses.arms(b, frames);
    let mut at_roots: Vec<BodyWrench<'g>> = Vec::new();
    sum_loads(
        b,
        frames,
        loads,
        title,
        |j, frame, [inner, outer, whole]| {
            let Some(arm) = arms.iter().find(|arm| arm.body == j) else {
                return;
            };
            let in_own = is_zero(&outer.force) && is_zero(&outer.moment);
            // In own axes, if everything is given in these: then the centre of mass is not rotated.
            at_roots.push(match arm.own.filter(|_| in_own) {
                Some(arm) => moved_to(inner, arm).map(|v| frame.turn.apply(v)),
                None => moved_to(whole, arm.basis),
            });
        },
    );
    at_roots.reverse();
    b.section(|| "about the centre of mass, in the world".into());
    let zero = Vec3([b.zero(); 3]);
    let (mut angular, mut linear) = (zero, zero);
    for (arm, whole) in arms.iter().zip(at_roots) {
        let twist = frames.bodies[arm.body].twist.map(|x| b.constant(x));
        let per_unit = Dd::ONE / plan.unit;
        angular = angular + twist * whole.moment;
        linear = linear + twist * whole.force.map(|x| x * per_unit);
    }
    angular.0.into_iter().chain(linear.0).collect()
}

/// Returns a load about a point that is displaced by `arm` from the present one.
fn moved_to<'g>(load: &BodyWrench<'g>, arm: Vec3<Expr<'g>>) -> BodyWrench<'g> {
    BodyWrench {
        force: load.force,
        moment: load.moment - arm.cross(load.force),
    }
}
