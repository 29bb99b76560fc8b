//! A motion that shows the base parameters: a periodic one within the limits, whose log det of AᵀA is large.
//!
//! The steps: random motions ([`search`]), shrunk to the limits ([`limits`]); from the best of them an ascent
//! ([`ascent`]) of log det ([`information`]) with barriers ([`objective`]) over the coefficients of Fourier series
//! ([`series`]) that are at rest at t = 0 ([`shape`]).

pub mod ascent;
mod grid;
pub mod information;
pub mod limits;
pub mod objective;
mod plan;
pub mod search;
pub mod series;
pub mod shape;

pub use limits::{JointLimits, Keep, Points};
pub use plan::{Excitation, Noise, Request, efforts_of_file, excite};
pub use search::Effort;
pub use series::{FourierSeries, PeriodicMotion, State};
