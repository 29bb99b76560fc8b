//! Courses in time.

use bgdyn_runtime::Dd;

use crate::fault::{Faults, Location, wording};

/// A course in time.
#[derive(Clone, Debug, PartialEq)]
pub enum Waveform {
    /// One value.
    Constant(Dd),
    /// from + rate·t
    Ramp {
        /// Value at t = 0.
        from: Dd,
        /// Per second.
        rate: Dd,
    },
    /// offset + amplitude·sin(2π frequency·t + phase)
    Harmonic {
        /// Amplitude.
        amplitude: Dd,
        /// Hz.
        frequency: Dd,
        /// rad
        phase: Dd,
        /// Mean.
        offset: Dd,
    },
    /// Straight lines between points (t, value), held before and after.
    Table(Vec<[Dd; 2]>),
    /// Polynomials in time, one after the other.
    Pieces {
        /// Value before the first one.
        before: Dd,
        /// In the order of time.
        pieces: Vec<Piece>,
    },
    /// The sum of courses.
    Sum(Vec<Waveform>),
}

/// A polynomial Σ c_k (t − start)ᵏ, which holds from `start` on.
#[derive(Clone, Debug, PartialEq)]
pub struct Piece {
    /// s
    pub start: Dd,
    /// c_0, c_1, …
    pub coefficients: Vec<Dd>,
}

impl Piece {
    /// Returns the polynomial with these coefficients.
    pub(super) fn new(start: Dd, coefficients: &[Dd]) -> Self {
        let coefficients = coefficients.to_vec();
        Piece {
            start,
            coefficients,
        }
    }
}

impl Waveform {
    /// The instants, s, at which it bends.
    pub(super) fn corners(&self) -> Vec<Dd> {
        match self {
            Waveform::Table(points) => points.iter().map(|point| point[0]).collect(),
            Waveform::Pieces { pieces, .. } => pieces.iter().map(|piece| piece.start).collect(),
            Waveform::Sum(terms) => terms.iter().flat_map(Waveform::corners).collect(),
            _ => Vec::new(),
        }
    }

    /// Returns whether its value jumps.
    pub(super) fn jumps(&self) -> bool {
        // A motion from point to point starts at rest; a step has another value from its first instant on.
        match self {
            Waveform::Pieces { before, pieces } => {
                let first = pieces.first().and_then(|piece| piece.coefficients.first());
                first != Some(before)
            }
            Waveform::Sum(terms) => terms.iter().any(Waveform::jumps),
            _ => false,
        }
    }

    /// Returns whether its rate jumps, or its value.
    pub(super) fn rate_jumps(&self) -> bool {
        match self {
            Waveform::Table(_) => true,
            Waveform::Sum(terms) => terms.iter().any(Waveform::rate_jumps),
            _ => self.jumps(),
        }
    }
}

/// Reports an unknown key of a course or of a controller.
pub(super) fn unknown_key<R>(
    location: &Location,
    key: &str,
    known: &[&'static str],
    faults: &mut Faults,
) -> Option<R> {
    faults.push(wording::unknown_key(location, key, known));
    None
}
