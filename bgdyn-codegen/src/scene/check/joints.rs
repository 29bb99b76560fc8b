//! The part of a scene's state that belongs to the joints: positions, velocities, joints with quasi-velocities.

use bgdyn_runtime::{Dd, QuasiJointKind};

use crate::format::Dimension;
use crate::layout::{
    DependentJoint, MomentumStore, QuasiJoint, StateCoordinate, StateFollower, StateLayout,
    StatePosition,
};
use crate::mechanism::closure::Closure;
use crate::mechanism::{
    CoordinateId, Coupling, Degrees, DependentVelocity, Joint, Mechanism, Motion, PositionId,
};

/// Returns the layout of the joints' positions and velocities.
pub(super) fn layout(mechanism: &Mechanism) -> StateLayout {
    let mut layout = StateLayout::default();
    let position_names = mechanism.position_names();
    let coordinate_names = mechanism.joint_names();
    let links = mechanism.links().iter().map(|link| &link.joint);
    for joint in links.filter(|joint| joint.degrees.own_positions()) {
        let Degrees {
            positions,
            velocities,
            ..
        } = &joint.degrees;
        let own_rates = joint.kind.motion.velocity_positions();
        for (k, p) in positions.iter().enumerate() {
            let own = velocities.iter().filter(|_| joint.degrees.own_velocities());
            let mut rates = own.filter(|j| rate_of(joint, **j, &own_rates) == Some(k));
            layout.positions.push(StatePosition {
                name: position_names[p.0].clone(),
                dimension: position_dimension(joint.kind.motion, k),
                coordinate: rates.next().map(|j| j.0),
                neutral: neutral(joint.kind.motion, k),
            });
        }
        let own = velocities.iter().filter(|_| joint.degrees.own_velocities());
        for j in own {
            let name = coordinate_names[j.0].clone();
            let position = rate_of(joint, *j, &own_rates).map(|own| positions[own].0);
            let ending = if position.is_some() {
                "rate"
            } else {
                "velocity"
            };
            layout.coordinates.push(StateCoordinate {
                store: MomentumStore::Links(*j),
                position,
                dimensions: dimensions(mechanism.linear(*j)),
                rate_name: format!("{name}_{ending}"),
                starts_with: None,
                name,
            });
        }
        layout.quasi_joints.extend(quasi_joint(joint));
    }
    layout.followers = mechanism.followers().map(follower).collect();
    layout.dependents = mechanism
        .dependent_velocities()
        .into_iter()
        .map(dependent)
        .collect();
    layout.closing = mechanism.closure().map_or(vec![], closing);
    let loops = mechanism.closure().into_iter().flat_map(|c| &c.loops);
    layout.loops = loops.map(|one| one.name.clone()).collect();
    for prescribed in mechanism.prescribed() {
        let joint = mechanism.prescribed_joint(prescribed);
        let [position, ..] = dimensions(joint.kind.motion == Motion::Translation);
        layout.prescribe(&joint.name, position);
    }
    layout
}

fn dependent(own: DependentVelocity) -> DependentJoint {
    let ending = if own.position.is_some() {
        "rate"
    } else {
        "velocity"
    };
    DependentJoint {
        rate_name: format!("{}_{ending}", own.name),
        name: own.name,
        position: own.position.map(|p| p.0),
        velocity: own.velocity,
        dimensions: dimensions(own.linear),
    }
}

/// Returns the positions that change where loops close and wheels touch, each with its loop or contact.
fn closing(closure: &Closure) -> Vec<(usize, usize)> {
    let mut all: Vec<(usize, usize)> = Vec::new();
    for j in closure.closing() {
        let own: Vec<PositionId> = match closure.positions[j.0] {
            Some(p) => vec![p],
            None => {
                let mut joints = closure.compounds.iter();
                let joint = joints.find(|joint| joint.degrees.velocities.contains(&j));
                joint.map_or(vec![], |joint| joint.degrees.positions.clone())
            }
        };
        for PositionId(p) in own {
            if all.iter().all(|(known, _)| *known != p) {
                all.push((p, closure.loop_of(j)));
            }
        }
    }
    all
}

fn follower((joint, coupling, linear): (&Joint, &Coupling, bool)) -> StateFollower {
    let degrees = &joint.degrees;
    let positions = degrees.positions.iter().map(|p| p.0);
    let velocities = degrees.velocities.iter().map(|j| j.0);
    StateFollower {
        name: joint.name.clone(),
        positions: positions.zip(degrees.position_ratios()).collect(),
        offset: coupling.offset,
        leaders: velocities.zip(degrees.velocity_ratios()).collect(),
        dimensions: dimensions(linear),
    }
}

/// Returns which of the joint's positions has one of its velocities as its rate.
fn rate_of(joint: &Joint, j: CoordinateId, own_rates: &[Option<usize>]) -> Option<usize> {
    let part = joint.degrees.part(j)?;
    own_rates.get(part).copied().flatten()
}

/// Returns the joint as one with quasi-velocities, if it is one.
fn quasi_joint(joint: &Joint) -> Option<QuasiJoint> {
    let Motion::Compound(motion) = joint.kind.motion else {
        return None;
    };
    let q = joint.degrees.positions.first()?.0;
    let v = joint.degrees.velocities.first().map_or(0, |v| v.0);
    QuasiJointKind::of_module(motion.manifold).map(|kind| QuasiJoint {
        name: joint.name.clone(),
        kind,
        positions: q..q + motion.positions.len(),
        coordinates: v..v + joint.degrees.velocities.len(),
        quaternion: motion.quaternion().map(|first| q + first),
        any_length: joint.degrees.any_length,
    })
}

/// Returns the value of a joint's position where the joint is neutral.
fn neutral(motion: Motion, k: usize) -> Dd {
    match motion {
        Motion::Compound(motion) => Dd::from_f64(motion.positions[k].neutral.into()),
        _ => Dd::ZERO,
    }
}

fn position_dimension(motion: Motion, k: usize) -> Dimension {
    let unit = match motion {
        Motion::Compound(motion) => motion.positions[k].unit,
        motion => motion.unit(),
    };
    match unit {
        "m" => Dimension::Length,
        "rad" => Dimension::Angle,
        _ => Dimension::One,
    }
}

/// Returns the dimensions of position, velocity and effort of a coordinate.
pub(super) fn dimensions(linear: bool) -> [Dimension; 3] {
    match linear {
        true => [Dimension::Length, Dimension::Speed, Dimension::Force],
        false => [Dimension::Angle, Dimension::AngularSpeed, Dimension::Torque],
    }
}
