//! The centre of mass, from first moments summed from the tips.

use bgdyn_runtime::Dd;

use super::super::energies::sum_first_moments;
use super::super::frames::Frames;
use super::super::geometry::Geometry;
use super::super::plan::Plan;
use crate::bond_graph::Multibody;
use crate::expr::{Builder, Expr};
use crate::formulation::arguments::value;
use crate::math::Vec3;
use crate::mechanism::LinkId;

/// A body on the base with all it carries.
struct Root<'g> {
    /// The body.
    body: usize,
    /// m, kg.
    mass: Expr<'g>,
    /// Σ m s about its origin, in the axes of its basis, units of the plan.
    first: Vec3<Expr<'g>>,
    /// The same in own axes, if all are given in these.
    own: Option<Vec3<Expr<'g>>>,
    /// Its origin in the world, m.
    origin: Vec3<Expr<'g>>,
}

/// The masses of a mechanism.
pub(super) struct Masses<'g> {
    roots: Vec<Root<'g>>,
    /// 1/Σ m, 1/kg.
    pub per_mass: Expr<'g>,
    /// The unit of length of the plan, m.
    unit: Dd,
}

impl<'g> Masses<'g> {
    /// Sums masses and first moments.
    pub fn new(
        b: &'g Builder,
        frames: &Frames<'g>,
        (graph, geometry, plan): (&Multibody, &Geometry, &Plan),
    ) -> Self {
        let mut roots: Vec<Root<'g>> = Vec::new();
        sum_first_moments(b, frames, |body, frame, [inner, outer, whole]| {
            if frame.parent.is_some() {
                return;
            }
            // The first moment that base parameters moved to the base is constant there, on the axes of the joint.
            let twist = frame.twist.map(|x| b.constant(x));
            let on_base = twist.transpose() * frames.on_base[body].map(|h| h * plan.unit);
            let own = &geometry.bodies[body];
            let mut origin = own.offset;
            origin.0[2] += plan.slides[body];
            let moved = frame.position.map(|x| x * plan.unit);
            roots.push(Root {
                body,
                mass: mass_carried(b, graph, geometry, body),
                first: whole.first + on_base,
                own: is_zero(&outer.first).then(|| inner.first + frame.turn.apply_back(on_base)),
                origin: twist * (b.vector(origin) + moved),
            });
        });
        roots.reverse();
        let total = roots.iter().fold(b.zero(), |sum, root| sum + root.mass);
        Masses {
            roots,
            per_mass: b.number(1.0) / total,
            unit: plan.unit,
        }
    }

    /// Returns the centre of mass in the world, m.
    pub fn centre(&self, b: &'g Builder, frames: &Frames<'g>) -> Vec3<Expr<'g>> {
        b.section(|| "the centre of mass".into());
        let turned = |root: &Root<'g>| {
            let twist = frames.bodies[root.body].twist.map(|x| b.constant(x));
            twist * root.first
        };
        let per_unit = Dd::ONE / self.unit;
        if let [root] = &self.roots[..] {
            let arm = root.first.scale(self.per_mass * per_unit);
            let twist = frames.bodies[root.body].twist.map(|x| b.constant(x));
            return root.origin + twist * arm;
        }
        let roots = self.roots.iter();
        let zero = Vec3([b.zero(); 3]);
        let first = roots.fold(zero, |sum, root| {
            let own = turned(root).map(|x| x * per_unit);
            sum + root.origin.scale(root.mass) + own
        });
        first.scale(self.per_mass)
    }

    /// Returns, for each body on the base, the centre of mass about its origin, units of the plan.
    pub fn arms(&self, b: &'g Builder, frames: &Frames<'g>) -> Vec<RootArm<'g>> {
        let per_unit = Dd::ONE / self.unit;
        if let [root] = &self.roots[..] {
            let scale = self.per_mass * (per_unit * per_unit);
            return vec![RootArm {
                body: root.body,
                basis: root.first.scale(scale),
                own: root.own.map(|first| first.scale(scale)),
            }];
        }
        let centre = self.centre(b, frames);
        let of = |root: &Root<'g>| {
            let back = frames.bodies[root.body].twist.transpose();
            let arm = back.map(|x| b.constant(x)) * (centre - root.origin);
            RootArm {
                body: root.body,
                basis: arm.map(|x| x * per_unit),
                own: None,
            }
        };
        self.roots.iter().map(of).collect()
    }
}

/// The centre of mass about the origin of a body on the base, units of the plan.
pub(super) struct RootArm<'g> {
    /// The body.
    pub body: usize,
    /// In the axes of its basis.
    pub basis: Vec3<Expr<'g>>,
    /// In its own axes, where it need not be rotated to these.
    pub own: Option<Vec3<Expr<'g>>>,
}

/// Returns whether a vector is zero at generation time.
pub(super) fn is_zero(v: &Vec3<Expr<'_>>) -> bool {
    v.0.iter().all(|x| x.is_zero())
}

/// Returns the mass of a body and of all it carries, as the spec has it.
fn mass_carried<'g>(
    b: &'g Builder,
    graph: &Multibody,
    geometry: &Geometry,
    root: usize,
) -> Expr<'g> {
    let mut carried = vec![false; geometry.bodies.len()];
    let mut mass = b.zero();
    for (j, body) in geometry.bodies.iter().enumerate() {
        carried[j] = j == root || body.parent.is_some_and(|p| carried[p]);
        let links = body.links.iter().filter(|_| carried[j]);
        let masses = links.map(|&(link, _): &(LinkId, _)| value(b, graph.inertial(link).mass));
        mass = masses.fold(mass, |sum, m| sum + m);
    }
    mass
}
