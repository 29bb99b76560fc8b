//! Base parameters: the combinations π_b = K π of the parameters of the bodies that efforts depend on.
//!
//! The transport rules of [`super::super::base_parameters`] move what a parent moves alike to the parent. They are exact,
//! but know nothing of what the joints before can do: what is left may still have columns that are zero or depend on
//! others (a first joint with a vertical axis, groups of parallel axes). These are found from columns at random states
//! in double-double, from the base to the tips; the coefficients become entries of K.

use bgdyn_runtime::Dd;

use super::super::base_parameters::take_to_parent;
use super::super::geometry::{Body, Geometry};
use super::super::inertia::BodyInertia;
use super::super::plan::Plan;
use super::base_parameter::{BaseParameter, CoefficientRow, InertiaEntry, bodies};
use super::columns::{Columns, GivenMotion};
use super::independent::independent;
use super::sample::random_states;
use super::wrenches::ENTRIES;
use crate::bond_graph::Multibody;
use crate::expr::{Builder, Inputs, Signed, evaluate};
use crate::math::Vec3;
use crate::method::{Method, PARAMETERS_PER_BODY, Regressor};

/// A coefficient below this size is the rounding error of a zero.
const NOISE: f64 = 1e-24;

/// The base parameters of a mechanism.
#[derive(Clone, Debug)]
pub(in crate::formulation) struct BaseParameters {
    /// In order, from the base to the tips.
    pub parameters: Vec<BaseParameter>,
}

impl BaseParameters {
    /// Finds the base parameters.
    pub(in crate::formulation) fn new(graph: &Multibody, geometry: &Geometry) -> Self {
        let plan = Plan::of_kinematics(geometry, false);
        let candidates = transported(graph, geometry, &plan);
        let columns = sampled_columns(graph, geometry, &plan, &candidates);
        let mut parameters: Vec<Option<BaseParameter>> = candidates.into_iter().map(Some).collect();
        for (dropped, coefficients) in independent(&columns).dependent {
            let Some(of) = parameters[dropped].take() else {
                continue;
            };
            for (kept, factor) in coefficients {
                if let Some(parameter) = &mut parameters[kept] {
                    add(&mut parameter.row, &of.row, factor);
                }
            }
        }
        let mut parameters: Vec<BaseParameter> = parameters.into_iter().flatten().collect();
        parameters.iter_mut().for_each(BaseParameter::turn);
        BaseParameters { parameters }
    }
}

/// Adds a multiple of a row.
fn add(sum: &mut CoefficientRow, other: &CoefficientRow, factor: Dd) {
    for (&k, &x) in other {
        let entry = sum.entry(k).or_insert(Dd::ZERO);
        *entry += x * factor;
    }
    sum.retain(|_, x| x.to_f64().abs() > NOISE);
}

/// Returns what the transport rules leave in each body: entries that are not zero, those with equal rows together.
fn transported(graph: &Multibody, geometry: &Geometry, plan: &Plan) -> Vec<BaseParameter> {
    let mut rows = vec![[const { CoefficientRow::new() }; ENTRIES]; geometry.bodies.len()];
    for (of, body) in bodies(graph, geometry).into_iter().enumerate() {
        for p in 0..PARAMETERS_PER_BODY {
            let column = of * PARAMETERS_PER_BODY + p;
            transport(graph, geometry, plan, (body, p), |entry, x| {
                rows[entry.body][entry.index].insert(column, x);
            });
        }
    }
    let mut found: Vec<BaseParameter> = Vec::new();
    for (body, rows) in rows.into_iter().enumerate() {
        let start = found.len();
        for (index, row) in rows.into_iter().enumerate().filter(|(_, r)| !r.is_empty()) {
            let entry = InertiaEntry { body, index };
            match found[start..].iter_mut().find(|other| other.row == row) {
                Some(other) => other.entries.push(entry),
                None => found.push(BaseParameter {
                    entries: vec![entry],
                    negative: false,
                    row,
                }),
            }
        }
    }
    found
}

/// Moves a one in the place of a parameter inboard, and calls `keep` for all that remains in each body.
fn transport(
    graph: &Multibody,
    geometry: &Geometry,
    plan: &Plan,
    (body, parameter): (usize, usize),
    mut keep: impl FnMut(InertiaEntry, Dd),
) {
    let b = Builder::silent();
    let mut at = Some(body);
    let mut inertia = one(&b, &geometry.bodies[body], plan.slides[body], parameter);
    while let Some(j) = at {
        let moved = take_to_parent(&b, graph, geometry, (plan, j), &mut inertia);
        for (index, x) in inertia.entries().into_iter().enumerate() {
            match x.as_constant() {
                Some(x) if x.to_f64().abs() > NOISE => keep(InertiaEntry { body: j, index }, x),
                _ => {}
            }
        }
        inertia = moved;
        at = geometry.bodies[j].parent;
    }
}

/// Returns the inertia of a one in the place of a parameter of a link, about the origin and in the axes of its body.
fn one<'g>(b: &'g Builder, body: &Body, slide: Dd, parameter: usize) -> BodyInertia<'g> {
    let unit = b.number(1.0);
    let mut inertia = BodyInertia::zero(b);
    // The order of π is xx, xy, yy, xz, yz, zz; that of tensors is xx, yy, zz, xy, xz, yz.
    const TENSOR: [usize; 6] = [0, 3, 1, 4, 5, 2];
    match parameter {
        0 => (inertia.mass, inertia.axial) = (unit, unit),
        1..=3 => inertia.first.0[parameter - 1] = unit,
        _ => {
            let mut tensor = [b.zero(); 6];
            tensor[TENSOR[parameter - 4]] = unit;
            inertia = BodyInertia::of_tensor(b, tensor);
        }
    }
    let shift = Vec3([b.zero(), b.zero(), b.constant(-slide)]);
    inertia.rotated(b, body.axes.transpose()).shifted(shift)
}

/// Returns the columns of these parameters at random states, one below the other.
fn sampled_columns(
    graph: &Multibody,
    geometry: &Geometry,
    plan: &Plan,
    candidates: &[BaseParameter],
) -> Vec<Vec<Dd>> {
    let rows = graph.coordinates.len();
    let b = Builder::silent();
    let outputs: Vec<Signed> = {
        let method = Method::Regressor(Regressor::Base);
        let columns = Columns::new(&b, graph, geometry, plan, method);
        let made = columns.matrix(GivenMotion::Given, candidates);
        made.into_iter().map(|e| e.signed()).collect()
    };
    let made = b.into_graph();
    let mut columns: Vec<Vec<Dd>> = vec![Vec::new(); candidates.len()];
    // Twice as many rows as columns, and some more.
    let states = 2 * candidates.len() / rows.max(1) + 8;
    for state in random_states(graph, states) {
        let state: Inputs<Dd> = state;
        let values = evaluate(&made, &outputs, &state, &mut None);
        for (k, value) in values.into_iter().enumerate() {
            columns[k % candidates.len()].push(value);
        }
    }
    columns
}
