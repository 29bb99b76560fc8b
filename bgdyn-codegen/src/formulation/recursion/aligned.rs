//! Where joints are aligned: the positions at which a mass matrix comes closest to losing rank.

use bgdyn_runtime::Dd;

use super::geometry::{Body, angle_of, geometry};
use crate::bond_graph::BondGraph;
use crate::math::Vec3;
use crate::mechanism::{Motion, Value};

/// For each rotation that another joint carries, the position at which the common normals with the
/// axes before and after it have one direction (θ = 0 of Denavit and Hartenberg). There, and every
/// quarter turn from there, the neighbouring axes are as close to parallel as they come, and the
/// arm is stretched or folded. At a tip the centre of mass takes the place of the next axis.
/// Nothing for joints on the base, whose position M does not depend on.
pub(in crate::formulation) fn in_line(graph: &BondGraph) -> Vec<Option<Dd>> {
    let geometry = geometry(graph);
    let bodies = geometry.bodies.iter();
    bodies
        .map(|body| {
            if body.motion != Motion::Rotation || body.parent.is_none() {
                return None;
            }
            let mut start = angle_of(body.phase);
            if body.free_x {
                let [x, y, _] = first_moment(graph, body).0;
                start += Dd::from_f64(f64::atan2(y.to_f64(), x.to_f64()));
            }
            Some(if body.opposite { start } else { -start })
        })
        .collect()
}

/// m r of a body in its axes, run-time parameters as the spec has them.
fn first_moment(graph: &BondGraph, body: &Body) -> Vec3<Dd> {
    let number = |x: Value| match x {
        Value::Fixed(x) => x,
        Value::Parameter(p) => graph.parameters[p.0].default,
    };
    let mut sum = Vec3([Dd::ZERO; 3]);
    for (link, place) in &body.links {
        let inertial = graph.inertial(*link);
        let r = place.translation + place.rotation * inertial.com.map(number);
        sum = sum + r.scale(number(inertial.mass));
    }
    body.axes.transpose() * sum
}
