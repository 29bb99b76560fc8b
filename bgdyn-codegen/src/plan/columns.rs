//! A loop over similar columns: the plan of one column, over the arrays of what it reads.

use super::block::BlockPlan;
use super::inline::reads_per_output;
use super::limits::PlanLimits;
use crate::column_loop::ColumnLoop;
use crate::method::Shape;

/// A loop over columns. One column reads the values that all columns share, and its own: both are results of the
/// blocks before the loop.
#[derive(Debug)]
pub struct ColumnPlan<'a> {
    /// The loop: which results of the blocks are read, column by column.
    pub group: &'a ColumnLoop,
    /// The plan of one column.
    pub column: BlockPlan<'a>,
}

impl<'a> ColumnPlan<'a> {
    pub(super) fn new(group: &'a ColumnLoop, shape: Shape, limits: &PlanLimits) -> Self {
        let outputs = group.outputs.clone();
        let reads = reads_per_output(shape);
        ColumnPlan {
            group,
            column: BlockPlan::new(&group.graph, outputs, None, reads, limits),
        }
    }

    /// Returns the indices of the values that one column has of its own, row by row: of each row, one index per
    /// column.
    pub fn own_rows(&self) -> Vec<Vec<usize>> {
        let height = self.group.own.first().map_or(0, Vec::len);
        let row = |row: usize| self.group.own.iter().map(|column| column[row]).collect();
        (0..height).map(row).collect()
    }
}
