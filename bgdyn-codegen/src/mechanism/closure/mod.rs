//! Closed kinematic loops, and wheels and knife edges: which velocities of the open tree follow from which others.
//!
//! A loop connects two places of the tree. Each row of its type is a condition c(q) = 0; its rate is a row of
//! B(q) q̇ = 0, with the velocities q̇ of the open tree. In the bond graph it is a 0-junction that adds flows,
//! with a flow source 0; the effort of that bond is the multiplier λ. As many velocities as there are rows are
//! dependent: q̇ = S(q) u and q̈ = S u̇ + z with B S = 0 and B z = γ = −Ḃ q̇, where u are the independent ones.
//!
//! A wheel or a knife edge is a loop between its place and a plane, whose rows are conditions B(q) q̇ = 0 on velocities
//! (linear nonholonomic constraints). They decide nothing about positions: only rows with a position equation c(q)
//! close.
//!
//! | file | has |
//! |---|---|
//! | `actuated.rs` | the joints with drives |
//! | `chain.rs` | the joints of a loop in series, and the motion from place to place |
//! | `row.rs` | rows of loops: value, rate, second derivative |
//! | `contact_shape.rs`, `contact_types.rs` | what touches a plane, as data; its words in a file |
//! | `contact.rs`, `contact_row.rs` | wheels, balls and knife edges at one position; their rows |
//! | `round_contact.rs` | the contacts of ellipsoids and tyres |
//! | `rows_at.rs` | the rows of a loop or a contact at one position |
//! | `closing/` | a file for each type of loop |
//! | `numeric.rs` | values and Jacobians in double-double; closes and assembles positions |
//! | `polygon/` | planar loops in closed form |
//! | `ranges.rs` | ranges of independent joints in which loops close, condition numbers, ranks |
//! | `gap.rs` | by how much loops miss that do not close |
//! | `way.rs` | ways through closed positions that pass none at which branches meet |
//! | `pins.rs` | closed positions with given ones of joints with several velocities |
//! | `reach.rs`, `start_velocities.rs` | closed positions with given ones, and velocities there |
//! | `followed.rs` | which independent velocities joints determine |
//! | `solve.rs` | linear equations |

mod actuated;
mod chain;
mod closing;
mod contact;
mod contact_row;
mod contact_shape;
mod contact_types;
mod followed;
mod gap;
mod numeric;
mod pins;
mod polygon;
mod ranges;
mod reach;
mod round_contact;
mod row;
mod rows_at;
mod solve;
mod start_velocities;
mod way;

use bgdyn_runtime::Dd;

use super::{CoordinateId, LinkId, PositionId};
use crate::fault::Location;
use crate::math::Vec3;
pub use actuated::Actuated;
pub use chain::{ChainFrames, ChainStep, LoopChain, RelativePlace, RelativeRates, TwistPoint};
pub use closing::{CLOSING_TYPES, ClosingType};
pub use contact_shape::{
    ContactAxes, ContactNumbers, ContactRow, ContactShape, DISC_ROWS, EDGE_ROWS, PlaneContact,
    SPHERE_ROWS,
};
pub use contact_types::{DISC, ELLIPSOID, KNIFE_EDGE, SPHERE};
pub use gap::Gap;
pub use polygon::{
    AngleTerm, PlaneJoint, PlaneVector, Polygon, PolygonForm, PolygonSide, TurnedVector,
    closing_polygons, polygons, snapped,
};
pub use ranges::{ClosedRange, RangeEnd, TreeLimits};
pub use reach::Unreached;
pub use row::{ClosingRow, RowKind};
pub use rows_at::{RowAxes, RowLoad, RowsAt};
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
    /// What touches at place a, if it is no loop but a contact.
    pub contact: Option<PlaneContact>,
    /// Whether its branch is that of an antiparallelogram.
    pub crossed: bool,
    /// The location of its entry in the file.
    pub location: Location,
}

impl KinematicLoop {
    /// Returns its rows with their names.
    pub fn rows(&self) -> Vec<(&'static str, RowKind)> {
        let closing = self.kind.rows.iter();
        let closing = closing.map(|&(name, row)| (name, RowKind::Closing(row)));
        let own = self.contact.iter().flat_map(|contact| &contact.rows);
        let own = own.map(|&(name, row)| (name, RowKind::Contact(row)));
        closing.chain(own).collect()
    }

