//! Joins a body to its parent: a joint for each of the file, with links without inertia between them.

use super::builder::{Builder, Carrier, Mount};
use super::joints::MjcfJoint;
use crate::import::joint_type::JointType;
use crate::import::model::{Joint, Link};
use crate::import::naming::{free_name, shown};
use crate::import::number::{Num, all_zero};
use crate::import::placement::Placement;
use crate::import::xml::fault;
use anyhow::Result;

impl Builder<'_> {
    /// Writes the joints of a body and the links between them; returns the body's axes in its link, and the
    /// pose of a body that is fixed to the world.
    pub(super) fn mount(
        &mut self,
        mount: &Mount<'_>,
        joints: Vec<MjcfJoint>,
        carrier: &Carrier,
    ) -> Result<(Placement, Option<Placement>)> {
        let Mount { element, name, .. } = *mount;
        let parent = carrier.link.as_deref();
        if joints.is_empty() {
            let Some(parent) = parent else {
                return Ok((Placement::identity(), Some(mount.place.clone())));
            };
            let joint_name = self.joint_name(&format!("{name}_mount"));
            self.model.joints.push(Joint {
                origin: mount.place.clone(),
                ..Joint::fixed(&joint_name, element.at, Some(parent), name)
            });
            return Ok((Placement::identity(), None));
        }
        if let Some(free) = joints.iter().find(|it| it.kind == JointType::Floating) {
            if joints.len() > 1 || parent.is_some() {
                let message = format!(
                    "the free joint of body `{}` must be its only one, and the body on the world",
                    shown(name)
                );
                return Err(fault(free.at, message));
            }
            self.float(free, mount);
            return Ok((Placement::identity(), None));
        }
        Ok((self.chain(mount, &joints, parent), None))
    }

    /// Writes a floating joint; its coordinates are the pose of the body in the world, as in MuJoCo.
    fn float(&mut self, free: &MjcfJoint, mount: &Mount<'_>) {
        let name = self.name_of(free, mount.name);
        let text = |numbers: &[Num; 3]| numbers.each_ref().map(|it| it.text.as_str()).join(" ");
        let Placement { xyz, rpy } = &mount.place;
        if !all_zero(xyz) || !all_zero(rpy) {
            let item = format!("`{}` at {}, rpy {}", shown(&name), text(xyz), text(rpy));
            let kind = "poses at the start, not a part of a mechanism";
            self.report.groups.add(kind, item);
        }
        self.model.joints.push(Joint {
            kind: JointType::Floating,
            ..Joint::fixed(&name, free.at, None, mount.name)
        });
    }

    /// Writes a joint for each of a body's, with links without inertia between them; returns the body's axes
    /// in its link.
    fn chain(
        &mut self,
        mount: &Mount<'_>,
        joints: &[MjcfJoint],
        parent: Option<&str>,
    ) -> Placement {
        let mut parent = parent.map(str::to_owned);
        let mut at = mount.place.clone();
        for (index, joint) in joints.iter().enumerate() {
            let name = self.name_of(joint, mount.name);
            let anchored = at.then(&moved(&joint.anchor));
            let child = match index + 1 == joints.len() {
                true => mount.name.to_owned(),
                false => {
                    let child = free_name(&format!("{}_{name}", mount.name), &self.links);
                    self.links.insert(child.clone());
                    self.model.links.push(Link {
                        name: child.clone(),
                        at: joint.at,
                        inertial: None,
                        place: None,
                    });
                    child
                }
            };
            if joint.kind.is_scalar() {
                let reference = joint.reference.clone();
                self.references.push((name.clone(), reference));
            }
            self.model.joints.push(Joint {
                kind: joint.kind,
                origin: anchored.then(&joint.at_zero()),
                axis: joint.axis.clone(),
                limits: joint.limits.clone(),
                effects: joint.effects.clone(),
                ..Joint::fixed(&name, joint.at, parent.as_deref(), &child)
            });
            at = moved(&joint.anchor.each_ref().map(negated));
            parent = Some(child);
        }
        at
    }

    /// Returns the joint's name, or one made of that of its body and its kind.
    fn name_of(&mut self, joint: &MjcfJoint, body: &str) -> String {
        match joint.name.as_str() {
            "" => {
                let word = match joint.kind {
                    JointType::Floating => "free",
                    JointType::Spherical => "ball",
                    JointType::Prismatic => "slide",
                    _ => "hinge",
                };
                self.joint_name(&format!("{body}_{word}"))
            }
            name => name.to_owned(),
        }
    }

    fn joint_name(&mut self, wanted: &str) -> String {
        let name = free_name(wanted, &self.joints);
        self.joints.insert(name.clone());
        name
    }
}

/// A displacement without a rotation.
fn moved(xyz: &[Num; 3]) -> Placement {
    Placement {
        xyz: xyz.clone(),
        rpy: Num::zeros(),
    }
}

fn negated(number: &Num) -> Num {
    match number.is_zero() {
        true => Num::zero(),
        false => Num::computed(-number.value),
    }
}
