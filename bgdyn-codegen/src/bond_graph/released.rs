//! The bond graph of a mechanism in which the prescribed joints are free: its arguments, and its loads.

use super::{
    BondGraph, EffortSource, FreeArgument, JunctionId, PrescribedVelocity, Released, Rotor, Store,
};
use crate::mechanism::{CoordinateId, Joint, LinkId, Mechanism, Motion};

impl Released {
    /// Returns it for a mechanism with prescribed joints; `graph` is the graph of `free`.
    pub(super) fn new(mechanism: &Mechanism, free: &Mechanism, graph: BondGraph) -> Self {
        let own = mechanism.prescribed();
        let at = |link: &LinkId| own.iter().position(|p| p.link == *link);
        let prescribed = own.iter().map(|p| {
            let joint: &Joint = &free.links()[p.link.0].joint;
            PrescribedVelocity {
                name: joint.name.clone(),
                coordinate: joint.degrees.velocities[0],
                motion: p.motion,
                linear: joint.kind.motion == Motion::Translation,
            }
        });
        Released {
            prescribed: prescribed.collect(),
            positions: origins(free.positions(), at),
            velocities: origins(free.coordinates(), at),
            graph,
        }
    }

    /// Returns the velocities of this mechanism that are those of v, in their order.
    pub fn own_velocities(&self) -> Vec<usize> {
        let own = |k: &usize| matches!(self.velocities[*k], FreeArgument::Own(_));
        (0..self.velocities.len()).filter(own).collect()
    }
}

impl BondGraph {
    /// Gives the mechanism in which the prescribed joints are free the loads, stores and rotors of this one.
    pub fn update_released(&mut self) {
        let Some(mut released) = self.released.take() else {
            return;
        };
        let moved = released.velocities.len() - self.coordinates.len();
        // The junctions of the links follow those of the velocities.
        let junction = |own: JunctionId| JunctionId(own.0 + moved);
        let kept = released.own_velocities();
        let other = &mut released.graph;
        let of_store = |store: &Store| Store {
            junction: junction(store.junction),
            ..*store
        };
        other.stores = self.stores.iter().map(of_store).collect();
        let of_source = |source: &EffortSource| EffortSource {
            junction: junction(source.junction),
            efforts: source.efforts.clone(),
        };
        other.sources = self.sources.iter().map(of_source).collect();
        let of_rotor = |rotor: &Rotor| Rotor {
            coordinate: CoordinateId(kept[rotor.coordinate.0]),
            ..rotor.clone()
        };
        other.multibody.rotors = self.rotors.iter().map(of_rotor).collect();
        other.multibody.gravity = self.gravity;
        other.multibody.velocity_products = self.velocity_products;
        other.multibody.inertials = self.inertials.clone();
        other.multibody.parameters = self.parameters.clone();
        self.released = Some(released);
    }
}

/// Returns the origin of each component, by the links of its joints.
fn origins(links: &[LinkId], prescribed: impl Fn(&LinkId) -> Option<usize>) -> Vec<FreeArgument> {
    let mut next = 0;
    let origin = |link: &LinkId| match prescribed(link) {
        Some(k) => FreeArgument::Prescribed(k),
        None => {
            next += 1;
            FreeArgument::Own(next - 1)
        }
    };
    links.iter().map(origin).collect()
}
