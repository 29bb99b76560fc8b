//! Regressors: columns of the wrenches that ones in the places of a body's parameters need.
//!
//! | file | computes |
//! |---|---|
//! | `wrenches.rs` | the wrench of each parameter of a body: entries of U and a |
//! | `directions.rs` | the directions in which coordinates move the bodies, carried outwards |
//! | `two_velocities.rs` | the motion of the bodies with two velocities |
//! | `columns.rs` | the columns: products of directions and wrenches |
//! | `transported.rs` | the columns of all parameters, some as sums of columns of the parent |
//! | `base.rs` | the base parameters π_b = K π |
//! | `independent.rs`, `sample.rs` | which columns are independent at random states |
//! | `gravity.rs` | potential energy by parameters |
//! | `parameters.rs` | π of the mechanism, K π, names |

mod base;
mod columns;
mod directions;
mod gravity;
mod independent;
mod parameters;
mod sample;
mod transported;
mod two_velocities;
mod wrenches;

pub(in crate::formulation) use base::BaseParameters;
pub(crate) use parameters::base_parameter_formulas;

use super::plan::Plan;
use crate::bond_graph::{LinkFrame, Multibody};
use crate::expr::{Builder, Expr, Signed};
use crate::formulation::{Formulation, Offer, Prepared};
use crate::function::Function;
use crate::method::{Method, Regressor};
use columns::{Columns, Motion};

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
        matches!(method, Method::Regressor(_))
    }

    fn unserved<'a>(&self, _: &'a Multibody) -> Option<&'a LinkFrame> {
        None
    }

    fn offer(&self, _: &Prepared<'_>, _: Method) -> Offer {
        Offer::Candidate
    }

    fn function(&self, prepared: &Prepared<'_>, method: Method) -> Option<Function> {
        let Method::Regressor(regressor) = method else {
            return None;
        };
        let graph = prepared.graph;
        let of = |transport: bool| {
            let b = Builder::new();
            let outputs: Vec<Signed> = {
                let made = outputs(&b, prepared, regressor, transport);
                made.into_iter().map(|e| e.signed()).collect()
            };
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
        Regressor::Full | Regressor::Gravity => whole(Motion::Given),
        Regressor::Momentum => whole(Motion::Momentum),
        Regressor::Base | Regressor::BaseGravity => columns().matrix(Motion::Given, base()),
        Regressor::Adaptive => columns().matrix(Motion::TwoVelocities, base()),
        Regressor::BaseMomentum => columns().matrix(Motion::Momentum, base()),
        Regressor::AdaptiveStep => columns().transposed_times(Motion::TwoVelocities, base()),
        Regressor::TransposedTimes => columns().transposed_times(Motion::Given, base()),
        Regressor::KineticEnergy => columns().kinetic_energies(),
        Regressor::PotentialEnergy => columns().potential_energies(),
        Regressor::Parameters => parameters::of_bodies(b, graph, geometry),
        Regressor::BaseParameters => parameters::base(b, base()),
    }
}