    /// Returns the velocities of the open tree that move place b relative to place a, and those of a wheel's axle.
    pub fn velocities(&self) -> impl Iterator<Item = CoordinateId> {
        let steps = self.chain.steps.iter();
        let spin = self.contact.iter().flat_map(|contact| &contact.spin);
        let of_steps = steps.flat_map(|step| step.degrees.velocities.iter().copied());
        of_steps.chain(spin.map(|(j, _)| *j))
    }
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

/// A row that is left out because it follows from others; its multiplier is not determined.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FollowingRow {
    /// The row.
    pub row: LoopRow,
    /// Whether it follows at every position of the tree, not at closed ones only.
    pub always: bool,
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
    /// The rows that follow from [`Closure::rows`].
    pub following: Vec<FollowingRow>,
    /// The independent velocities, in the order of v.
    pub independents: Vec<CoordinateId>,
    /// The other velocities, block by block.
    pub blocks: Vec<ClosureBlock>,
    /// For each velocity of the open tree, the position whose rate it is, if a loop contains its joint; `None` for
    /// those of [`Closure::compounds`].
    pub positions: Vec<Option<PositionId>>,
    /// The joints of several degrees of freedom that contacts contain.
    pub compounds: Vec<ChainStep>,
    /// The dependent velocities along which positions close, by the shortest step, if there are rows without positions;
    /// otherwise all dependent ones do.
    pub closers: Vec<CoordinateId>,
    /// With rows on velocities: the rows that are solved, as sums of [`Closure::rows`] with these constant factors;
    /// otherwise empty. Rows of loops are themselves.
    pub combined: Vec<Vec<Dd>>,
    /// For each row of contacts that is solved and each velocity of the open tree its rate, if it is the same at every
    /// position; empty like [`Closure::combined`].
    pub constants: Vec<Vec<Option<Dd>>>,
    /// Whether rows of contacts are solved along their planes, not in axes of wheels.
    pub of_plane: bool,
    /// The same with the rows of contacts along their planes, where wheels lean: an alternative.
    pub along_planes: Option<Box<Closure>>,
    /// A closed position.
    pub start: Vec<Dd>,
    /// Closed positions at random, on the branch of the start.
    pub samples: Vec<Vec<Dd>>,
    /// The joints with drives, if the file names them; otherwise the independent ones have drives.
    pub actuated: Option<Actuated>,
    /// For each block, whether the determinant of its columns is positive at the start: it changes its sign at
    /// singular positions only, so that it tells the branch.
    pub signs: Vec<bool>,
}

impl Closure {
    /// Returns the length of the largest loop, m: the sum of its constant segments; 1 without one.
    pub fn size(&self) -> f64 {
        let length = |one: &KinematicLoop| {
            let places = [one.chain.start.translation, one.chain.end.translation];
            let origins = one.chain.steps.iter().map(|step| step.origin.translation);
            let lengths = origins.chain(places).map(|v| v.dot(v).to_f64().sqrt());
            lengths.sum::<f64>()
        };
        match self.loops.iter().map(length).fold(0.0, f64::max) {
            0.0 => 1.0,
            size => size,
        }
    }

    /// Returns the joints with drives, if they are not the independent ones.
    pub fn drives(&self) -> Option<&Actuated> {
        let others = |of: &&Actuated| of.joints != self.independents;
        self.actuated.as_ref().filter(others)
    }

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

    /// Returns whether a row is one on velocities alone.
    pub fn nonholonomic(&self) -> bool {
        self.rows.iter().any(|row| !row.kind.has_positions())
    }

    /// Returns whether positions close along velocities of the open tree, not each by its own: with rows on velocities,
    /// and where joints in loops have several velocities.
    pub fn closes_along(&self) -> bool {
        self.nonholonomic() || !self.compounds.is_empty()
    }

    /// Returns the rows that decide about positions.
    pub fn position_rows(&self) -> Vec<LoopRow> {
        let rows = self.rows.iter();
        rows.filter(|row| row.kind.has_positions())
            .copied()
            .collect()
    }

    /// Returns the positions of the joints in loops and contacts.
    pub fn moved_positions(&self) -> Vec<PositionId> {
        let compounds = self.compounds.iter();
        let compounds = compounds.flat_map(|joint| joint.degrees.positions.iter());
        self.positions
            .iter()
            .flatten()
            .chain(compounds)
            .copied()
            .collect()
    }

    /// Returns the dependent velocities along which positions close.
    pub fn closing(&self) -> impl Iterator<Item = CoordinateId> {
        let all = !self.nonholonomic();
        self.dependents()
            .filter(move |j| all || self.closers.contains(j))
    }

    /// Returns the dependent velocities, block by block.
    pub fn dependents(&self) -> impl Iterator<Item = CoordinateId> {
        self.blocks
            .iter()
            .flat_map(|block| block.dependents.iter().copied())
    }
}
