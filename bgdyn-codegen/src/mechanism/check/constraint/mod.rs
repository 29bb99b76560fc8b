//! Constraints with constant coefficients.
//!
//! They decide which joints follow which, and whose motion is given, before any formulation sees them.
//!
//! Wheels and knife edges are read here as well; their rows are those of `closure`.
//!
//! A row is Σ k q = offset (`gear`) or Σ k v = 0 (`linear`). Each row makes one joint dependent: the last one
//! in the order of the links that is not among the `independent` ones. The rows on positions are solved first
//! (Gauss–Jordan), then those on velocities among the joints that are left. A type is a file and a line in
//! [`CONSTRAINT_TYPES`].
//!
//! | file | does |
//! |---|---|
//! | `constraint_type.rs` | the trait of the types |
//! | `gear.rs`, `linear.rs` | types that relate joints: keys, and their row |
//! | `prescribed.rs` | the type that gives the motion of a joint: its keys and rules |
//! | `knife_edge.rs`, `rolling.rs` | types on the velocities of places: keys and rules |
//! | `contact.rs` | what they say |
//! | `row.rs` | a row from the coefficients in the file: names, units |
//! | `elimination.rs` | solves rows for dependent joints |
//! | `couple.rs` | sets the couplings of the joints, those with `mimic` included |

mod constraint_type;
mod contact;
mod couple;
mod elimination;
mod gear;
mod knife_edge;
mod linear;
mod prescribed;
mod rolling;
mod row;

use crate::fault::{Faults, wording};
use crate::format::{Key, Raw, Reads, Spec};
use crate::mechanism::check::parameters::Parameters;
use crate::mechanism::{Joint, Leader, Link, LinkId, Motion};
use crate::name::is_identifier;
use constraint_type::{ConstraintType, ReadConstraint};
pub(super) use contact::{ContactEntry, ContactKind, RollingSize, Slip};
pub(super) use couple::Relations;
pub(super) use row::Row;
use row::{RowReader, one_degree, unknown};

/// All types of constraints.
static CONSTRAINT_TYPES: [&dyn ConstraintType; 5] = [
    &gear::Gear,
    &linear::Linear,
    &prescribed::Prescribed,
    &knife_edge::KnifeEdge,
    &rolling::Rolling,
];

/// Returns the words for the types of constraints, with their keys.
pub fn constraint_types() -> impl Iterator<Item = (&'static str, &'static [Key])> {
    CONSTRAINT_TYPES
        .into_iter()
        .map(|kind| (kind.keyword(), kind.keys()))
}

/// The key for the type.
const TYPE: Key = Key {
    name: "type",
    reads: Reads::Word(&[]),
    needed: true,
    about: "what it is",
};

/// What constraints say that is not in the joints.
pub(super) struct AppliedConstraints {
    /// The links of the joints whose motion is given.
    pub(super) prescribed: Vec<LinkId>,
    /// Wheels and knife edges.
    pub(super) contacts: Vec<ContactEntry>,
}

/// Reads the constraints, couples the joints that they and the rows of loops make dependent, and returns the rest.
/// `None` if a rule is broken.
pub(super) fn apply(
    spec: &Spec,
    (links, of_loops): (&mut [Link], Vec<Row>),
    parameters: &Parameters<'_>,
    faults: &mut Faults,
) -> Option<AppliedConstraints> {
    let before = faults.count();
    let raws = spec.constraints.value().map_or(&[][..], Vec::as_slice);
    let (mut rows, mut prescribed, mut contacts) = (of_loops, Vec::new(), Vec::new());
    for raw in raws {
        match read(raw, (spec, links), faults) {
            Some(ReadConstraint::Row(row)) => rows.push(row),
            Some(ReadConstraint::Prescribed(entry)) => prescribed.push(entry),
            Some(ReadConstraint::Contact(entry)) => contacts.push(*entry),
            None => {}
        }
    }
    let closed = !contacts.is_empty()
        || spec
            .loops
            .value()
            .is_some_and(|l| l.iter().any(|one| !one.is_parallel()));
    let kept = independent(spec, links, closed, faults);
    let others = (&*links, &rows[..], &kept[..]);
    prescribed::check(&prescribed, others, parameters, faults);
    prescribed::check_loops(&prescribed, closed, (links, faults));
    if faults.count() > before {
        return None;
    }
    couple::couple(links, &rows, &kept, faults);
    let prescribed = prescribed.iter().map(|entry| entry.link).collect();
    (faults.count() == before).then_some(AppliedConstraints {
        prescribed,
        contacts,
    })
}

