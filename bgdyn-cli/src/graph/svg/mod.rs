//! Prints a drawing as SVG.

mod drawing;
mod legend;
mod style;
mod symbols;

use super::chart::{Chart, ChartLink, Component, Flow, Port, Transformer, lines};
use super::layout::{
    BOND, Band, DROP, Layout, MARGIN, PITCH, SYMBOL, VECTOR, VelocityColumn, layout, text_width,
    vector_width, words_width,
};
use drawing::{ALARM, Anchor, Drawing, FAINT, INK};
use style::{LINE, SUM, SUM_BAR, VELOCITY, VELOCITY_BAR};
use symbols::{Bond, Point, bar, bond, clearing, junction};

/// Background colour of a link.
const BAND: &str = "#f5f6f7";
/// Text for a link without flows.
const NOTHING: &str = "moves, but has no store and no source";
/// The least width of a drawing.
const NARROWEST: f64 = 860.0;
/// The largest width of the lines of the legend.
const WIDEST: f64 = 1100.0;

impl Chart {
    /// Returns the drawing as the text of an SVG file.
    pub(crate) fn svg(&self) -> String {
        let top = header_height(self);
        let layout = layout(self, top);
        let width = layout.right.max(NARROWEST);
        let legend = legend::lines(self, width.min(WIDEST) - 2.0 * MARGIN);
        let mut d = Drawing::new(
            width.ceil(),
            (layout.bottom + legend::height(&legend)).ceil(),
        );
        header(&mut d, self);
        self.draw(&mut d, &layout);
        legend::draw(&mut d, &legend, layout.bottom);
        d.finish()
    }

    /// Draws horizontal bars first, so that the velocities' bars pass over them.
    fn draw(&self, d: &mut Drawing, layout: &Layout) {
        for (link, band) in self.bands().zip(&layout.bands) {
            let size = (band.right - band.left, band.bottom - band.top);
            d.rectangle((band.left, band.top), size, BAND);
            for (flow, &row) in link.flows.iter().zip(&band.rows) {
                sum(d, flow, (layout, band), row);
            }
        }
        for (j, column) in layout.columns.iter().enumerate() {
            head(d, self, j, column);
        }
        for (link, band) in self.bands().zip(&layout.bands) {
            d.bold(
                (band.zero, band.top + 16.0),
                13,
                INK,
                Anchor::Start,
                &link.name,
            );
            if link.flows.is_empty() {
                let at = (
                    band.zero + text_width(&link.name, 13) + 12.0,
                    band.top + 16.0,
                );
                d.text(at, 11, FAINT, Anchor::Start, NOTHING);
            }
            for (flow, &row) in link.flows.iter().zip(&band.rows) {
                for transformer in &flow.transformers {
                    let column = &layout.columns[transformer.velocity];
                    let target = (flow.sums(), band.zero);
                    self.transformer(d, link, transformer, (column, row), target);
                }
                stores(d, flow, (band.zero, row + DROP));
            }
        }
    }

    /// Draws a transformer at the height of its row, with its bonds from the velocity's bar and to the
    /// horizontal bar, or, without such a bar, to the 1-junction.
    fn transformer(
        &self,
        d: &mut Drawing,
        link: &ChartLink,
        t: &Transformer,
        (column, row): (&VelocityColumn, f64),
        (sums, zero): (bool, f64),
    ) {
        let velocity = &self.velocities[t.velocity];
        let varies = match t.varies.is_empty() {
            true => "constant".to_owned(),
            false => format!("varies with {}", t.varies),
        };
        let what = format!("{} = {}, {varies}", t.name, t.vector());
        d.group(&format!("{} → {}: {what}", velocity.name, link.name));
        let (x, centre) = (column.x, column.x + SYMBOL);
        d.text(
            (x + 5.0, row - 9.0),
            10,
            VELOCITY,
            Anchor::Start,
            &velocity.symbol,
        );
        bond(
            d,
            &Bond::single(&[(x + 3.0, row), (centre - 17.0, row)]).stroke_at_start(),
        );
        d.bold((centre, row + 4.5), 12, INK, Anchor::Middle, t.symbol());
        match t.is_vector() {
            true => modulus(d, t, (x + VECTOR, row)),
            false => below(d, t, (x + VECTOR, row)),
        }
        let (from, down) = ((centre, row + 9.0), row + DROP);
        let path = match sums {
            true => vec![from, (centre, down - 2.0)],
            false => vec![from, (centre, down), (zero + BOND - 9.0, down)],
        };
        bond(d, &Bond::of(&path, t.is_vector()).stroke_at_start());
        d.end_group();
    }
}

