//! Velocities and accelerations outward, forces and moments inward.

use bgdyn_runtime::Dd;

use super::bodies::{Bodies, SubspaceBody};
use super::spatial::Spatial;
use crate::expr::{Builder, Expr};
use crate::formulation::arguments::{Arguments, reflected};
use crate::math::{Mat3, Vec3};

/// The motion of a body, in its own axes.
struct BodyMotion<'g> {
    /// ω
    angular: Vec3<Expr<'g>>,
    /// ω̇
    turning: Vec3<Expr<'g>>,
    /// [ω̇]× + [ω]×[ω]×
    field: Mat3<Expr<'g>>,
    /// Acceleration of the origin, minus gravity.
    linear: Vec3<Expr<'g>>,
}

/// A force and its moment about a body's origin, in its axes.
#[derive(Clone, Copy)]
pub(in crate::formulation) struct JointLoad<'g> {
    pub(in crate::formulation) force: Vec3<Expr<'g>>,
    pub(in crate::formulation) moment: Vec3<Expr<'g>>,
}

impl<'g> SubspaceBody<'g> {
    /// Returns the load in the parent's axes, about its origin.
    pub(super) fn inboard(&self, b: &'g Builder, load: JointLoad<'g>) -> JointLoad<'g> {
        let (force, moment) = (self.inward(b, load.force), self.inward(b, load.moment));
        JointLoad {
            force,
            moment: moment + self.position.cross(force),
        }
    }

    /// Returns a load in the parent's axes about its origin in the body's axes, about the body's origin.
    pub(super) fn outboard(&self, b: &'g Builder, load: JointLoad<'g>) -> JointLoad<'g> {
        let moment = load.moment - self.position.cross(load.force);
        JointLoad {
            force: self.outward(b, load.force),
            moment: self.outward(b, moment),
        }
    }
}

