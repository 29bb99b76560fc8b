//! The trait of the types of constraints.

use super::contact::ContactEntry;
use super::row::{PrescribedEntry, Row, RowReader};
use crate::format::{Fields, Key};

/// A type of constraint.
pub(super) trait ConstraintType: Sync {
    /// Returns its word in files.
    fn keyword(&self) -> &'static str;

    /// Returns its keys.
    fn keys(&self) -> &'static [Key];

    /// Returns what it says of joints; `None` if a rule is broken.
    fn read(&self, fields: &Fields, reader: &mut RowReader<'_>) -> Option<ReadConstraint>;
}

/// What a constraint says of joints.
#[derive(Clone, Debug)]
pub(super) enum ReadConstraint {
    /// Joints follow each other.
    Row(Row),
    /// The motion of a joint is given.
    Prescribed(PrescribedEntry),
    /// A place does not slip.
    Contact(Box<ContactEntry>),
}
