//! Equation (6), literally: every term of the double sum, in fixed axes.
//!
//! P_j = Σ_i [ ∂r_i/∂q_j · (m_i r̈_i − R_i) + ρ_j^i · (K̇_i − M_i) ]
//!
//! All other formulations are verified against it. It follows the transformers of the bond graph one by
//! one and omits only structural zeros.

mod centroidal;
mod closed;
mod closing_loads;
mod coriolis;
mod regressor;
mod relative_poses;
mod sum;

use super::arguments::Arguments;
use super::{Formulation, Offer, Prepared, placed_sites, solve};
use crate::bond_graph::{LinkFrame, Multibody};
use crate::expr::{Builder, Expr};
use crate::function::Function;
use crate::method::{Method, Regressor};
use sum::LiteralSum;

pub(super) const NAME: &str = "literal";

/// The literal double sum.
pub(super) struct Literal;

impl Formulation for Literal {
    fn name(&self) -> &'static str {
        NAME
    }

    fn summary(&self) -> &'static str {
        "equation (6) term by term, in fixed axes"
    }

    /// Other regressors are combinations of these three.
    fn knows(&self, method: Method) -> bool {
        let known = [
            Regressor::Full,
            Regressor::PotentialEnergy,
            Regressor::Parameters,
        ];
        match method {
            Method::Regressor(regressor) => known.contains(&regressor),
            _ => !method.is_derived(),
        }
    }

    fn unserved<'a>(&self, _: &'a Multibody) -> Option<&'a LinkFrame> {
        None
    }

    fn serves_loops(&self) -> bool {
        true
    }

    /// The graph grows with the cube of the number of links.
    fn offer(&self, _: &Prepared<'_>, _: Method) -> Offer {
        Offer::Never
    }

    fn function(&self, prepared: &Prepared<'_>, method: Method) -> Option<Function> {
        let graph = prepared.graph;
        let b = Builder::new();
        let outputs = if let Some(closed) = &graph.closed {
            let outputs = closed::outputs(self, &b, (graph, closed), method)?;
            outputs.into_iter().map(|e: Expr<'_>| e.signed()).collect()
        } else {
            let arguments = Arguments::new(&b, graph, method);
            let sum = LiteralSum::new(&b, graph, &arguments.q);
            let outputs = match method {
                Method::InverseDynamics | Method::Bias | Method::Gravity => sum.efforts(&arguments),
                Method::MassMatrix => sum.mass_matrix().into_iter().flatten().collect(),
                Method::ForwardDynamics => {
                    let bias = sum.efforts(&arguments);
                    let mass = sum.mass_matrix();
                    let drive = arguments
                        .tau
                        .iter()
                        .zip(bias)
                        .map(|(&tau, h)| tau - h)
                        .collect();
                    solve::ltdl(&b, mass, drive)
                }
                Method::JointReactions => sum.joint_loads(&arguments, &[]),
                Method::CoriolisMatrix => sum.coriolis_matrix(&arguments),
                Method::Regressor(Regressor::Full) => sum.regressor(&arguments),
                Method::Regressor(Regressor::PotentialEnergy) => sum.potential_energy_regressor(),
                Method::Regressor(Regressor::Parameters) => sum.body_parameters(),
                Method::Centroidal(of) => sum.centroidal(of, &arguments),
                Method::MassMatrixRate => sum.mass_matrix_rate(&arguments.v),
                Method::KineticEnergy => vec![sum.kinetic_energy(&arguments.v)],
                Method::PotentialEnergy => vec![sum.potential_energy()],
                method => placed_sites::outputs(&b, graph, method, &arguments)?,
            };
            outputs.into_iter().map(|e: Expr<'_>| e.signed()).collect()
        };
        let name = NAME.into();
        Some(Function::flat(graph, method, name, b.into_graph(), outputs).in_order())
    }
}
