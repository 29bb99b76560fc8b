//! The contacts of a mechanism.

use super::{ContactPair, LinkId, Mechanism};

impl Mechanism {
    /// Returns the pairs that may touch, in the file's order.
    pub fn contact_pairs(&self) -> &[ContactPair] {
        &self.contact_pairs
    }

    /// Returns the pair with this name.
    pub fn contact_pair(&self, name: &str) -> Option<&ContactPair> {
        self.contact_pairs.iter().find(|pair| pair.name == name)
    }

    /// Returns the names of the links of the pair with this name, without the world.
    pub fn contact_links(&self, name: &str) -> Vec<&str> {
        let pair = self.contact_pair(name).into_iter();
        let links = pair.flat_map(|pair| [pair.sphere.link, pair.partner.link()]);
        let named = |LinkId(i): LinkId| self.links[i].name.as_str();
        links.flatten().map(named).collect()
    }
}
