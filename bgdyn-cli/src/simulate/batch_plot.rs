//! Plots a batch: the final value of each output against each varied quantity.

use bgdyn_accuracy::plot::plotters::prelude::{Color, Polygon};
use bgdyn_accuracy::plot::{
    Area, Axis, BLUE, Drawn, INK, Marker, Panel, RGBColor, Stroke, VERMILION, curve, draw, mark,
    px, text, write,
};

use super::batch::RunSummary;
use super::batch_values::BatchValues;
use super::run_table::Column;

const PANEL: (u32, u32) = (400, 230);
const HEADER: u32 = 60;
/// Largest number of panels in a row of a page.
const ACROSS: usize = 4;
const DOWN: usize = 12;
/// Largest number of points that are drawn as distinguishable discs.
const FEW: usize = 400;
/// Colour of the range of an output's values.
const BAND: RGBColor = RGBColor(209, 209, 209);

/// Returns the drawing of a batch, as SVG.
pub(crate) fn plot(
    title: &str,
    columns: &[Column],
    (varied, summaries): (&BatchValues, &[RunSummary]),
) -> String {
    let across = varied.quantities.len().min(ACROSS);
    let down = columns.len().min(DOWN);
    // A single panel needs space for the title beside it.
    let width = if across == 1 {
        600
    } else {
        PANEL.0 * across as u32
    };
    let failed = summaries.iter().filter(|run| run.failure.is_some()).count();
    let mut caption = format!("{} runs; blue: outputs at the end", summaries.len());
    if varied.quantities.len() == 1 {
        caption += ", grey: from their least to their largest value";
    }
    if failed > 0 {
        caption += &format!("; orange: {failed} failed, at the lower edge");
    }
    draw((width, HEADER + PANEL.1 * down as u32), |area| {
        write(area, (16.0, 20.0), title, text(18, INK))?;
        write(area, (16.0, 44.0), &caption, text(13, INK))?;
        let (_, rest) = area.split_vertically(px(HEADER));
        for (i, part) in rest.split_evenly((down, across)).iter().enumerate() {
            let (row, column) = (i / across, i % across);
            draw_panel(part, (&columns[row], row), (varied, column), summaries)?;
        }
        Ok(())
    })
}

/// Draws one output against one quantity.
fn draw_panel(
    area: &Area<'_>,
    (output, row): (&Column, usize),
    (varied, column): (&BatchValues, usize),
    summaries: &[RunSummary],
) -> Drawn {
    let quantity = &varied.quantities[column];
    let single = varied.quantities.len() == 1;
    let all = || varied.runs.iter().map(|run| run[column]).zip(summaries);
    let sound = |run: &RunSummary| run.failure.is_none();
    let mut points: Vec<(f64, [f64; 3])> = all()
        .filter(|(_, run)| sound(run))
        .map(|(x, run)| (x, run.outputs[row]))
        .filter(|(_, y)| y.iter().all(|y| y.is_finite()))
        .collect();
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    let shown = if single { 0..3 } else { 0..1 };
    let values = points.iter().flat_map(|(_, y)| y[shown.clone()].to_vec());
    let y = Axis::around(values, 7);
    let x = Axis::around(all().map(|(x, _)| x), 8);
    let below = match x.unit(quantity.unit).as_str() {
        "" => x.quantity(&quantity.name),
        unit => format!("{} / {unit}", x.quantity(&quantity.name)),
    };
    let (name, unit) = (y.quantity(&output.name), y.unit(output.unit));
    let panel = Panel::new(&name, x.label(below), y.label(unit));
    let chart = panel.draw(area)?;
    let inside = chart.plotting_area();
    let of = |k: usize| points.iter().map(move |(q, v)| (*q, v[k]));
    if single {
        let above: Vec<(f64, f64)> = of(2).collect();
        let outline: Vec<_> = of(1).chain(above.into_iter().rev()).collect();
        inside.draw(&Polygon::new(outline, BAND.mix(0.5)))?;
        curve(inside, of(0), Stroke::new(BLUE, 1.0))?;
    }
    let few = points.len() <= FEW;
    for end in of(0) {
        mark(
            inside,
            end,
            if few { Marker::Disc } else { Marker::Dot },
            BLUE,
        )?;
    }
    let foot = chart.y_range().start;
    for (q, _) in all().filter(|(_, run)| !sound(run)) {
        mark(inside, (q, foot), Marker::Cross, VERMILION)?;
    }
    Ok(())
}
