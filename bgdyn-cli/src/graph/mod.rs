//! Drawings of bond graphs.
//!
//! ```text
//! BondGraph, BondNetwork ──chart_of_graph, unfold, scene──▶ Chart ──layout──▶ Layout ──draw──▶ SVG
//!                                                   └──────────────────────write──▶ DOT
//! ```
//!
//! [`Chart`] says what is drawn and in which order, with every word of it; it knows no coordinates.
//! `layout.rs` computes coordinates, `svg/` draws, `dot.rs` writes. Nothing is drawn that is not in the data:
//! no transformer that the structure makes zero, no flow that no transformer feeds, no source
//! without effort.

mod chart;
mod chart_of_graph;
mod dot;
mod layout;
mod notation;
mod scene;
mod svg;
mod unfold;

pub(crate) use chart::Chart;
