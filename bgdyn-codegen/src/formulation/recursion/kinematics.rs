//! Poses, velocities and Jacobians of sites in the frames of the recursion.
//!
//! Groups of parallel axes have a common basis that does not rotate with them.

use bgdyn_runtime::Dd;

use super::frames::Frames;
use super::geometry::Geometry;
use super::joint_columns::{ColumnDirection, JointColumn};
use super::motion::{GravityField, motions};
use super::plan::Plan;
use crate::bond_graph::{Multibody, SiteId};
use crate::expr::{Builder, Expr, Graph, Signed};
use crate::formulation::arguments::Arguments;
use crate::formulation::site::{JacobianColumn, SiteMotion};
use crate::function::Function;
use crate::math::{Mat3, Vec3};
use crate::mechanism::{LinkId, Pose};
use crate::method::Method;

/// How the motion of a site is computed.
#[derive(Clone, Copy, PartialEq)]
enum MotionSource {
    /// From its Jacobian, in world axes.
    Jacobian,
    /// From the motion of its body, in the axes of the body: J̇ v only.
    Body,
}

/// Returns the cheaper one of the functions with and without groups; of J̇ v from the motion of the body, if that costs
/// less. Sums of angles, which only the other one has, do not count then.
pub(super) fn function(
    graph: &Multibody,
    geometry: &Geometry,
    method: Method,
    site: SiteId,
) -> Function {
    let of = |source, grouped, name: &str| {
        let (made, outputs) = outputs(graph, geometry, (method, site), grouped, source);
        Function::flat(graph, method, format!("recursion: {name}"), made, outputs)
    };
    let cheaper = |plain: Function, grouped: Function| match grouped.cost().weighted()
        < plain.cost().weighted()
    {
        true => grouped,
        false => plain,
    };
    let (jacobian, body) = (MotionSource::Jacobian, MotionSource::Body);
    let usual = cheaper(
        of(jacobian, false, "plain"),
        of(jacobian, true, "parallel axes grouped"),
    );
    if !matches!(method, Method::JacobianDotV(_)) {
        return usual;
    }
    let other = cheaper(
        of(body, false, "in body axes, plain"),
        of(body, true, "in body axes, parallel axes grouped"),
    );
    let cost = |function: &Function| function.cost().unfinished().weighted();
    match cost(&other) < cost(&usual) {
        true => other,
        false => usual,
    }
}

fn outputs(
    graph: &Multibody,
    geometry: &Geometry,
    (method, site): (Method, SiteId),
    grouped: bool,
    source: MotionSource,
) -> (Graph, Vec<Signed>) {
    let b = Builder::new();
    let outputs = {
        let x = Arguments::new(&b, graph, method);
        let plan = Plan::of_kinematics(geometry, grouped);
        let frames = Frames::new(&b, graph, geometry, &plan, &x);
        let outputs = match source {
            MotionSource::Jacobian => {
                let motion = motion(&b, graph, geometry, &frames, site);
                motion.outputs(&b, graph, method, &x.v)
            }
            MotionSource::Body => {
                let motion = (&frames, &plan, GravityField::Zero);
                acceleration((&b, graph, geometry), &frames, motion, site)
            }
        };
        outputs.into_iter().map(|e| e.signed()).collect()
    };
    (b.into_graph(), outputs)
}

/// Returns functions for J̇ v that share the motion of the bodies with a method that is computed under this plan.
pub(super) fn sharing(
    graph: &Multibody,
    geometry: &Geometry,
    site: SiteId,
    plan: &Plan,
) -> Vec<Function> {
    let method = Method::JacobianDotV(site);
    let of = |grouped| {
        let b = Builder::new();
        let outputs: Vec<Signed> = {
            let x = Arguments::new(&b, graph, method);
            let poses = Plan::of_kinematics(geometry, grouped);
            let poses = Frames::new(&b, graph, geometry, &poses, &x);
            let frames = Frames::new(&b, graph, geometry, plan, &x);
            let made = acceleration(
                (&b, graph, geometry),
                &poses,
                (&frames, plan, GravityField::Gravity),
                site,
            );
            made.into_iter().map(|e| e.signed()).collect()
        };
        let name = "recursion: in body axes, with the motion of other methods";
        Function::flat(graph, method, name.into(), b.into_graph(), outputs)
    };
    vec![of(false), of(true)]
}

/// Returns the acceleration of a site for the accelerations in `frames`, angular part first, in world axes: from ω̇, U
/// and the acceleration a of its body's origin, in the axes of the body, R ω̇ and R (a + U p), with gravity added where
/// a has it subtracted. `poses` are frames in metres with the origins of the spec.
fn acceleration<'g>(
    (b, graph, geometry): (&'g Builder, &Multibody, &Geometry),
    poses: &Frames<'g>,
    (frames, plan, field): (&Frames<'g>, &Plan, GravityField),
    site: SiteId,
) -> Vec<Expr<'g>> {
    let site = &graph.sites[site.0];
    let (body, (_, mut p)) = home(geometry, site.link, &site.pose);
    let Some(body) = body else {
        return vec![b.zero(); 6];
    };
    let moving = motions(b, frames, field);
    let placed = placed(b, geometry, poses);
    b.section(|| format!("{}: its acceleration in the world", site.name));
    // The origin and the axes of the plan.
    p.0[2] -= plan.slides[body];
    let (c, s) = frames.bodies[body].aim;
    let zero = Dd::ZERO;
    let aim = Mat3([[c, -s, zero], [s, c, zero], [zero, zero, Dd::ONE]]);
    let p = (aim.transpose() * p).scale(Dd::ONE / plan.unit);
    let (moving, axes) = (&moving[body], placed[body].own);
    let aim = aim.map(|x| b.constant(x));
    let linear = aim * (moving.a_own + moving.own.u * b.vector(p));
    let mut linear = axes * linear.map(|x| x * plan.unit);
    if field != GravityField::Zero {
        linear = linear + b.vector(graph.gravity);
    }
    let angular = axes * (aim * moving.own.omega_dot);
    angular.0.into_iter().chain(linear.0).collect()
}

