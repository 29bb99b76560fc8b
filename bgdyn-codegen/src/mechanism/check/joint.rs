//! Checks joints: type, axes, lead, origin, limits.

use bgdyn_runtime::Dd;

use super::direction::Directions;
use super::limits::limits;
use super::names::mount_name;
use crate::fault::{Faults, wording};
use crate::format::{self, Dimension, Field, LinkSpec, Located, MimicSpec};
use crate::math::Vec3;
use crate::mechanism::joint::{JOINT_TYPES, Step};
use crate::mechanism::{Degrees, Joint, JointType, Limits, Motion};
use crate::name::WORLD;

/// Cosine above which two axes are not perpendicular: rounding of decimals.
const OBLIQUE: f64 = 1e-9;

/// The joints from a link's parent to the link, in series: one, or two with a massless link between them.
pub(super) struct CheckedJoints {
    /// From the parent outward; the last one is the link's own.
    pub(super) chain: Vec<Joint>,
    /// The joint that it mimics.
    pub(super) mimic: Option<Located<MimicSpec>>,
}

/// Returns the joints of `link`; their coordinates are assigned later.
pub(super) fn joints(
    link: &LinkSpec,
    directions: &Directions,
    faults: &mut Faults,
) -> Option<CheckedJoints> {
    match &link.joint {
        Field::Absent => Some(CheckedJoints {
            chain: vec![plain(
                mount_name(link.name.value()?),
                crate::mechanism::joint::fixed(),
            )],
            mimic: None,
        }),
        Field::Broken => None,
        Field::Given(joint) => given(&joint.value, link, directions, faults),
    }
}

/// Returns a joint about z in the parent's axes, without limits.
fn plain(name: String, kind: &'static JointType) -> Joint {
    Joint {
        name,
        label: None,
        kind,
        axis: z(),
        origin: Directions::identity(),
        limits: Limits::default(),
        coordinate: None,
        degrees: Degrees::default(),
    }
}

fn given(
    joint: &format::JointSpec,
    link: &LinkSpec,
    directions: &Directions,
    faults: &mut Faults,
) -> Option<CheckedJoints> {
    let kind = kind(joint, faults);
    let axis = axis(joint, kind, directions, faults);
    let axis2 = second_axis(joint, kind, directions, faults);
    let degrees = degrees(joint, kind, faults);
    let origin = directions.pose(&joint.origin, faults);
    let limits = limits(joint, kind, faults);
    let name = name(joint, link, kind, faults);
    let mimic = mimic(joint, kind, faults);
    let (kind, name, axis, axis2) = (kind?, name?, axis?, axis2?);
    let limits = limits?;
    let first = Joint {
        label: joint.label.value().cloned(),
        axis,
        origin: origin?,
        limits: limits[0],
        degrees: degrees?,
        ..plain(name, kind)
    };
    // Along one axis two rotations are one, and two translations; a rotation and a translation are not.
    let is_rotation = |k: usize| {
        kind.chain
            .get(k)
            .map(|member| member.kind.motion == Motion::Rotation)
    };
    let both_rotate = is_rotation(0) == Some(true) && is_rotation(1) == Some(true);
    if let Some(axis2) = axis2
        && is_rotation(0) == is_rotation(1)
        && parallel(axis, axis2)
    {
        let location = joint.axis2.given().map_or(&joint.location, |a| &a.location);
        faults.push(wording::parallel_axes(location, both_rotate));
        return None;
    }
    if let (Some(axis2), Some(given)) = (axis2, joint.axis2.given())
        && both_rotate
        && axis.dot(axis2).to_f64().abs() > OBLIQUE
    {
        let degrees = axis.dot(axis2).to_f64().acos().to_degrees();
        faults.push(wording::oblique_axes(&given.location, degrees));
    }
    if let (Motion::Compound(motion), Some(parent)) = (kind.motion, link.parent.given())
        && motion.velocities.len() == 6
        && parent.value != WORLD
    {
        let location = joint.kind.given().map_or(&joint.location, |k| &k.location);
        faults.push(wording::floating_on_link(
            location,
            &first.name,
            &parent.value,
        ));
    }
    let mut chain = Vec::new();
    for (k, member) in kind.chain.iter().enumerate() {
        chain.push(Joint {
            label: first
                .label
                .as_ref()
                .map(|l| format!("{l}_{}", member.suffix)),
            axis: match member.second_axis {
                true => axis2.unwrap_or(axis),
                false => axis,
            },
            origin: match k {
                0 => first.origin,
                _ => Directions::identity(),
            },
            limits: limits[k],
            ..plain(format!("{}_{}", first.name, member.suffix), member.kind)
        });
    }
    if chain.is_empty() {
        chain.push(first);
    }
    Some(CheckedJoints {
        chain,
        mimic: mimic?,
    })
}

