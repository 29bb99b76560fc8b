//! Drawings of bond graphs.
//!
//! ```text
//! BondGraph, BondNetwork ──chart_of_graph, unfold, scene──▶ Chart ──layout──▶ Layout ──draw──▶ SVG
//!                                                   └──────────────────────write──▶ DOT
//! ```
//!
//! `Chart` defines the nodes of the drawing, their order and all texts, without coordinates. `layout.rs`
//! computes coordinates, `svg/` and `dot.rs` print the drawing. Everything drawn is in the data:
//! structurally zero transformers, flows without transformers and sources of zero effort are omitted.

mod chart;
mod chart_of_graph;
mod dot;
mod layout;
mod notation;
mod scene;
mod svg;
mod unfold;

use bgdyn_codegen::mechanism::Mechanism;
use bgdyn_codegen::system::SceneEquations;

pub(crate) use chart::Chart;

/// Returns the bond graph of a mechanism as the text of an SVG file.
pub fn mechanism_svg(mechanism: &Mechanism) -> String {
    Chart::new(mechanism).svg()
}

/// Returns the bond graph of a scene, with its effects, as the text of an SVG file.
pub fn scene_svg(system: &SceneEquations) -> String {
    Chart::of_scene(system).svg()
}
