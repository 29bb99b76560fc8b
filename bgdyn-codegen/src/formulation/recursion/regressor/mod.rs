//! Regressors: columns of the wrenches that ones in the places of a body's parameters need.
//!
//! | file | computes |
//! |---|---|
//! | `wrenches.rs` | the wrench of each parameter of a body: entries of U and a |
//! | `directions.rs` | the directions in which coordinates move the bodies, carried outwards |
//! | `two_velocities.rs` | the motion of the bodies with two velocities |
//! | `columns.rs` | the columns: products of directions and wrenches |
//! | `transported.rs` | the columns of all parameters, some as sums of columns of the parent |
//! | `base.rs`, `base_parameter.rs` | the base parameters π_b = K π |
//! | `independent.rs`, `sample.rs` | which columns are independent at random states |
//! | `payload.rs` | those of a payload at a frame |
//! | `gravity.rs` | potential energy by parameters |
//! | `parameters.rs` | π of the mechanism, K π, names |

mod base;
mod base_parameter;
mod columns;
mod directions;
mod gravity;
mod independent;
mod parameters;
mod payload;
mod sample;
mod transported;
mod two_velocities;
mod wrenches;

pub(in crate::formulation) use base::BaseParameters;
pub(crate) use parameters::base_parameter_formulas;

use super::plan::Plan;
use crate::bond_graph::{LinkFrame, Multibody};
use crate::expr::{Builder, Expr, Signed, evaluate};
use crate::formulation::{Formulation, Offer, Prepared};
use crate::function::Function;
use crate::method::{Method, PayloadRegressor, Regressor};
use columns::{Columns, GivenMotion};
use sample::random_states;

/// Number of states at which an output that is always zero is found.
const STATES: usize = 4;

/// A sum below this is the rounding error of a zero in double-double.
const ZERO: f64 = 1e-24;

/// The columns of regressors.
pub(in crate::formulation) struct ParameterColumns;

impl Formulation for ParameterColumns {
    fn name(&self) -> &'static str {
        "parameter_columns"
    }

    fn summary(&self) -> &'static str {
        "regressors from the wrenches of each parameter, link axes, with directions carried outwards"
    }

    fn knows(&self, method: Method) -> bool {
        matches!(method, Method::Regressor(_) | Method::Payload(_))
    }

    fn unserved<'a>(&self, _: &'a Multibody) -> Option<&'a LinkFrame> {
        None
    }

    fn offer(&self, _: &Prepared<'_>, _: Method) -> Offer {
        Offer::Candidate
    }

    fn function(&self, prepared: &Prepared<'_>, method: Method) -> Option<Function> {
        let regressor = match method {
            Method::Regressor(regressor) => regressor,
            Method::Payload(of) => return self.of_payload(prepared, of),
            _ => return None,
        };
        let graph = prepared.graph;
        let of = |transport: bool| {
            let b = Builder::new();
            let outputs: Vec<Signed> = {
                let made = outputs(&b, prepared, regressor, transport);
                made.into_iter().map(|e| e.signed()).collect()
            };
            let outputs = without_hidden_zeros(&b, graph, regressor, outputs);
            let name = match transport {
                true => format!("{}: some from those of the parent", self.name()),
                false => self.name().into(),
            };
            Function::flat(graph, method, name, b.into_graph(), outputs)
        };
        let plain = of(false);
        if !matches!(
            regressor,
            Regressor::Full | Regressor::Gravity | Regressor::Momentum
        ) {
            return Some(plain);
        }
        let transported = of(true);
        let cheaper = transported.cost().weighted() < plain.cost().weighted();
        Some(if cheaper { transported } else { plain })
    }
}

impl ParameterColumns {
    fn of_payload(&self, prepared: &Prepared<'_>, of: PayloadRegressor) -> Option<Function> {
        let (graph, geometry) = (prepared.graph, prepared.geometry());
        let (b, method) = (Builder::new(), Method::Payload(of));
        let outputs: Vec<Signed> = {
            let plan = Plan::of_kinematics(geometry, false);
            let columns = Columns::new(&b, graph, geometry, &plan, method);
            let made = payload::outputs(&columns, of)?;
            made.into_iter().map(Expr::signed).collect()
        };
        let outputs = with_exact_zeros(&b, graph, outputs);
        let name = self.name().into();
        Some(Function::flat(graph, method, name, b.into_graph(), outputs))
    }
}

/// Returns the outputs with a zero in place of each sum that is zero at random states, like the effort of gravity about a
/// vertical axis.
fn without_hidden_zeros(
    b: &Builder,
    graph: &Multibody,
    regressor: Regressor,
    outputs: Vec<Signed>,
) -> Vec<Signed> {
    if regressor.arguments().is_empty() || regressor == Regressor::BaseParameters {
        return outputs;
    }
    with_exact_zeros(b, graph, outputs)
}

/// Returns the outputs with a zero in place of each one that is zero at random states: of a sum, like the effort of
/// gravity about a vertical axis, rounding errors would be left.
fn with_exact_zeros(b: &Builder, graph: &Multibody, outputs: Vec<Signed>) -> Vec<Signed> {
    let mut largest = vec![0.0_f64; outputs.len()];
    for state in random_states(graph, STATES) {
        let values = b.with_graph(|graph| evaluate(graph, &outputs, &state, &mut None));
        for (most, value) in largest.iter_mut().zip(values) {
            *most = most.max(value.to_f64().abs());
        }
    }
    let zero = b.zero().signed();
    let pairs = outputs.into_iter().zip(largest);
    pairs
        .map(|(output, size)| if size < ZERO { zero } else { output })
        .collect()
}

fn outputs<'g>(
    b: &'g Builder,
    prepared: &Prepared<'_>,
    regressor: Regressor,
    transport: bool,
) -> Vec<Expr<'g>> {
    let (graph, geometry) = (prepared.graph, prepared.geometry());
    let plan = Plan::of_kinematics(geometry, false);
    let columns = || Columns::new(b, graph, geometry, &plan, Method::Regressor(regressor));
    let whole = |motion| match transport {
        true => columns().whole_transported(motion, &plan),
        false => columns().whole(motion),
    };
    let base = || &prepared.base_parameters().parameters[..];
    match regressor {
        Regressor::Full | Regressor::Gravity => whole(GivenMotion::Given),
        Regressor::Momentum => whole(GivenMotion::Momentum),
        Regressor::Base | Regressor::BaseGravity => columns().matrix(GivenMotion::Given, base()),
        Regressor::Adaptive => columns().matrix(GivenMotion::TwoVelocities, base()),
        Regressor::BaseMomentum => columns().matrix(GivenMotion::Momentum, base()),
        Regressor::AdaptiveStep => columns().transposed_times(GivenMotion::TwoVelocities, base()),
        Regressor::TransposedTimes => columns().transposed_times(GivenMotion::Given, base()),
        Regressor::KineticEnergy => columns().kinetic_energies(),
        Regressor::PotentialEnergy => columns().potential_energies(),
        Regressor::Parameters => parameters::of_bodies(b, graph, geometry),
        Regressor::BaseParameters => parameters::base(b, base()),
    }
}
