//! Poses, velocities and Jacobians of sites in the frames of the recursion.
//!
//! Groups of parallel axes have a common basis that does not rotate with them.

use bgdyn_runtime::Dd;

use super::frames::Frames;
use super::geometry::Geometry;
use super::joint_columns::{ColumnDirection, JointColumn};
use super::plan::Plan;
use crate::bond_graph::{Multibody, SiteId};
use crate::expr::{Builder, Expr, Graph, Signed, cost};
use crate::formulation::arguments::Arguments;
use crate::formulation::site::{JacobianColumn, SiteMotion};
use crate::function::Function;
use crate::math::{Mat3, Vec3};
use crate::mechanism::{LinkId, Pose};
use crate::method::Method;

/// Returns the cheaper one of the functions with and without groups.
pub(super) fn function(
    graph: &Multibody,
    geometry: &Geometry,
    method: Method,
    site: SiteId,
) -> Function {
    let of = |grouped| {
        let (made, outputs) = outputs(graph, geometry, method, site, grouped);
        let cost = cost(&made, &outputs);
        (cost.weighted(), made, outputs)
    };
    let (plain, grouped) = (of(false), of(true));
    let (name, best) = if grouped.0 < plain.0 {
        ("recursion: parallel axes grouped", grouped)
    } else {
        ("recursion: plain", plain)
    };
    Function::flat(graph, method, name.into(), best.1, best.2)
}

fn outputs(
    graph: &Multibody,
    geometry: &Geometry,
    method: Method,
    site: SiteId,
    grouped: bool,
) -> (Graph, Vec<Signed>) {
    let b = Builder::new();
    let outputs = {
        let x = Arguments::new(&b, graph, method);
        let frames = Frames::new(
            &b,
            graph,
            geometry,
            &Plan::of_kinematics(geometry, grouped),
            &x,
        );
        let motion = motion(&b, graph, geometry, &frames, site);
        motion
            .outputs(&b, graph, method, &x.v)
            .into_iter()
            .map(|e| e.signed())
            .collect()
    };
    (b.into_graph(), outputs)
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
        let twist = frame.twist.map(|x| b.constant(x));
        let (basis, origin) = match frame.parent {
            // The pose of the base enters here, and not in the dynamics.
            None => (twist, twist * (b.vector(body.offset) + frame.position)),
            Some(p) => {
                let parent = placed[p];
                let basis = if frame.continues {
                    parent.basis
                } else {
                    parent.own * twist
                };
                (basis, parent.origin + parent.own * frame.position_in_parent)
            }
        };
        let own = frame.turn.own_axes(&basis);
        placed.push(PlacedSite { basis, own, origin });
    }
    placed
}

/// Returns the body of a site, and its axes and origin in those of the body; in those of the world if no
/// joint moves it.
fn home(
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
