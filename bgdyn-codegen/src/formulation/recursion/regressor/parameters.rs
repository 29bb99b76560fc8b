//! The parameters of the bodies, the base parameters of any parameters, and their names.

use bgdyn_runtime::{Dd, Digits};

use super::super::base_parameters::point;
use super::super::geometry::Geometry;
use super::super::inertia::BodyInertia;
use super::base_parameter::{BaseParameter, CoefficientRow, bodies};
use crate::bond_graph::Multibody;
use crate::expr::{Builder, Expr, Leaf};
use crate::formulation::Prepared;
use crate::formulation::arguments::value;
use crate::method::{PARAMETER_NAMES, PARAMETERS_PER_BODY};

/// Returns π: for each body the sum over its links, about the origin and in the axes of the first.
pub(super) fn of_bodies<'g>(
    b: &'g Builder,
    graph: &Multibody,
    geometry: &Geometry,
) -> Vec<Expr<'g>> {
    let of = |body: usize| {
        let mut sum = BodyInertia::zero(b);
        for (link, pose) in &geometry.bodies[body].links {
            let inertial = graph.inertial(*link);
            let tensor = inertial.inertia;
            let entries = tensor.entries.map(|x| value(b, x));
            let about_com = BodyInertia::of_tensor(b, entries);
            sum = sum
                .plus(&BodyInertia::of_point(b, &point(b, &inertial, pose)))
                .plus(&about_com.rotated(b, pose.rotation * tensor.axes));
        }
        let [x, y, z] = sum.first.0;
        let [[xx, xy, xz], [_, yy, yz], [_, _, zz]] = sum.tensor().0;
        [sum.mass, x, y, z, xx, xy, yy, xz, yz, zz]
    };
    bodies(graph, geometry).into_iter().flat_map(of).collect()
}

/// Returns K π for the argument π.
pub(super) fn base<'g>(b: &'g Builder, parameters: &[BaseParameter]) -> Vec<Expr<'g>> {
    let of = |parameter: &BaseParameter| {
        let row = parameter.row.iter();
        row.fold(b.zero(), |sum, (&k, &factor)| {
            sum + b.leaf(Leaf::Input(k)) * factor
        })
    };
    parameters.iter().map(of).collect()
}

/// Returns the base parameters as formulas of the parameters of the bodies, like `forearm.Ixx − 0.5 tool.m`.
pub(crate) fn base_parameter_formulas(prepared: &Prepared<'_>) -> Vec<String> {
    let graph = prepared.graph;
    let bodies: Vec<&str> = (graph.moving_links().iter())
        .map(|link| graph.frames[link.0].name.as_str())
        .collect();
    let parameters = prepared.base_parameters().parameters.iter();
    let named = parameters.map(|p| formula(&p.row, &bodies));
    named.collect()
}

/// Returns a row of K as a formula, with six digits.
fn formula(row: &CoefficientRow, bodies: &[&str]) -> String {
    let mut text = String::new();
    for (&k, &factor) in row {
        let (body, name) = (
            bodies[k / PARAMETERS_PER_BODY],
            PARAMETER_NAMES[k % PARAMETERS_PER_BODY],
        );
        let negative = factor < Dd::ZERO;
        text += match (text.is_empty(), negative) {
            (true, false) => "",
            (true, true) => "−",
            (false, false) => " + ",
            (false, true) => " − ",
        };
        let size = factor.to_f64().abs();
        if size != 1.0 {
            text += &format!("{} ", Digits::new(size, 6));
        }
        text += &format!("{body}.{name}");
    }
    text
}
