//! Rotors behind gears: N² J on a joint's junction, and for a full rotor the momentum N J q̇_j e
//! that it has in the body it sits on.
//!
//! A rotor turns N times as fast as its joint about an axis e of its carrier, so the carrier holds
//! the momentum h = N J q̇_j e beside its own. What moves it is ḣ = N J (q̈_j e + q̇_j ω × e) on the
//! carrier, and N J e · ω̇ on the joint beside N² J q̈_j. In M it is N J e · z_k for every joint k
//! that turns the carrier, and twice that where k is j itself.
//!
//! The bodies' motion comes in as vectors, so that nothing here knows frames or recursions.

use bgdyn_runtime::Dd;

use super::geometry::Geometry;
use crate::bond_graph::Multibody;
use crate::expr::{Builder, Expr};
use crate::formulation::arguments::{Arguments, reflected, spin};
use crate::math::Vec3;

/// The rotors of a mechanism.
pub(super) struct Rotors<'g> {
    /// N² J of each joint, summed.
    armature: Vec<Expr<'g>>,
    rate: Vec<Expr<'g>>,
    acceleration: Vec<Expr<'g>>,
    full: Vec<FullRotor<'g>>,
}

/// A full rotor on a body that moves.
pub(super) struct FullRotor<'g> {
    body: usize,
    /// The joint that turns it.
    pub joint: usize,
    /// Factor from a moment or force along z to that joint's effort.
    effort: Dd,
    /// q̇ and q̈ of that joint.
    rates: (Expr<'g>, Expr<'g>),
    /// N J e in the body's own axes.
    momentum: Vec3<Expr<'g>>,
}

impl<'g> FullRotor<'g> {
    /// Momentum that a unit rate along its joint's z gives it, in the body's own axes.
    pub fn unit_momentum(&self) -> Vec3<Expr<'g>> {
        let per_unit = Dd::ONE / self.effort;
        self.momentum.map(|x| x * per_unit)
    }

    /// Its momentum N J q̇ e, in the body's own axes.
    pub fn momentum(&self) -> Vec3<Expr<'g>> {
        self.momentum.scale(self.rates.0)
    }

    /// The rate N J q̈ e of that momentum in axes fixed to the body.
    pub fn momentum_rate(&self) -> Vec3<Expr<'g>> {
        self.momentum.scale(self.rates.1)
    }
}

impl<'g> Rotors<'g> {
    /// `aims` has cosine and sine of the angle about z by which a plan turns each body's axes,
    /// `efforts` the factor from a moment or force along each joint's z to its effort.
    pub fn new(
        b: &'g Builder,
        graph: &Multibody,
        geometry: &Geometry,
        (aims, efforts): (&[(Dd, Dd)], &[Dd]),
        x: &Arguments<'g>,
    ) -> Self {
        let mut rotors = Rotors {
            armature: vec![b.zero(); geometry.bodies.len()],
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
                if let Some((_, place)) = of.links.iter().find(|(l, _)| *l == carrier.link) {
                    let [px, py, pz] = (of.axes.transpose() * (place.rotation * carrier.axis)).0;
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

    /// The full rotors on a body.
    pub fn on(&self, body: usize) -> impl Iterator<Item = &FullRotor<'g>> {
        self.full.iter().filter(move |rotor| rotor.body == body)
    }

    /// ḣ of the rotors on a body with the angular velocity `omega`, in its own axes.
    pub fn moment(&self, body: usize, omega: Vec3<Expr<'g>>) -> Option<Vec3<Expr<'g>>> {
        let moment = self.on(body).map(|rotor| {
            let whirl = omega.cross(rotor.momentum);
            rotor.momentum_rate() + whirl.scale(rotor.rates.0)
        });
        moment.reduce(|a, b| a + b)
    }

    /// Adds to the joints' efforts what turns the rotors; `omega_dot` has the angular acceleration of
    /// each body, in its own axes.
    pub fn add_efforts(&self, omega_dot: &[Vec3<Expr<'g>>], efforts: &mut [Expr<'g>]) {
        for (j, effort) in efforts.iter_mut().enumerate() {
            *effort = *effort + self.armature[j] * self.acceleration[j];
        }
        for rotor in &self.full {
            let carried = rotor.momentum.dot(omega_dot[rotor.body]);
            efforts[rotor.joint] = efforts[rotor.joint] + carried;
        }
    }

    /// N² J of a joint.
    pub fn armature(&self, joint: usize) -> Expr<'g> {
        self.armature[joint]
    }

    /// Twice the kinetic energy that the rotors have beyond the links': N² J q̇² + 2 N J q̇ e · ω, with
    /// the angular velocity of each body in its own axes.
    pub fn twice_kinetic_energy(&self, b: &'g Builder, omega: &[Vec3<Expr<'g>>]) -> Expr<'g> {
        let squares = self.armature.iter().zip(&self.rate);
        let own = squares.fold(b.zero(), |sum, (&i, &v)| sum + i * v * v);
        self.full.iter().fold(own, |sum, rotor| {
            let shared = rotor.momentum.dot(omega[rotor.body]) * rotor.rates.0;
            sum + shared + shared
        })
    }
}