fn read(raw: &Raw, (spec, links): (&Spec, &[Link]), faults: &mut Faults) -> Option<ReadConstraint> {
    let name = &raw.name;
    if !is_identifier(&name.value) {
        faults.push(wording::not_identifier(&name.location, &name.value));
    }
    if is_taken(spec, links, &name.value) {
        faults.push(wording::constraint_has_taken_name(
            &name.location,
            &name.value,
        ));
    }
    let words: Vec<&str> = CONSTRAINT_TYPES.iter().map(|kind| kind.keyword()).collect();
    let Some(word) = raw.peek(TYPE.name) else {
        let fault = wording::constraint_without_type(&raw.location, &name.value, &words);
        faults.push(fault);
        return None;
    };
    let mut kinds = CONSTRAINT_TYPES.into_iter();
    let Some(kind) = kinds.find(|kind| kind.keyword() == word.value) else {
        let fault = wording::unknown_constraint_type(&word.location, &word.value, &words);
        faults.push(fault);
        return None;
    };
    let mut keys = kind.keys().to_vec();
    keys.push(TYPE);
    let example = format!("`{{ type: {}, … }}`", kind.keyword());
    let fields = raw.fields(("a constraint's keys", &example), &keys, faults)?;
    let missing = kind
        .keys()
        .iter()
        .find(|key| key.needed && fields.get(key).is_none());
    if let Some(key) = missing {
        let location = &raw.location;
        let key = (key.name, key.about);
        faults.push(wording::constraint_without_key(location, &name.value, key));
        return None;
    }
    let mut reader = RowReader {
        links,
        name,
        location: &raw.location,
        faults,
    };
    kind.read(&fields, &mut reader)
}

/// Returns whether a link, a joint, a frame or an effect has this name.
fn is_taken(spec: &Spec, links: &[Link], name: &str) -> bool {
    let mut frames = spec.frames.value().into_iter().flatten();
    let mut effects = spec.effects.value().into_iter().flatten();
    links
        .iter()
        .any(|link| link.name == name || link.joint.name == name)
        || frames.any(|frame| frame.name.value().is_some_and(|own| own == name))
        || effects.any(|effect| effect.name.value == name)
}

/// Returns the links of the joints that the file lists as `independent`; none has `mimic`. With loops or contacts, where
/// positions are `closed`, velocities of joints with several may be listed.
fn independent(spec: &Spec, links: &[Link], closed: bool, faults: &mut Faults) -> Vec<LinkId> {
    let mut kept = Vec::new();
    for name in spec.independent.value().into_iter().flatten() {
        if closed && links.iter().any(|link| is_part(&link.joint, &name.value)) {
            continue;
        }
        let found = one_degree(links).find(|(_, link)| link.joint.name == name.value);
        let Some((link, own)) = found else {
            faults.push(unknown(name, links));
            continue;
        };
        if let Some(coupling) = &own.joint.degrees.coupling {
            let leader = |leader: &Leader| links[leader.link.0].joint.name.as_str();
            let leaders: Vec<&str> = coupling.positions.iter().map(leader).collect();
            let fault = wording::independent_follower(&name.location, &name.value, &leaders);
            faults.push(fault);
        }
        kept.push(link);
    }
    kept
}

/// Returns whether a velocity of a joint with several has this name.
fn is_part(joint: &Joint, name: &str) -> bool {
    let Motion::Compound(motion) = joint.kind.motion else {
        return false;
    };
    let part = name
        .strip_prefix(&joint.name)
        .and_then(|end| end.strip_prefix('_'));
    let mut velocities = motion.velocities.iter();
    velocities.any(|velocity| part == Some(velocity.suffix))
}
