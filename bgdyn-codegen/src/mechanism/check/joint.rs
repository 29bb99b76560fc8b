//! Checks joints: type, axis, origin, limits.

use bgdyn_runtime::Dd;

use super::direction::Directions;
use super::names::mount_name;
use crate::fault::{Faults, wording};
use crate::format::{self, Dimension, Field, LinkSpec, Located, Number, misfit};
use crate::math::Vec3;
use crate::mechanism::joint::JOINT_TYPES;
use crate::mechanism::{Joint, JointType, Limits, Motion};

/// Returns the joint of `link`; its coordinate is assigned later.
pub(super) fn joint(
    link: &LinkSpec,
    directions: &Directions,
    faults: &mut Faults,
) -> Option<Joint> {
    match &link.joint {
        Field::Absent => Some(Joint {
            name: mount_name(link.name.value()?),
            label: None,
            kind: crate::mechanism::joint::fixed(),
            axis: z(),
            origin: Directions::identity(),
            limits: Limits::default(),
            coordinate: None,
        }),
        Field::Broken => None,
        Field::Given(joint) => given(&joint.value, link, directions, faults),
    }
}

fn given(
    joint: &format::JointSpec,
    link: &LinkSpec,
    directions: &Directions,
    faults: &mut Faults,
) -> Option<Joint> {
    let kind = kind(joint, faults);
    let axis = axis(joint, kind, directions, faults);
    let origin = directions.pose(&joint.origin, faults);
    let limits = limits(joint, kind, faults);
    let name = name(joint, link, kind, faults);
    Some(Joint {
        name: name?,
        label: joint.label.value().cloned(),
        kind: kind?,
        axis: axis?,
        origin: origin?,
        limits: limits?,
        coordinate: None,
    })
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
    match &joint.axis {
        Field::Absent => Some(z()),
        Field::Broken => None,
        Field::Given(axis) if kind.is_some_and(|kind| kind.motion == Motion::None) => {
            faults.push(wording::axis_of_fixed_joint(&axis.location));
            None
        }
        Field::Given(axis) => directions.axis(axis, faults),
    }
}

fn limits(
    joint: &format::JointSpec,
    kind: Option<&'static JointType>,
    faults: &mut Faults,
) -> Option<Limits> {
    let given = match &joint.limits {
        Field::Absent => return Some(Limits::default()),
        Field::Broken => return None,
        Field::Given(limits) => limits,
    };
    if kind.is_some_and(|kind| kind.motion == Motion::None) {
        faults.push(wording::limits_of_fixed_joint(&given.location));
        return None;
    }
    let limits = &given.value;
    if let Some(kind) = kind {
        position_limits(limits, kind, faults);
        units(limits, kind.motion, faults);
    }
    signs(limits, faults);
    Some(Limits {
        lower: number(&limits.lower)?,
        upper: number(&limits.upper)?,
        velocity: number(&limits.velocity)?,
        effort: number(&limits.effort)?,
    })
}

fn number(field: &Field<Number>) -> Option<Option<f64>> {
    match field {
        Field::Absent => Some(None),
        Field::Broken => None,
        Field::Given(number) => Some(Some(number.value.value.to_f64())),
    }
}

fn position_limits(limits: &format::LimitsSpec, kind: &JointType, faults: &mut Faults) {
    if kind.position_limits {
        return;
    }
    for limit in [&limits.lower, &limits.upper]
        .into_iter()
        .filter_map(Field::given)
    {
        faults.push(wording::position_limit(&limit.location, kind.keyword));
    }
}

/// Checks the units of the coordinate, its rate and its effort, for a motion.
fn units(limits: &format::LimitsSpec, motion: Motion, faults: &mut Faults) {
    let [position, speed, effort] = match motion {
        Motion::None => return,
        Motion::Rotation => [Dimension::Angle, Dimension::AngularSpeed, Dimension::Torque],
        Motion::Translation => [Dimension::Length, Dimension::Speed, Dimension::Force],
    };
    let places = [
        (&limits.lower, position),
        (&limits.upper, position),
        (&limits.velocity, speed),
        (&limits.effort, effort),
    ];
    for (limit, dimension) in places {
        faults
            .0
            .extend(limit.given().and_then(|limit| misfit(limit, &[dimension])));
    }
}

fn signs(limits: &format::LimitsSpec, faults: &mut Faults) {
    if let (Some(lower), Some(upper)) = (limits.lower.given(), limits.upper.given())
        && lower.value.value > upper.value.value
        && same_dimension(lower, upper)
    {
        let (low, high) = (&lower.value.text, &upper.value.text);
        faults.push(wording::lower_above_upper(&lower.location, low, high));
    }
    for limit in [&limits.velocity, &limits.effort]
        .into_iter()
        .filter_map(Field::given)
    {
        if limit.value.value < Dd::ZERO {
            faults.push(wording::negative_limit(&limit.location, &limit.value.text));
        }
    }
}

/// Returns whether two numbers can be compared: not an angle with a length.
fn same_dimension(a: &Located<Number>, b: &Located<Number>) -> bool {
    match (a.value.unit, b.value.unit) {
        (Some(a), Some(b)) => a.dimension == b.dimension,
        _ => true,
    }
}
