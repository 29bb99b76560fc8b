//! `knife_edge`: a place does not move along one of its directions: a blade, a skate, a steered axle.

use super::constraint_type::{ConstraintType, ReadConstraint};
use super::contact::{ContactEntry, ContactKind};
use super::row::RowReader;
use crate::format::{Fields, Key, Reads};

/// The type `knife_edge`.
pub(super) struct KnifeEdge;

const AT: Key = Key {
    name: "at",
    reads: Reads::Site,
    needed: true,
    about: "the link or frame whose origin is the edge's place",
};

const DIRECTION: Key = Key {
    name: "direction",
    reads: Reads::Axis,
    needed: true,
    about: "the direction of its axes along which its origin does not move: `y`, `[1, 0, 0.5]`",
};

impl ConstraintType for KnifeEdge {
    fn keyword(&self) -> &'static str {
        "knife_edge"
    }

    fn keys(&self) -> &'static [Key] {
        &[AT, DIRECTION]
    }

    fn read(&self, fields: &Fields, reader: &mut RowReader<'_>) -> Option<ReadConstraint> {
        let kind = ContactKind::Edge {
            direction: reader.axis(fields, &DIRECTION)?,
        };
        Some(ReadConstraint::Contact(Box::new(ContactEntry {
            name: reader.name.value.clone(),
            location: reader.location.clone(),
            at: reader.text(fields, &AT)?,
            kind,
        })))
    }
}
