//! Rotors behind gears: N² J on a joint's junction, and for a full rotor the momentum N J q̇_j e
//! that it has in the body it sits on.
//!
//! A rotor turns N times as fast as its joint about an axis e of its carrier, so the carrier holds
//! the momentum h = N J q̇_j e beside its own. What moves it is ḣ = N J (q̈_j e + q̇_j ω × e) on the
//! carrier, and N J e · ω̇ on the joint beside N² J q̈_j.

use bgdyn_runtime::Dd;

use super::frames::Frames;
use super::geometry::Geometry;
use super::inertia::turn;
use super::mass::Momentum;
use super::motion::Moving;
use crate::bond_graph::BondGraph;
use crate::expr::{Builder, Ex};
use crate::formulation::{Arguments, reflected, spin};
use crate::math::Vec3;

/// The rotors of a mechanism.
pub(super) struct Rotors<'g> {
    /// N² J of each joint, summed.
    armature: Vec<Ex<'g>>,
    rate: Vec<Ex<'g>>,
    acceleration: Vec<Ex<'g>>,
    spinning: Vec<Spinning<'g>>,
}

/// A full rotor on a body that moves.
struct Spinning<'g> {
    body: usize,
    joint: usize,
    /// N J e in the body's own axes.
    momentum: Vec3<Ex<'g>>,
}

impl<'g> Rotors<'g> {
    pub fn new(b: &'g Builder, graph: &BondGraph, geometry: &Geometry, x: &Arguments<'g>) -> Self {
        let mut rotors = Rotors {
            armature: vec![b.zero(); geometry.bodies.len()],
            rate: x.v.clone(),
            acceleration: x.a.clone(),
            spinning: Vec::new(),
        };
        for rotor in &graph.rotors {
            let j = rotor.coordinate.0;
            rotors.armature[j] = rotors.armature[j] + reflected(b, rotor);
            let Some(carrier) = &rotor.carrier else {
                continue;
            };
            for (body, of) in geometry.bodies.iter().enumerate() {
                if let Some((_, place)) = of.links.iter().find(|(l, _)| *l == carrier.link) {
                    let axis = of.axes.transpose() * (place.rotation * carrier.axis);
                    rotors.spinning.push(Spinning {
                        body,
                        joint: j,
                        momentum: b.vector(axis).scale(spin(b, rotor)),
                    });
                }
            }
        }
        rotors
    }

    /// ḣ of the rotors on a body, its own axes.
    pub fn moment(&self, body: usize, motion: &Moving<'g>) -> Option<Vec3<Ex<'g>>> {
        let on = self.spinning.iter().filter(|s| s.body == body);
        let moment = on.map(|s| {
            let whirl = motion.own.omega.cross(s.momentum);
            s.momentum.scale(self.acceleration[s.joint]) + whirl.scale(self.rate[s.joint])
        });
        moment.reduce(|a, b| a + b)
    }

    /// What turns the rotors, added to the joints' efforts.
    pub fn add_efforts(&self, moving: &[Moving<'g>], efforts: &mut [Ex<'g>]) {
        for (j, effort) in efforts.iter_mut().enumerate() {
            *effort = *effort + self.armature[j] * self.acceleration[j];
        }
        for s in &self.spinning {
            let carried = s.momentum.dot(moving[s.body].own.omega_dot);
            efforts[s.joint] = efforts[s.joint] + carried;
        }
    }

    /// N² J of a joint.
    pub fn armature(&self, joint: usize) -> Ex<'g> {
        self.armature[joint]
    }

    /// Adds to momenta, in the axes of a body's basis, what a unit rate of each joint gives the
    /// rotors on that body.
    pub fn add_momenta(&self, frames: &Frames<'g>, body: usize, momenta: &mut [Momentum<'g>]) {
        for s in self.spinning.iter().filter(|s| s.body == body) {
            let per_unit = Dd::ONE / frames.bodies[s.joint].effort;
            let turned = turn(s.momentum, frames.bodies[body].turn).map(|x| x * per_unit);
            for m in momenta.iter_mut().filter(|m| m.joint == s.joint) {
                m.angular = m.angular + turned;
            }
        }
    }

    /// Twice the kinetic energy that the rotors have beyond the links': N² J q̇² + 2 N J q̇ e · ω.
    pub fn twice_kinetic_energy(&self, b: &'g Builder, omega: &[Vec3<Ex<'g>>]) -> Ex<'g> {
        let squares = self.armature.iter().zip(&self.rate);
        let own = squares.fold(b.zero(), |sum, (&i, &v)| sum + i * v * v);
        self.spinning.iter().fold(own, |sum, s| {
            let shared = s.momentum.dot(omega[s.body]) * self.rate[s.joint];
            sum + shared + shared
        })
    }
}
