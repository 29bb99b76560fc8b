//! One panel: axes, the shaded time, limits and lines.

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::{Area, BLUE, CARRIED, Drawn, FONT, GREY, INK, VERMILION, at, px};

/// A line of a panel.
pub struct Line {
    points: Vec<(f64, f64)>,
    style: ShapeStyle,
}

impl Line {
    /// The desired curve: broad and pale, so that the lines on it remain visible.
    pub fn wanted(points: Vec<(f64, f64)>) -> Self {
        let style = GREY.stroke_width(px(5));
        Line { points, style }
    }

    /// The run under computed torque.
    pub fn computed(points: Vec<(f64, f64)>) -> Self {
        let style = BLUE.stroke_width(px(2));
        Line { points, style }
    }

    /// The run for comparison.
    pub fn baseline(points: Vec<(f64, f64)>) -> Self {
        let style = VERMILION.stroke_width(px(2));
        Line { points, style }
    }

    /// Largest magnitude.
    pub fn peak(&self) -> f64 {
        self.points.iter().map(|p| p.1.abs()).fold(0.0, f64::max)
    }
}

/// A quantity over time.
pub struct Panel {
    /// Title of the panel.
    pub title: String,
    /// The time axis's label; `None` if the panel below has it.
    pub x_label: Option<&'static str>,
    /// The quantity with its unit.
    pub y_label: String,
    /// Range of the time axis, s.
    pub x: (f64, f64),
    /// Time to shade, s.
    pub carried: Option<(f64, f64)>,
    /// Magnitude to mark above and below zero.
    pub limit: Option<f64>,
    /// Whether the range includes zero.
    pub zero: bool,
    /// Least range, in the quantity's unit, so that a constant quantity is drawn as constant.
    pub least: f64,
}

/// Smallest and largest of `values`.
fn range(values: impl Iterator<Item = f64>) -> (f64, f64) {
    values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| {
        (low.min(x), high.max(x))
    })
}

/// Prints a number of an axis, with as few decimals as possible.
fn axis_number(x: &f64) -> String {
    let rounded = (x * 1e6).round() / 1e6;
    format!("{}", if rounded == 0.0 { 0.0 } else { rounded }).replace('-', "−")
}

impl Panel {
    fn y_range(&self, lines: &[Line]) -> (f64, f64) {
        let values = lines.iter().flat_map(|l| l.points.iter().map(|p| p.1));
        let limits = self.limit.into_iter().flat_map(|l| [-l, l]);
        let zero = self.zero.then_some(0.0);
        let (low, high) = range(values.chain(limits).chain(zero));
        let margin = (0.08 * (high - low)).max(0.5 * (self.least - (high - low)));
        (low - margin, high + margin)
    }

    /// Draws the panel with its lines, the first one lowest.
    pub fn draw(&self, area: &Area<'_>, lines: &[Line]) -> Drawn {
        let (low, high) = self.y_range(lines);
        let bottom = if self.x_label.is_some() { 46 } else { 26 };
        let mut chart = ChartBuilder::on(area)
            .caption(&self.title, (FONT, px(16)).into_font().color(&INK))
            .margin_left(px(10))
            .margin_right(px(22))
            .margin_top(px(4))
            .margin_bottom(px(if self.x_label.is_some() { 6 } else { 0 }))
            .x_label_area_size(px(bottom))
            .y_label_area_size(px(68))
            .build_cartesian_2d(self.x.0..self.x.1, low..high)?;
        if let Some((from, to)) = self.carried {
            let shade = [(from, low), (to, high)];
            chart.draw_series([Rectangle::new(shade, CARRIED.filled())])?;
        }
        chart
            .configure_mesh()
            .disable_x_mesh()
            .x_labels(9)
            .y_labels(5)
            .x_desc(self.x_label.unwrap_or(""))
            .y_desc(&self.y_label)
            .x_label_formatter(&axis_number)
            .y_label_formatter(&axis_number)
            .label_style((FONT, px(13)).into_font().color(&INK))
            .axis_desc_style((FONT, px(14)).into_font().color(&INK))
            .light_line_style(TRANSPARENT)
            .bold_line_style(BLACK.mix(0.10).stroke_width(px(1)))
            .axis_style(INK.mix(0.6).stroke_width(px(1)))
            .set_all_tick_mark_size(px(5))
            .draw()?;
        if low < 0.0 && high > 0.0 {
            let zero = [(self.x.0, 0.0), (self.x.1, 0.0)];
            chart.draw_series(LineSeries::new(zero, BLACK.mix(0.35).stroke_width(px(1))))?;
        }
        for limit in self.limit.into_iter().flat_map(|l| [-l, l]) {
            let ends = [(self.x.0, limit), (self.x.1, limit)];
            chart.draw_series(DashedLineSeries::new(
                ends,
                px(7),
                px(5),
                INK.stroke_width(px(1)),
            ))?;
        }
        for line in lines {
            chart.draw_series(LineSeries::new(line.points.iter().copied(), line.style))?;
        }
        Ok(())
    }
}

/// Draws a plane figure in metres, with the same scale along both axes and named points.
pub fn draw_plan(
    area: &Area<'_>,
    title: &str,
    lines: &[Line],
    marks: &[((f64, f64), &'static str)],
) -> Drawn {
    const SIDES: (u32, u32) = (px(10 + 68 + 22), px(4 + 24 + 46 + 6));
    let places = || {
        let points = lines.iter().flat_map(|l| l.points.iter().copied());
        points.chain(marks.iter().map(|m| m.0))
    };
    let (left, right) = range(places().map(|p| p.0));
    let (low, high) = range(places().map(|p| p.1));
    let (width, height) = area.dim_in_pixel();
    let (width, height) = (f64::from(width - SIDES.0), f64::from(height - SIDES.1));
    // Metres per pixel, by the tighter of the two directions.
    let scale = 1.25 * ((right - left) / width).max((high - low) / height);
    let around = |a: f64, b: f64, pixels: f64| {
        let (middle, half) = (0.5 * (a + b), 0.5 * scale * pixels);
        middle - half..middle + half
    };
    let mut chart = ChartBuilder::on(area)
        .caption(title, (FONT, px(16)).into_font().color(&INK))
        .margin_left(px(10))
        .margin_right(px(22))
        .margin_top(px(4))
        .margin_bottom(px(6))
        .x_label_area_size(px(46))
        .y_label_area_size(px(68))
        .build_cartesian_2d(around(left, right, width), around(low, high, height))?;
    chart
        .configure_mesh()
        .x_labels(8)
        .y_labels(7)
        .x_desc("y / m, left of the base positive")
        .y_desc("x / m")
        .x_label_formatter(&|x| axis_number(&-x))
        .y_label_formatter(&axis_number)
        .label_style((FONT, px(13)).into_font().color(&INK))
        .axis_desc_style((FONT, px(14)).into_font().color(&INK))
        .light_line_style(TRANSPARENT)
        .bold_line_style(BLACK.mix(0.10).stroke_width(px(1)))
        .axis_style(INK.mix(0.6).stroke_width(px(1)))
        .set_all_tick_mark_size(px(5))
        .draw()?;
    for line in lines {
        chart.draw_series(LineSeries::new(line.points.iter().copied(), line.style))?;
    }
    let below = Pos::new(HPos::Center, VPos::Top);
    let style = (FONT, px(15)).into_font().color(&INK).pos(below);
    chart.draw_series(marks.iter().map(|(place, name)| {
        EmptyElement::at(*place)
            + Circle::new((0, 0), px(5), INK.filled())
            + Text::new(*name, at(0, 10), style.clone())
    }))?;
    Ok(())
}
