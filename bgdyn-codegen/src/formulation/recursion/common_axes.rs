//! Mass matrix with all momenta and all joint axes expressed in the axes of the first body.
//!
//! As in [`super::mass_matrix`] a unit rate of joint k gives its composite body a linear and an angular
//! momentum (l_k, L_k). In that file they are transformed to the base joint by joint, with a rotation and
//! a shift for every entry of M. Here every joint's axis is computed once, as the axis z_j and the
//! velocity w_j = o_j × z_j that it gives to the common origin, every momentum is transformed to the
//! origin once, and an entry is a sum of two products:
//!
//! M_kj = z_j · L_k + w_j · l_k  (prismatic joint: w_j = z_j, and no angular part)
//!
//! The entries of a long chain then cost 11 operations each instead of about 32, for some 90 more per
//! body. In an arm with parallel or perpendicular axes the joint-by-joint method is cheaper.
//!
//! The axes are those of the first body and not of the world, so that its joint's axis is (0, 0, 1) and
//! its angle is not read. Both methods are counted before factoring and the cheaper one is created: this
//! one for about 13 or more links in general position.

use super::frames::{BodyFrame, Frames};
use super::geometry::Geometry;
use super::mass_matrix::{Momentum, composites};
use super::plan::Plan;
use super::plan_search::{self, BestPlan};
use super::plans::cheapest_plans;
use crate::bond_graph::Multibody;
use crate::expr::{self, Builder, Expr, Graph, Signed};
use crate::formulation::arguments::Arguments;
use crate::formulation::{Formulation, Offer, Prepared};
use crate::function::Function;
use crate::math::{Mat3, Vec3};
use crate::mechanism::Motion;
use crate::method::Method;

const METHOD: Method = Method::MassMatrix;

/// The mass matrix in common axes.
pub(in crate::formulation) struct CommonAxes;

impl Formulation for CommonAxes {
    fn name(&self) -> &'static str {
        "common_axes"
    }

    fn summary(&self) -> &'static str {
        "mass matrix by composite bodies, momenta and joint axes in the axes of the first body"
    }

    fn knows(&self, method: Method) -> bool {
        method == METHOD
    }

    /// In place of the joint-by-joint method if it costs less before factoring.
    fn offer(&self, prepared: &Prepared<'_>, method: Method) -> Offer {
        let Some(best) = plans(prepared, method) else {
            return Offer::Never;
        };
        let joint_by_joint = cheapest_plans(prepared, METHOD).cost();
        match best.cost().weighted() < joint_by_joint.weighted() {
            true => Offer::Instead(None),
            false => Offer::Never,
        }
    }

    fn function(&self, prepared: &Prepared<'_>, method: Method) -> Option<Function> {
        let (graph, geometry) = (prepared.graph, prepared.geometry());
        let best = plans(prepared, method)?;
        let plan = best.taken();
        let (made, entries) = outputs(Builder::new(), graph, geometry, plan);
        let name = format!("{}: {}", self.name(), plan_search::describe(geometry, plan));
        Some(Function::flat(graph, METHOD, name, made, entries))
    }
}

/// Returns the best plans of the joint-by-joint method, which has the same composite bodies; the cheapest
/// one for this method first. `None` with a rotor that rotates with a body: it gives momentum to some of
/// the inboard bodies, not to all.
fn plans(prepared: &Prepared<'_>, method: Method) -> Option<BestPlan> {
    let graph = prepared.graph;
    let coupled = graph.rotors.iter().any(|r| r.carrier.is_some());
    if method != METHOD || coupled || !graph.plain() {
        return None;
    }
    let mut best = cheapest_plans(prepared, METHOD);
    for tried in &mut best.plans {
        let (made, entries) = outputs(Builder::silent(), graph, prepared.geometry(), &tried.plan);
        tried.cost = expr::cost(&made, &entries).unfinished();
    }
    best.plans.sort_by_key(|tried| tried.cost.weighted());
    Some(best)
}

/// Returns the entries of the lower triangle under a plan, row by row.
fn outputs(
    b: Builder,
    graph: &Multibody,
    geometry: &Geometry,
    plan: &Plan,
) -> (Graph, Vec<Signed>) {
    let entries: Vec<Signed> = {
        let x = Arguments::new(&b, graph, METHOD);
        let frames = Frames::new(&b, graph, geometry, plan, &x);
        let rows = mass_matrix(&b, &frames);
        rows.into_iter().flatten().map(|e| e.signed()).collect()
    };
    (b.into_graph(), entries)
}

