//! `linear`: Σ k v = 0, on velocities only; each joint has a position of its own.

use super::constraint_type::{ConstraintType, ReadConstraint};
use super::row::{COEFFICIENTS, RowReader};
use crate::format::{Fields, Key, Reads};

/// The type `linear`.
pub(super) struct Linear;

const ROW: Key = Key {
    name: "row",
    reads: Reads::Coefficients(&COEFFICIENTS),
    needed: true,
    about: "the joints with the coefficients of their velocities: `{ left: 1, right: -1 }`",
};

impl ConstraintType for Linear {
    fn keyword(&self) -> &'static str {
        "linear"
    }

    fn keys(&self) -> &'static [Key] {
        &[ROW]
    }

    fn read(&self, fields: &Fields, reader: &mut RowReader<'_>) -> Option<ReadConstraint> {
        let (terms, _) = reader.terms(fields, &ROW)?;
        Some(ReadConstraint::Row(reader.row(terms, None)))
    }
}
