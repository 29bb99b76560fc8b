//! Where the outputs of a function are in its flat result, and which of them must be finite.

use std::ops::Range;

use super::style::Style;
use crate::function::Function;
use crate::method::Shape;
use crate::plan::{Place, matrix_places};

/// The flat result of a function.
pub(super) struct FlatResult {
    /// Places of each output; none for one that is only checked.
    pub(super) places: Vec<Vec<usize>>,
    /// Number of elements, in C.
    pub(super) size: String,
    /// The outputs that must be finite.
    pub(super) checked: Range<usize>,
}

impl FlatResult {
    pub(super) fn new(function: &Function, nv: usize, style: &Style) -> Self {
        let shape = function.shape();
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
        let n = style.constant("NV");
        let size = match shape {
            Shape::Vector | Shape::CheckedVector => n,
            Shape::Symmetric | Shape::Square => format!("{n} * {n}"),
            Shape::SquarePair => format!("2 * {n} * {n}"),
            Shape::CheckedSquares => format!("3 * {n} * {n}"),
            Shape::Jacobian => format!("6 * {n}"),
            _ => elements.to_string(),
        };
        let checked = match shape {
            Shape::CheckedVector | Shape::CheckedActuated(_) => 0..count,
            _ => 0..only_checked,
        };
        FlatResult {
            places,
            size,
            checked,
        }
    }

    /// Returns the places for a plan.
    pub(super) fn elements(&self) -> Vec<Vec<Place>> {
        let places = self.places.iter();
        places
            .map(|places| places.iter().map(|&k| Place::Element(k)).collect())
            .collect()
    }
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
