//! Closed kinematic loops: which velocities of the open tree follow from which others.
//!
//! A loop connects two places of the tree. Each row of its type is a condition c(q) = 0; its rate is a row of
//! B(q) q̇ = 0, with the velocities q̇ of the open tree. In the bond graph it is a 0-junction that adds flows,
//! with a flow source 0; the effort of that bond is the multiplier λ. As many velocities as there are rows are
//! dependent: q̇ = S(q) u and q̈ = S u̇ + z with B S = 0 and B z = γ = −Ḃ q̇, where u are the independent ones.
//!
//! | file | has |
//! |---|---|
//! | `chain.rs` | the joints of a loop in series, and the motion from place to place |
//! | `row.rs` | rows: value, rate, second derivative |
//! | `closing/` | a file for each type of loop |
//! | `numeric.rs` | values and Jacobians in double-double; closes and assembles positions |
//! | `reach.rs` | closed positions and velocities with given ones |
//! | `solve.rs` | linear equations |

mod chain;
mod closing;
mod numeric;
mod reach;
mod row;
mod solve;

use bgdyn_runtime::Dd;

use super::{CoordinateId, LinkId, PositionId};
use crate::fault::Location;
use crate::math::Vec3;
pub use chain::{ChainFrames, ChainStep, LoopChain, RelativePlace, RelativeRates};
pub use closing::{CLOSING_TYPES, ClosingType};
pub use reach::Unreached;
pub use row::RowKind;
use solve::solve_basic;
pub(crate) use solve::{eliminate, solve};

/// A kinematic loop of a mechanism.
#[derive(Clone, Debug, PartialEq)]
pub struct KinematicLoop {
    /// Its name.
    pub name: String,
    /// Its type.
    pub kind: &'static ClosingType,
    /// The links of its places a and b; `None` for the world.
    pub links: [Option<LinkId>; 2],
    /// The joints from a to b.
    pub chain: LoopChain,
    /// Length of a rod, m; 1 for other types.
    pub length: Dd,
    /// Unit vector of the axis of a planar loop, in the axes of place a.
    pub axis: Option<Vec3<Dd>>,
    /// Whether the same rows hold in the axes of place b: those of the chain from b to a.
    pub reversible: bool,
    /// The location of its entry in the file.
    pub location: Location,
}

/// A row of a loop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoopRow {
    /// The index of its loop.
    pub closes: usize,
    /// Its name: "x", "turn z".
    pub name: &'static str,
    /// What it is.
    pub kind: RowKind,
}

/// Rows that are solved together for as many dependent velocities, after those of earlier blocks.
#[derive(Clone, Debug, PartialEq)]
pub struct ClosureBlock {
    /// Indices of [`Closure::rows`].
    pub rows: Vec<usize>,
    /// The dependent velocities, of the open tree: that of the pivot of each row.
    pub dependents: Vec<CoordinateId>,
}

/// The loops of a mechanism, solved for the dependent velocities. Coordinates are those of the open tree.
#[derive(Clone, Debug, PartialEq)]
pub struct Closure {
    /// The loops, in the file's order.
    pub loops: Vec<KinematicLoop>,
    /// The rows, loop by loop, without those that hold at every position of the tree.
    pub rows: Vec<LoopRow>,
    /// The rows that hold at every position of the tree.
    pub dropped: Vec<LoopRow>,
    /// The independent velocities, in the order of v.
    pub independents: Vec<CoordinateId>,
    /// The other velocities, block by block.
    pub blocks: Vec<ClosureBlock>,
    /// For each velocity of the open tree, the position whose rate it is, if a loop contains its joint.
    pub positions: Vec<Option<PositionId>>,
    /// A closed position.
    pub start: Vec<Dd>,
    /// Closed positions at random, on the branch of the start.
    pub samples: Vec<Vec<Dd>>,
    /// For each block, whether the determinant of its columns is positive at the start: it changes its sign at
    /// singular positions only, so that it tells the branch.
    pub signs: Vec<bool>,
}

impl Closure {
    /// Returns the name of a row: "rocker_pin x".
    pub fn row_name(&self, row: &LoopRow) -> String {
        format!("{} {}", self.loops[row.closes].name, row.name)
    }

    /// Returns the index of the loop with the row that determines a dependent velocity.
    pub fn loop_of(&self, dependent: CoordinateId) -> usize {
        let mut blocks = self.blocks.iter();
        let block = blocks.find(|block| block.dependents.contains(&dependent));
        let row = block.and_then(|block| block.rows.first());
        row.map_or(0, |&r| self.rows[r].closes)
    }

    /// Returns the dependent velocities, block by block.
    pub fn dependents(&self) -> impl Iterator<Item = CoordinateId> {
        self.blocks
            .iter()
            .flat_map(|block| block.dependents.iter().copied())
    }
}
