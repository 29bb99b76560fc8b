//! Assigns names to nodes and numbers, titles and units to sections. No pass depends on them.

use std::collections::btree_map::Entry;

use bgdyn_runtime::Dd;

use super::graph::Graph;
use super::naming::{Name, Section, Title};
use super::node::{Constant, Node, NodeId, Signed};

impl Graph {
    /// Returns the name that a formulation gave to a node, for readers of the output.
    pub fn name(&self, id: NodeId) -> Option<&Name> {
        self.names.get(&id)
    }

    /// Names an expression, unless its node has a name.
    pub(crate) fn set_name(&mut self, e: Signed, text: impl FnOnce() -> String) {
        if !matches!(self.node(e.node), Node::Constant(_) | Node::Leaf(_)) {
            let named = || Name {
                text: text(),
                negative: e.negative,
                contents: None,
            };
            self.names.entry(e.node).or_insert_with(named);
        }
    }

    /// Names a number, unless it has a name. With `alone`, the name is removed if several quantities have
    /// the value. Numbers in equations have no names.
    pub(crate) fn set_constant_name(&mut self, x: Dd, text: impl FnOnce() -> String, alone: bool) {
        let negative = x < Dd::ZERO;
        let size = if negative { -x } else { x };
        if [0.0, 0.5, 1.0, 2.0].contains(&size.hi()) && size.lo() == 0.0 {
            return;
        }
        let text = text();
        let name = Name {
            text,
            negative,
            contents: None,
        };
        match self.constant_names.entry(Constant::new(size)) {
            Entry::Vacant(place) => {
                place.insert(Some(name));
            }
            Entry::Occupied(mut place) => {
                let is_alike = |known: &Name| known.is_alike(&name);
                if alone && !place.get().as_ref().is_some_and(is_alike) {
                    place.insert(None);
                }
            }
        }
    }

    /// Sets what a named number is the sum of.
    pub(crate) fn set_constant_contents(&mut self, x: Dd, contents: String) {
        let size = if x < Dd::ZERO { -x } else { x };
        if let Some(Some(name)) = self.constant_names.get_mut(&Constant::new(size)) {
            name.contents = Some(contents);
        }
    }

    /// Returns the name of a nonnegative number.
    pub fn constant_name(&self, x: Dd) -> Option<&Name> {
        self.constant_names.get(&Constant::new(x))?.as_ref()
    }

    /// Gives `copy` the name of the node `id` of another graph.
    pub(crate) fn copy_name(&mut self, copy: Signed, from: &Graph, id: NodeId) {
        if let Some(name) = from.name(id) {
            self.set_name(copy.flipped(name.negative), || name.text.clone());
        }
    }

    /// Returns the title of the section in which a node was created.
    pub fn section(&self, id: NodeId) -> Option<&str> {
        let section = self.sections[id.0 as usize] as usize;
        section.checked_sub(1).map(|i| self.titles[i].text.as_str())
    }

    /// Returns the unit of length, m, of the section in which a node was created, if it is set.
    pub fn unit_of_length(&self, id: NodeId) -> Option<Dd> {
        let section = self.sections[id.0 as usize] as usize;
        section.checked_sub(1).and_then(|i| self.titles[i].unit)
    }

    /// Sets the unit of length of the following sections, m.
    pub(crate) fn set_unit_of_length(&mut self, unit: Dd) {
        self.unit = Some(unit);
    }

    /// Begins a section with this title.
    pub(crate) fn begin_section(&mut self, title: String) {
        let unit = self.unit;
        self.titles.push(Title { text: title, unit });
        self.open = self.titles.len() as Section;
    }

    /// Copies another graph's titles. The result is the offset for [`Graph::reopen_section`].
    pub(crate) fn adopt_sections(&mut self, from: &Graph) -> Section {
        let offset = self.titles.len() as Section;
        self.titles.extend(from.titles.iter().cloned());
        for (constant, name) in &from.constant_names {
            let kept = self.constant_names.entry(*constant);
            let kept = kept.or_insert_with(|| name.clone());
            let is_alike = match (kept.as_ref(), name) {
                (Some(kept), Some(name)) => kept.is_alike(name),
                (kept, name) => kept.is_none() && name.is_none(),
            };
            if !is_alike {
                *kept = None;
            }
        }
        offset
    }

    /// Opens the section in which `id` of `from` was created; `offset` is that of its copied titles.
    pub(crate) fn reopen_section(&mut self, from: &Graph, id: NodeId, offset: Section) {
        let section = from.sections[id.0 as usize];
        self.open = if section == 0 { 0 } else { section + offset };
    }
}
