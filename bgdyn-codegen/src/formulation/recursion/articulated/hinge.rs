//! The pivots and columns of a joint, eliminated from the articulated inertia of its body.

use bgdyn_runtime::Dd;

use super::inertia::{ArticulatedInertia, InertiaColumn};
use crate::expr::{Bound, Builder, ErrorBound, Expr};
use crate::formulation::recursion::frames::{BodyFrame, Frames};
use crate::formulation::recursion::joint_columns::ColumnDirection;

/// A pivot's rounding error in units of eps/2, times this factor, is the magnitude that
/// [`bgdyn_runtime::Scalar::checked_pivot`] compares with: the least accepted pivot is 64 eps times it, a
/// factor of four for effects that the bound omits.
const MAGNITUDE: f64 = 1.0 / 32.0;

/// A joint between a body and its parent.
pub(super) struct Hinge<'g> {
    /// The columns of its velocities, in the order of their elimination.
    pub columns: Vec<HingeColumn<'g>>,
    /// Whether they are in the body's own axes; otherwise in those of its basis.
    pub own: bool,
}

/// A velocity of a joint.
pub(super) struct HingeColumn<'g> {
    /// Its index among the columns of the frame.
    pub index: usize,
    /// Its direction.
    pub direction: ColumnDirection,
    /// The wrench of a unit acceleration.
    pub column: InertiaColumn<'g>,
}

/// Returns the magnitude of the terms subtracted in a pivot, from its rounding error; zero if the error is
/// always a small fraction of the pivot.
fn magnitude<'g>(b: &'g Builder, bounds: &mut ErrorBound, pivot: Expr<'g>) -> Expr<'g> {
    let pivot = pivot.signed();
    match b.with_graph(|g| bounds.of(g, pivot)) {
        Bound::Relative(_) => b.zero(),
        Bound::Absolute(bound) => b.expr(bound) * Dd::from_f64(MAGNITUDE),
    }
}

/// Eliminates a joint with an axis. `inner` is the inertia in own axes, `outer` that of the bodies that
/// continue its basis; `carries` whether bodies on other joints are part of `inner`. The pivot is guarded
/// if there are error bounds. Returns the remaining inertia in the axes of the basis.
pub(super) fn axial_hinge<'g>(
    b: &'g Builder,
    frames: &Frames<'g>,
    j: usize,
    (inner, outer, carries): (ArticulatedInertia<'g>, ArticulatedInertia<'g>, bool),
    (careful, bounds): (bool, Option<&mut ErrorBound>),
) -> (Hinge<'g>, ArticulatedInertia<'g>) {
    let frame = &frames.bodies[j];
    let (direction, joint) = (frame.columns[0].direction, frame.columns[0].coordinate);
    let armature = frames.rotors.armature(joint) * (Dd::ONE / (frame.effort * frame.effort));
    let along = inner.along(direction) + outer.along(direction);
    let magnitude = bounds.map_or(b.zero(), |bounds| magnitude(b, bounds, along));
    // A rotor adds to the inertia of the joint, so that the projection is not complete.
    let pivot = (along + armature).pivot(magnitude, joint);
    pivot.named(|| format!("pivot_{}", frame.joint));
    let (column, own, rest) = if outer.is_zero() {
        // The rotation about the joint's axis and the projection along it commute: the projection
        // first, which leaves a row and a column of zeros.
        let column = inner.column(b, direction, pivot, armature);
        let rest = inner.projected(b, direction, &column);
        // A rigid body's column is constant and rotated once; another's is not rotated.
        let column = match carries {
            true => column,
            false => column.map(|v| frame.turn.apply(v)),
        };
        (column, carries, rest.turned(frame.turn, careful))
    } else {
        let whole = inner.turned(frame.turn, careful).plus(&outer);
        whole.name(&format!("at_{}", frame.joint));
        let column = whole.column(b, direction, pivot, armature);
        let rest = whole.projected(b, direction, &column);
        (column, false, rest)
    };
    let columns = vec![HingeColumn {
        index: 0,
        direction,
        column,
    }];
    (Hinge { columns, own }, rest)
}

/// Eliminates a joint with several velocities, the linear ones or the angular ones first. Returns the
/// remaining inertia in own axes.
pub(super) fn compound_hinge<'g>(
    b: &'g Builder,
    frames: &Frames<'g>,
    frame: &BodyFrame<'g>,
    whole: ArticulatedInertia<'g>,
    linear_first: bool,
) -> (Hinge<'g>, ArticulatedInertia<'g>) {
    let mut order: Vec<usize> = (0..frame.columns.len()).collect();
    order.sort_by_key(|&k| {
        let linear = matches!(frame.columns[k].direction, ColumnDirection::Along(_));
        linear != linear_first
    });
    let mut rest = whole;
    let mut columns = Vec::new();
    for index in order {
        let of = &frame.columns[index];
        let direction = of.direction;
        let armature = frames.rotors.armature(of.coordinate) * (Dd::ONE / (of.effort * of.effort));
        let (along, first) = (rest.along(direction), whole.along(direction));
        // Only subtractions at run time can lose digits.
        let magnitude = match along == first || along.as_constant().is_some() {
            true => b.zero(),
            false => first,
        };
        let pivot = (along + armature).pivot(magnitude, of.coordinate);
        pivot.named(|| format!("pivot_{}", of.name));
        let column = rest.column(b, direction, pivot, armature);
        rest = rest.projected(b, direction, &column);
        columns.push(HingeColumn {
            index,
            direction,
            column,
        });
    }
    (Hinge { columns, own: true }, rest)
}
