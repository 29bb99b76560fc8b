//! The plot of a batch: where each output ends against each quantity that was varied.

use std::path::Path;

use plotters::prelude::*;

use super::batch::Told;
use super::difference::range;
use super::plot::{Area, Axis, Drawn, FONT, INK, LARGEST, LINE};
use super::record::Column;
use super::varied::Varied;

const PANEL: (u32, u32) = (400, 230);
const HEADER: u32 = 60;
/// More panels than these have no place on a page.
const ACROSS: usize = 4;
const DOWN: usize = 12;
const FAILED: RGBColor = RGBColor(213, 94, 0);
/// Points up to which each is drawn as a disc that can be told from its neighbours.
const FEW: usize = 400;

/// Draws a batch to a file.
///
/// # Errors
/// Where the file cannot be written.
pub(crate) fn draw(
    path: &Path,
    title: &str,
    columns: &[Column],
    (varied, told): (&Varied, &[Told]),
) -> Drawn {
    let across = varied.quantities.len().min(ACROSS);
    let down = columns.len().min(DOWN);
    // A single panel needs room for the title beside it.
    let panel = if across == 1 {
        PANEL.0 * 3 / 2
    } else {
        PANEL.0
    };
    let size = (panel * across as u32, HEADER + PANEL.1 * down as u32);
    let root = SVGBackend::new(path, size).into_drawing_area();
    root.fill(&WHITE)?;
    let (header, rest) = root.split_vertically(HEADER);
    let text = |size: u32| (FONT, size).into_font().color(&INK);
    header.draw_text(title, &text(20), (16, 8))?;
    let failed = told.iter().filter(|run| run.failure.is_some()).count();
    let mut told_of = format!("{} runs; blue: outputs at the end", told.len());
    if varied.quantities.len() == 1 {
        told_of += ", grey: from their least to their largest value";
    }
    if failed > 0 {
        told_of += &format!("; orange: {failed} failed, at the lower edge");
    }
    header.draw_text(&told_of, &text(13), (16, 36))?;
    for (i, area) in rest.split_evenly((down, across)).iter().enumerate() {
        let (row, column) = (i / across, i % across);
        draw_panel(area, (&columns[row], row), (varied, column), told)?;
    }
    root.present()?;
    Ok(())
}

/// One output against one quantity.
fn draw_panel(
    area: &Area<'_>,
    (output, row): (&Column, usize),
    (varied, column): (&Varied, usize),
    told: &[Told],
) -> Drawn {
    let quantity = &varied.quantities[column];
    let single = varied.quantities.len() == 1;
    let all = || varied.runs.iter().map(|run| run[column]).zip(told);
    let sound = |run: &Told| run.failure.is_none();
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
    let mut chart = ChartBuilder::on(area)
        .caption(y.title(&output.name), (FONT, 15).into_font().color(&INK))
        .margin_left(8)
        .margin_right(22)
        .margin_top(4)
        .x_label_area_size(42)
        .y_label_area_size(70)
        .build_cartesian_2d(x.low..x.high, y.low..y.high)?;
    let unit = x.label(quantity.unit);
    chart
        .configure_mesh()
        .disable_x_mesh()
        .x_labels(6)
        .y_labels(5)
        .x_desc(match unit.as_str() {
            "" => x.title(&quantity.name),
            unit => format!("{} / {unit}", x.title(&quantity.name)),
        })
        .y_desc(y.label(output.unit))
        .x_label_formatter(&|v| x.number(*v))
        .y_label_formatter(&|v| y.number(*v))
        .label_style((FONT, 12).into_font().color(&INK))
        .axis_desc_style((FONT, 13).into_font().color(&INK))
        .light_line_style(TRANSPARENT)
        .bold_line_style(BLACK.mix(0.12))
        .axis_style(INK.mix(0.6))
        .draw()?;
    let at = |(q, value): (f64, f64)| (x.of(q), y.of(value));
    if single {
        let band = points.iter().map(|(q, v)| at((*q, v[1])));
        let back = points.iter().rev().map(|(q, v)| at((*q, v[2])));
        let outline: Vec<(f64, f64)> = band.chain(back).collect();
        chart.draw_series([Polygon::new(outline, BLACK.mix(0.09))])?;
        let line = points.iter().map(|(q, v)| at((*q, v[0])));
        chart.draw_series(LineSeries::new(line, LINE.mix(0.5)))?;
    }
    let (size, ink) = if points.len() <= FEW {
        (3, 0.8)
    } else {
        (2, 0.35)
    };
    let disc = |(q, v): &(f64, [f64; 3])| Circle::new(at((*q, v[0])), size, LINE.mix(ink).filled());
    chart.draw_series(points.iter().map(disc))?;
    let lost = all().filter(|(_, run)| !sound(run));
    let lost = lost.map(|(q, _)| Cross::new((x.of(q), y.low), 4, FAILED.stroke_width(2)));
    chart.draw_series(lost)?;
    Ok(())
}
