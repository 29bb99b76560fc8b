//! Rotors behind gears: N² J on a joint's junction, and for a full rotor the momentum N J q̇_j e
//! that it has in the body it sits on.
//!
//! A rotor turns N times as fast as its joint about an axis e of its carrier, so the carrier holds
//! the momentum h = N J q̇_j e beside its own. What moves it is ḣ = N J (q̈_j e + q̇_j ω × e) on the
//! carrier, and N J e · ω̇ on the joint beside N² J q̈_j. In M it is N J e · z_k for every joint k
//! that turns the carrier, and twice that where k is j itself.

use bgdyn_runtime::Dd;

use super::derivatives::composite_flow::CompositeFlow;
use super::derivatives::outboard_joint::{Axis, OutboardJoint};
use super::frames::Frames;
use super::geometry::Geometry;
use super::inertia::turn;
use super::mass_matrix::{Momenta, Momentum};
use super::motion::Moving;
use crate::bond_graph::BondGraph;
use crate::expr::{Builder, Ex};
use crate::formulation::{Arguments, reflected, spin};
use crate::math::{Mat3, Vec3};

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

impl<'g> Spinning<'g> {
    /// What a unit rate along the joint's z gives it.
    fn per_unit(&self, frames: &Frames<'g>) -> Vec3<Ex<'g>> {
        let per_unit = Dd::ONE / frames.bodies[self.joint].effort;
        self.momentum.map(|x| x * per_unit)
    }
}

impl<'g> Rotors<'g> {
    /// `aims` has cosine and sine of the angle about z by which a plan turns each body's axes.
    pub fn new(
        b: &'g Builder,
        graph: &BondGraph,
        geometry: &Geometry,
        aims: &[(Dd, Dd)],
        x: &Arguments<'g>,
    ) -> Self {
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
                    let [x, y, z] = (of.axes.transpose() * (place.rotation * carrier.axis)).0;
                    let (c, s) = aims[body];
                    let axis = Vec3([c * x + s * y, c * y - s * x, z]);
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
        let moment = self.on(body).map(|s| {
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
    /// rotors on that body. The joint may be anywhere: beyond the body, before it, or its own.
    pub fn add_momenta(
        &self,
        b: &'g Builder,
        frames: &Frames<'g>,
        body: usize,
        momenta: &mut Momenta<'g>,
    ) {
        for s in self.on(body) {
            let angular = turn(s.per_unit(frames), frames.bodies[body].turn);
            momenta.add(Momentum {
                joint: s.joint,
                linear: Vec3([b.zero(); 3]),
                angular,
            });
        }
    }

    /// Adds the rotors on a body to what that body carries, in its own axes. Seen from the body,
    /// the momentum H = h q̇_j is a flow of mass in place: its E is −[H]× (times `factor` / 2), as
    /// the moment ω × H must be E ω. What changes H takes h q̈_j.
    pub fn add_flow(&self, b: &'g Builder, body: usize, factor: Dd, whole: &mut CompositeFlow<'g>) {
        let half = factor * Dd::from_f64(0.5);
        for s in self.on(body) {
            let [x, y, z] = s.momentum.scale(self.rate[s.joint]).map(|x| x * half).0;
            let moment = Mat3([[b.zero(), z, -y], [-z, b.zero(), x], [y, -x, b.zero()]]);
            whole.flow.moment = whole.flow.moment + moment;
            let turned = s.momentum.scale(self.acceleration[s.joint]);
            whole.rest.moment = whole.rest.moment + turned;
        }
    }

    /// The rotors on a body as the joints before it see them, in its own axes: each with the joint
    /// that turns it. See [`OutboardJoint::of_rotor`].
    pub fn seen<'s>(
        &'s self,
        b: &'g Builder,
        frames: &'s Frames<'g>,
        body: usize,
        axis: &'s Axis<'g>,
    ) -> impl Iterator<Item = OutboardJoint<'g>> + 's
    where
        'g: 's,
    {
        self.on(body)
            .map(move |s| OutboardJoint::of_rotor(b, s.joint, s.per_unit(frames), axis))
    }

    fn on(&self, body: usize) -> impl Iterator<Item = &Spinning<'g>> {
        self.spinning.iter().filter(move |s| s.body == body)
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