impl<'g> Bodies<'_, 'g> {
    /// Returns the efforts that produce the accelerations.
    pub(super) fn efforts(&self, x: &Arguments<'g>) -> Vec<Expr<'g>> {
        self.efforts_and_loads(x).0
    }

    /// Returns the efforts that produce the accelerations, and the loads on the bodies through their joints.
    pub(super) fn efforts_and_loads(
        &self,
        x: &Arguments<'g>,
    ) -> (Vec<Expr<'g>>, Vec<JointLoad<'g>>) {
        let b = self.b;
        let motions = self.motions(x);
        let zero = Vec3([b.zero(); 3]);
        let mut efforts = vec![b.zero(); self.graph.coordinates.len()];
        let still = JointLoad {
            force: zero,
            moment: zero,
        };
        let mut loads = vec![still; self.bodies.len()];
        for (i, body) in self.bodies.iter().enumerate().rev() {
            let motion = &motions[i];
            let inertia = &body.inertia;
            // F = m a + U h, N = ∫ s × U s dm + h × a
            let own = motion.linear.scale(inertia.mass) + motion.field * inertia.first;
            let force = loads[i].force + own;
            let mut moment =
                moment_of(motion.field, inertia.pseudo) + inertia.first.cross(motion.linear);
            // A full rotor adds the rate of its momentum N J q̇ e, and has an effort of its own.
            for &(j, h) in &body.rotors {
                moment = moment + h.scale(x.a[j]) + motion.angular.cross(h).scale(x.v[j]);
                efforts[j] = efforts[j] + h.dot(motion.turning);
            }
            moment = loads[i].moment + moment;
            loads[i] = JointLoad { force, moment };
            for (j, column) in &body.columns {
                efforts[*j] = efforts[*j] + column.angular.dot(moment) + column.linear.dot(force);
            }
            if let Some(p) = body.parent {
                let (force, moment) = (body.inward(b, force), body.inward(b, moment));
                loads[p].force = loads[p].force + force;
                loads[p].moment = loads[p].moment + moment + body.position.cross(force);
            }
        }
        for rotor in &self.graph.rotors {
            let j = rotor.coordinate.0;
            efforts[j] = efforts[j] + reflected(b, rotor) * x.a[j];
        }
        (efforts, loads)
    }

    fn motions(&self, x: &Arguments<'g>) -> Vec<BodyMotion<'g>> {
        let b = self.b;
        let zero = Vec3([b.zero(); 3]);
        let mut motions: Vec<BodyMotion<'g>> = Vec::new();
        for body in &self.bodies {
            let (carried, turning, origin) = match body.parent {
                Some(p) => {
                    let parent = &motions[p];
                    let origin = parent.linear + parent.field * body.position;
                    (
                        body.outward(b, parent.angular),
                        body.outward(b, parent.turning),
                        body.outward(b, origin),
                    )
                }
                None if body.given => (zero, zero, zero),
                None if x.active => (zero, zero, body.outward(b, -b.vector(self.graph.gravity))),
                None => (zero, zero, zero),
            };
            let (mut own, mut rate) = (body.twist(b, &x.v), body.twist(b, &x.a));
            if let (true, Some(base)) = (body.given, &x.base) {
                own.angular = base.omega;
                (rate.angular, rate.linear) = (base.omega_dot, base.acceleration);
            }
            let angular = carried + own.angular;
            let turning = turning + carried.cross(own.angular) + rate.angular;
            // The columns are constant in axes that turn relative to the parent's.
            let coupled = match body.axial {
                true => carried + carried,
                false => carried + angular,
            };
            motions.push(BodyMotion {
                angular,
                turning,
                field: field(angular, turning),
                linear: origin + coupled.cross(own.linear) + rate.linear,
            });
        }
        motions
    }

    /// Returns the twist of each body relative to the base, in its own axes.
    pub(super) fn twists(&self, v: &[Expr<'g>]) -> Vec<Spatial<'g>> {
        let b = self.b;
        let mut twists: Vec<Spatial<'g>> = Vec::new();
        for body in &self.bodies {
            let own = body.twist(b, v);
            twists.push(match body.parent {
                Some(p) => {
                    let (angular, linear) = twists[p];
                    let origin = linear + angular.cross(body.position);
                    (
                        body.outward(b, angular) + own.angular,
                        body.outward(b, origin) + own.linear,
                    )
                }
                None => (own.angular, own.linear),
            });
        }
        twists
    }

    /// Returns T = ½ Σ (m v·v + 2 v·(ω × h) + ω·J ω) and the energy of the rotors.
    pub(super) fn kinetic_energy(&self, v: &[Expr<'g>]) -> Expr<'g> {
        let b = self.b;
        let mut twice = b.zero();
        for (body, (angular, linear)) in self.bodies.iter().zip(self.twists(v)) {
            let inertia = &body.inertia;
            let moved = angular.cross(inertia.first);
            let momentum = linear.scale(inertia.mass) + moved + moved;
            twice = twice + linear.dot(momentum) + angular.dot(inertia.tensor_times(angular));
            for &(j, h) in &body.rotors {
                let shared = angular.dot(h) * v[j];
                twice = twice + shared + shared;
            }
        }
        for rotor in &self.graph.rotors {
            let rate = v[rotor.coordinate.0];
            twice = twice + reflected(b, rotor) * rate * rate;
        }
        twice * Dd::from_f64(0.5)
    }
}

/// Returns [ω̇]× + [ω]×[ω]×.
fn field<'g>(omega: Vec3<Expr<'g>>, turning: Vec3<Expr<'g>>) -> Mat3<Expr<'g>> {
    let [x, y, z] = omega.0;
    let [dx, dy, dz] = turning.0;
    let (xx, yy, zz) = (x * x, y * y, z * z);
    let (xy, xz, yz) = (x * y, x * z, y * z);
    Mat3([
        [-(yy + zz), xy - dz, xz + dy],
        [xy + dz, -(xx + zz), yz - dx],
        [xz - dy, yz + dx, -(xx + yy)],
    ])
}

/// Returns ∫ s × U s dm, from the antisymmetric part of U D.
fn moment_of<'g>(u: Mat3<Expr<'g>>, d: Mat3<Expr<'g>>) -> Vec3<Expr<'g>> {
    let (u, d) = (u.0, d.0);
    let component = |i: usize| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        d[i][j] * u[k][i] - d[i][k] * u[j][i] + d[j][j] * u[k][j] - d[k][k] * u[j][k]
            + d[j][k] * (u[k][k] - u[j][j])
    };
    Vec3([component(0), component(1), component(2)])
}
