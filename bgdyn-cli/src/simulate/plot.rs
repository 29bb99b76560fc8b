//! The plot: one panel per column, over time.

use std::path::Path;

use plotters::coord::Shift;
use plotters::prelude::*;

use super::difference::range;
use super::record::{Column, Record};

pub(super) type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
pub(super) type Drawn = Result<(), Box<dyn std::error::Error>>;

// Blue of Okabe and Ito's palette.
pub(super) const LINE: RGBColor = RGBColor(0, 114, 178);
const EVENT: RGBColor = RGBColor(213, 94, 0);
pub(super) const INK: RGBColor = RGBColor(40, 40, 40);
pub(super) const FONT: &str = "sans-serif";

const PANEL: (u32, u32) = (560, 210);
const HEADER: u32 = 56;
/// Columns up to which panels stand one below the other.
const FEW: usize = 3;
/// What is larger than this, or smaller than its reciprocal, has no place on an axis.
pub(super) const LARGEST: f64 = 1e250;
/// More events than these would hide the curves.
const EVENTS: usize = 60;

/// Draws a run to a file.
///
/// # Errors
/// Where the file cannot be written.
pub(crate) fn draw(path: &Path, title: &str, columns: &[Column], record: &Record) -> Drawn {
    let across = if columns.len() <= FEW { 1 } else { 2 };
    let down = columns.len().div_ceil(across).max(1);
    let width = if across == 1 {
        PANEL.0 * 3 / 2
    } else {
        PANEL.0 * 2
    };
    let marked = !record.events.is_empty() && record.events.len() <= EVENTS;
    let header = if marked { HEADER } else { HEADER - 20 };
    let size = (width, header + PANEL.1 * down as u32);
    let root = SVGBackend::new(path, size).into_drawing_area();
    root.fill(&WHITE)?;
    let (header, rest) = root.split_vertically(header);
    let text = |size: u32| (FONT, size).into_font().color(&INK);
    header.draw_text(title, &text(20), (16, 8))?;
    if marked {
        let events = "orange: events, where friction takes hold or breaks away";
        header.draw_text(events, &text(13), (16, 36))?;
    }
    for (i, area) in rest.split_evenly((down, across)).iter().enumerate() {
        if let Some(column) = columns.get(i) {
            let last = i + across >= columns.len();
            panel(area, column, i, record, (last, marked))?;
        }
    }
    root.present()?;
    Ok(())
}

/// How values become numbers of an axis: (value − offset)/10^exponent.
pub(super) struct Axis {
    offset: f64,
    exponent: i32,
    decimals: usize,
    pub(super) low: f64,
    pub(super) high: f64,
}

impl Axis {
    /// For values in this range.
    pub(super) fn new((low, high): (f64, f64)) -> Self {
        let (low, high) = if low <= high { (low, high) } else { (0.0, 0.0) };
        let size = low.abs().max(high.abs());
        let (low, high, size) = match size < 1.0 / LARGEST {
            true => (0.0, 0.0, 0.0),
            false => (low, high, size),
        };
        // A small change of a large value is shown as a change.
        let change = high - low;
        let flat = change <= 1e-12 * size;
        let offset = if !flat && change < 1e-3 * size {
            low
        } else {
            0.0
        };
        let shown = if offset == 0.0 { size } else { change };
        let exponent = match shown {
            0.0 => 0,
            _ if (0.01..1e4).contains(&shown) => 0,
            _ => 3 * (shown.log10() / 3.0).floor() as i32,
        };
        let scale = 10_f64.powi(exponent);
        let (low, high) = ((low - offset) / scale, (high - offset) / scale);
        let span = match flat {
            true => (0.2 * size / scale).max(if size == 0.0 { 1.0 } else { 0.0 }),
            false => high - low,
        };
        let margin = if flat { 0.5 * span } else { 0.08 * span };
        let decimals = (1.0 - (0.3 * span).log10().floor()).clamp(0.0, 9.0) as usize;
        Axis {
            offset,
            exponent,
            decimals,
            low: low - margin,
            high: high + margin,
        }
    }

    pub(super) fn of(&self, value: f64) -> f64 {
        (value - self.offset) / 10_f64.powi(self.exponent)
    }

    pub(super) fn number(&self, x: f64) -> String {
        number(x, self.decimals)
    }

    pub(super) fn title(&self, name: &str) -> String {
        let sign = if self.offset < 0.0 { '+' } else { '−' };
        match self.offset {
            0.0 => name.to_owned(),
            offset => format!("{name} {sign} {:?}", offset.abs()),
        }
    }

    pub(super) fn label(&self, unit: &str) -> String {
        match (self.exponent, unit) {
            (0, unit) => unit.to_owned(),
            (e, "") => format!("1e{e}"),
            (e, unit) => format!("1e{e} {unit}"),
        }
    }
}

/// A number with so many decimals at most.
fn number(x: f64, decimals: usize) -> String {
    let text = format!("{x:.decimals$}");
    let text = match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.'),
        false => &text,
    };
    let text = if text == "-0" { "0" } else { text };
    text.replace('-', "−")
}

/// One column over time; where `last`, with the name of the time's axis.
fn panel(
    area: &Area<'_>,
    column: &Column,
    i: usize,
    record: &Record,
    (last, marked): (bool, bool),
) -> Drawn {
    let points = record.rows.iter().map(|row| (row.t, row.values[i]));
    let points: Vec<_> = points.filter(|p| p.1.abs() < LARGEST).collect();
    let axis = Axis::new(range(points.iter().map(|p| p.1)));
    let end = if record.t > 0.0 { record.t } else { 1.0 };
    let seconds = Axis::new((0.0, end));
    let mut chart = ChartBuilder::on(area)
        .caption(axis.title(&column.name), (FONT, 15).into_font().color(&INK))
        .margin_left(8)
        .margin_right(24)
        .margin_top(4)
        .x_label_area_size(if last { 44 } else { 24 })
        .y_label_area_size(70)
        .build_cartesian_2d(0.0..seconds.of(end), axis.low..axis.high)?;
    chart
        .configure_mesh()
        .disable_x_mesh()
        .x_labels(9)
        .y_labels(5)
        .x_desc(if last {
            format!("t / {}", seconds.label("s"))
        } else {
            String::new()
        })
        .y_desc(axis.label(column.unit))
        .x_label_formatter(&|x| seconds.number(*x))
        .y_label_formatter(&|x| axis.number(*x))
        .label_style((FONT, 12).into_font().color(&INK))
        .axis_desc_style((FONT, 13).into_font().color(&INK))
        .light_line_style(TRANSPARENT)
        .bold_line_style(BLACK.mix(0.12))
        .axis_style(INK.mix(0.6))
        .draw()?;
    let events = record.events.iter().filter(|_| marked);
    for t in events.map(|event| seconds.of(event.t)) {
        let line = [(t, axis.low), (t, axis.high)];
        chart.draw_series(LineSeries::new(line, EVENT.mix(0.45)))?;
    }
    let line = points.iter().map(|&(t, x)| (seconds.of(t), axis.of(x)));
    chart.draw_series(LineSeries::new(line, LINE.stroke_width(2)))?;
    Ok(())
}
