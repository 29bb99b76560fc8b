//! Contacts whose gap no joint changes.

use bgdyn_runtime::Dd;

use super::loops::{Tree, path};
use crate::fault::{Faults, wording};
use crate::format::Spec;
use crate::mechanism::{
    ContactPair, ContactPartner, ContactSphere, LinkId, Mechanism, Motion, Pose, SiteOrigins,
};

/// Gaps that differ by less, relative to the largest length, are equal.
const ROUNDING: f64 = 1e-26;

/// Reports entries of `contacts` whose gaps no joint changes.
pub(super) fn refuse_constant(spec: &Spec, mechanism: &Mechanism, faults: &mut Faults) {
    let raws = spec.contacts.value().map_or(&[][..], Vec::as_slice);
    if raws.is_empty() {
        return;
    }
    let poses = SiteOrigins::sampled_poses(mechanism);
    for pairs in mechanism
        .contact_pairs()
        .chunk_by(|a, b| a.entry == b.entry)
    {
        let constant: Option<Vec<f64>> = pairs
            .iter()
            .map(|pair| constant_gap(pair, &poses))
            .collect();
        let raw = raws.iter().find(|raw| raw.name.value == pairs[0].entry);
        let (Some(gaps), Some(raw)) = (constant, raw) else {
            continue;
        };
        let (location, name) = (&raw.location, &raw.name.value);
        faults.push(match joint_between(mechanism, &pairs[0]) {
            true => wording::contact_gap_constant(location, name, gaps[0]),
            false => wording::contact_pair_moves_nothing(location, name),
        });
    }
}

/// Returns whether a joint moves the two links of a pair relative to each other.
fn joint_between(mechanism: &Mechanism, pair: &ContactPair) -> bool {
    let tree = Tree::new(mechanism.links(), mechanism.frames());
    let way = path(tree, pair.sphere.link, pair.partner.link());
    let moves =
        |&(LinkId(i), _): &(LinkId, bool)| mechanism.links()[i].joint.kind.motion != Motion::None;
    way.iter().any(moves)
}

/// Returns the gap of a pair, m, if it is the same at all positions; `poses` are those of the links at each.
fn constant_gap(pair: &ContactPair, poses: &[Vec<Pose>]) -> Option<f64> {
    let gaps: Vec<Dd> = poses.iter().map(|poses| gap(pair, poses)).collect();
    let first = *gaps.first()?;
    let places = poses.iter().flatten().map(|pose| pose.translation);
    let places = places.chain([pair.sphere.centre]);
    let size = places.flat_map(|place| place.0.map(|x| x.to_f64().abs()));
    let size = size.fold(first.to_f64().abs().max(1e-3), f64::max);
    let same = gaps
        .iter()
        .all(|x| (*x - first).to_f64().abs() <= ROUNDING * size);
    same.then(|| first.to_f64())
}

/// Returns the gap of a pair with links at these poses, m.
fn gap(pair: &ContactPair, poses: &[Pose]) -> Dd {
    let of = |link: Option<LinkId>| link.map_or(Pose::IDENTITY, |LinkId(i)| poses[i]);
    let place = |sphere: &ContactSphere| {
        let pose = of(sphere.link);
        pose.translation + pose.rotation * sphere.centre
    };
    let centre = place(&pair.sphere);
    match &pair.partner {
        ContactPartner::Plane { link, pose } => {
            let carrier = of(*link);
            let origin = carrier.translation + carrier.rotation * pose.translation;
            let normal = (carrier.rotation * pose.rotation).column(2);
            normal.dot(centre - origin) - pair.sphere.radius
        }
        ContactPartner::Sphere(other) => {
            let apart = centre - place(other);
            apart.dot(apart).sqrt() - pair.sphere.radius - other.radius
        }
    }
}
