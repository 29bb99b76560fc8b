//! Which methods a mechanism can have, and why it does not have others.

use super::{
    Centroidal, ContactMethod, Directional, Method, Operational, ParameterDerivatives,
    PayloadRegressor, Regressor, TASK_DIRECTIONS,
};
use crate::bond_graph::{BondGraph, Site, SiteId};
use crate::fault::unknown_name;

impl Method {
    /// Returns every method that this mechanism can have.
    pub fn possible_of(graph: &BondGraph) -> Vec<Method> {
        let drives = graph.released.iter().map(|r| r.prescribed.len());
        let drives = drives.map(Method::DriveEfforts);
        let (own, of_sites): (Vec<_>, Vec<_>) = Method::possible(&graph.sites)
            .into_iter()
            .partition(|method| method.site().is_none());
        let regressors = Method::regressors_of(graph).unwrap_or_default();
        let own = own.into_iter().chain(drives).chain(regressors);
        let own = own.chain(Method::payload_of(graph));
        let own = own.chain(Method::operational_of(graph));
        let own = own.chain(Method::directional_of(graph).unwrap_or_default());
        let own = own.chain(Method::parameter_derivatives_of(graph));
        let own = own.chain(Method::centroidal_of(graph).unwrap_or_default());
        let own = own.chain(Method::mass_matrix_rate_of(graph).ok());
        let own = own.chain(Method::contact_of(graph).unwrap_or_default());
        let mut all: Vec<Method> = own.chain(of_sites).collect();
        let [inverse, forward] = Method::derivatives_of(graph);
        for method in &mut all {
            *method = match *method {
                Method::InverseDynamicsDerivatives => inverse,
                Method::ForwardDynamicsDerivatives => forward,
                other => other,
            };
        }
        if let Some(closed) = &graph.closed {
            all.extend(Method::of_closed(closed));
            all.extend(Method::ON_REQUEST);
            if let Some(actuated) = closed.closure.drives() {
                // Loads depend on where the drives are.
                all.retain(|m| !matches!(m, Method::Reactions | Method::JointReactions));
                all.extend(Method::of_actuated(closed));
                let number = actuated.joints.len();
                all.push(Method::ActuatedReactions(number));
                all.push(Method::ActuatedJointReactions(number));
            }
        }
        // Joints carry the loads of these loops, which no equation contains.
        all.retain(|method| graph.parallel.is_empty() || !method.loads_joints());
        all
    }