/// Draws the horizontal bar of a flow, up to its 0-junction.
fn sum(d: &mut Drawing, flow: &Flow, (layout, band): (&Layout, &Band), row: f64) {
    if !flow.sums() {
        return;
    }
    let centres = flow
        .transformers
        .iter()
        .map(|t| layout.columns[t.velocity].x + SYMBOL);
    let first = centres.fold(f64::MAX, f64::min);
    bar(
        d,
        (first - 8.0, row + DROP),
        (band.zero, row + DROP),
        SUM_BAR,
    );
}

/// Draws the 1-junction of a velocity, its bar, and its ports.
fn head(d: &mut Drawing, chart: &Chart, j: usize, column: &VelocityColumn) {
    let velocity = &chart.velocities[j];
    let (x, y) = (column.x, column.head);
    clearing(d, (x, y), (x, column.end + 4.0), BAND);
    bar(d, (x, y), (x, column.end + 4.0), VELOCITY_BAR);
    junction(d, (x, y), "1", VELOCITY);
    let symbol = &velocity.symbol;
    d.bold((x - 6.0, y - 16.0), 14, VELOCITY, Anchor::Start, symbol);
    let beside = x + 2.0 + text_width(symbol, 14);
    d.bold((beside, y - 16.0), 13, INK, Anchor::Start, &velocity.name);
    let beside = beside + text_width(&velocity.name, 13) + 10.0;
    d.text((beside, y - 16.0), 11, FAINT, Anchor::Start, velocity.unit);
    ports(d, &velocity.ports, (x, y));
}

/// Draws the part from the 0-junction of a flow to the stores and sources on its 1-junction.
fn stores(d: &mut Drawing, flow: &Flow, (x, y): Point) {
    let one = (x + BOND, y);
    if flow.sums() {
        junction(d, (x, y), "0", SUM);
        bond(
            d,
            &Bond::of(&[(x + 9.0, y), (one.0 - 9.0, y)], flow.is_vector()).stroke_at_start(),
        );
    }
    match flow.is_vector() {
        true => upwards(d, &flow.ports, one),
        false => {
            ports_bar(d, &flow.ports, one, VELOCITY_BAR);
            ports(d, &flow.ports, one);
        }
    }
    junction(d, one, "1", VELOCITY);
    let (dx, dy) = if flow.is_vector() {
        (0.0, 21.0)
    } else {
        (-12.0, 21.0)
    };
    let at = (one.0 + dx, y + dy);
    d.bold(at, 12, VELOCITY, Anchor::Middle, &flow.symbol);
}

/// Draws a link's store and sources, one above the other, because the space below belongs to the next
/// flow.
fn upwards(d: &mut Drawing, all: &[Port], (x, y): Point) {
    if all.len() > 1 {
        let up = y - 30.0 * (all.len() - 1) as f64;
        bar(d, (x, y), (x, up), VELOCITY_BAR);
    }
    for (k, port) in all.iter().enumerate() {
        one_port(d, port, (x, y - 30.0 * k as f64), (k == 0, true));
    }
}

/// Draws the bar of a junction, down to its last port.
fn ports_bar(d: &mut Drawing, all: &[Port], (x, y): Point, colour: &str) {
    if let [before @ .., _] = all
        && !before.is_empty()
    {
        let down = PITCH * lines(before) as f64;
        bar(d, (x, y), (x, y + down), colour);
    }
}

/// Returns the colours of a junction and of its bar.
fn colours(sign: &str) -> (&'static str, &'static str) {
    match sign {
        "0" => (SUM, SUM_BAR),
        _ => (VELOCITY, VELOCITY_BAR),
    }
}

