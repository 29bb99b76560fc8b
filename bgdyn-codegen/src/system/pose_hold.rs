//! The efforts of controllers that hold the position or the orientation of a joint with quasi-velocities.

use bgdyn_runtime::Dd;

use super::EffortSums;
use super::waveform::{course, rate};
use crate::effort_sums::angular_velocity;
use crate::expr::{Builder, Expr};
use crate::math::Vec3;
use crate::scene::{PoseHold, PoseTarget, Waveform, quaternion_of_half_turns};

/// Returns the forces or the moments of a controller, in link axes; the third force of a planar joint is 0.
pub(super) fn efforts<'g>(sums: &EffortSums<'g, '_>, hold: &PoseHold) -> Vec3<Expr<'g>> {
    let b = sums.b;
    match &hold.target {
        PoseTarget::Position(courses) => force(sums, hold, courses),
        PoseTarget::Quaternion(q) => moment(sums, hold, q.map(|x| b.constant(x))),
        PoseTarget::Rpy(courses) => {
            let angles = courses.each_ref().map(|waveform| course(b, waveform));
            let half = Dd::from_f64(0.5);
            let halves = angles.map(|angle| {
                let (cosine, sine) = b.cos_sin(&[angle * half], Dd::ZERO);
                (sine, cosine)
            });
            moment(sums, hold, quaternion_of_half_turns(halves))
        }
    }
}

/// Returns Rᵀ (K (r − p) + D (ṙ − ṗ)).
fn force<'g>(sums: &EffortSums<'g, '_>, hold: &PoseHold, courses: &[Waveform]) -> Vec3<Expr<'g>> {
    let b = sums.b;
    let (rotation, origin) = sums.pose_in_joint(&hold.joint);
    let (stiffness, damping) = (gains(b, &hold.stiffness), gains(b, &hold.damping));
    let mut target = Vec3([b.zero(); 3]);
    let mut velocity = target;
    for (k, waveform) in courses.iter().enumerate() {
        target.0[k] = course(b, waveform);
        velocity.0[k] = sums.v[hold.joint.coordinates.start + k];
    }
    let speed = target.map(|x| rate(b, x));
    let pull = product(stiffness, target - origin);
    let one = hold.damping.iter().all(|d| *d == hold.damping[0]);
    if one {
        // Rᵀ D Ṙ v = d v
        let push = pull + product(damping, speed);
        return rotation.transpose() * push - product(damping, velocity);
    }
    let push = pull + product(damping, speed - rotation * velocity);
    rotation.transpose() * push
}

/// Returns the moment towards an orientation, and D (ω_target − ω).
fn moment<'g>(sums: &EffortSums<'g, '_>, hold: &PoseHold, target: [Expr<'g>; 4]) -> Vec3<Expr<'g>> {
    let b = sums.b;
    let attitude = sums.attitude(&hold.joint, target);
    let speed = angular_velocity(target, target.map(|x| rate(b, x)));
    let first = hold.joint.coordinates.end - 3;
    let velocity = Vec3([0, 1, 2].map(|k| sums.v[first + k]));
    let moving = speed.0.iter().any(|x| !x.is_zero());
    let slip = match moving {
        true => attitude.in_link_axes(speed) - velocity,
        false => -velocity,
    };
    attitude.moment(gains(b, &hold.stiffness)) + product(gains(b, &hold.damping), slip)
}

/// Returns three gains; those that a planar joint does not have are 0.
fn gains<'g>(b: &'g Builder, gains: &[Dd]) -> Vec3<Expr<'g>> {
    let gain = |k: usize| gains.get(k).copied().unwrap_or(Dd::ZERO);
    Vec3([0, 1, 2].map(|k| b.constant(gain(k))))
}

fn product<'g>(a: Vec3<Expr<'g>>, b: Vec3<Expr<'g>>) -> Vec3<Expr<'g>> {
    Vec3(std::array::from_fn(|k| a.0[k] * b.0[k]))
}
