//! The loads of loops and contacts that nothing determines.

use bgdyn_runtime::Dd;

use crate::math::Vec3;
use crate::mechanism::closure::{
    ClosingRow, Closure, ContactShape, LoopRow, PlaneContact, RowKind,
};
use crate::mechanism::joint::DoubleDouble;

/// A load that equations of rigid bodies do not determine.
pub struct UndeterminedLoad {
    /// The index of its loop or contact.
    pub reaction: usize,
    /// The name of its row.
    pub row: String,
    /// The direction of the force, in the axes of the reaction; zero for a moment.
    pub force: Vec3<Dd>,
    /// The direction of the moment, in the axes of the reaction; zero for a force.
    pub moment: Vec3<Dd>,
}

/// Returns the loads of the rows without a multiplier: those that hold at every position of the joints, and those that
/// follow from others.
pub fn undetermined_loads(closure: &Closure) -> Vec<UndeterminedLoad> {
    let following = closure.following.iter().map(|one| &one.row);
    let rows = closure.dropped.iter().chain(following);
    rows.map(|row| undetermined(closure, row)).collect()
}

/// Returns the load of a row without a multiplier.
fn undetermined(closure: &Closure, row: &LoopRow) -> UndeterminedLoad {
    let one = &closure.loops[row.closes];
    let none = Vec3([Dd::ZERO; 3]);
    let unit = |k: usize| {
        let at = |i| if i == k { Dd::ONE } else { Dd::ZERO };
        Vec3(std::array::from_fn(at))
    };
    let axes = one.chain.start.rotation;
    let end = || one.chain.frames(&closure.start, &DoubleDouble);
    let (force, moment) = match row.kind {
        RowKind::Closing(ClosingRow::Place(k)) => (axes * unit(k), none),
        RowKind::Closing(ClosingRow::Tilt(k) | ClosingRow::Turn(k)) => (none, axes * unit(k)),
        RowKind::Closing(ClosingRow::Length) => {
            (axes * end().end().scale(Dd::ONE / one.length), none)
        }
        RowKind::Closing(ClosingRow::Angle) => {
            let across = (end().last_axes() * one.chain.end.rotation).column(0);
            (none, axes * across.cross(unit(2)))
        }
        RowKind::Contact(row) => match (row.contact_axis(), one.contact.as_ref()) {
            (Some(k), _) => (unit(k), none),
            (None, contact) => (contact.map_or(none, |contact| axes * edge(contact)), none),
        },
    };
    UndeterminedLoad {
        reaction: row.closes,
        row: closure.row_name(row),
        force,
        moment,
    }
}

/// Returns the direction of a knife edge in the axes of its place.
fn edge(contact: &PlaneContact) -> Vec3<Dd> {
    match contact.shape {
        ContactShape::Edge(direction) | ContactShape::Disc(direction) => direction,
        ContactShape::Sphere | ContactShape::Ellipsoid(_) => Vec3([Dd::ZERO; 3]),
    }
}