/// Draws the ports of a junction, right of it and one below the other, and the nodes behind them.
fn ports(d: &mut Drawing, all: &[Port], (x, mut y): Point) {
    for (k, port) in all.iter().enumerate() {
        one_port(d, port, (x, y), (k == 0, false));
        let behind = (x + BOND + words_width(port), y);
        ports_bar(d, &port.ports, behind, colours(port.symbol).1);
        if port.is_junction() {
            let (at, colour) = ((behind.0 + 10.0, y + 17.0), colours(port.symbol).0);
            junction(d, behind, port.symbol, colour);
            if !port.text.is_empty() {
                d.text(at, 11, colour, Anchor::Start, &port.text);
            }
        }
        ports(d, &port.ports, behind);
        y += PITCH * port.lines() as f64;
    }
}

/// Draws a port of a junction, right of it: at its symbol, or at its bar.
fn one_port(d: &mut Drawing, port: &Port, (x, y): Point, (at_sign, triple): (bool, bool)) {
    let near = (x + if at_sign { 9.0 } else { 4.0 }, y);
    let far = (x + BOND - if port.is_junction() { 8.0 } else { 5.0 }, y);
    let path = if port.feeds { [far, near] } else { [near, far] };
    let mut line = Bond::single(&path);
    line.triple = triple;
    line.stroke = port.on_junction.map(|on| if on { near } else { far });
    bond(d, &line);
    if port.is_junction() {
        return;
    }
    let (x, symbol) = (x + BOND, port.symbol);
    d.bold((x, y + 4.5), 13, INK, Anchor::Start, symbol);
    let beside = x + text_width(symbol, 13) + 3.0;
    d.text(
        (beside, y + 4.5),
        12,
        INK,
        Anchor::Start,
        &format!(": {}", port.text),
    );
    if let Some(more) = &port.more {
        d.text((beside + 8.0, y + 17.5), 11, INK, Anchor::Start, more);
    }
}

/// Draws the modulus as a column in brackets, and below it the coordinates that it varies with.
fn modulus(d: &mut Drawing, transformer: &Transformer, (x, y): Point) {
    let (width, half) = (vector_width(transformer), 18.0);
    for (edge, inwards) in [(x, 3.0), (x + width, -3.0)] {
        let (upper, lower) = (y - half, y + half);
        let inner = edge + inwards;
        d.stroke(
            &[(inner, upper), (edge, upper), (edge, lower), (inner, lower)],
            INK,
            1.0,
        );
    }
    for (entry, k) in transformer.modulus.iter().zip([-1.0, 0.0, 1.0]) {
        let at = (x + 0.5 * width, y + 4.0 + 12.0 * k);
        match entry {
            Component::Zero => d.text(at, 11, FAINT, Anchor::Middle, "0"),
            Component::Varying => d.bold(at, 13, INK, Anchor::Middle, "·"),
            other => d.text(at, 11, INK, Anchor::Middle, &other.to_string()),
        }
    }
    below(d, transformer, (x, y));
}

/// Draws the coordinates that a modulus varies with, below it.
fn below(d: &mut Drawing, transformer: &Transformer, (x, y): Point) {
    let at = (x - VECTOR + SYMBOL + 10.0, y + 29.0);
    d.text(at, 10, FAINT, Anchor::Start, &transformer.varies);
}

/// Returns the height of the header.
fn header_height(chart: &Chart) -> f64 {
    54.0 + LINE * words(chart).count() as f64
}

/// Returns the description, the size of the graph, and the notes.
fn words(chart: &Chart) -> impl Iterator<Item = (String, &'static str)> {
    let plain = chart.description.iter().map(|text| (text.clone(), INK));
    let census = std::iter::once((chart.census(), FAINT));
    let notes = chart.notes.iter().map(|note| (note.clone(), ALARM));
    let lines = |(text, colour): (String, &'static str)| {
        let lines = legend::wrapped(&text, 12, NARROWEST - 2.0 * MARGIN);
        lines.into_iter().map(move |line| (line, colour))
    };
    plain.chain(census).chain(notes).flat_map(lines)
}

/// Draws the name, the description and the notes.
fn header(d: &mut Drawing, chart: &Chart) {
    let title = format!("{}: bond graph", chart.title);
    d.bold((MARGIN, 34.0), 18, INK, Anchor::Start, &title);
    for (k, (line, colour)) in words(chart).enumerate() {
        let y = 54.0 + LINE * k as f64;
        d.text((MARGIN, y), 12, colour, Anchor::Start, &line);
    }
}
