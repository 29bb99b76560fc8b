//! The states in the form of generated models' arguments: one number per joint, or one lane per state.

use bgdyn_runtime::Scalar;
use bgdyn_runtime::wide::{f64x4, f64x8};
use nalgebra::SVector;

use crate::states::State;

/// A scalar with one state per lane.
pub trait Lanes: Scalar {
    /// Number of lanes.
    const LANES: usize;

    /// Returns the number with `value(lane)` in each lane.
    fn gather(value: impl Fn(usize) -> f64) -> Self;

    /// Returns the number in a lane.
    fn lane(self, lane: usize) -> f64;
}

macro_rules! lanes {
    ($($scalar:ident: $lanes:literal;)*) => {$(
        impl Lanes for $scalar {
            const LANES: usize = $lanes;

            fn gather(value: impl Fn(usize) -> f64) -> Self {
                Self::new(std::array::from_fn(value))
            }

            fn lane(self, lane: usize) -> f64 {
                self.to_array()[lane]
            }
        }
    )*};
}
lanes! { f64x4: 4; f64x8: 8; }

impl Lanes for f64 {
    const LANES: usize = 1;

    fn gather(value: impl Fn(usize) -> f64) -> Self {
        value(0)
    }

    fn lane(self, _: usize) -> f64 {
        self
    }
}

impl Lanes for f32 {
    const LANES: usize = 1;

    fn gather(value: impl Fn(usize) -> f64) -> Self {
        value(0) as f32
    }

    fn lane(self, _: usize) -> f64 {
        self.into()
    }
}

/// The arguments of one call: [`Lanes::LANES`] states with `N` velocities and `NQ` positions.
#[derive(Clone, Debug)]
pub struct Input<T: Lanes, const N: usize, const NQ: usize = N> {
    /// Positions.
    pub q: SVector<T, NQ>,
    /// Velocities.
    pub v: SVector<T, N>,
    /// Accelerations.
    pub a: SVector<T, N>,
    /// Efforts.
    pub tau: SVector<T, N>,
}

/// Returns all states, `LANES` per call, of a mechanism with a position for each velocity.
pub fn inputs<T: Lanes, const N: usize>(states: &[State]) -> Vec<Input<T, N>> {
    inputs_of(states)
}

/// Returns all states, `LANES` per call.
pub fn inputs_of<T: Lanes, const N: usize, const NQ: usize>(
    states: &[State],
) -> Vec<Input<T, N, NQ>> {
    let input = |states: &[State]| Input {
        q: gather(states, |s| &s.q),
        v: gather(states, |s| &s.v),
        a: gather(states, |s| &s.a),
        tau: gather(states, |s| &s.tau),
    };
    states.chunks_exact(T::LANES).map(input).collect()
}

/// Returns a part of the states, one per lane.
fn gather<T: Lanes, const N: usize>(
    states: &[State],
    part: fn(&State) -> &Vec<f64>,
) -> SVector<T, N> {
    SVector::from_fn(|i, _| T::gather(|lane| part(&states[lane])[i]))
}
