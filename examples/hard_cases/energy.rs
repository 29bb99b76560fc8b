//! The figure: the error of the energy over the number of steps.

use std::error::Error;
use std::path::Path;

use hard_cases::{Curve, Panel};
use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;

// Okabe and Ito's palette, which colour-blind readers tell apart.
const COLORS: [RGBColor; 4] = [
    RGBColor(213, 94, 0),
    RGBColor(0, 114, 178),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
];
const INK: RGBColor = RGBColor(40, 40, 40);
const FONT: &str = "sans-serif";
const SIZE: (u32, u32) = (1240, 560);
const HEADER: u32 = 64;

/// Draws both panels.
pub fn draw(path: &Path, curves: &[Curve]) -> Result<(), Box<dyn Error>> {
    let root = SVGBackend::new(path, SIZE).into_drawing_area();
    root.fill(&WHITE)?;
    let (header, rest) = root.split_vertically(HEADER);
    let text = |size: u32| (FONT, size).into_font().color(&INK);
    header.draw_text(
        "Energy of a double pendulum, step by step",
        &text(22),
        (16, 8),
    )?;
    let about = "largest |ΔE| since the point before, in units of 29.43 J: a quarter of what it takes to stand the pendulum up is 14.7 J";
    header.draw_text(about, &text(14), (16, 38))?;
    let panels = rest.split_evenly((1, 2));
    panel(
        &panels[0],
        Panel::Regular,
        "from (0.5 rad, 0): regular; in momenta",
        curves,
        1e-18..1e-9,
    )?;
    panel(
        &panels[1],
        Panel::Chaotic,
        "from (120°, 30°): chaotic; in velocities and in momenta",
        curves,
        1e-12..1e1,
    )?;
    root.present()?;
    Ok(())
}

/// One motion by several methods.
fn panel(
    area: &Area<'_>,
    of: Panel,
    title: &str,
    curves: &[Curve],
    range: std::ops::Range<f64>,
) -> Result<(), Box<dyn Error>> {
    let own: Vec<&Curve> = curves.iter().filter(|c| c.panel == of).collect();
    let ends = own.iter().filter_map(|c| c.points.last());
    let end = ends.fold(10.0_f64, |end, p| end.max(p.0));
    let mut chart = ChartBuilder::on(area)
        .caption(title, (FONT, 16).into_font().color(&INK))
        .margin(10)
        .x_label_area_size(44)
        .y_label_area_size(66)
        .build_cartesian_2d((1.0..end).log_scale(), range.clone().log_scale())?;
    chart
        .configure_mesh()
        .x_desc("steps")
        .x_label_formatter(&|x| power(*x))
        .y_label_formatter(&|y| power(*y))
        .x_labels(8)
        .y_labels(12)
        .label_style((FONT, 13).into_font().color(&INK))
        .axis_desc_style((FONT, 14).into_font().color(&INK))
        .light_line_style(TRANSPARENT)
        .bold_line_style(BLACK.mix(0.12))
        .axis_style(INK.mix(0.6))
        .draw()?;
    for (curve, color) in own.iter().zip(COLORS) {
        let points = curve.points.iter().filter(|p| p.1 > range.start);
        chart.draw_series(LineSeries::new(points.copied(), color.stroke_width(2)))?;
    }
    for (curve, color) in own.iter().zip(COLORS) {
        let Some(&(x, y)) = curve.points.last() else {
            continue;
        };
        let style = (FONT, 14).into_font().color(&color);
        let style = style.pos(Pos::new(HPos::Right, VPos::Bottom));
        let place = chart.backend_coord(&(x, y.max(range.start)));
        let (left, top) = area.get_base_pixel();
        let place = (place.0 - left - 6, place.1 - top - 6);
        area.draw_text(curve.name, &style, place)?;
    }
    Ok(())
}

/// A power of ten.
fn power(x: f64) -> String {
    let exponent = x.log10().round();
    let digits = exponent.to_string();
    let raised = |c: char| match c {
        '-' => '⁻',
        _ => "⁰¹²³⁴⁵⁶⁷⁸⁹"
            .chars()
            .nth(c as usize - '0' as usize)
            .unwrap_or(c),
    };
    format!("10{}", digits.chars().map(raised).collect::<String>())
}
