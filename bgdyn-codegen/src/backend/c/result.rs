//! Where the outputs of a function are in its flat result, and which of them must be finite.

use std::ops::Range;

use super::context::FunctionContext;
use super::style::Style;
use crate::function::Function;
use crate::method::Shape;
use crate::plan::{Place, matrix_places};

/// The flat result of a function.
pub(super) struct FlatResult {
    /// Places of each output; none for one that is only checked.
    pub(super) places: Vec<Vec<usize>>,
    /// Number of elements.
    elements: usize,
    /// The same in C.
    pub(super) size: String,
    /// The outputs that must be finite.
    pub(super) checked: Range<usize>,
}

impl FlatResult {
    pub(super) fn new(function: &Function, context: &FunctionContext<'_>) -> Self {
        let (shape, nv) = (function.shape(), context.nv);
        let count = output_count(function);
        let places = matrix_places(shape, nv);
        let flat = |place: &Place| match *place {
            Place::Element(k) => k,
            Place::Entry {
                matrix,
                row,
                column,
            } => (matrix * nv + row) * nv + column,
        };
        let only_checked = match shape {
            Shape::CheckedSquares | Shape::CheckedSlopesByTree | Shape::CheckedWrenches => nv,
            _ => 0,
        };
        let in_order = |k: usize| k.checked_sub(only_checked).into_iter().collect();
        let places: Vec<Vec<usize>> = match places {
            Some(places) => places
                .iter()
                .map(|p| p.iter().map(flat).collect())
                .collect(),
            None => (0..count).map(in_order).collect(),
        };
        let elements = places.iter().map(Vec::len).sum::<usize>();
        let checked = match shape {
            Shape::CheckedVector | Shape::CheckedActuated(_) | Shape::CheckedTree => 0..count,
            Shape::CheckedTreeAndRows => 0..context.nt,
            _ => 0..only_checked,
        };
        FlatResult {
            places,
            size: size(shape, context.style).unwrap_or_else(|| elements.to_string()),
            elements,
            checked,
        }
    }

    /// Returns whether the function has no result, so that C does not have it.
    pub(super) fn is_empty(&self) -> bool {
        self.elements == 0
    }

    /// Returns the places for a plan.
    pub(super) fn elements(&self) -> Vec<Vec<Place>> {
        let places = self.places.iter();
        places
            .map(|places| places.iter().map(|&k| Place::Element(k)).collect())
            .collect()
    }
}

/// Returns the number of a result's elements in C; `None` if sizes with names do not tell it.
fn size(shape: Shape, style: &Style) -> Option<String> {
    let [nv, nt, nc, nr] = ["NV", "NT", "NC", "NR"].map(|size| style.constant(size));
    Some(match shape {
        Shape::Vector | Shape::CheckedVector => nv,
        Shape::Symmetric | Shape::Square => format!("{nv} * {nv}"),
        Shape::SquarePair => format!("2 * {nv} * {nv}"),
        Shape::CheckedSquares => format!("3 * {nv} * {nv}"),
        Shape::SlopesByTree => format!("{nv} * ({nt} + {nv})"),
        Shape::CheckedSlopesByTree => format!("{nv} * ({nt} + 2 * {nv})"),
        Shape::Jacobian => format!("6 * {nv}"),
        Shape::TreeVector | Shape::CheckedTree => nt,
        Shape::TreeMatrix => format!("{nt} * {nv}"),
        Shape::RowVector => nc,
        Shape::RowMatrix => format!("{nc} * {nt}"),
        Shape::CheckedTreeAndRows => format!("{nt} + {nc}"),
        Shape::CheckedWrenches => format!("6 * {nr}"),
        Shape::LinkWrenches => format!("6 * {}", style.constant("NL")),
        Shape::CheckedActuated(_) => style.constant("NA"),
        Shape::Drives(_) => style.constant("NP"),
        Shape::Scalar | Shape::Pose | Shape::Spatial => return None,
        Shape::Parts | Shape::CheckedParts => return None,
    })
}

/// Returns the number of a function's outputs.
fn output_count(function: &Function) -> usize {
    match &function.loops {
        Some(loops) => loops.parts.len(),
        None => function
            .blocks
            .last()
            .map_or(0, |block| block.outputs.len()),
    }
}
