//! Finds elements without influence: no joint moves their site in a direction in which they act.

use super::SceneEquations;
use crate::bond_graph::PortSite;
use crate::declaration::Element;
use crate::expr::Builder;

impl SceneEquations {
    /// Returns the elements that act at a site of a link, but exchange no power in any state: the Jacobian
    /// of the site is zero in the directions in which they act. Elements whose numbers are all zero are
    /// omitted.
    pub fn idle(&self) -> Vec<&Element> {
        let b = Builder::silent();
        let sums = self.effort_sums(&b);
        let elements = self.scene.elements.iter().zip(sums.balances()).enumerate();
        let idle = elements.filter(|(at, (element, balance))| {
            let powers = [balance.supplied, balance.stored, balance.dissipated];
            let mut numbers = element.quantities().peekable();
            let is_off = numbers.peek().is_some() && numbers.all(|(_, q)| q.value.to_f64() == 0.0);
            let mut rigid = sums.rigid_contacts().iter();
            let touches = rigid.any(|contact| contact.element == *at);
            self.acts_at_site(*at)
                && !touches
                && powers.iter().all(|power| power.is_zero())
                && !is_off
        });
        idle.map(|(_, (element, _))| element).collect()
    }

    /// Returns whether the element with this index has a node on the flow of a site of a link.
    fn acts_at_site(&self, element: usize) -> bool {
        let network = &self.network;
        let mut sites = network.ports.iter();
        sites.any(|port| {
            let mut bonds = network.bonds_at(port.junction);
            let is_own = |node: usize| network.nodes[node].element == Some(element);
            matches!(port.site, PortSite::Site(_) | PortSite::Contact(_))
                && bonds.any(|(_, bond)| is_own(bond.other(port.junction).0))
        })
    }
}
