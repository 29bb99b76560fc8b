//! Constraints with constant coefficients: which joints follow which, and whose motion is given, before any
//! formulation sees them.
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
//! | `row.rs` | a row from the coefficients in the file: names, units |
//! | `elimination.rs` | solves rows for dependent joints |
//! | `couple.rs` | sets the couplings of the joints, those with `mimic` included |

mod constraint_type;
mod couple;
mod elimination;
mod gear;
mod linear;
mod prescribed;
mod row;

use crate::fault::{Faults, wording};
use crate::format::{Key, Raw, Reads, Spec};
use crate::mechanism::check::parameters::Parameters;
use crate::mechanism::{Leader, Link, LinkId};
use crate::name::is_identifier;
use constraint_type::{ConstraintType, ReadConstraint};
use row::{RowReader, one_degree, unknown};

/// All types of constraints.
static CONSTRAINT_TYPES: [&dyn ConstraintType; 3] =
    [&gear::Gear, &linear::Linear, &prescribed::Prescribed];

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

/// Reads the constraints, couples the joints that they make dependent, and returns the links of those whose
/// motion is given. `None` if a rule is broken.
pub(super) fn apply(
    spec: &Spec,
    links: &mut [Link],
    parameters: &Parameters<'_>,
    faults: &mut Faults,
) -> Option<Vec<LinkId>> {
    let before = faults.count();
    let raws = spec.constraints.value().map_or(&[][..], Vec::as_slice);
    let (mut rows, mut prescribed) = (Vec::new(), Vec::new());
    for raw in raws {
        match read(raw, (spec, links), faults) {
            Some(ReadConstraint::Row(row)) => rows.push(row),
            Some(ReadConstraint::Prescribed(entry)) => prescribed.push(entry),
            None => {}
        }
    }
    let kept = independent(spec, links, faults);
    let others = (&*links, &rows[..], &kept[..]);
    prescribed::check(&prescribed, others, parameters, faults);
    prescribed::check_loops(&prescribed, spec, (links, faults));
    if faults.count() > before {
        return None;
    }
    couple::couple(links, &rows, &kept, faults);
    let given = prescribed.iter().map(|entry| entry.link).collect();
    (faults.count() == before).then_some(given)
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
        .find(|key| key.needed && fields.get(key.name).is_none());
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

/// Returns the links of the joints that the file lists as `independent`; none has `mimic`.
fn independent(spec: &Spec, links: &[Link], faults: &mut Faults) -> Vec<LinkId> {
    let mut kept = Vec::new();
    for name in spec.independent.value().into_iter().flatten() {
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
