//! Checks joints: type, axes, lead, origin, limits.

use bgdyn_runtime::Dd;

use super::direction::Directions;
use super::names::mount_name;
use crate::fault::{Faults, Location, wording};
use crate::format::{self, Dimension, Field, LinkSpec, Located, MimicSpec, Number, misfit};
use crate::math::Vec3;
use crate::mechanism::joint::{ChainMember, JOINT_TYPES, Step};
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
    if let Some(axis2) = axis2
        && parallel(axis, axis2)
    {
        let location = joint.axis2.given().map_or(&joint.location, |a| &a.location);
        faults.push(wording::parallel_axes(location));
        return None;
    }
    if let (Some(axis2), Some(given)) = (axis2, joint.axis2.given())
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
            faults.push(wording::no_second_axis(&joint.location));
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

/// Returns the limits of the joint, or of each joint of a chain.
fn limits(
    joint: &format::JointSpec,
    kind: Option<&'static JointType>,
    faults: &mut Faults,
) -> Option<Vec<Limits>> {
    let members = kind.map_or(&[][..], |kind| kind.chain);
    let given = match &joint.limits {
        Field::Absent => return Some(vec![Limits::default(); members.len().max(1)]),
        Field::Broken => return None,
        Field::Given(limits) => limits,
    };
    match kind.map(|kind| kind.motion) {
        Some(Motion::None) => {
            faults.push(wording::limits_of_fixed_joint(&given.location));
            return None;
        }
        Some(motion) if motion.nv() > 1 => {
            faults.push(wording::limits_of_joint(&given.location, kind?.keyword));
            return None;
        }
        _ => {}
    }
    let parts = given.value.parts.iter().zip(format::LIMIT_PARTS);
    for (part, key) in parts.clone() {
        let known = members.iter().any(|member| member.suffix == key);
        if let (Some(part), Some(kind), false) = (part.given(), kind, known) {
            faults.push(wording::limits_of_part(&part.location, kind.keyword, key));
            return None;
        }
    }
    if members.is_empty() {
        return Some(vec![of_one(&given.value, kind, faults)?]);
    }
    if let Some(bare) = of_whole(&given.value) {
        let suffixes: Vec<&str> = members.iter().map(|member| member.suffix).collect();
        faults.push(wording::limits_of_chain(bare, kind?.keyword, &suffixes));
        return None;
    }
    let of_member = |member: &ChainMember| {
        let own = parts.clone().find(|(_, key)| *key == member.suffix);
        match own?.0 {
            Field::Absent => Some(Limits::default()),
            Field::Broken => None,
            Field::Given(limits) => of_one(&limits.value, Some(member.kind), faults),
        }
    };
    members.iter().map(of_member).collect()
}

/// Returns the location of a limit that belongs to no part.
fn of_whole(limits: &format::LimitsSpec) -> Option<&Location> {
    let own = [
        &limits.lower,
        &limits.upper,
        &limits.velocity,
        &limits.effort,
    ];
    let mut own = own.into_iter().filter_map(Field::given);
    own.next().map(|limit| &limit.location)
}

fn of_one(
    limits: &format::LimitsSpec,
    kind: Option<&'static JointType>,
    faults: &mut Faults,
) -> Option<Limits> {
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
        // The coordinate of a screw is its angle.
        Motion::Rotation | Motion::Compound(_) => {
            [Dimension::Angle, Dimension::AngularSpeed, Dimension::Torque]
        }
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
