//! Creates the recursion's expressions for a method, under one plan.

use super::frames::Frames;
use super::geometry::Geometry;
use super::motion::{GravityField, add_set_aside, motions};
use super::plan::Plan;
use super::{centroidal, derivatives, energies, inverse_dynamics, mass_matrix};
use crate::bond_graph::Multibody;
use crate::expr::{Builder, Expr, Graph, Signed};
use crate::formulation::arguments::Arguments;
use crate::formulation::solve;
use crate::method::Method;

/// Returns the method's expressions under a plan.
pub(super) fn outputs(
    b: Builder,
    graph: &Multibody,
    geometry: &Geometry,
    method: Method,
    plan: &Plan,
) -> (Graph, Vec<Signed>) {
    let outputs: Vec<Signed> = {
        let x = Arguments::new(&b, graph, method);
        let frames = Frames::new(&b, graph, geometry, plan, &x);
        let outputs = match method {
            Method::InverseDynamics | Method::Bias | Method::Gravity => {
                let moving = motions(&b, &frames, GravityField::Gravity);
                inverse_dynamics::efforts(&b, &frames, plan, &moving)
            }
            Method::MassMatrix => mass_matrix::mass_matrix(&b, &frames)
                .into_iter()
                .flatten()
                .collect(),
            Method::ForwardDynamics => forward_dynamics(&b, &frames, plan, &x.tau),
            Method::InverseDynamicsDerivatives => {
                let derivatives =
                    derivatives::effort_derivatives(&b, &frames, &plan.views, x.active);
                let rows = derivatives
                    .by_position
                    .into_iter()
                    .chain(derivatives.by_rate);
                rows.flatten().collect()
            }
            Method::CoriolisMatrix => {
                let rows = derivatives::coriolis_matrix(&b, &frames, &plan.views);
                rows.into_iter().flatten().collect()
            }
            Method::Centroidal(of) => {
                let bodies = (graph, geometry, plan);
                centroidal::outputs(&b, &frames, bodies, of, &x.v)
            }
            Method::KineticEnergy => vec![energies::kinetic_energy(&b, &frames)],
            Method::PotentialEnergy => vec![energies::potential_energy(&b, &frames)],
            other => unreachable!("{other:?} is no method of the recursion"),
        };
        outputs.into_iter().map(|e| e.signed()).collect()
    };
    (b.into_graph(), outputs)
}

/// Returns M⁻¹ (τ − h).
fn forward_dynamics<'g>(
    b: &'g Builder,
    frames: &Frames<'g>,
    plan: &Plan,
    tau: &[Expr<'g>],
) -> Vec<Expr<'g>> {
    let moving = motions(b, frames, GravityField::SetAside);
    let bias = inverse_dynamics::efforts(b, frames, plan, &moving);
    let drive = tau.iter().zip(bias).map(|(&tau, h)| tau - h).collect();
    let mass = mass_matrix::mass_matrix(b, frames);
    let first = if plan.linear_first {
        frames.translations()
    } else {
        Vec::new()
    };
    let mut found = solve::ltdl_after(b, mass, drive, &first);
    add_set_aside(frames, &moving, &mut found);
    found
}

/// Returns the lower triangle of M, row by row, and h, in one graph.
pub(crate) fn mass_and_bias(graph: &Multibody, geometry: &Geometry) -> (Graph, Vec<Signed>) {
    let (b, plan) = (Builder::silent(), &Plan::of_kinematics(geometry, true));
    let outputs: Vec<Signed> = {
        let x = Arguments::new(&b, graph, Method::ForwardDynamics);
        let frames = Frames::new(&b, graph, geometry, plan, &x);
        let rows = mass_matrix::mass_matrix(&b, &frames).into_iter().flatten();
        let moving = motions(&b, &frames, GravityField::Gravity);
        let bias = inverse_dynamics::efforts(&b, &frames, plan, &moving);
        rows.chain(bias).map(|e| e.signed()).collect()
    };
    (b.into_graph(), outputs)
}
