//! Checks joints that mimic others, and resolves chains of them.

use bgdyn_runtime::Dd;

use crate::fault::{Faults, wording};
use crate::format::{Dimension, Field, Located, MimicSpec, Number, check_unit};
use crate::mechanism::joint::{JOINT_TYPES, JointType};
use crate::mechanism::{Coupling, Joint, Leader, Limits, Link, LinkId, Motion};

/// The `mimic` of a link's joint, as in the file.
pub(super) type Given = Option<Located<MimicSpec>>;

/// A relation to another joint that may have a leader itself.
#[derive(Clone, Copy)]
struct Relation {
    leader: usize,
    ratio: Dd,
    offset: Dd,
}

/// Resolves every `mimic`: leaders that mimic no other joint, with ratios and offsets of whole chains; the
/// limits of followers become limits of their leader. `None` if a rule is broken.
pub(super) fn resolve(links: &mut [Link], given: &[Given], faults: &mut Faults) -> Option<()> {
    let before = faults.0.len();
    let relation = |i: usize, faults: &mut Faults| match &given[i] {
        None => Some(None),
        Some(mimic) => direct(links, i, mimic, faults).map(Some),
    };
    let direct: Vec<Option<Option<Relation>>> =
        (0..links.len()).map(|i| relation(i, faults)).collect();
    let direct: Vec<Option<Relation>> = direct.into_iter().collect::<Option<_>>()?;
    for i in 0..links.len() {
        if circle(links, &direct, i, given, faults) {
            return None;
        }
    }
    for i in 0..links.len() {
        let Some(mut whole) = direct[i] else { continue };
        while let Some(next) = direct[whole.leader] {
            // x = a (b y + c) + d
            whole = Relation {
                leader: next.leader,
                ratio: whole.ratio * next.ratio,
                offset: whole.ratio * next.offset + whole.offset,
            };
        }
        let limits = links[i].joint.limits;
        let leader = Leader {
            link: LinkId(whole.leader),
            ratio: whole.ratio,
        };
        links[i].joint.degrees.coupling = Some(Coupling::single(leader, whole.offset));
        let leader = &mut links[whole.leader].joint;
        narrow(&mut leader.limits, limits, (whole.ratio, whole.offset));
        let empty =
            matches!((leader.limits.lower, leader.limits.upper), (Some(l), Some(u)) if l > u);
        if let (true, Some(mimic)) = (empty, &given[i]) {
            let range = (leader.limits.lower, leader.limits.upper);
            faults.push(wording::mimic_empty_range(
                &mimic.location,
                &leader.name,
                range,
            ));
        }
    }
    (faults.0.len() == before).then_some(())
}

/// Returns the relation as the file states it.
fn direct(
    links: &[Link],
    i: usize,
    mimic: &Located<MimicSpec>,
    faults: &mut Faults,
) -> Option<Relation> {
    let name = mimic.value.joint.given()?;
    let Some(leader) = links.iter().position(|l| l.joint.name == name.value) else {
        if let Some(keyword) = chain_named(links, &name.value) {
            faults.push(wording::leader_of_type(
                &name.location,
                &name.value,
                keyword,
            ));
            return None;
        }
        let names: Vec<&str> = links.iter().map(|l| l.joint.name.as_str()).collect();
        faults.push(wording::unknown_leader(&name.location, &name.value, &names));
        return None;
    };
    let (own, other) = (&links[i].joint, &links[leader].joint);
    if !other.kind.one_degree() {
        let keyword = other.kind.keyword;
        faults.push(wording::leader_of_type(
            &name.location,
            &name.value,
            keyword,
        ));
        return None;
    }
    let slides = |joint: &Joint| joint.kind.motion == Motion::Translation;
    let fit = match (slides(own), slides(other)) {
        (true, false) => Dimension::Lead,
        (false, true) => Dimension::AnglePerLength,
        _ => Dimension::One,
    };
    let length = if slides(own) {
        Dimension::Length
    } else {
        Dimension::Angle
    };
    if fit != Dimension::One && mimic.value.ratio.is_absent() {
        faults.push(wording::ratio_needed(&mimic.location, &name.value, fit));
        return None;
    }
    let ratio = number(&mimic.value.ratio, fit, Dd::ONE, faults)?;
    let offset = number(&mimic.value.offset, length, Dd::ZERO, faults)?;
    if ratio == Dd::ZERO {
        let location = mimic
            .value
            .ratio
            .given()
            .map_or(&mimic.location, |r| &r.location);
        faults.push(wording::zero_ratio(location));
        return None;
    }
    Some(Relation {
        leader,
        ratio,
        offset,
    })
}

/// Returns the type of a joint that is two joints in series, by its name.
fn chain_named(links: &[Link], name: &str) -> Option<&'static str> {
    let hidden = links.iter().filter(|link| link.hidden);
    let mut first = hidden.filter_map(|link| link.joint.name.strip_prefix(name)?.strip_prefix('_'));
    let suffix = first.next()?;
    let of = |kind: &&&JointType| kind.chain.first().is_some_and(|m| m.suffix == suffix);
    JOINT_TYPES.iter().find(of).map(|kind| kind.keyword)
}

/// Returns a number of this dimension, or the default.
fn number(field: &Field<Number>, fit: Dimension, default: Dd, faults: &mut Faults) -> Option<Dd> {
    match field {
        Field::Absent => Some(default),
        Field::Broken => None,
        Field::Given(number) => match check_unit(number, &[fit]) {
            Some(fault) => {
                faults.push(fault);
                None
            }
            None => Some(number.value.value),
        },
    }
}

/// Reports a circle of joints that mimic each other, at its first joint; returns whether `start` leads to
/// one.
fn circle(
    links: &[Link],
    direct: &[Option<Relation>],
    start: usize,
    given: &[Given],
    faults: &mut Faults,
) -> bool {
    let mut chain = vec![start];
    while let Some(next) = direct[chain[chain.len() - 1]] {
        if let Some(from) = chain.iter().position(|&i| i == next.leader) {
            let names: Vec<&str> = chain[from..]
                .iter()
                .map(|&i| links[i].joint.name.as_str())
                .collect();
            if let Some(mimic) = &given[chain[from]] {
                faults.push(wording::mimic_circle(&mimic.location, &names));
            }
            return true;
        }
        chain.push(next.leader);
    }
    false
}

/// Narrows the limits of a leader by those of a follower at ratio · q + offset.
pub(super) fn narrow(leader: &mut Limits, follower: Limits, (ratio, offset): (Dd, Dd)) {
    let (ratio, offset) = (ratio.to_f64(), offset.to_f64());
    let bound = |x: Option<f64>| x.map(|x| (x - offset) / ratio);
    let (mut lower, mut upper) = (bound(follower.lower), bound(follower.upper));
    if ratio < 0.0 {
        (lower, upper) = (upper, lower);
    }
    let both = |a: Option<f64>, b: Option<f64>, pick: fn(f64, f64) -> f64| match (a, b) {
        (Some(a), Some(b)) => Some(pick(a, b)),
        (a, b) => a.or(b),
    };
    leader.lower = both(leader.lower, lower, f64::max);
    leader.upper = both(leader.upper, upper, f64::min);
    let speed = follower.velocity.map(|x| x / ratio.abs());
    leader.velocity = both(leader.velocity, speed, f64::min);
    // An effort e at the follower is ratio · e at the leader.
    let effort = follower.effort.map(|x| x * ratio.abs());
    leader.effort = both(leader.effort, effort, f64::min);
}