/// Returns the second axis, of a joint that needs one.
fn second_axis(
    joint: &format::JointSpec,
    kind: Option<&'static JointType>,
    directions: &Directions,
    faults: &mut Faults,
) -> Option<Option<Vec3<Dd>>> {
    let needs = kind?.chain.iter().any(|member| member.second_axis);
    match &joint.axis2 {
        Field::Broken => None,
        Field::Absent if needs => {
            faults.push(wording::no_second_axis(&joint.location, kind?.keyword));
            None
        }
        Field::Absent => Some(None),
        Field::Given(axis) if !needs => {
            faults.push(wording::key_of_other_joint(
                &axis.location,
                "axis2",
                kind?.keyword,
                "universal",
            ));
            None
        }
        Field::Given(axis) => Some(Some(directions.axis(axis, faults)?)),
    }
}

/// Returns whether two unit vectors are parallel or opposite, to rounding.
fn parallel(a: Vec3<Dd>, b: Vec3<Dd>) -> bool {
    let across = a.cross(b);
    across.dot(across).to_f64() < 1e-22
}

/// Returns the advance per radian of a helical joint, and whether a quaternion may have any length.
fn degrees(
    joint: &format::JointSpec,
    kind: Option<&'static JointType>,
    faults: &mut Faults,
) -> Option<Degrees> {
    let steps = match kind?.motion {
        Motion::Compound(motion) => motion.steps,
        _ => &[],
    };
    let screw = steps.iter().any(|step| matches!(step, Step::Screw(_)));
    let turns = steps.iter().any(|step| matches!(step, Step::Quaternion(_)));
    let advance = match &joint.lead {
        Field::Broken => None,
        Field::Absent if screw => {
            faults.push(wording::no_lead(&joint.location));
            None
        }
        Field::Absent => Some(Dd::ZERO),
        Field::Given(lead) if !screw => {
            faults.push(wording::key_of_other_joint(
                &lead.location,
                "lead",
                kind?.keyword,
                "helical",
            ));
            None
        }
        Field::Given(lead) if lead.value.value == Dd::ZERO => {
            faults.push(wording::zero_lead(&lead.location));
            None
        }
        Field::Given(lead) => Some(match lead.value.unit.map(|unit| unit.dimension) {
            Some(Dimension::Lead) => lead.value.value,
            _ => lead.value.value / (Dd::from_f64(2.0) * Dd::PI),
        }),
    };
    let any_length = match &joint.quaternion {
        Field::Broken => None,
        Field::Absent => Some(false),
        Field::Given(word) if !turns => {
            faults.push(wording::key_of_other_joint(
                &word.location,
                "quaternion",
                kind?.keyword,
                "spherical` or `floating",
            ));
            None
        }
        Field::Given(word) if word.value != "any" => {
            faults.push(wording::unknown_quaternion(&word.location, &word.value));
            None
        }
        Field::Given(_) => Some(true),
    };
    Some(Degrees {
        advance: advance?,
        any_length: any_length?,
        ..Degrees::default()
    })
}

/// Returns the `mimic` of a joint of one degree.
fn mimic(
    joint: &format::JointSpec,
    kind: Option<&'static JointType>,
    faults: &mut Faults,
) -> Option<Option<Located<MimicSpec>>> {
    match &joint.mimic {
        Field::Broken => None,
        Field::Absent => Some(None),
        Field::Given(mimic) if !kind?.one_degree() => {
            faults.push(wording::mimic_of_joint(&mimic.location, kind?.keyword));
            None
        }
        Field::Given(mimic) => Some(Some(mimic.clone())),
    }
}

fn z() -> Vec3<Dd> {
    Vec3([Dd::ZERO, Dd::ZERO, Dd::ONE])
}

fn kind(joint: &format::JointSpec, faults: &mut Faults) -> Option<&'static JointType> {
    let word = joint.kind.given()?;
    let found = JOINT_TYPES
        .iter()
        .find(|kind| kind.keyword == word.value)
        .copied();
    if found.is_none() {
        let known: Vec<&str> = JOINT_TYPES.iter().map(|kind| kind.keyword).collect();
        faults.push(wording::unknown_joint_type(
            &word.location,
            &word.value,
            &known,
        ));
    }
    found
}

fn name(
    joint: &format::JointSpec,
    link: &LinkSpec,
    kind: Option<&'static JointType>,
    faults: &mut Faults,
) -> Option<String> {
    match &joint.name {
        Field::Given(name) => Some(name.value.clone()),
        Field::Broken => None,
        Field::Absent if kind?.motion == Motion::None => Some(mount_name(link.name.value()?)),
        Field::Absent => {
            faults.push(wording::moving_joint_without_name(&joint.location));
            None
        }
    }
}

fn axis(
    joint: &format::JointSpec,
    kind: Option<&'static JointType>,
    directions: &Directions,
    faults: &mut Faults,
) -> Option<Vec3<Dd>> {
    let axial = |kind: &JointType| kind.motion.has_axis();
    match &joint.axis {
        Field::Absent => Some(z()),
        Field::Broken => None,
        Field::Given(axis) if kind.is_some_and(|kind| kind.motion == Motion::None) => {
            faults.push(wording::axis_of_fixed_joint(&axis.location));
            None
        }
        Field::Given(axis) if kind.is_some_and(|kind| !axial(kind)) => {
            faults.push(wording::axis_of_joint(&axis.location, kind?.keyword));
            None
        }
        Field::Given(axis) => directions.axis(axis, faults),
    }
}
