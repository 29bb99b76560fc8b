//! Draws the error of the energy over the number of steps.

use std::error::Error;
use std::path::Path;

use bgdyn_accuracy::dark::with_dark_mode;
use bgdyn_accuracy::fine::{FINE, shown_at};
use hard_cases::{Curve, Panel};
use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;

// The palette of Okabe and Ito, which is distinguishable for colour-blind readers.
const COLORS: [RGBColor; 4] = [
    RGBColor(213, 94, 0),
    RGBColor(0, 114, 178),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
];
const INK: RGBColor = RGBColor(40, 40, 40);
const FONT: &str = "sans-serif";
const SIZE: (u32, u32) = (1400, 540);
const HEADER: u32 = 64;
/// Width for the names of the curves, and space between two of them.
const NAMES: u32 = 176;
const LINE: i32 = 17;

/// Converts whole pixels to the drawing's units.
const fn px(pixels: u32) -> u32 {
    FINE * pixels
}

/// Converts a position in whole pixels to the drawing's units.
const fn at(x: i32, y: i32) -> (i32, i32) {
    (FINE as i32 * x, FINE as i32 * y)
}

/// Draws both panels.
pub fn draw(path: &Path, curves: &[Curve]) -> Result<(), Box<dyn Error>> {
    let mut svg = String::new();
    draw_all(&mut svg, curves)?;
    std::fs::write(path, with_dark_mode(&shown_at(&svg, SIZE)))?;
    Ok(())
}

fn draw_all(svg: &mut String, curves: &[Curve]) -> Result<(), Box<dyn Error>> {
    let root = SVGBackend::with_string(svg, (px(SIZE.0), px(SIZE.1))).into_drawing_area();
    root.fill(&WHITE)?;
    let (header, rest) = root.split_vertically(px(HEADER));
    let text = |size: u32| (FONT, px(size)).into_font().color(&INK);
    header.draw_text(
        "Energy of a double pendulum, step by step",
        &text(22),
        at(16, 8),
    )?;
    let about = "largest |ΔE| since the point before, in units of 29.43 J, half of what it takes to stand the pendulum up";
    header.draw_text(about, &text(14), at(16, 38))?;
    let panels = rest.split_evenly((1, 2));
    panel(
        &panels[0],
        Panel::Regular,
        "from (0.5 rad, 0): regular; in momenta",
        curves,
        -18.0..-8.0,
    )?;
    panel(
        &panels[1],
        Panel::Chaotic,
        "from (120°, 30°): chaotic; in velocities and in momenta",
        curves,
        -10.0..0.0,
    )?;
    root.present()?;
    Ok(())
}

/// Draws one motion by several integrators, on logarithmic axes.
fn panel(
    area: &Area<'_>,
    of: Panel,
    title: &str,
    curves: &[Curve],
    powers: std::ops::Range<f64>,
) -> Result<(), Box<dyn Error>> {
    let own: Vec<&Curve> = curves.iter().filter(|c| c.panel == of).collect();
    let ends = own.iter().filter_map(|c| c.points.last());
    let end = ends.fold(1.0_f64, |end, p| end.max(p.0.log10()));
    let mut chart = ChartBuilder::on(area)
        .caption(title, (FONT, px(16)).into_font().color(&INK))
        .margin(px(10))
        .margin_right(px(NAMES))
        .x_label_area_size(px(44))
        .y_label_area_size(px(60))
        .build_cartesian_2d(0.0..end, powers.clone())?;
    chart
        .configure_mesh()
        .x_desc("steps")
        .x_label_formatter(&|x| power(*x))
        .y_label_formatter(&|y| power(*y))
        .x_labels(end as usize + 1)
        .y_labels((powers.end - powers.start) as usize / 2 + 1)
        .label_style((FONT, px(13)).into_font().color(&INK))
        .axis_desc_style((FONT, px(14)).into_font().color(&INK))
        .light_line_style(TRANSPARENT)
        .bold_line_style(BLACK.mix(0.12).stroke_width(px(1)))
        .axis_style(INK.mix(0.6).stroke_width(px(1)))
        .set_all_tick_mark_size(px(5))
        .draw()?;
    let mut names = vec![];
    for (curve, color) in own.iter().zip(COLORS) {
        let points = curve.points.iter().map(|p| (p.0.log10(), p.1.log10()));
        let points: Vec<(f64, f64)> = points.filter(|p| p.1 > powers.start).collect();
        if let Some(last) = points.last() {
            names.push((chart.backend_coord(last), curve.name, color));
        }
        chart.draw_series(LineSeries::new(points, color.stroke_width(px(2))))?;
    }
    // Beside the ends of the curves, each on a line of its own.
    names.sort_by_key(|((_, y), ..)| *y);
    let (left, top) = area.get_base_pixel();
    let mut free = i32::MIN;
    for ((x, y), name, color) in names {
        let y = y.max(free);
        free = y + at(0, LINE).1;
        let style = (FONT, px(13)).into_font().color(&color);
        let style = style.pos(Pos::new(HPos::Left, VPos::Center));
        area.draw_text(name, &style, (x - left + at(8, 0).0, y - top))?;
    }
    Ok(())
}

/// Prints ten to an integer power.
fn power(exponent: f64) -> String {
    let raised = |c: char| match c.to_digit(10) {
        Some(digit) => ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'][digit as usize],
        None => '⁻',
    };
    let digits = format!("{}", exponent.round() as i32);
    format!("10{}", digits.chars().map(raised).collect::<String>())
}
