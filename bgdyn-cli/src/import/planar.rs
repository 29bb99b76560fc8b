//! Planar joints of a URDF: the normal of the plane becomes the z axis of the link.

use super::joint_type::JointType;
use super::model::Model;
use super::naming::shown;
use super::number::Num;
use super::placement::{Placement, Pose, displaced, unit};
use bgdyn_codegen::math::{Mat3, Vec3};
use bgdyn_runtime::Dd;

/// The joint's x axis counts as normal to the plane if the sine of the angle between the two is below this:
/// then y is projected.
const PARALLEL: f64 = 1e-6;

/// Turns the links of planar joints so that the plane's normal is z and x the projection of the joint's x
/// axis; returns a line that names them. Joints about z do not change.
pub(super) fn turn_links(model: &mut Model) -> Option<String> {
    let mut turned = Vec::new();
    for index in 0..model.joints.len() {
        let joint = &mut model.joints[index];
        let axis = joint.axis.each_ref();
        let along_z = axis[0].is_zero() && axis[1].is_zero() && axis[2].value > 0.0;
        if joint.kind != JointType::Planar || along_z {
            continue;
        }
        let turn = axes_of_plane(Vec3(axis.map(Num::exact)));
        joint.origin = joint.origin.then(&turn.placement());
        let [x, y, z] = axis.map(|number| number.text.clone());
        let (name, link) = (shown(&joint.name), joint.child.clone());
        turned.push(format!("`{}` by `{name}` ({x} {y} {z})", shown(&link)));
        joint.axis = [Num::zero(), Num::zero(), Num::computed(1.0)];
        reframe(model, &link, &turn);
    }
    let names = (!turned.is_empty()).then(|| turned.join("; "));
    names.map(|names| {
        format!(
            "links turned so that z is the normal of their joint's plane, and x the projection of the joint's x axis: {names}"
        )
    })
}

/// Returns the rotation whose z axis is the normal, and whose x axis is the projection of x, or of y if x is
/// normal to the plane.
fn axes_of_plane(normal: Vec3<Dd>) -> Pose {
    let z = unit(normal);
    let e = |axis: usize| {
        Vec3(std::array::from_fn(|i| {
            Dd::from_f64(f64::from(u8::from(i == axis)))
        }))
    };
    let project = |v: Vec3<Dd>| v - z.scale(z.dot(v));
    let along = project(e(0));
    let x = match along.dot(along).sqrt().to_f64() < PARALLEL {
        true => unit(project(e(1))),
        false => unit(along),
    };
    let columns = [x, z.cross(x), z];
    Pose {
        rotation: Mat3::from_fn(|i, j| columns[j].0[i]),
        ..displaced([Dd::ZERO; 3])
    }
}

/// Replaces a link's axes by those that have the pose `new` in them: inertia, joints and frames on the link
/// stay where they are.
fn reframe(model: &mut Model, link: &str, new: &Pose) {
    let back = new.inverse().placement();
    for found in model.links.iter_mut().filter(|it| it.name == link) {
        let Some(inertial) = &mut found.inertial else {
            continue;
        };
        let own = Placement {
            xyz: inertial.com.clone(),
            rpy: inertial.rpy.clone(),
        };
        let moved = back.then(&own);
        (inertial.com, inertial.rpy) = (moved.xyz, moved.rpy);
    }
    let carried = |parent: &Option<String>| parent.as_deref() == Some(link);
    for joint in model.joints.iter_mut().filter(|it| carried(&it.parent)) {
        joint.origin = back.then(&joint.origin);
    }
    for frame in model.frames.iter_mut().filter(|it| carried(&it.link)) {
        frame.place = back.then(&frame.place);
    }
}
