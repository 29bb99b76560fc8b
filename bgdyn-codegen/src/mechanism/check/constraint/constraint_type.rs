//! The trait of the types of constraints.

use super::row::{Row, RowReader};
use crate::format::{Fields, Key};

/// A type of constraint.
pub(super) trait ConstraintType: Sync {
    /// Returns its word in files.
    fn keyword(&self) -> &'static str;

    /// Returns its keys.
    fn keys(&self) -> &'static [Key];

    /// Returns its row; `None` if a rule is broken.
    fn row(&self, fields: &Fields, reader: &mut RowReader<'_>) -> Option<Row>;
}
