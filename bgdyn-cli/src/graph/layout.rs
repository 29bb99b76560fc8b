//! Computes the coordinates of a drawing's nodes, in the form of a staircase.
//!
//! ```text
//! 1 q̇₁ ↽ Se
//! ├ MTF   1 ⇀ I                  link 1
//! │       1 q̇₂ ↽ Se
//! ├ MTF   ├ MTF
//! └──┴────┴───┴─ 0 ⇀ 1 ⇀ I       link 2
//! ```
//!
//! The 1-junction of each velocity is extended downwards to a bar, past all links that it moves. The
//! 0-junction of each flow of a link is a horizontal bar, past all velocities that feed it. The
//! transformer is at the intersection of both, if it exists. In tree order a velocity begins just above
//! its own link and ends with the last link outboard of it; so only transformers are left of a link's
//! stores, and nothing is right of them.

use super::chart::{Chart, ChartLink, Flow, Port, Transformer, Velocity, lines};

/// Margin around the drawing.
pub(super) const MARGIN: f64 = 28.0;
/// From a velocity's bar to the centre of its transformers' symbols.
pub(super) const SYMBOL: f64 = 42.0;
/// From a velocity's bar to the bracket of the modulus.
pub(super) const VECTOR: f64 = 64.0;
/// From the centre of a transformer to the horizontal bar.
pub(super) const DROP: f64 = 36.0;
/// From the upper edge of a link to the first transformers.
const FIRST: f64 = 24.0;
/// From one flow of a link to the next one.
const ROW: f64 = 66.0;
/// From the last horizontal bar to the lower edge of a link.
const LAST: f64 = 24.0;
/// Height of the part above a link, for each velocity that begins there: its 1-junction.
const HEAD: f64 = 50.0;
/// Between the upper edge of this part and that junction.
const ABOVE_HEAD: f64 = 34.0;
/// From one port of a velocity's junction to the next one.
pub(super) const PITCH: f64 = 27.0;
/// Space between links.
const GAP: f64 = 10.0;
/// Between a link's left edge and the first bar in it.
const INDENT: f64 = 12.0;
/// Between the columns and the 0-junctions.
const BEFORE_ZERO: f64 = 16.0;
/// From a 0-junction to the 1-junction that it feeds, and from there to its ports.
pub(super) const BOND: f64 = 46.0;

/// The coordinates of all parts of a drawing, px.
#[derive(Debug)]
pub(super) struct Layout {
    /// The column of each velocity.
    pub columns: Vec<VelocityColumn>,
    /// The band of each link.
    pub bands: Vec<Band>,
    /// The right end of the drawing.
    pub right: f64,
    /// The lower end of the drawing.
    pub bottom: f64,
}

/// The bar of a velocity.
#[derive(Clone, Debug)]
pub(super) struct VelocityColumn {
    pub x: f64,
    /// Height of its 1-junction.
    pub head: f64,
    /// Height of the end of its bar.
    pub end: f64,
    width: f64,
}

/// The band of a link.
#[derive(Debug)]
pub(super) struct Band {
    pub top: f64,
    pub bottom: f64,
    /// Left edge, before its first transformer.
    pub left: f64,
    /// Position of its 0-junctions.
    pub zero: f64,
    /// Right edge, after its texts.
    pub right: f64,
    /// The transformers of each flow, by the height of their symbols.
    pub rows: Vec<f64>,
}

/// Computes the layout, below `top`.
pub(super) fn layout(chart: &Chart, top: f64) -> Layout {
    let mut columns = columns(chart);
    let mut y = top;
    let mut bands = Vec::new();
    for link in chart.bands() {
        for &j in &link.velocities {
            columns[j].head = y + ABOVE_HEAD;
            columns[j].end = columns[j].head;
            y += head_height(&chart.velocities[j]);
        }
        let band = band(link, &columns, y);
        for (flow, row) in link.flows.iter().zip(&band.rows) {
            for t in &flow.transformers {
                columns[t.velocity].end = *row;
            }
        }
        y = band.bottom + GAP;
        bands.push(band);
    }
    let heads = columns.iter().zip(&chart.velocities);
    let heads = heads.map(|(column, velocity)| column.x + head_width(velocity));
    let right = bands
        .iter()
        .map(|b| b.right)
        .chain(heads)
        .fold(0.0, f64::max);
    Layout {
        columns,
        bands,
        right: right + MARGIN,
        bottom: y,
    }
}

