//! Which mechanisms have centroidal methods and the rate of the mass matrix.

use super::{Centroidal, Method};
use crate::bond_graph::BondGraph;

impl Method {
    /// Returns the centroidal methods of a mechanism.
    ///
    /// # Errors
    /// Why it has none.
    pub fn centroidal_of(graph: &BondGraph) -> Result<Vec<Method>, &'static str> {
        let bodies = graph.closed.as_ref().map_or(graph, |closed| &closed.tree);
        match bodies.moves_mass() {
            true => Ok(Centroidal::ALL.map(Method::Centroidal).to_vec()),
            false => Err(
                "no link that a joint moves has a mass, so that there is no centre of mass; write `mass` for at least one of them",
            ),
        }
    }

    /// Returns the rate of the mass matrix.
    ///
    /// # Errors
    /// Why a mechanism does not have it.
    pub fn mass_matrix_rate_of(graph: &BondGraph) -> Result<Method, &'static str> {
        match graph.released {
            None => Ok(Method::MassMatrixRate),
            Some(_) => Err(
                "the mass matrix also changes along the motion of the prescribed joints; `coriolis_matrix` returns C with C + Cᵀ = Ṁ + ∂M/∂t",
            ),
        }
    }

    /// Returns why a mechanism does not have the method with this name, if it is one of this file.
    pub(super) fn without_momentum(graph: &BondGraph, name: &str) -> Option<String> {
        let centroidal = Centroidal::ALL.iter().any(|of| of.name() == name);
        let why = match name {
            _ if centroidal => Method::centroidal_of(graph).err(),
            _ if name == Method::MassMatrixRate.name(&[]) => {
                Method::mass_matrix_rate_of(graph).err()
            }
            _ => None,
        };
        Some(format!("`{name}`: {}", why?))
    }
}
