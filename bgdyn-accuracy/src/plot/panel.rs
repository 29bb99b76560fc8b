//! A panel: axes with their title and labels.

use plotters::prelude::{ChartBuilder, Color, Rectangle};

use super::{Area, Axis, Chart, Drawn, FAINT, GRID, INK, RGBColor, px, text, write};

/// Axes in an area, with a title above their frame.
#[derive(Clone, Debug)]
pub struct Panel<'t> {
    title: &'t str,
    x: Axis,
    y: Axis,
    /// Widths of the area left of the frame, right of it, above and below it, px.
    sides: [u32; 4],
    /// A range along the horizontal axis, and the colour of its ground.
    shaded: Option<((f64, f64), RGBColor)>,
}

impl<'t> Panel<'t> {
    /// Returns a panel with sides that have space for title, numbers and labels.
    pub fn new(title: &'t str, x: Axis, y: Axis) -> Self {
        let above = if title.is_empty() { 10 } else { 32 };
        let below = if x.label.is_empty() { 26 } else { 46 };
        let sides = [78, 20, above, below];
        Panel {
            title,
            x,
            y,
            sides,
            shaded: None,
        }
    }

    /// Returns the panel with other sides: left, right, above, below, px.
    pub fn sides(self, sides: [u32; 4]) -> Self {
        Panel { sides, ..self }
    }

    /// Returns the panel with a range along the horizontal axis shaded, below grid lines and curves.
    pub fn shaded(self, range: (f64, f64), colour: RGBColor) -> Self {
        Panel {
            shaded: Some((range, colour)),
            ..self
        }
    }

    /// Draws the axes in the area and returns their chart.
    ///
    /// # Errors
    /// Those of `plotters`; none in a drawing of [`super::draw`].
    pub fn draw<'a>(&self, area: &Area<'a>) -> Drawn<Chart<'a>> {
        let [left, right, above, below] = self.sides;
        let title = (f64::from(left), f64::from(above) - 13.0);
        write(area, title, self.title, text(14, INK))?;
        let margin = left.min(6);
        let mut chart = ChartBuilder::on(area)
            .margin_left(px(margin))
            .margin_right(px(right))
            .margin_top(px(above))
            .margin_bottom(px(if self.x.label.is_empty() { 0 } else { 4 }))
            .x_label_area_size(px(below - if self.x.label.is_empty() { 0 } else { 4 }))
            .y_label_area_size(px(left - margin))
            .build_cartesian_2d(self.x.clone(), self.y.clone())?;
        if let Some(((from, to), colour)) = self.shaded {
            let y = chart.y_range();
            let corners = [(from, y.start), (to, y.end)];
            let ground = Rectangle::new(corners, colour.filled());
            chart.plotting_area().draw(&ground)?;
        }
        let mut mesh = chart.configure_mesh();
        mesh.light_line_style(plotters::style::TRANSPARENT)
            .bold_line_style(GRID.stroke_width(px(1)))
            .axis_style(FAINT.stroke_width(px(1)))
            .label_style(text(11, INK))
            .axis_desc_style(text(13, INK))
            .set_all_tick_mark_size(px(4));
        if !self.x.lines {
            mesh.disable_x_mesh();
        }
        if self.x.is_bare() {
            mesh.disable_x_axis();
        }
        if !self.x.label.is_empty() {
            mesh.x_desc(&self.x.label);
        }
        if !self.y.label.is_empty() {
            mesh.y_desc(&self.y.label);
        }
        mesh.draw()?;
        Ok(chart)
    }
}

/// Returns the place of a point of a chart in the area that its panel is drawn in, or in one around it.
pub fn place_in(area: &Area<'_>, chart: &Chart<'_>, point: (f64, f64)) -> (i32, i32) {
    let ((x, y), (left, top)) = (chart.backend_coord(&point), area.get_base_pixel());
    (x - left, y - top)
}
