//! What positions are assembled to: the rows that close, the blocks that tell the branch, the joints of the loops.

use crate::mechanism::closure::Closure;

/// What positions are assembled to.
pub struct AssemblyConditions {
    /// For each row, the index of its loop; `None` for a row that is no condition on positions.
    pub rows: Vec<Option<usize>>,
    /// The blocks that tell the branch.
    pub blocks: Vec<BranchConditions>,
    /// Velocities of the joints in loops with a position of their own, and these positions.
    pub joints: Vec<(usize, usize)>,
}

/// Rows of one block of conditions, and its dependent velocities: their determinant tells the branch.
pub struct BranchConditions {
    /// The rows.
    pub rows: Vec<usize>,
    /// As many velocities of the open tree.
    pub columns: Vec<usize>,
    /// Whether the determinant is positive on the branch of the mechanism.
    pub positive: bool,
    /// The index of its loop.
    pub closes: usize,
}

impl AssemblyConditions {
    /// Returns the conditions of loops and contacts.
    pub fn new(closure: &Closure) -> Self {
        let rows = closure.rows.iter().map(|row| {
            let closes = row.kind.has_positions();
            closes.then_some(row.closes)
        });
        // With rows on velocities positions close by shortest steps, and no determinant tells a branch.
        let slips = closure.nonholonomic();
        let blocks = closure.blocks.iter().zip(&closure.signs);
        let blocks = blocks
            .filter(|_| !slips)
            .map(|(block, positive)| BranchConditions {
                rows: block.rows.clone(),
                columns: block.dependents.iter().map(|j| j.0).collect(),
                positive: *positive,
                closes: block.rows.first().map_or(0, |&r| closure.rows[r].closes),
            });
        let joints = closure.positions.iter().enumerate();
        let joints = joints.filter_map(|(j, position)| Some((j, position.as_ref()?.0)));
        AssemblyConditions {
            rows: rows.collect(),
            blocks: blocks.collect(),
            joints: joints.filter(|_| !slips).collect(),
        }
    }
}
