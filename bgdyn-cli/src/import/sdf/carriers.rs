//! Which joints carry links.
//!
//! SDF prescribes no tree: the child of a joint may carry others already, and a link without a joint is free.
//!
//! 1. The first joint of each child, in the order of the file, carries it, unless the child carries that joint.
//! 2. A further joint between two trees, one of which is not on the world, carries that tree: its end becomes the root
//!    of the tree. Joints that carry their parent then are reversed.
//!
//! All others close loops.

use super::layout::ReadJoint;

/// Returns the index of the joint that carries each link; reverses the joints that carry their parent.
pub(super) fn carriers(joints: &mut [ReadJoint<'_>], links: usize) -> Vec<Option<usize>> {
    let mut carrier = in_order(joints, links);
    for j in 0..joints.len() {
        let (parent, child) = (joints[j].parent, joints[j].child);
        let root = |link| root(link, joints, &carrier);
        let roots = (parent.and_then(root), root(child));
        if roots.0 == roots.1 {
            continue;
        }
        match (roots, parent) {
            ((_, Some(_)), _) => {
                make_root(child, joints, &mut carrier);
                carrier[child] = Some(j);
            }
            ((_, None), Some(parent)) => {
                make_root(parent, joints, &mut carrier);
                joints[j].reverse();
                carrier[parent] = Some(j);
            }
            // The world has no root.
            ((_, None), None) => {}
        }
    }
    carrier
}

/// Returns the carriers of step 1.
fn in_order(joints: &[ReadJoint<'_>], links: usize) -> Vec<Option<usize>> {
    let mut carrier: Vec<Option<usize>> = vec![None; links];
    for (j, joint) in joints.iter().enumerate() {
        let mut at = joint.parent;
        while let Some(link) = at.filter(|link| *link != joint.child) {
            at = carrier[link].and_then(|j| joints[j].parent);
        }
        if carrier[joint.child].is_none() && at.is_none() {
            carrier[joint.child] = Some(j);
        }
    }
    carrier
}

/// Returns the link without a joint that carries this one; `None` for a link on the world.
fn root(link: usize, joints: &[ReadJoint<'_>], carrier: &[Option<usize>]) -> Option<usize> {
    let mut at = link;
    while let Some(j) = carrier[at] {
        at = joints[j].parent?;
    }
    Some(at)
}

/// Reverses the joints between a link and the root of its tree, so that the link is the root.
fn make_root(link: usize, joints: &mut [ReadJoint<'_>], carrier: &mut [Option<usize>]) {
    let (mut at, mut through) = (link, None);
    while let Some(j) = std::mem::replace(&mut carrier[at], through) {
        let Some(parent) = joints[j].parent else {
            return;
        };
        joints[j].reverse();
        (at, through) = (parent, Some(j));
    }
}
