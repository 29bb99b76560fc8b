//! Checks the limits of joints, and of the parts of two joints in series.

use bgdyn_runtime::Dd;

use crate::fault::{Faults, Location, wording};
use crate::format::{self, Dimension, Field, Located, Number, check_unit};
use crate::mechanism::joint::ChainMember;
use crate::mechanism::{JointType, Limits, Motion};

/// Returns the limits of the joint, or of each joint of a chain.
pub(super) fn limits(
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
        faults.0.extend(
            limit
                .given()
                .and_then(|limit| check_unit(limit, &[dimension])),
        );
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
