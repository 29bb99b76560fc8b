//! Rotors behind gears.
//!
//! A rotor is N² J on a joint's junction, a full rotor also the momentum N J q̇_j e on its carrier.
//!
//! A rotor rotates N times as fast as its joint about an axis e of its carrier, so the carrier has the
//! momentum h = N J q̇_j e besides its own. It requires the moment ḣ = N J (q̈_j e + q̇_j ω × e) on the
//! carrier, and the effort N J e · ω̇ on the joint besides N² J q̈_j. Its entry in M is N J e · z_k for
//! every joint k that moves the carrier, and twice that if k is j.
//!
//! The bodies' motion is given as vectors, so that this file does not depend on frames or recursions.

use bgdyn_runtime::Dd;

use super::geometry::Geometry;
use crate::bond_graph::Multibody;
use crate::expr::{Builder, Expr};
use crate::formulation::arguments::{Arguments, reflected, spin};
use crate::math::Vec3;

/// The rotors of a mechanism.
pub(super) struct Rotors<'g> {
    /// The sum of N² J for each joint.
    armature: Vec<Expr<'g>>,
    rate: Vec<Expr<'g>>,
    acceleration: Vec<Expr<'g>>,
    full: Vec<FullRotor<'g>>,
}

/// A full rotor on a moving body.
pub(super) struct FullRotor<'g> {
    body: usize,
    /// The coordinate that drives it.
    pub joint: usize,
    /// Factor from a moment or force in the direction of that coordinate to its effort.
    pub effort: Dd,
    /// q̇ and q̈ of that joint.
    rates: (Expr<'g>, Expr<'g>),
    /// N J e in the body's own axes.
    momentum: Vec3<Expr<'g>>,
}

impl<'g> FullRotor<'g> {
    /// Returns its momentum per unit rate along its joint's z, in the body's own axes.
    pub fn unit_momentum(&self) -> Vec3<Expr<'g>> {
        let per_unit = Dd::ONE / self.effort;
        self.momentum.map(|x| x * per_unit)
    }

    /// Returns its momentum N J q̇ e, in the body's own axes.
    pub fn momentum(&self) -> Vec3<Expr<'g>> {
        self.momentum.scale(self.rates.0)
    }

    /// Returns the rate N J q̈ e of that momentum in axes fixed to the body.
    pub fn momentum_rate(&self) -> Vec3<Expr<'g>> {
        self.momentum.scale(self.rates.1)
    }
}

impl<'g> Rotors<'g> {
    /// `aims` are cosine and sine of the angle about z by which a plan rotates each body's axes, `efforts`
    /// the factor from a moment or force in the direction of each coordinate to its effort.
    pub fn new(
        b: &'g Builder,
        graph: &Multibody,
        geometry: &Geometry,
        (aims, efforts): (&[(Dd, Dd)], &[Dd]),
        x: &Arguments<'g>,
    ) -> Self {
        let mut rotors = Rotors {
            armature: vec![b.zero(); graph.coordinates.len()],
            rate: x.v.clone(),
            acceleration: x.a.clone(),
            full: Vec::new(),
        };
        for rotor in &graph.rotors {
            let j = rotor.coordinate.0;
            rotors.armature[j] = rotors.armature[j] + reflected(b, rotor);
            let Some(carrier) = &rotor.carrier else {
                continue;
            };
            for (body, of) in geometry.bodies.iter().enumerate() {
                if let Some((_, pose)) = of.links.iter().find(|(l, _)| *l == carrier.link) {
                    let [px, py, pz] = (of.axes.transpose() * (pose.rotation * carrier.axis)).0;
                    let (c, s) = aims[body];
                    let axis = Vec3([c * px + s * py, c * py - s * px, pz]);
                    rotors.full.push(FullRotor {
                        body,
                        joint: j,
                        effort: efforts[j],
                        rates: (x.v[j], x.a[j]),
                        momentum: b.vector(axis).scale(spin(b, rotor)),
                    });
                }
            }
        }
        rotors
    }

    /// Returns the number of coordinates.
    pub fn coordinates(&self) -> usize {
        self.armature.len()
    }

    /// Returns the full rotors on a body.
    pub fn on(&self, body: usize) -> impl Iterator<Item = &FullRotor<'g>> {
        self.full.iter().filter(move |rotor| rotor.body == body)
    }

    /// Returns ḣ of the rotors on a body with the angular velocity `omega`, in its own axes.
    pub fn moment(&self, body: usize, omega: Vec3<Expr<'g>>) -> Option<Vec3<Expr<'g>>> {
        let moment = self.on(body).map(|rotor| {
            let whirl = omega.cross(rotor.momentum);
            rotor.momentum_rate() + whirl.scale(rotor.rates.0)
        });
        moment.reduce(|a, b| a + b)
    }

    /// Adds to the joints' efforts those that accelerate the rotors; `omega_dot` is the angular
    /// acceleration of each body, in its own axes.
    pub fn add_efforts(&self, omega_dot: &[Vec3<Expr<'g>>], efforts: &mut [Expr<'g>]) {
        for (j, effort) in efforts.iter_mut().enumerate() {
            *effort = *effort + self.armature[j] * self.acceleration[j];
        }
        for rotor in &self.full {
            let carried = rotor.momentum.dot(omega_dot[rotor.body]);
            efforts[rotor.joint] = efforts[rotor.joint] + carried;
        }
    }

    /// Returns N² J of a joint.
    pub fn armature(&self, joint: usize) -> Expr<'g> {
        self.armature[joint]
    }

    /// Returns twice the kinetic energy of the rotors in addition to that of the links: N² J q̇² + 2 N J
    /// q̇ e · ω, with the angular velocity of each body in its own axes.
    pub fn twice_kinetic_energy(&self, b: &'g Builder, omega: &[Vec3<Expr<'g>>]) -> Expr<'g> {
        let squares = self.armature.iter().zip(&self.rate);
        let own = squares.fold(b.zero(), |sum, (&i, &v)| sum + i * v * v);
        self.full.iter().fold(own, |sum, rotor| {
            let shared = rotor.momentum.dot(omega[rotor.body]) * rotor.rates.0;
            sum + shared + shared
        })
    }
}
