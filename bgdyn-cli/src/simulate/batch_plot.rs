//! Plots a batch: the final value of each output against each varied quantity.

use std::path::Path;

use bgdyn_accuracy::svg::{Anchor, Drawing, INK, Marker};

use super::axis::{Axis, LARGEST};
use super::batch::RunSummary;
use super::batch_values::BatchValues;
use super::difference::range;
use super::panel::{BLUE, ORANGE, Panel};
use super::run_table::Column;

const PANEL: (f64, f64) = (400.0, 230.0);
const HEADER: f64 = 60.0;
/// Largest number of panels in a row of a page.
const ACROSS: usize = 4;
const DOWN: usize = 12;
/// Largest number of points that are drawn as distinguishable discs.
const FEW: usize = 400;
/// Colour of the range of an output's values.
const BAND: &str = "#e8e8e8";

/// Draws a batch to a file.
///
/// # Errors
/// If the file cannot be written.
pub(crate) fn draw(
    path: &Path,
    title: &str,
    columns: &[Column],
    (varied, summaries): (&BatchValues, &[RunSummary]),
) -> std::io::Result<()> {
    let across = varied.quantities.len().min(ACROSS);
    let down = columns.len().min(DOWN);
    // A single panel needs space for the title beside it.
    let width = if across == 1 { 1.5 * PANEL.0 } else { PANEL.0 };
    let mut d = Drawing::new(width * across as f64, HEADER + PANEL.1 * down as f64);
    d.text((16.0, 25.0), 18, INK, Anchor::Start, title);
    let failed = summaries.iter().filter(|run| run.failure.is_some()).count();
    let mut caption = format!("{} runs; blue: outputs at the end", summaries.len());
    if varied.quantities.len() == 1 {
        caption += ", grey: from their least to their largest value";
    }
    if failed > 0 {
        caption += &format!("; orange: {failed} failed, at the lower edge");
    }
    d.text((16.0, 48.0), 12, INK, Anchor::Start, &caption);
    for i in 0..across * down {
        let (row, column) = (i / across, i % across);
        let at = (width * column as f64, HEADER + PANEL.1 * row as f64);
        draw_panel(
            &mut d,
            (at, width),
            (&columns[row], row),
            (varied, column),
            summaries,
        );
    }
    std::fs::write(path, d.finish())
}

/// Draws one output against one quantity.
fn draw_panel(
    d: &mut Drawing,
    (at, width): ((f64, f64), f64),
    (output, row): (&Column, usize),
    (varied, column): (&BatchValues, usize),
    summaries: &[RunSummary],
) {
    let quantity = &varied.quantities[column];
    let single = varied.quantities.len() == 1;
    let all = || varied.runs.iter().map(|run| run[column]).zip(summaries);
    let sound = |run: &RunSummary| run.failure.is_none();
    let mut points: Vec<(f64, [f64; 3])> = all()
        .filter(|(_, run)| sound(run))
        .map(|(x, run)| (x, run.outputs[row]))
        .filter(|(_, y)| y.iter().all(|y| y.abs() < LARGEST))
        .collect();
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    let shown = if single { 0..3 } else { 0..1 };
    let values = points
        .iter()
        .flat_map(|(_, y)| y[shown.clone()].iter().copied());
    let y = Axis::new(range(values));
    let x = Axis::new(range(all().map(|(x, _)| x)));
    let panel = Panel {
        at,
        size: (width, PANEL.1),
        title: y.title(&output.name),
        below: match x.label(quantity.unit).as_str() {
            "" => x.title(&quantity.name),
            unit => format!("{} / {unit}", x.title(&quantity.name)),
        },
        beside: y.label(output.unit),
        x: &x,
        y: &y,
    };
    let of = |k: usize| points.iter().map(move |(q, v)| (*q, v[k]));
    if single {
        let outline = of(1).chain(of(2).collect::<Vec<_>>().into_iter().rev());
        let outline: Vec<_> = outline.map(|p| panel.place(p)).collect();
        d.area(&outline, BAND);
    }
    panel.draw(d);
    let ends: Vec<_> = of(0).map(|p| panel.place(p)).collect();
    if single {
        d.stroke(&ends, BLUE, 1.0);
    }
    let size = if points.len() <= FEW { 3.0 } else { 1.5 };
    for point in ends {
        d.disc(point, size, BLUE);
    }
    for (q, _) in all().filter(|(_, run)| !sound(run)) {
        let (x, _) = panel.place((q, 0.0));
        d.marker((x, panel.floor()), Marker::Cross, ORANGE);
    }
}
