//! One panel: axes, the shaded time, limits and lines.

use bgdyn_accuracy::plot::{
    self, Area, Axis, BLUE, Drawn, FAINT, INK, Marker, RGBColor, Stroke, VERMILION, at, centred,
    curve, mark, text,
};

use super::CARRIED;

/// The desired curve: broad and pale, so that the lines on it remain visible.
pub const WANTED: Stroke = Stroke::new(RGBColor(190, 190, 190), 5.0);
/// The run under computed torque.
pub const COMPUTED: Stroke = Stroke::new(BLUE, 2.0);
/// The run for comparison.
pub const BASELINE: Stroke = Stroke::new(VERMILION, 2.0);
/// The limit of a drive.
pub const LIMIT: Stroke = Stroke::new(INK, 1.0).dashed(7.0, 5.0);

/// A line of a panel.
pub struct Line {
    points: Vec<(f64, f64)>,
    stroke: Stroke,
}

impl Line {
    /// Returns a line through points.
    pub fn new(stroke: Stroke, points: Vec<(f64, f64)>) -> Self {
        Line { points, stroke }
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
        let x = Axis::linear(self.x.0, self.x.1, 9).label(self.x_label.unwrap_or_default());
        let y = Axis::linear(low, high, 7);
        let label = match self.y_label.split_once(" / ") {
            Some((name, unit)) => format!("{name} / {}", y.unit(unit)),
            None => self.y_label.clone(),
        };
        let panel = plot::Panel::new(&self.title, x, y.label(label));
        let panel = match self.carried {
            Some(time) => panel.shaded(time, CARRIED),
            None => panel,
        };
        let chart = panel.draw(area)?;
        let inside = chart.plotting_area();
        let level = |y: f64| [(self.x.0, y), (self.x.1, y)];
        if low < 0.0 && high > 0.0 {
            curve(inside, level(0.0), Stroke::new(FAINT, 1.0))?;
        }
        for limit in self.limit.into_iter().flat_map(|l| [-l, l]) {
            curve(inside, level(limit), LIMIT)?;
        }
        for line in lines {
            curve(inside, line.points.iter().copied(), line.stroke)?;
        }
        Ok(())
    }
}

/// Draws a plane figure in metres, with the same scale along both axes and named points. The horizontal
/// coordinate grows to the left.
pub fn draw_plan(
    area: &Area<'_>,
    title: &str,
    lines: &[Line],
    marks: &[((f64, f64), &'static str)],
) -> Drawn {
    const SIDES: [u32; 4] = [78, 20, 32, 46];
    let places = || {
        let points = lines.iter().flat_map(|l| l.points.iter().copied());
        points.chain(marks.iter().map(|m| m.0))
    };
    let (right, left) = range(places().map(|p| p.0));
    let (low, high) = range(places().map(|p| p.1));
    let (width, height) = area.dim_in_pixel();
    let inner = |size: u32, sides: u32| f64::from(size - plot::px(sides));
    let (width, height) = (
        inner(width, SIDES[0] + SIDES[1]),
        inner(height, SIDES[2] + SIDES[3]),
    );
    // Metres per unit of the drawing, by the tighter of the two directions.
    let scale = 1.25 * ((left - right) / width).max((high - low) / height);
    let around = |a: f64, b: f64, size: f64| {
        let (middle, half) = (0.5 * (a + b), 0.5 * scale * size);
        Axis::linear(middle - half, middle + half, 8).lines()
    };
    let x = around(right, left, width).reversed();
    let x = x.label("y / m, left of the base positive");
    let y = around(low, high, height).label("x / m");
    let panel = plot::Panel::new(title, x, y).sides(SIDES);
    let chart = panel.draw(area)?;
    for line in lines {
        let points = line.points.iter().copied();
        curve(chart.plotting_area(), points, line.stroke)?;
    }
    for (place, name) in marks {
        mark(chart.plotting_area(), *place, Marker::Disc, INK)?;
        let (x, y) = plot::place_in(area, &chart, *place);
        let below = (x, y + at(0.0, 16.0).1);
        area.draw_text(name, &centred(text(13, INK)), below)?;
    }
    Ok(())
}
