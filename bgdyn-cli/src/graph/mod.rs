//! Drawings of bond graphs.
//!
//! ```text
//! BondGraph, BondNetwork ──order, unfold, scene──▶ Chart ──place──▶ Places ──draw──▶ SVG
//!                                                   └──────────────────────write──▶ DOT
//! ```
//!
//! [`Chart`] says what is drawn and in which order, with every word of it; it knows no place.
//! `place.rs` gives places, `svg/` draws, `dot.rs` writes. Nothing is drawn that is not in the data:
//! no transformer that the structure makes zero, no flow that no transformer feeds, no source
//! without effort.

mod chart;
mod dot;
mod notation;
mod order;
mod place;
mod scene;
mod svg;
mod unfold;

pub(crate) use chart::Chart;
