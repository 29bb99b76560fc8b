//! What an SDF has and a mechanism does not: counted, or refused.

use crate::import::groups::Groups;
use crate::import::tally::Tally;
use crate::import::xml::{At, Element, fault};
use anyhow::Result;

/// Collects what is left out, and what is refused.
#[derive(Default)]
pub(super) struct SdfReport {
    pub(super) groups: Groups,
    elements: Tally,
    refused: Vec<(At, String)>,
}

impl SdfReport {
    /// Counts the elements directly inside one that are not in the list.
    pub(super) fn children(&mut self, element: &Element, read: &[&str]) {
        for child in &element.children {
            if !read.contains(&child.name.as_str()) {
                let what = format!("`<{}>` in `<{}>`", child.name, element.name);
                self.elements.count(what, child.count("mesh"));
            }
        }
    }

    /// Notes something without which the mechanism would be wrong.
    pub(super) fn refuse(&mut self, at: At, what: String) {
        self.refused.push((at, what));
    }

    /// Returns one error for everything that was refused.
    pub(super) fn check(&self) -> Result<()> {
        let Some((at, _)) = self.refused.first() else {
            return Ok(());
        };
        let all: Vec<&str> = self.refused.iter().map(|(_, what)| what.as_str()).collect();
        Err(fault(*at, all.join("; ")))
    }

    /// Returns the warnings.
    pub(super) fn lines(self) -> Vec<String> {
        self.groups.lines().chain(self.elements.lines()).collect()
    }
}