/// Returns the lower triangle of M.
fn mass_matrix<'g>(b: &'g Builder, frames: &Frames<'g>) -> Vec<Vec<Expr<'g>>> {
    let placed = placed(b, frames);
    let axes: Vec<Axis<'g>> = (frames.bodies.iter().zip(&placed))
        .map(|(frame, axes)| axis(b, frame, axes))
        .collect();
    let units = composites(b, frames).into_iter().flatten();
    let units: Vec<Momentum<'g>> = units.collect();
    let momenta = units.iter().zip(&placed).map(|(unit, axes)| {
        let frame = &frames.bodies[unit.joint];
        b.section(|| format!("{}: momentum in common axes", frame.name));
        let turned = unit.map(|v| (axes.basis * v).map(|x| x * frame.effort));
        turned.carried(axes.origin)
    });
    let momenta: Vec<Momentum<'g>> = momenta.collect();
    let rows = units.iter().zip(&momenta);
    rows.map(|(unit, momentum)| {
        let k = unit.joint;
        let frame = &frames.bodies[k];
        b.section(|| format!("row of `{}`", frame.joint));
        let mut row = vec![b.zero(); k + 1];
        let diagonal = unit.along(&frame.columns[0]) * (frame.effort * frame.effort);
        row[k] = (diagonal + frames.rotors.armature(k))
            .named(|| format!("m_{}_{}", frame.joint, frame.joint));
        let mut inwards = frame.parent;
        while let Some(j) = inwards {
            let other = &frames.bodies[j];
            row[j] = axes[j]
                .along(momentum)
                .named(|| format!("m_{}_{}", other.joint, frame.joint));
            inwards = other.parent;
        }
        row
    })
    .collect()
}

/// A body in common axes: the axes of its basis, and its origin.
struct PlacedAxis<'g> {
    basis: Mat3<Expr<'g>>,
    own: Mat3<Expr<'g>>,
    origin: Vec3<Expr<'g>>,
}

/// Returns all bodies in the axes of the first one of their tree, from its origin.
fn placed<'g>(b: &'g Builder, frames: &Frames<'g>) -> Vec<PlacedAxis<'g>> {
    let unit = Mat3::from_fn(|i, j| if i == j { b.number(1.0) } else { b.zero() });
    let mut placed: Vec<PlacedAxis<'g>> = Vec::new();
    for frame in &frames.bodies {
        b.section(|| format!("{}: its axes and origin", frame.name));
        let rows_turned =
            |m: &Mat3<Expr<'g>>| Mat3(m.0.map(|row| frame.turn.apply_back(Vec3(row)).0));
        let axes = match frame.parent {
            None => PlacedAxis {
                basis: rows_turned(&unit).transpose(),
                own: unit,
                origin: Vec3([b.zero(); 3]),
            },
            Some(p) => {
                let parent = &placed[p];
                let basis = if frame.continues {
                    parent.basis
                } else {
                    parent.own * frame.twist.map(|x| b.constant(x))
                };
                PlacedAxis {
                    own: rows_turned(&basis),
                    origin: parent.origin + basis * frame.position,
                    basis,
                }
            }
        };
        placed.push(axes);
    }
    placed
}

/// The velocities of everything outboard of a joint at a unit rate: the angular velocity, and the velocity
/// at the common origin.
struct Axis<'g> {
    angular: Vec3<Expr<'g>>,
    linear: Vec3<Expr<'g>>,
}

/// Returns the axis of a joint from the pose of its body; forces along it count as efforts.
fn axis<'g>(b: &'g Builder, frame: &BodyFrame<'g>, axes: &PlacedAxis<'g>) -> Axis<'g> {
    b.section(|| format!("`{}`: its axis", frame.joint));
    let z = axes.basis.column(2).map(|x| x * frame.effort);
    match frame.motion {
        Motion::Rotation => Axis {
            angular: z,
            linear: axes.origin.cross(z),
        },
        _ => Axis {
            angular: Vec3([b.zero(); 3]),
            linear: z,
        },
    }
}

impl<'g> Axis<'g> {
    /// Returns z · L + w · l, one product after the other.
    fn along(&self, momentum: &Momentum<'g>) -> Expr<'g> {
        let pairs = self.linear.0.into_iter().zip(momentum.linear.0);
        let start = self.angular.dot(momentum.angular);
        pairs.fold(start, |sum, (w, l)| sum + w * l)
    }
}
