//! `gear`: Σ k q = offset, on positions and velocities.

use bgdyn_runtime::Dd;

use super::constraint_type::{ConstraintType, ReadConstraint};
use super::row::{COEFFICIENTS, RowReader};
use crate::format::{Dimension, Fields, Key, Reads};

/// The type `gear`.
pub(super) struct Gear;

const JOINTS: Key = Key {
    name: "joints",
    reads: Reads::Coefficients(&COEFFICIENTS),
    needed: true,
    about: "the joints with their coefficients: `{ left: 1, right: -1/50 }`",
};

const OFFSET: Key = Key {
    name: "offset",
    reads: Reads::Number(&[Dimension::Angle, Dimension::Length]),
    needed: false,
    about: "the value of the sum; 0 without it",
};

impl ConstraintType for Gear {
    fn keyword(&self) -> &'static str {
        "gear"
    }

    fn keys(&self) -> &'static [Key] {
        &[JOINTS, OFFSET]
    }

    fn read(&self, fields: &Fields, reader: &mut RowReader<'_>) -> Option<ReadConstraint> {
        let (terms, dimension) = reader.terms(fields, &JOINTS)?;
        let offset = match fields.get(&OFFSET) {
            None => Dd::ZERO,
            Some(entry) => reader.number(entry, dimension)?,
        };
        Some(ReadConstraint::Row(reader.row(terms, Some(offset))))
    }
}
