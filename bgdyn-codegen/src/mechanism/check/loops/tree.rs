//! The tree of links that loops refer to, and the joints between two of its links.

use bgdyn_runtime::Dd;

use crate::fault::{Faults, Location, wording};
use crate::format::Located;
use crate::mechanism::closure::ChainStep;
use crate::mechanism::{Frame, Link, LinkId, Mechanism, Pose};
use crate::name::WORLD;

/// Links and frames.
#[derive(Clone, Copy)]
pub struct Tree<'a> {
    links: &'a [Link],
    frames: &'a [Frame],
}

impl<'a> Tree<'a> {
    /// Returns these links and frames.
    pub fn new(links: &'a [Link], frames: &'a [Frame]) -> Self {
        Self { links, frames }
    }

    /// Returns those of a mechanism.
    pub(super) fn of(mechanism: &'a Mechanism) -> Self {
        Self::new(mechanism.links(), mechanism.frames())
    }

    pub fn links(self) -> &'a [Link] {
        self.links
    }

    pub(super) fn frames(self) -> &'a [Frame] {
        self.frames
    }
}

/// Returns the link of this name; `None` in it for the world.
pub(super) fn find_link(
    name: &str,
    location: &Location,
    tree: Tree<'_>,
    faults: &mut Faults,
) -> Option<Option<LinkId>> {
    if name == WORLD {
        return Some(None);
    }
    let shown = || tree.links().iter().filter(|link| !link.hidden);
    let found = tree
        .links()
        .iter()
        .position(|known| !known.hidden && known.name == name);
    if found.is_none() {
        let known: Vec<&str> = shown().map(|link| link.name.as_str()).collect();
        let is_frame = tree.frames().iter().any(|frame| frame.name == name);
        faults.push(wording::unknown_link(
            location,
            "unknown-link",
            name,
            &known,
            is_frame,
        ));
    }
    Some(Some(LinkId(found?)))
}

/// Returns link and pose of a link or a frame.
pub fn find_site(
    name: &Located<String>,
    tree: Tree<'_>,
    faults: &mut Faults,
) -> Option<(Option<LinkId>, Pose)> {
    let mut frames = tree.frames().iter();
    if let Some(frame) = frames.find(|frame| frame.name == name.value) {
        return Some((frame.link, frame.origin));
    }
    let mut links = tree.links().iter();
    let found = links.position(|link| !link.hidden && link.name == name.value);
    if found.is_none() {
        let links = tree.links().iter().filter(|link| !link.hidden);
        let links = links.map(|link| link.name.as_str());
        let frames = tree.frames().iter().map(|frame| frame.name.as_str());
        let known: Vec<&str> = links.chain(frames).collect();
        faults.push(wording::unknown_site(&name.location, &name.value, &known));
    }
    Some((Some(LinkId(found?)), Pose::IDENTITY))
}

/// Returns the links whose joints lead from place a to place b, and whether each is passed outward.
pub fn path(tree: Tree<'_>, a: Option<LinkId>, b: Option<LinkId>) -> Vec<(LinkId, bool)> {
    let to_base = |mut link: Option<LinkId>| {
        let mut all = Vec::new();
        while let Some(l) = link {
            all.push(l);
            link = tree.links()[l.0].parent;
        }
        all
    };
    let (from, to) = (to_base(a), to_base(b));
    let inward = from
        .iter()
        .filter(|link| !to.contains(link))
        .map(|&link| (link, false));
    let outward = to
        .iter()
        .rev()
        .filter(|link| !from.contains(link))
        .map(|&link| (link, true));
    inward.chain(outward).collect()
}

/// Returns the step through the joint of a link.
pub(super) fn step(tree: Tree<'_>, link: LinkId, outward: bool) -> ChainStep {
    let joint = &tree.links()[link.0].joint;
    ChainStep {
        link,
        outward,
        origin: joint.origin,
        motion: joint.kind.motion,
        axis: joint.axis,
        degrees: joint.degrees.clone(),
        phase: Dd::ZERO,
        columns: None,
    }
}
