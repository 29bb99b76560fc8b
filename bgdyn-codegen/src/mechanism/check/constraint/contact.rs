//! What the file says of a wheel, a ball or a knife edge; its places are those of a numbered tree.

use bgdyn_runtime::Dd;

use crate::fault::Location;
use crate::format::{Located, Vector};

/// A constraint on the velocity of a place.
#[derive(Clone, Debug)]
pub(in crate::mechanism::check) struct ContactEntry {
    /// The name of the constraint.
    pub(in crate::mechanism::check) name: String,
    /// The location of its entry.
    pub(in crate::mechanism::check) location: Location,
    /// The link or frame.
    pub(in crate::mechanism::check) at: Located<String>,
    /// What touches.
    pub(in crate::mechanism::check) kind: ContactKind,
}

/// What touches, in the axes of the link or frame.
#[derive(Clone, Debug)]
pub(in crate::mechanism::check) enum ContactKind {
    /// A knife edge.
    Edge {
        /// The direction along which it does not move.
        direction: Located<Vector>,
    },
    /// A wheel or a ball.
    Rolling {
        /// The axle of a wheel.
        axle: Option<Located<Vector>>,
        /// Its radius, m.
        radius: Dd,
        /// Where a wheel slips.
        slip: Slip,
        /// The name of its plane; `None` for the world's x–y plane.
        on: Option<Located<String>>,
    },
}

/// The directions in which a wheel may slip.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::mechanism::check) struct Slip {
    /// Across the axle.
    pub(in crate::mechanism::check) longitudinal: bool,
    /// Along the axle.
    pub(in crate::mechanism::check) lateral: bool,
}

impl Slip {
    /// It slips in no direction.
    pub(super) const NONE: Self = Slip {
        longitudinal: false,
        lateral: false,
    };
}
