//! Converts a mechanism of bgdyn to moving bodies.

extern crate std;

use std::vec::Vec;

use bgdyn_codegen::math::{Mat3, Vec3};
use bgdyn_codegen::mechanism::{Inertial, LinkId, Mechanism, Motion, Pose, Value};
use bgdyn_runtime::Dd;
use nalgebra::{Matrix3, Vector3};

use crate::body::steiner;
pub use crate::body::{Body, Placement};

/// A site on a moving body, or in the world (`body: None`).
#[derive(Clone, Copy, Debug)]
pub struct Site {
    /// The body.
    pub body: Option<usize>,
    /// Its pose in the body's axes.
    pub placement: Placement,
}

/// Returns the links whose joints move, in the order of the velocities: one a body.
pub fn moving_links(mechanism: &Mechanism) -> Vec<LinkId> {
    let mut links = mechanism.coordinates().to_vec();
    // A joint of several velocities is listed once for each.
    links.dedup();
    links
}

/// Returns the moving bodies in the order of the velocities. Run-time parameters have the values of the
/// spec. Links fixed to the world are omitted. Joints of several velocities have no meaningful axis.
pub fn bodies(mechanism: &Mechanism) -> Vec<Body> {
    let mut bodies: Vec<Body> = moving_links(mechanism)
        .into_iter()
        .map(|link| empty(mechanism, link))
        .collect();
    for (i, link) in mechanism.links().iter().enumerate() {
        let site = site(mechanism, LinkId(i));
        if let Some(body) = site.body {
            add(
                &mut bodies[body],
                mechanism,
                &link.inertial,
                &site.placement,
            );
        }
    }
    bodies
}

/// Returns the names of the bodies' joints.
pub fn joint_names(mechanism: &Mechanism) -> impl Iterator<Item = &str> {
    let links = mechanism.links();
    let moving = moving_links(mechanism).into_iter();
    moving.map(|link| links[link.0].joint.name.as_str())
}

/// Returns which joints are prismatic.
pub fn slides(bodies: &[Body]) -> Vec<bool> {
    bodies.iter().map(|b| b.slides).collect()
}

/// Returns the site of the link or frame of this name.
pub fn place(mechanism: &Mechanism, name: &str) -> Option<Site> {
    let links = mechanism.links();
    if let Some(link) = links.iter().position(|l| l.name == name) {
        return Some(site(mechanism, LinkId(link)));
    }
    let frame = mechanism.frames().iter().find(|f| f.name == name)?;
    let carrier = carrier(mechanism, frame.link);
    Some(Site {
        placement: carrier.placement.of(&placement(&frame.origin)),
        ..carrier
    })
}

/// Returns a link's frame on its body.
fn site(mechanism: &Mechanism, link: LinkId) -> Site {
    let body = moving_links(mechanism).iter().position(|&l| l == link);
    if body.is_some() {
        return Site {
            body,
            placement: Placement::identity(),
        };
    }
    let link = &mechanism.links()[link.0];
    let carrier = carrier(mechanism, link.parent);
    Site {
        body: carrier.body,
        placement: carrier.placement.of(&placement(&link.joint.origin)),
    }
}

fn carrier(mechanism: &Mechanism, parent: Option<LinkId>) -> Site {
    let world = Site {
        body: None,
        placement: Placement::identity(),
    };
    parent.map_or(world, |parent| site(mechanism, parent))
}

/// Returns the body of a moving link, without its inertia.
fn empty(mechanism: &Mechanism, link: LinkId) -> Body {
    let link = &mechanism.links()[link.0];
    let carrier = carrier(mechanism, link.parent);
    Body {
        parent: carrier.body,
        slides: link.joint.kind.motion == Motion::Translation,
        placement: carrier.placement.of(&placement(&link.joint.origin)),
        axis: vector(link.joint.axis),
        mass: 0.0,
        com: Vector3::zeros(),
        inertia: Matrix3::zeros(),
    }
}

/// Adds a rigid part, whose frame is given in the body's.
fn add(body: &mut Body, mechanism: &Mechanism, part: &Inertial, at: &Placement) {
    let number = |value: Value| match value {
        Value::Fixed(x) => x.to_f64(),
        Value::Parameter(p) => mechanism.parameters()[p.0].default.to_f64(),
    };
    let mass = number(part.mass);
    let com = Vector3::from(part.com.0.map(number));
    let com = at.rotation * com + at.translation;
    let [xx, yy, zz, xy, xz, yz] = part.inertia.entries.map(number);
    let tensor = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
    let axes = at.rotation * matrix(part.inertia.axes);
    let tensor = axes * tensor * axes.transpose();
    // Both tensors are about their own centres: add Steiner's terms of the pair about the common one.
    let sum = body.mass + mass;
    if sum > 0.0 {
        let between = com - body.com;
        body.inertia += steiner(body.mass * mass / sum, &between);
        body.com += between * (mass / sum);
    }
    body.mass = sum;
    body.inertia += tensor;
}

fn placement(pose: &Pose) -> Placement {
    Placement {
        rotation: matrix(pose.rotation),
        translation: vector(pose.translation),
    }
}

/// Converts to `f64`.
pub fn vector(v: Vec3<Dd>) -> Vector3<f64> {
    Vector3::from(v.0.map(Dd::to_f64))
}

fn matrix(m: Mat3<Dd>) -> Matrix3<f64> {
    Matrix3::from_fn(|i, j| m.0[i][j].to_f64())
}
