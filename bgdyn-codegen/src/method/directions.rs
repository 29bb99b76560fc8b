//! Which mechanisms have the methods of operational space, and derivatives along directions.

use super::{Directional, Method, Operational};
use crate::bond_graph::{BondGraph, SiteId};

/// The number of directions of a frame.
const DIRECTIONS: usize = 6;

impl Method {
    /// Returns whether it has no result where a frame cannot move in some direction.
    pub fn inverts_task(self) -> bool {
        matches!(self, Method::Operational(of) if of.inverts_task())
    }

    /// Returns the methods of operational space that a mechanism can have. A frame has them only if joints move it, and an
    /// inertia only if they can move it in six directions.
    pub(super) fn operational_of(graph: &BondGraph) -> Vec<Method> {
        let sites = (0..graph.sites.len()).map(SiteId);
        let mut all = vec![Operational::InverseMassMatrix];
        all.extend(sites.flat_map(|site| {
            let velocities = velocities_of(graph, site);
            let of_site = Operational::of_site(site).into_iter();
            of_site.filter(move |of| velocities >= if of.inverts_task() { DIRECTIONS } else { 1 })
        }));
        all.into_iter().map(Method::Operational).collect()
    }

    /// Returns why a mechanism does not have this method of a frame, if it is one of operational space.
    pub(super) fn without_task(graph: &BondGraph, name: &str) -> Option<String> {
        let sites = (0..graph.sites.len()).map(SiteId);
        let named = |of: &Operational| Method::Operational(*of).name(&graph.sites) == name;
        let of = sites.flat_map(Operational::of_site).find(named)?;
        let velocities = velocities_of(graph, of.site()?);
        if velocities == 0 {
            return Some(format!("`{name}`: no joint moves this frame"));
        }
        (of.inverts_task() && velocities < DIRECTIONS).then(|| {
            format!(
                "`{name}`: the mechanism moves this frame by {velocities} velocities, and a frame has an inertia only where it can move in six directions; `operational_inverse_X` is its inverse, of which you can invert the rows of your task"
            )
        })
    }

    /// Returns the derivatives along directions that a mechanism can have.
    ///
    /// # Errors
    /// Why it has none.
    pub fn directional_of(graph: &BondGraph) -> Result<Vec<Method>, &'static str> {
        let mut closed = graph.closed.iter();
        match closed.any(|closed| closed.closure.nonholonomic()) {
            true => Err(
                "where conditions on velocities alone leave more ways to move than velocities, there is no derivative along one direction; use `inverse_dynamics_derivatives` and `forward_dynamics_derivatives`",
            ),
            false => Ok(Directional::ALL.map(Method::Directional).to_vec()),
        }
    }

    /// Returns why a mechanism does not have this method, if it is a derivative along a direction.
    pub(super) fn without_direction(graph: &BondGraph, name: &str) -> Option<String> {
        let known = Directional::ALL.iter().any(|of| of.name() == name);
        let why = Method::directional_of(graph).err().filter(|_| known)?;
        Some(format!("`{name}`: {why}"))
    }
}

/// Returns the number of velocities that may move a site; with loops, of all.
fn velocities_of(graph: &BondGraph, site: SiteId) -> usize {
    match graph.closed {
        Some(_) => graph.coordinates.len(),
        None => graph.velocities_of(&graph.sites[site.0]),
    }
}
