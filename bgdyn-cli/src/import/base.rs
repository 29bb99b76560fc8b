//! `--base`: a joint between the world and the robot, or a base whose motion is given.

use super::joint_type::JointType;
use super::model::{Joint, Model};
use super::naming::{free_name, shown};
use super::placement::Placement;
use super::tree::Tree;
use anyhow::{Result, bail};

/// The name of the joint that carries the robot.
const ROOT: &str = "root";

/// How the link without a joint is connected to the world.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub enum Base {
    /// Fixed to the world
    Fixed,
    /// On a floating joint
    Floating,
    /// On a planar joint: x and y of the world, and the turn about z
    Planar,
    /// On a base whose motion is given at run time
    Given,
}

/// Puts a joint between the world and the only link without a joint. At a neutral position the link is where
/// it was fixed. A base whose motion is given takes the place of the world.
pub(super) fn free(model: &mut Model, tree: &Tree, base: Base) -> Result<()> {
    let kind = match base {
        Base::Fixed => return Ok(()),
        Base::Floating => JointType::Floating,
        Base::Planar => JointType::Planar,
        Base::Given => {
            model.moving_base = true;
            return Ok(());
        }
    };
    if !model.incomplete.is_empty() {
        let names = model
            .incomplete
            .iter()
            .map(|name| format!("`{}`", shown(name)));
        bail!(
            "--base: the inertia of {} is that of meshes or shells, which is not computed here, and they would \
             move; give each an `<inertial>` (MuJoCo writes them into the file it saves with `saveinertial`)",
            names.collect::<Vec<_>>().join(", ")
        )
    }
    let root = match tree.roots.as_slice() {
        [root] => *root,
        [] => bail!("--base: no link is fixed to the world, every one has a joint already"),
        several => {
            let names = several.iter().map(|root| &model.links[*root].name);
            let names: Vec<String> = names.map(|name| format!("`{}`", shown(name))).collect();
            bail!(
                "--base: several links have no joint: {}; join them by fixed joints, or keep one with `--chain`",
                names.join(", ")
            )
        }
    };
    let taken = model
        .joints
        .iter()
        .map(|joint| joint.name.clone())
        .collect();
    let name = free_name(ROOT, &taken);
    put(model, root, &name, kind);
    Ok(())
}

/// Puts a floating joint between the world and each link without a joint, as the file means them.
pub(super) fn free_all(model: &mut Model, tree: &Tree) {
    for &root in tree.roots.iter().rev() {
        let taken = model.joints.iter().map(|joint| joint.name.clone());
        let name = free_name(
            &format!("{}_free", model.links[root].name),
            &taken.collect(),
        );
        put(model, root, &name, JointType::Floating);
    }
}

/// Puts a joint between the world and a link without one. At its neutral position the link is where it was fixed.
fn put(model: &mut Model, root: usize, name: &str, kind: JointType) {
    let link = &mut model.links[root];
    let joint = Joint {
        kind,
        origin: link.place.take().unwrap_or_else(Placement::identity),
        ..Joint::fixed(name, link.at, None, &link.name)
    };
    model.joints.insert(0, joint);
}
