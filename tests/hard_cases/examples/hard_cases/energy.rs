//! Draws the error of the energy over the number of steps.

use std::ops::Range;

use bgdyn_accuracy::plot::{
    self, Area, Axis, BLUE, Drawn, GREEN, INK, PURPLE, RGBColor, VERMILION, curve, name_ends, px,
    text, write,
};
use hard_cases::{Curve, Panel};

const COLOURS: [RGBColor; 4] = [VERMILION, BLUE, GREEN, PURPLE];
/// Width for the names of the curves.
const NAMES: u32 = 190;

/// Returns the drawing of both panels, as SVG.
pub fn draw(curves: &[Curve]) -> String {
    plot::draw((1400, 540), |area| {
        let title = "Energy of a double pendulum, step by step";
        let about = "largest |ΔE| since the point before, in units of 29.43 J, half of what it takes to stand the pendulum up";
        write(area, (16.0, 20.0), title, text(18, INK))?;
        write(area, (16.0, 44.0), about, text(13, INK))?;
        let (_, rest) = area.split_vertically(px(60));
        let parts = rest.split_evenly((1, 2));
        let regular = "from (0.5 rad, 0): regular; in momenta";
        panel(&parts[0], regular, of(curves, Panel::Regular), 1e-18..1e-8)?;
        let chaotic = "from (120°, 30°): chaotic; in velocities and in momenta";
        panel(&parts[1], chaotic, of(curves, Panel::Chaotic), 1e-10..1.0)
    })
}

fn of(curves: &[Curve], panel: Panel) -> Vec<&Curve> {
    curves.iter().filter(|c| c.panel == panel).collect()
}

/// Draws one motion by several integrators, on logarithmic axes.
fn panel(area: &Area<'_>, title: &str, curves: Vec<&Curve>, errors: Range<f64>) -> Drawn {
    let ends = curves.iter().filter_map(|c| c.points.last());
    let end = ends.fold(10.0_f64, |end, p| end.max(p.0));
    let x = Axis::log(1.0, end, 9).label("steps");
    let y = Axis::log(errors.start, errors.end, 6);
    let panel = plot::Panel::new(title, x, y).sides([60, NAMES, 32, 46]);
    let chart = panel.draw(area)?;
    let mut names = vec![];
    for (of, colour) in curves.iter().zip(COLOURS) {
        let points = of.points.iter().filter(|p| p.1 > errors.start);
        let points: Vec<(f64, f64)> = points.copied().collect();
        names.extend(points.last().map(|end| (*end, of.name.to_owned(), colour)));
        curve(chart.plotting_area(), points, colour.into())?;
    }
    name_ends(area, &chart, names)
}
