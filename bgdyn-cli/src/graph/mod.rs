//! Drawings of bond graphs.
//!
//! ```text
//! BondGraph ──order──▶ Chart ──place──▶ Places ──draw──▶ SVG
//! System ────scene────▶ ─┘ └────────────────────write──▶ DOT
//! ```
//!
//! [`Chart`] says what is drawn and in which order, with every word of it; it knows no place.
//! `place.rs` gives places, `svg/` draws, `dot.rs` writes. Nothing is drawn that is not in the data:
//! no transformer that the structure makes zero, no flow that no transformer feeds, no source
//! without effort.

mod between;
mod chart;
mod dot;
mod fluid;
mod notation;
mod order;
mod place;
mod scene;
mod svg;

pub(crate) use chart::Chart;
