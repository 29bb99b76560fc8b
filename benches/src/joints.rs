//! The joints of a mechanism, in the terms of the compared programs.

use bgdyn_codegen::mechanism::{Mechanism, Motion};

use crate::body::moving_links;
use crate::states::JointKind;

/// Returns the kinds of the bodies' joints.
///
/// # Errors
/// A joint that the descriptions for other programs have no word for: its name and type.
pub fn joint_kinds(mechanism: &Mechanism) -> Result<Vec<JointKind>, String> {
    let follower = mechanism
        .links()
        .iter()
        .find(|l| l.joint.degrees.mimic.is_some());
    if let Some(link) = follower {
        let name = &link.joint.name;
        return Err(format!("joint {name}: peers have no joint with `mimic`"));
    }
    let kind = |&link: &_| {
        let joint = &mechanism.links()[link].joint;
        match joint.kind.motion {
            Motion::Rotation => Ok(JointKind::Turns),
            Motion::Translation => Ok(JointKind::Slides),
            Motion::Compound(motion) if motion.manifold == "floating" => Ok(JointKind::Floats),
            Motion::None | Motion::Compound(_) => Err(format!(
                "joint {}: its type {} is not compared with other systems; `revolute`, `continuous`, \
                 `prismatic` and `floating` are",
                joint.name, joint.kind.keyword
            )),
        }
    };
    let links: Vec<usize> = moving_links(mechanism).iter().map(|link| link.0).collect();
    links.iter().map(kind).collect()
}
