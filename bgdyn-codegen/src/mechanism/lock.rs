//! Locks joints of a mechanism: their links are welded together at given positions.
//!
//! Joints that follow only locked ones are locked with them; others keep the joints that still move.

use bgdyn_runtime::Dd;

use super::joint::{self, PoseNumbers};
use super::{Coupling, Degrees, Joint, Leader, LinkId, Mechanism, Motion, Pose, PrescribedJoint};
use crate::math::rodrigues;

impl Mechanism {
    /// Returns the mechanism with the joints of these links locked at these positions, rad or m.
    pub fn locked(&self, locks: &[(LinkId, Dd)]) -> Self {
        let mut locked = self.clone();
        for link in &mut locked.links {
            let joint = &mut link.joint;
            let Some(coupling) = joint.degrees.coupling.take() else {
                continue;
            };
            match remaining(coupling, locks) {
                Ok(coupling) => joint.degrees.coupling = Some(coupling),
                Err(at) => weld(joint, at),
            }
        }
        for &(link, at) in locks {
            weld(&mut locked.links[link.0].joint, at);
        }
        locked.forget_prescribed(locks);
        locked.number();
        locked
    }
}

impl Mechanism {
    /// Removes locked joints from the prescribed ones, with their parameters, which are the last ones.
    fn forget_prescribed(&mut self, locks: &[(LinkId, Dd)]) {
        let is_locked = |p: &PrescribedJoint| locks.iter().any(|(link, _)| *link == p.link);
        let (gone, mut kept): (Vec<_>, Vec<_>) = self.prescribed.drain(..).partition(is_locked);
        let mut gone = gone.iter().flat_map(|p| p.motion).collect::<Vec<_>>();
        gone.sort();
        for p in gone.iter().rev() {
            self.parameters.remove(p.0);
        }
        for parameter in kept.iter_mut().flat_map(|p| &mut p.motion) {
            parameter.0 -= gone.iter().filter(|g| **g < *parameter).count();
        }
        self.prescribed = kept;
    }
}

/// Returns the relation to the joints that are not locked, or the position of a joint that follows no other.
fn remaining(coupling: Coupling, locks: &[(LinkId, Dd)]) -> Result<Coupling, Dd> {
    let at = |leader: &Leader| locks.iter().find(|(link, _)| *link == leader.link);
    let fixed = coupling.positions.iter().filter_map(|leader| {
        let (_, at) = at(leader)?;
        Some(leader.ratio * *at)
    });
    let offset = fixed.fold(coupling.offset, |sum, part| part + sum);
    let moving = |leaders: Vec<Leader>| leaders.into_iter().filter(|l| at(l).is_none()).collect();
    let velocities: Vec<Leader> = moving(coupling.velocities);
    if velocities.is_empty() {
        return Err(offset);
    }
    Ok(Coupling {
        positions: moving(coupling.positions),
        offset,
        velocities,
    })
}

fn weld(joint: &mut Joint, at: Dd) {
    joint.origin = locked_pose(joint, at);
    joint.kind = joint::fixed();
    joint.degrees = Degrees::default();
}

/// Returns the pose of a joint's link at a coordinate.
fn locked_pose(joint: &Joint, at: Dd) -> Pose {
    let Pose {
        rotation,
        translation,
    } = joint.origin;
    match joint.kind.motion {
        Motion::Rotation => Pose {
            rotation: rotation * rodrigues(joint.axis, cos_sin(at), |x| x),
            translation,
        },
        Motion::Translation => Pose {
            rotation,
            translation: translation + rotation * joint.axis.scale(at),
        },
        Motion::Compound(motion) if motion.positions.len() == 1 => {
            let (turn, shift) = motion.pose(&joint.constants(), &[at], &Exact);
            Pose {
                rotation: rotation * turn,
                translation: translation + rotation * shift,
            }
        }
        // Only joints with one velocity can be locked.
        Motion::None | Motion::Compound(_) => joint.origin,
    }
}

/// Double-double numbers with exact quarter turns.
struct Exact;

impl PoseNumbers<Dd> for Exact {
    fn constant(&self, x: Dd) -> Dd {
        x
    }

    fn cos_sin(&self, angle: Dd) -> (Dd, Dd) {
        cos_sin(angle)
    }

    fn twice_inverse(&self, squares: Dd) -> Dd {
        Dd::from_f64(2.0) / squares
    }
}

/// Returns cosine and sine of an angle, exact for quarter turns.
fn cos_sin(angle: Dd) -> (Dd, Dd) {
    let (sin, cos) = angle.sin_cos();
    let exact = |x: Dd| {
        let near = Dd::from_f64(x.to_f64().round());
        if (x - near).to_f64().abs() < 1e-28 {
            near
        } else {
            x
        }
    };
    (exact(cos), exact(sin))
}