    /// Returns the regressors of a mechanism.
    ///
    /// # Errors
    /// Why it has none.
    pub fn regressors_of(graph: &BondGraph) -> Result<Vec<Method>, &'static str> {
        match (&graph.closed, &graph.released) {
            (Some(_), _) => Err(
                "a mechanism with loops, wheels or knife edges has no regressors; write its open tree as a file of its own, generate them there, and combine their rows by the `velocity_map`",
            ),
            (_, Some(_)) => Err(
                "a mechanism with prescribed joints has no regressors; write these joints as free ones in a file of its own, and generate them there",
            ),
            _ => Ok(Regressor::ALL.map(Method::Regressor).to_vec()),
        }
    }

    /// Returns every method that a mechanism without loops and prescribed joints can have.
    pub fn possible(sites: &[Site]) -> Vec<Method> {
        let own = [
            Method::CoriolisMatrix,
            Method::InverseDynamicsDerivatives,
            Method::ForwardDynamicsDerivatives,
            Method::JointReactions,
        ];
        let of_sites = (0..sites.len()).flat_map(|i| Method::of_site(SiteId(i)));
        Method::OF_TRAIT
            .into_iter()
            .chain(own)
            .chain(of_sites)
            .collect()
    }

    /// Returns the method with this name, if the mechanism can have it.
    ///
    /// # Errors
    /// A sentence with the nearest name, or with all names.
    pub fn named(graph: &BondGraph, name: &str) -> Result<Method, String> {
        let (possible, sites) = (Method::possible_of(graph), &graph.sites);
        let closed = graph.closed.as_deref();
        let own_name = |m: &Method| m.name_in(closed, sites);
        let found = possible.iter().find(|m| own_name(m) == name);
        found.copied().ok_or_else(|| {
            if let Some(why) = Method::why_without(graph, name) {
                return why;
            }
            let known: Vec<String> = possible.iter().map(own_name).collect();
            let known: Vec<&str> = known.iter().map(String::as_str).collect();
            let own = possible.iter().zip(&known).filter(|(m, _)| m.site().is_none());
            let own: Vec<&str> = own.map(|(_, name)| *name).collect();
            let places: Vec<&str> = sites.iter().map(|s| s.name.as_str()).collect();
            let all = format!(
                "{}; and pose_X, velocity_X, jacobian_world_X, jacobian_dot_v_world_X, operational_inverse_X, operational_inertia_X, consistent_inverse_X, operational_bias_X, payload_regressor_X, payload_adaptive_step_X for X = {}",
                own.join(", "),
                places.join(", ")
            );
            unknown_name("method", name, &known, &all)
        })
    }

    /// Returns why a mechanism does not have the method with this name, if others have it.
    fn why_without(graph: &BondGraph, name: &str) -> Option<String> {
        let closed = graph.closed.as_deref();
        without_multipliers(graph, name)
            .or_else(|| without_regressor(graph, name))
            .or_else(|| Method::without_payload(graph, name))
            .or_else(|| Method::without_task(graph, name))
            .or_else(|| Method::without_direction(graph, name))
            .or_else(|| Method::without_parameters(graph, name))
            .or_else(|| Method::without_momentum(graph, name))
            .or_else(|| Method::without_contacts(graph, name))
            .or_else(|| Method::lacking(closed?, name))
    }

    /// Returns the methods for payloads that a mechanism can have: at frames that joints move.
    fn payload_of(graph: &BondGraph) -> Vec<Method> {
        if Method::regressors_of(graph).is_err() {
            return Vec::new();
        }
        let sites = (0..graph.sites.len()).map(SiteId);
        let moves = |site: &SiteId| velocities_of(graph, *site) > 0;
        let of_sites = sites.filter(moves).flat_map(PayloadRegressor::of_site);
        of_sites.map(Method::Payload).collect()
    }

    /// Returns why a mechanism does not have this method of a frame, if it is one for payloads.
    fn without_payload(graph: &BondGraph, name: &str) -> Option<String> {
        let sites = (0..graph.sites.len()).map(SiteId);
        let mut of_sites = sites.flat_map(PayloadRegressor::of_site);
        of_sites.find(|of| Method::Payload(*of).name(&graph.sites) == name)?;
        let why = Method::regressors_of(graph).err();
        let why = why.unwrap_or("no joint moves this frame");
        Some(format!("`{name}`: {why}"))
    }

    /// Returns whether it has no result where a frame cannot move in some direction.
    pub fn inverts_task(self) -> bool {
        matches!(self, Method::Operational(of) if of.inverts_task())
    }

    /// Returns the methods of operational space that a mechanism can have. A frame has them only if joints move it, and an
    /// inertia only if they can move it in six directions.
    fn operational_of(graph: &BondGraph) -> Vec<Method> {
        let sites = (0..graph.sites.len()).map(SiteId);
        let mut all = vec![Operational::InverseMassMatrix];
        all.extend(sites.flat_map(|site| {
            let velocities = velocities_of(graph, site);
            let of_site = Operational::of_site(site).into_iter();
            of_site.filter(move |of| {
                velocities
                    >= if of.inverts_task() {
                        TASK_DIRECTIONS.len()
                    } else {
                        1
                    }
            })
        }));
        all.into_iter().map(Method::Operational).collect()
    }

    /// Returns why a mechanism does not have this method of a frame, if it is one of operational space.
    fn without_task(graph: &BondGraph, name: &str) -> Option<String> {
        let sites = (0..graph.sites.len()).map(SiteId);
        let named = |of: &Operational| Method::Operational(*of).name(&graph.sites) == name;
        let of = sites.flat_map(Operational::of_site).find(named)?;
        let velocities = velocities_of(graph, of.site()?);
        if velocities == 0 {
            return Some(format!("`{name}`: no joint moves this frame"));
        }
        (of.inverts_task() && velocities < TASK_DIRECTIONS.len()).then(|| {
            format!(
                "`{name}`: the mechanism moves this frame by {velocities} of its velocities, and a frame has an inertia only where it can move in six directions; `operational_inverse_X` is its inverse, of which you can invert the rows of your task"
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
    fn without_direction(graph: &BondGraph, name: &str) -> Option<String> {
        let known = Directional::ALL.iter().any(|of| of.name() == name);
        let why = Method::directional_of(graph).err().filter(|_| known)?;
        Some(format!("`{name}`: {why}"))
    }

    /// Returns whether it has columns or elements for parameters of the bodies.
    pub fn has_body_parameters(self) -> bool {
        matches!(
            self,
            Method::Regressor(_) | Method::ParameterDerivatives(ParameterDerivatives::Base)
        )
    }

    /// Returns the derivatives by parameters that a mechanism can have.
    fn parameter_derivatives_of(graph: &BondGraph) -> Vec<Method> {
        let all = ParameterDerivatives::all(graph.parameters.len()).into_iter();
        let all = all.filter(|&of| Method::lacks_parameters(graph, of).is_none());
        all.map(Method::ParameterDerivatives).collect()
    }

    /// Returns why a mechanism does not have this derivative by parameters.
    fn lacks_parameters(graph: &BondGraph, of: ParameterDerivatives) -> Option<&'static str> {
        match of {
            ParameterDerivatives::Base => Method::regressors_of(graph).err(),
            ParameterDerivatives::RunTime(0) => Some(
                "the mechanism has no run-time parameters; write a number as `{ parameter: NAME, value: NUMBER }`",
            ),
            ParameterDerivatives::RunTime(_) => None,
        }
    }

    /// Returns why a mechanism does not have the method with this name, if it is a derivative by parameters.
    fn without_parameters(graph: &BondGraph, name: &str) -> Option<String> {
        let mut all = ParameterDerivatives::all(graph.parameters.len()).into_iter();
        let of = all.find(|of| of.name() == name)?;
        let why = Method::lacks_parameters(graph, of)?;
        Some(format!("`{name}`: {why}"))
    }

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

    /// Returns the methods of the contacts of a mechanism.
    ///
    /// # Errors
    /// Why it has none.
    pub fn contact_of(graph: &BondGraph) -> Result<Vec<Method>, &'static str> {
        match graph.contacts.len() {
            0 => Err(
                "the mechanism has no contacts; write under `contacts` which spheres may touch planes or spheres",
            ),
            contacts => Ok(ContactMethod::all(contacts).map(Method::Contact).to_vec()),
        }
    }

    /// Returns why a mechanism does not have the method with this name, if it is one of contacts.
    fn without_contacts(graph: &BondGraph, name: &str) -> Option<String> {
        let known = ContactMethod::all(0).iter().any(|of| of.name() == name);
        let why = Method::contact_of(graph).err().filter(|_| known)?;
        Some(format!("`{name}`: {why}"))
    }

    /// Returns why a mechanism does not have the method with this name, if it is one of this file.
    fn without_momentum(graph: &BondGraph, name: &str) -> Option<String> {
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

/// Returns the number of velocities that may move a site; with loops, of all.
fn velocities_of(graph: &BondGraph, site: SiteId) -> usize {
    match graph.closed {
        Some(_) => graph.coordinates.len(),
        None => graph.velocities_of(&graph.sites[site.0]),
    }
}

/// Returns why a mechanism with a loop on its parallel branch does not have this method, if that is the reason: the
/// efforts of such a loop are in no equation, and it has no rows.
fn without_multipliers(graph: &BondGraph, name: &str) -> Option<String> {
    let closes = graph.parallel.first()?;
    let mut of_loops = (Method::OF_LOOPS.into_iter())
        .chain(Method::ON_REQUEST)
        .chain([Method::JointReactions]);
    let asked = of_loops.any(|method| method.name(&graph.sites) == name);
    asked.then(|| {
        format!(
            "`{name}`: the loop `{closes}` has no rows and no multipliers, because with `branch: parallel` it is closed by joints that follow; write `branch: left` or `branch: right`, or `near`, for the efforts that close it"
        )
    })
}

/// Returns why a mechanism does not have this regressor, if it is the name of one.
fn without_regressor(graph: &BondGraph, name: &str) -> Option<String> {
    let known = Regressor::ALL.iter().any(|of| of.name() == name);
    let why = Method::regressors_of(graph).err().filter(|_| known)?;
    Some(format!("`{name}`: {why}"))
}
