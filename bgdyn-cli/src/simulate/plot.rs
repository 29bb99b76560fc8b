//! Plots a run: a panel for each column, over time.

use bgdyn_accuracy::plot::{
    Area, Axis, BLUE, Drawn, INK, Panel, RGBColor, Stroke, VERMILION, curve, draw, place_in, px,
    text, write,
};

use super::run_table::{Column, Record};

const PANEL: (u32, u32) = (560, 210);
const HEADER: u32 = 56;
/// Largest number of columns whose panels are one below the other.
const FEW: usize = 3;
/// More events would hide the curves and are not drawn.
const EVENTS: usize = 60;
/// Colour of event marks.
const EVENT: RGBColor = RGBColor(242, 198, 165);

/// Returns the drawing of a run, as SVG.
pub(crate) fn plot(title: &str, columns: &[Column], record: &Record) -> String {
    let across = if columns.len() <= FEW { 1 } else { 2 };
    let down = columns.len().div_ceil(across).max(1);
    let width = if across == 1 { 840 } else { 2 * PANEL.0 };
    let marked = !record.events.is_empty() && record.events.len() <= EVENTS;
    let header = if marked { HEADER } else { HEADER - 20 };
    draw((width, header + PANEL.1 * down as u32), |area| {
        write(area, (16.0, 20.0), title, text(18, INK))?;
        if marked {
            let events = "orange, upright: events, where a contact holds or is released";
            write(area, (16.0, 42.0), events, text(13, INK))?;
        }
        let (_, rest) = area.split_vertically(px(header));
        let parts = rest.split_evenly((down, across));
        for (i, (column, part)) in columns.iter().zip(&parts).enumerate() {
            let last = i + across >= columns.len();
            panel(part, (column, i), record, (last, marked))?;
        }
        Ok(())
    })
}

/// Draws one column over time; if `last`, with the name of the time axis.
fn panel(
    area: &Area<'_>,
    (column, i): (&Column, usize),
    record: &Record,
    (last, marked): (bool, bool),
) -> Drawn {
    let points = record.rows.iter().map(|row| (row.t, row.values[i]));
    let points: Vec<(f64, f64)> = points.filter(|p| p.1.is_finite()).collect();
    let y = Axis::around(points.iter().map(|p| p.1), 7);
    let end = if record.t > 0.0 { record.t } else { 1.0 };
    let x = Axis::linear(0.0, end, 8);
    let time = last.then(|| format!("t / {}", x.unit("s")));
    let x = x.label(time.unwrap_or_default());
    let (name, unit) = (y.quantity(&column.name), y.unit(column.unit));
    let chart = Panel::new(&name, x, y.label(unit)).draw(area)?;
    let inside = chart.plotting_area();
    let y = chart.y_range();
    let events = || record.events.iter().filter(|_| marked);
    for event in events() {
        let upright = [(event.t, y.start), (event.t, y.end)];
        curve(inside, upright, Stroke::new(EVENT, 1.0))?;
    }
    curve(inside, points, BLUE.into())?;
    for event in events() {
        let (x, foot) = place_in(area, &chart, (event.t, y.start));
        let mark = [(x, foot), (x, foot - px(5) as i32)];
        curve(area, mark, Stroke::new(VERMILION, 2.0))?;
    }
    Ok(())
}
