//! Checks the tree of links and sorts them, parents before children.

use std::collections::BTreeMap;

use crate::fault::{Faults, wording};
use crate::format::{Field, FrameSpec, LinkSpec, Located};
use crate::mechanism::LinkId;
use crate::name::WORLD;

/// The parent of a link or frame, by its index in the file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Carrier {
    /// The fixed base.
    World,
    /// The link with this index in the file.
    Link(usize),
    /// Unknown; a fault was reported.
    Unknown,
}

/// The links as a tree.
#[derive(Debug)]
pub(super) struct LinkTree<'s> {
    /// Indices in the file, parents before children, otherwise in the file's order.
    pub(super) sequence: Vec<usize>,
    /// For each index in the file the index in the sequence.
    rank: Vec<usize>,
    carriers: Vec<Carrier>,
    by_name: BTreeMap<&'s str, usize>,
    names: Vec<&'s str>,
    frames: Vec<&'s str>,
}

impl<'s> LinkTree<'s> {
    /// Finds every parent, reports unknown parents and cycles, and sorts the links.
    pub(super) fn new(links: &'s [LinkSpec], frames: &'s [FrameSpec], faults: &mut Faults) -> Self {
        let mut tree = LinkTree {
            sequence: Vec::with_capacity(links.len()),
            rank: vec![0; links.len()],
            carriers: Vec::new(),
            by_name: BTreeMap::new(),
            names: links
                .iter()
                .filter_map(|l| l.name.value())
                .map(String::as_str)
                .collect(),
            frames: frames
                .iter()
                .filter_map(|f| f.name.value())
                .map(String::as_str)
                .collect(),
        };
        for (index, link) in links.iter().enumerate() {
            if let Some(name) = link.name.value() {
                tree.by_name.entry(name).or_insert(index);
            }
        }
        tree.carriers = links.iter().map(|link| tree.parent(link, faults)).collect();
        tree.order(links, faults);
        tree
    }

    /// Returns the parent of the link with this index in the file; `Some(None)` for the world.
    pub(super) fn parent_id(&self, index: usize) -> Option<Option<LinkId>> {
        self.id(*self.carriers.get(index)?)
    }

    /// Returns the link of a frame; `Some(None)` for the world.
    pub(super) fn frame_id(
        &self,
        frame: &FrameSpec,
        faults: &mut Faults,
    ) -> Option<Option<LinkId>> {
        let link = frame.link.given()?;
        let carrier = self.find(&link.value);
        if carrier == Carrier::Unknown {
            self.unknown(link, "unknown-link", faults);
        }
        self.id(carrier)
    }

    fn id(&self, carrier: Carrier) -> Option<Option<LinkId>> {
        match carrier {
            Carrier::World => Some(None),
            Carrier::Link(index) => Some(Some(LinkId(*self.rank.get(index)?))),
            Carrier::Unknown => None,
        }
    }

    fn find(&self, name: &str) -> Carrier {
        match self.by_name.get(name) {
            _ if name == WORLD => Carrier::World,
            Some(index) => Carrier::Link(*index),
            None => Carrier::Unknown,
        }
    }

    fn parent(&self, link: &LinkSpec, faults: &mut Faults) -> Carrier {
        match &link.parent {
            Field::Absent => Carrier::World,
            Field::Broken => Carrier::Unknown,
            Field::Given(parent) => {
                let carrier = self.find(&parent.value);
                if carrier == Carrier::Unknown {
                    self.unknown(parent, "unknown-parent", faults);
                }
                carrier
            }
        }
    }

    fn unknown(&self, name: &Located<String>, rule: &'static str, faults: &mut Faults) {
        let is_frame = self.frames.contains(&name.value.as_str());
        faults.push(wording::unknown_link(
            &name.location,
            rule,
            &name.value,
            &self.names,
            is_frame,
        ));
    }

    /// Visits the links in the file's order, each after its ancestors.
    fn order(&mut self, links: &[LinkSpec], faults: &mut Faults) {
        let mut visited = vec![false; links.len()];
        for start in 0..links.len() {
            let mut chain: Vec<usize> = Vec::new();
            let mut next = Carrier::Link(start);
            while let Carrier::Link(index) = next {
                if visited[index] {
                    if let Some(from) = chain.iter().position(|i| *i == index) {
                        circle(&chain[from..], links, faults);
                    }
                    break;
                }
                visited[index] = true;
                chain.push(index);
                next = self.carriers[index];
            }
            for &index in chain.iter().rev() {
                self.rank[index] = self.sequence.len();
                self.sequence.push(index);
            }
        }
    }
}

/// Reports a cycle of links, once, at the link that is first in the file.
fn circle(members: &[usize], links: &[LinkSpec], faults: &mut Faults) {
    let Some(first) = members.iter().enumerate().min_by_key(|(_, index)| **index) else {
        return;
    };
    let turned = members[first.0..].iter().chain(&members[..first.0]);
    let names: Vec<&str> = turned
        .filter_map(|i| links[*i].name.value())
        .map(String::as_str)
        .collect();
    if let Some(parent) = links[*first.1].parent.given() {
        faults.push(wording::circle(&parent.location, &names));
    }
}
