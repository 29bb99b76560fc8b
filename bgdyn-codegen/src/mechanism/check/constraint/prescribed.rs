//! `prescribed`: the position of a joint is a given function of time.

use super::constraint_type::{ConstraintType, ReadConstraint};
use super::row::{PrescribedEntry, Row, RowReader};
use crate::fault::{Faults, wording};
use crate::format::{Fields, Key, Reads};
use crate::mechanism::check::parameters::Parameters;
use crate::mechanism::{Leader, Link, LinkId, prescribed_parameter_names};

/// The type `prescribed`.
pub(super) struct Prescribed;

const JOINT: Key = Key {
    name: "joint",
    reads: Reads::Joint,
    needed: true,
    about: "the joint whose position, velocity and acceleration are given at run time",
};

impl ConstraintType for Prescribed {
    fn keyword(&self) -> &'static str {
        "prescribed"
    }

    fn keys(&self) -> &'static [Key] {
        &[JOINT]
    }

    fn read(&self, fields: &Fields, reader: &mut RowReader<'_>) -> Option<ReadConstraint> {
        let (link, location) = reader.joint(fields, &JOINT)?;
        Some(ReadConstraint::Prescribed(PrescribedEntry {
            name: reader.name.value.clone(),
            location,
            link,
        }))
    }
}

/// Reports joints that are prescribed and follow others, are followed, or are listed as independent; a joint
/// that is prescribed twice; and run-time parameters with the names of those of such a joint.
pub(super) fn check(
    entries: &[PrescribedEntry],
    (links, rows, kept): (&[Link], &[Row], &[LinkId]),
    parameters: &Parameters<'_>,
    faults: &mut Faults,
) {
    for (i, entry) in entries.iter().enumerate() {
        let joint = links[entry.link.0].joint.name.as_str();
        let location = &entry.location;
        if let Some(first) = entries[..i].iter().find(|e| e.link == entry.link) {
            faults.push(wording::prescribed_twice(location, joint, &first.name));
        }
        for row in rows.iter().filter(|row| contains(&row.terms, entry.link)) {
            faults.push(wording::prescribed_in_row(location, joint, &row.name));
        }
        if let Some(own) = &links[entry.link.0].joint.degrees.coupling {
            let leader = |leader: &Leader| links[leader.link.0].joint.name.as_str();
            let leaders: Vec<&str> = own.positions.iter().map(leader).collect();
            faults.push(wording::prescribed_follower(location, joint, &leaders));
        }
        let follows = |link: &&Link| {
            let coupling = link.joint.degrees.coupling.as_ref();
            coupling.is_some_and(|c| contains(&c.positions, entry.link))
        };
        if let Some(follower) = links.iter().find(follows) {
            let follower = &follower.joint.name;
            faults.push(wording::prescribed_leader(location, joint, follower));
        }
        if kept.contains(&entry.link) {
            faults.push(wording::prescribed_independent(location, joint));
        }
        let own = prescribed_parameter_names(joint);
        for (name, at) in parameters
            .names()
            .filter(|(name, _)| own.iter().any(|o| o == name))
        {
            faults.push(wording::parameter_of_prescribed(at, name, joint));
        }
    }
}

/// Refuses prescribed joints in a mechanism with loops, wheels or knife edges.
pub(super) fn check_loops(
    entries: &[PrescribedEntry],
    closed: bool,
    (links, faults): (&[Link], &mut Faults),
) {
    if let (true, Some(entry)) = (closed, entries.first()) {
        let joint = &links[entry.link.0].joint.name;
        faults.push(wording::prescribed_with_loops(&entry.location, joint));
    }
}

fn contains(terms: &[Leader], link: LinkId) -> bool {
    terms.iter().any(|term| term.link == link)
}