/// World pose of a body: its basis, its own axes, its origin.
#[derive(Clone, Copy)]
struct PlacedSite<'g> {
    basis: Mat3<Expr<'g>>,
    own: Mat3<Expr<'g>>,
    origin: Vec3<Expr<'g>>,
}

fn motion<'g>(
    b: &'g Builder,
    graph: &Multibody,
    geometry: &Geometry,
    frames: &Frames<'g>,
    site: SiteId,
) -> SiteMotion<'g> {
    let placed = placed(b, geometry, frames);
    let site = &graph.sites[site.0];
    b.section(|| format!("{}: its axes and place in the world", site.name));
    let n = graph.coordinates.len();
    let mut columns: Vec<Option<JacobianColumn<'g>>> = vec![None; n];
    let (body, in_body) = home(geometry, site.link, &site.pose);
    let (rotation, origin) = in_body;
    let (mut rotation, mut origin) = (rotation.map(|x| b.constant(x)), b.vector(origin));
    if let Some(body) = body {
        rotation = placed[body].own * rotation;
        origin = placed[body].origin + placed[body].own * origin;
    }
    let mut on_path = body;
    while let Some(j) = on_path {
        let frame = &frames.bodies[j];
        for column in &frame.columns {
            let own = jacobian_column(b, column, frame.axial, &placed[j], origin);
            let entry = &mut columns[column.coordinate];
            *entry = Some(match entry.take() {
                Some(other) => JacobianColumn {
                    angular: other.angular + own.angular,
                    linear: other.linear + own.linear,
                },
                None => own,
            });
        }
        on_path = frame.parent;
    }
    SiteMotion {
        rotation,
        origin,
        columns,
    }
}

/// Returns the velocity of a site at `origin` per unit velocity of a column.
fn jacobian_column<'g>(
    b: &'g Builder,
    column: &JointColumn,
    axial: bool,
    placed: &PlacedSite<'g>,
    origin: Vec3<Expr<'g>>,
) -> JacobianColumn<'g> {
    let axes = if axial { &placed.basis } else { &placed.own };
    let axis = |k: usize| {
        let axis = axes.column(k);
        let signed = if column.effort < Dd::ZERO {
            -axis
        } else {
            axis
        };
        signed.map(|x| x * column.effort.abs())
    };
    let about = |k: usize| (axis(k), axis(k).cross(origin - placed.origin));
    let (angular, linear) = match column.direction {
        ColumnDirection::About(k) => about(k),
        ColumnDirection::Along(k) => (Vec3([b.zero(); 3]), axis(k)),
        ColumnDirection::Screw(pitch) => {
            let (angular, linear) = about(2);
            (angular, linear + axis(2).map(|x| x * pitch))
        }
    };
    JacobianColumn { angular, linear }
}

fn placed<'g>(b: &'g Builder, geometry: &Geometry, frames: &Frames<'g>) -> Vec<PlacedSite<'g>> {
    let mut placed: Vec<PlacedSite<'g>> = Vec::new();
    for (body, frame) in geometry.bodies.iter().zip(&frames.bodies) {
        b.section(|| format!("{}: its axes and origin in the world", frame.name));
        let parent = frame.parent.map(|p| placed[p]);
        let basis = frame.basis_in_world(b, parent.as_ref().map(|p| (&p.basis, &p.own)));
        let origin = match parent {
            // The pose of the base enters here, and not in the dynamics.
            None => basis * (b.vector(body.offset) + frame.position),
            Some(parent) => parent.origin + parent.own * frame.position_in_parent,
        };
        let own = frame.turn.own_axes(&basis);
        placed.push(PlacedSite { basis, own, origin });
    }
    placed
}

/// Returns the body of a site, and its axes and origin in those of the body; in those of the world if no
/// joint moves it.
pub(super) fn home(
    geometry: &Geometry,
    link: Option<LinkId>,
    pose: &Pose,
) -> (Option<usize>, (Mat3<Dd>, Vec3<Dd>)) {
    let still = (pose.rotation, pose.translation);
    let Some(link) = link else {
        return (None, still);
    };
    let within = |outer: &Pose| {
        let p = outer.translation + outer.rotation * pose.translation;
        (outer.rotation * pose.rotation, p)
    };
    for (j, body) in geometry.bodies.iter().enumerate() {
        if let Some((_, outer)) = body.links.iter().find(|(l, _)| *l == link) {
            let (rotation, p) = within(outer);
            let back = body.axes.transpose();
            return (Some(j), (back * rotation, back * p));
        }
    }
    match geometry.fixed.iter().find(|(l, _)| *l == link) {
        Some((_, outer)) => (None, within(outer)),
        None => (None, still),
    }
}
