//! Reads what an entry of `loops` allows: rows that follow from others, gaps of rounded lengths.

use crate::fault::{Faults, wording};
use crate::format::{Field, LoopSpec};

/// The largest `tolerance`, m.
const LARGEST_TOLERANCE: f64 = 1e-3;

/// Returns whether `redundant` is `allow`.
pub(super) fn redundant(one: &LoopSpec, faults: &mut Faults) -> Option<bool> {
    match &one.redundant {
        Field::Broken => None,
        Field::Absent => Some(false),
        Field::Given(word) if word.value == "allow" => Some(true),
        Field::Given(word) => {
            faults.push(wording::redundant_word(&word.location, &word.value));
            None
        }
    }
}

/// Returns the gap by which rows may be open, m or rad; 0 without the key.
pub(super) fn tolerance(one: &LoopSpec, faults: &mut Faults) -> Option<f64> {
    match &one.tolerance {
        Field::Broken => None,
        Field::Absent => Some(0.0),
        Field::Given(given) => {
            let value = given.value.value.to_f64();
            if value > 0.0 && value <= LARGEST_TOLERANCE {
                return Some(value);
            }
            let text = &given.value.text;
            faults.push(wording::tolerance_out_of_range(&given.location, text));
            None
        }
    }
}