/// Returns columns as wide as the widest modulus in them.
fn columns(chart: &Chart) -> Vec<VelocityColumn> {
    let mut x = MARGIN + INDENT;
    let mut columns = Vec::new();
    for j in 0..chart.velocities.len() {
        let own = chart.transformers().filter(|t| t.velocity == j);
        let width = own.map(cell_width).fold(0.0, f64::max);
        columns.push(VelocityColumn {
            x,
            head: 0.0,
            end: 0.0,
            width,
        });
        x += width;
    }
    columns
}

fn cell_width(transformer: &Transformer) -> f64 {
    let below = SYMBOL + 8.0 + text_width(&transformer.varies, 10);
    let modulus = match transformer.is_vector() {
        true => VECTOR + vector_width(transformer),
        false => VECTOR,
    };
    modulus.max(below) + 14.0
}

/// Returns the width of a modulus with its brackets.
pub(super) fn vector_width(transformer: &Transformer) -> f64 {
    let entries = transformer.modulus.iter();
    let widths = entries.map(|entry| text_width(&entry.to_string(), 11));
    widths.fold(0.0, f64::max) + 8.0
}

fn band(link: &ChartLink, columns: &[VelocityColumn], top: f64) -> Band {
    let transformers = || link.flows.iter().flat_map(|flow| &flow.transformers);
    let used = transformers()
        .map(|t| t.velocity)
        .chain(link.velocities.iter().copied());
    let used: Vec<&VelocityColumn> = used.map(|j| &columns[j]).collect();
    let left = used.iter().map(|c| c.x).reduce(f64::min);
    let left = left.unwrap_or(MARGIN + INDENT);
    // No bar is right of a line's junctions either: lines are below the whole tree.
    let is_line = link.flows.iter().any(|flow| !flow.is_vector());
    let cleared: Vec<&VelocityColumn> = match is_line {
        true => columns.iter().collect(),
        false => used,
    };
    let zero = cleared.iter().map(|c| c.x + c.width).fold(left, f64::max) + BEFORE_ZERO;
    let rows: Vec<f64> = (0..link.flows.len())
        .map(|row| top + FIRST + ROW * row as f64)
        .collect();
    let behind = link.flows.last().map_or(0, |flow| match flow.is_vector() {
        true => 0,
        false => lines(&flow.ports) - 1,
    });
    let bottom = rows.last().map_or(top + FIRST, |row| row + DROP + LAST);
    let bottom = bottom + PITCH * behind as f64;
    let widths = link.flows.iter().map(flow_width);
    let right = zero + widths.fold(text_width(&link.name, 13) + 24.0, f64::max);
    Band {
        top,
        bottom,
        left: left - INDENT,
        zero,
        right,
        rows,
    }
}

/// Returns the distance from the 0-junction to the end of the text.
fn flow_width(flow: &Flow) -> f64 {
    BOND + ports_width(&flow.ports) + 14.0
}

/// Returns the height of the part above a link.
fn head_height(velocity: &Velocity) -> f64 {
    let more = velocity.ports.iter().any(|port| port.more.is_some());
    let room = if more { 10.0 } else { 0.0 };
    HEAD + room + PITCH * (lines(&velocity.ports) - 1) as f64
}

/// Returns the distance from a velocity's bar to the end of the text at its top.
fn head_width(velocity: &Velocity) -> f64 {
    let name = format!("{} {} {}", velocity.symbol, velocity.name, velocity.unit);
    ports_width(&velocity.ports).max(text_width(&name, 14) + 16.0)
}

/// Returns the distance from a junction to the end of its ports.
fn ports_width(ports: &[Port]) -> f64 {
    let widths = ports
        .iter()
        .map(|port| BOND + words_width(port) + ports_width(&port.ports));
    widths.fold(0.0, f64::max)
}

/// Returns the distance from the end of a port's bond to the end of its text.
pub(super) fn words_width(port: &Port) -> f64 {
    if port.is_junction() {
        return 2.0;
    }
    let more = port
        .more
        .as_deref()
        .map_or(0.0, |more| text_width(more, 11));
    let words = text_width(&port.text, 12).max(more);
    text_width(port.symbol, 13) + words + 16.0
}

/// Estimates the width of a text: sans-serif letters are a little more than half as wide as high.
pub(super) fn text_width(text: &str, size: u32) -> f64 {
    let narrow = |c: &char| " .,:·…()Iijlt1ⱼᵢⁱ".contains(*c) || ('₀'..='₉').contains(c);
    let all = text.chars().filter(|c| *c != '\u{307}').count() as f64;
    let narrow = text.chars().filter(narrow).count() as f64;
    f64::from(size) * (0.62 * all - 0.22 * narrow)
}
