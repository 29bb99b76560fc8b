//! The joints of a mechanism, in the terms of the compared programs.

use bgdyn_codegen::mechanism::{LinkId, Mechanism, Motion};

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
        .find(|l| l.joint.degrees.coupling.is_some());
    if let Some(link) = follower {
        let name = &link.joint.name;
        return Err(format!(
            "joint {name}: peers have no joint that follows others"
        ));
    }
    let kind = |link: LinkId| {
        let joint = &mechanism.links()[link.0].joint;
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
    moving_links(mechanism).into_iter().map(kind).collect()
}
