//! Plots a run: a panel for each column, over time.

use std::path::Path;

use bgdyn_accuracy::svg::{Anchor, Drawing, INK};

use super::axis::{Axis, LARGEST};
use super::difference::range;
use super::panel::{BLUE, ORANGE, Panel};
use super::run_table::{Column, Record};

const PANEL: (f64, f64) = (560.0, 210.0);
const HEADER: f64 = 56.0;
/// Largest number of columns whose panels are one below the other.
const FEW: usize = 3;
/// More events would hide the curves and are not drawn.
const EVENTS: usize = 60;
/// Colour of event marks.
const EVENT: &str = "#f2c6a5";

/// Draws a run to a file.
///
/// # Errors
/// If the file cannot be written.
pub(crate) fn draw(
    path: &Path,
    title: &str,
    columns: &[Column],
    record: &Record,
) -> std::io::Result<()> {
    let across = if columns.len() <= FEW { 1 } else { 2 };
    let down = columns.len().div_ceil(across).max(1);
    let width = if across == 1 { 1.5 * PANEL.0 } else { PANEL.0 };
    let marked = !record.events.is_empty() && record.events.len() <= EVENTS;
    let header = if marked { HEADER } else { HEADER - 20.0 };
    let size = (width * across as f64, header + PANEL.1 * down as f64);
    let mut d = Drawing::new(size.0, size.1);
    d.text((16.0, 25.0), 18, INK, Anchor::Start, title);
    if marked {
        let events = "orange, upright: events, where a contact holds or is released";
        d.text((16.0, 46.0), 12, INK, Anchor::Start, events);
    }
    for (i, column) in columns.iter().enumerate() {
        let at = (
            width * (i % across) as f64,
            header + PANEL.1 * (i / across) as f64,
        );
        let last = i + across >= columns.len();
        panel(&mut d, (at, width), (column, i), record, (last, marked));
    }
    std::fs::write(path, d.finish())
}

/// Draws one column over time; if `last`, with the name of the time axis.
fn panel(
    d: &mut Drawing,
    (at, width): ((f64, f64), f64),
    (column, i): (&Column, usize),
    record: &Record,
    (last, marked): (bool, bool),
) {
    let points = record.rows.iter().map(|row| (row.t, row.values[i]));
    let points: Vec<_> = points.filter(|p| p.1.abs() < LARGEST).collect();
    let y = Axis::new(range(points.iter().map(|p| p.1)));
    let end = if record.t > 0.0 { record.t } else { 1.0 };
    let x = Axis::tight(0.0, end);
    let panel = Panel {
        at,
        size: (width, PANEL.1),
        title: y.title(&column.name),
        below: match last {
            true => format!("t / {}", x.label("s")),
            false => String::new(),
        },
        beside: y.label(column.unit),
        x: &x,
        y: &y,
    };
    panel.draw(d);
    for event in record.events.iter().filter(|_| marked) {
        panel.upright(d, event.t, EVENT);
    }
    let curve: Vec<_> = points.iter().map(|&p| panel.place(p)).collect();
    d.curve(&curve, BLUE, "");
    for event in record.events.iter().filter(|_| marked) {
        let (x, _) = panel.place((event.t, 0.0));
        let foot = panel.floor();
        d.stroke(&[(x, foot), (x, foot - 5.0)], ORANGE, 2.0);
    }
}
