//! The trees that joints form from links, with links without a joint as roots.

use super::model::Model;
use super::naming::shown;
use super::xml::fault;
use anyhow::Result;
use std::collections::HashMap;

/// The links in the order of the mechanism: those without a joint first, the others in the order of their
/// joints in the file.
pub(super) struct Tree {
    /// Indices of links without a joint.
    pub(super) roots: Vec<usize>,
    /// For each joint the indices of its parent and its child; `None` is the world.
    pub(super) ends: Vec<(Option<usize>, usize)>,
}

impl Tree {
    /// Returns for each link the joint that carries it, and the link that this joint is on; `None` for links
    /// without a joint or with a joint on the world.
    pub(super) fn carriers(&self) -> Vec<Option<(usize, usize)>> {
        let links = self.roots.len() + self.ends.len();
        let mut carriers = vec![None; links];
        for (joint, (parent, child)) in self.ends.iter().enumerate() {
            carriers[*child] = parent.map(|parent| (joint, parent));
        }
        carriers
    }

    /// Returns the joint of a link.
    pub(super) fn joint_of(&self, link: usize) -> Option<usize> {
        self.ends.iter().position(|(_, child)| *child == link)
    }
}

/// Sorts the links; an error names a link that is missing, repeated, the child of two joints or on a loop.
pub(super) fn order(model: &Model) -> Result<Tree> {
    let mut index = HashMap::new();
    for (i, link) in model.links.iter().enumerate() {
        if index.insert(link.name.as_str(), i).is_some() {
            return Err(fault(
                link.at,
                format_args!("there is a second link `{}`", shown(&link.name)),
            ));
        }
    }
    if model.links.is_empty() {
        return Err(fault((1, 1), "the robot has no link"));
    }
    let mut carrier: Vec<Option<usize>> = vec![None; model.links.len()];
    let mut ends = Vec::new();
    for (j, joint) in model.joints.iter().enumerate() {
        let name = shown(&joint.name);
        let find = |link: &str, end| {
            let missing = || {
                let link = shown(link);
                fault(
                    joint.at,
                    format_args!(
                        "the {end} of joint `{name}` is `{link}`, and there is no such link"
                    ),
                )
            };
            index.get(link).copied().ok_or_else(missing)
        };
        let parent = joint.parent.as_deref();
        let parent = parent.map(|link| find(link, "parent")).transpose()?;
        let child = find(&joint.child, "child")?;
        if let Some(other) = carrier[child] {
            let (link, other) = (shown(&joint.child), shown(&model.joints[other].name));
            let message = format!(
                "link `{link}` is the child of joint `{other}` and of joint `{name}`: \
                 closed loops cannot be imported, cut the loop at one of them"
            );
            return Err(fault(joint.at, message));
        }
        carrier[child] = Some(j);
        ends.push((parent, child));
    }
    let roots: Vec<usize> = (0..carrier.len())
        .filter(|link| carrier[*link].is_none())
        .collect();
    refuse_cycles(model, &carrier, &ends)?;
    Ok(Tree { roots, ends })
}

/// Checks that the parents of every link lead to a root.
fn refuse_cycles(
    model: &Model,
    carrier: &[Option<usize>],
    ends: &[(Option<usize>, usize)],
) -> Result<()> {
    // For each link the start of the walk that visited it first: a walk that visits its own links is a
    // cycle.
    let mut seen = vec![None; carrier.len()];
    for start in 0..carrier.len() {
        let mut link = start;
        while seen[link].is_none() {
            seen[link] = Some(start);
            match carrier[link].and_then(|joint| ends[joint].0) {
                Some(parent) => link = parent,
                None => break,
            }
        }
        // A walk that ended at the world is none.
        let inside = carrier[link].filter(|joint| ends[*joint].0.is_some());
        if let Some(joint) = inside
            && seen[link] == Some(start)
        {
            let (name, joint) = (shown(&model.links[link].name), &model.joints[joint]);
            return Err(fault(
                joint.at,
                format_args!("link `{name}` is carried by itself: the joints go round"),
            ));
        }
    }
    Ok(())
}
