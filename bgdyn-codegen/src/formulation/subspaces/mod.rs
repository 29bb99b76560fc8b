//! The recursion over motion subspaces, in link axes: it serves every joint type.
//!
//! Each joint has a constant motion subspace in link axes (Featherstone 2008, chapter 4): the columns s_k,
//! one for each velocity. Velocities and accelerations are computed outward, forces and momenta inward
//! (Newton–Euler, composite rigid bodies). Links that are welded together are one body.
//!
//! | file | computes |
//! |---|---|
//! | `bodies.rs` | the bodies: pose in the parent body, columns, inertia |
//! | `inertia.rs` | mass, first moment and pseudo-inertia of a body |
//! | `dynamics.rs` | velocities and accelerations outward, efforts inward, kinetic energy |
//! | `mass_matrix.rs` | the mass matrix from the momenta of composite bodies, and potential energy |
//! | `spatial.rs` | spatial vectors and 6×6 matrices |
//! | `loads.rs` | loads through joints, and those of loops and contacts along their chains |
//! | `coriolis.rs` | the Coriolis matrix |

mod bodies;
mod coriolis;
mod dynamics;
mod inertia;
mod loads;
mod mass_matrix;
mod spatial;

use super::arguments::Arguments;
use super::{Formulation, Offer, Prepared, placed_sites, solve};
use crate::bond_graph::{LinkFrame, Multibody};
use crate::expr::{Builder, Expr, Graph, Signed};
use crate::function::Function;
use crate::method::Method;
use bodies::Bodies;
pub(super) use dynamics::JointLoad;
pub(super) use loads::{ChainLoad, add_chain_loads};

/// The recursion over motion subspaces.
pub(super) struct Subspaces;

impl Formulation for Subspaces {
    fn name(&self) -> &'static str {
        "subspaces"
    }

    fn summary(&self) -> &'static str {
        "link axes, motion subspaces of joints of any type, composite bodies"
    }

    fn unserved<'a>(&self, _: &'a Multibody) -> Option<&'a LinkFrame> {
        None
    }

    fn knows(&self, method: Method) -> bool {
        !method.differentiates_dynamics()
            && !matches!(method, Method::Scene(_))
            && !method.is_derived()
    }

    /// For rotations and translations alone the recursion with base parameters costs less; it does not know the loads
    /// through joints, because base parameters move masses between links.
    fn offer(&self, prepared: &Prepared<'_>, method: Method) -> Offer {
        match prepared.graph.plain() && method != Method::JointReactions {
            true => Offer::Never,
            false => Offer::Candidate,
        }
    }

    fn function(&self, prepared: &Prepared<'_>, method: Method) -> Option<Function> {
        let graph: &Multibody = prepared.graph;
        let b = Builder::new();
        let outputs: Vec<Signed> = {
            let x = Arguments::new(&b, graph, method);
            let outputs = match method {
                method if method.placed_site().is_some() => {
                    placed_sites::outputs(&b, graph, method, &x)?
                }
                method => outputs(&b, graph, method, &x)?,
            };
            outputs.into_iter().map(Expr::signed).collect()
        };
        let name = self.name().into();
        Some(Function::flat(graph, method, name, b.into_graph(), outputs))
    }
}

fn outputs<'g>(
    b: &'g Builder,
    graph: &Multibody,
    method: Method,
    x: &Arguments<'g>,
) -> Option<Vec<Expr<'g>>> {
    if method == Method::JointReactions {
        return Some(loads::joint_loads(b, graph, x));
    }
    let bodies = Bodies::new(b, graph, &x.q);
    Some(match method {
        Method::InverseDynamics | Method::Bias | Method::Gravity => bodies.efforts(x),
        Method::MassMatrix => bodies.mass_matrix().into_iter().flatten().collect(),
        Method::ForwardDynamics => {
            let bias = bodies.efforts(x);
            let drive = x.tau.iter().zip(bias).map(|(&tau, h)| tau - h).collect();
            solve::ltdl(b, bodies.mass_matrix(), drive)
        }
        Method::KineticEnergy => vec![bodies.kinetic_energy(&x.v)],
        Method::PotentialEnergy => vec![bodies.potential_energy()],
        Method::CoriolisMatrix => bodies.coriolis_matrix(x),
        _ => return None,
    })
}

/// Returns the expressions of the mass matrix, its lower triangle, and then of the bias.
pub(crate) fn mass_and_bias(graph: &Multibody) -> (Graph, Vec<Signed>) {
    let b = Builder::new();
    let outputs = {
        let x = Arguments::new(&b, graph, Method::Bias);
        let bodies = Bodies::new(&b, graph, &x.q);
        let mass = bodies.mass_matrix().into_iter().flatten();
        let all: Vec<Expr<'_>> = mass.chain(bodies.efforts(&x)).collect();
        all.into_iter().map(Expr::signed).collect()
    };
    (b.into_graph(), outputs)
}
