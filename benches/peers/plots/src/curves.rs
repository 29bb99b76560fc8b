//! Curves of systems over logarithmic axes, in rows of panels.

use bgdyn_accuracy::plot::{Axis, Marker, Panel, Sign, Stroke, curve, draw, legend, mark, px};
use serde::Deserialize;

use crate::COLOURS;

/// The panels of a drawing.
#[derive(Deserialize)]
pub(crate) struct Curves {
    /// The name of a kind of curve, the index of its colour, and whether it is dashed with hollow points.
    legend: Vec<(String, usize, bool)>,
    panels: Vec<Curved>,
}

/// A panel with its title, the labels of its axes, and its curves.
#[derive(Deserialize)]
struct Curved {
    title: String,
    x: String,
    y: String,
    /// The index in the legend, and points.
    series: Vec<(usize, Vec<(f64, f64)>)>,
}

/// Panels in a row.
const COLUMNS: usize = 3;
/// Size of a panel, px, and height of the legend.
const SIZE: (u32, u32) = (330, 290);
const HEAD: u32 = 36;

/// Returns a logarithmic axis over values, with a margin at both ends.
fn around(values: impl Iterator<Item = f64>, most: usize) -> Axis {
    let (low, high) = values.fold((f64::INFINITY, 0.0_f64), |(low, high), x| {
        (low.min(x), high.max(x))
    });
    Axis::log(0.7 * low, 1.4 * high, most)
}

/// Draws a panel for each case.
pub(crate) fn curves(curves: &Curves) -> String {
    let rows = curves.panels.len().div_ceil(COLUMNS);
    let (width, height) = (SIZE.0 * COLUMNS as u32, SIZE.1 * rows as u32 + HEAD);
    let kind = |index: usize| {
        let (_, colour, hollow) = &curves.legend[index];
        let stroke = Stroke::from(COLOURS[*colour]);
        match hollow {
            true => (stroke.dashed(4.0, 3.0), Marker::Hollow),
            false => (stroke, Marker::Disc),
        }
    };
    draw((width, height), |area| {
        let signs = curves.legend.iter().enumerate().map(|(k, entry)| {
            let (stroke, marker) = kind(k);
            (Sign::Curve(stroke, marker), entry.0.as_str())
        });
        legend(area, (20.0, 18.0), &signs.collect::<Vec<_>>())?;
        let (_, rest) = area.split_vertically(px(HEAD));
        let parts = rest.split_evenly((rows, COLUMNS));
        for (panel, part) in curves.panels.iter().zip(&parts) {
            let points = || panel.series.iter().flat_map(|s| &s.1);
            let x = around(points().map(|p| p.0), 6).label(panel.x.as_str());
            let y = around(points().map(|p| p.1), 9).label(panel.y.as_str());
            let chart = Panel::new(&panel.title, x, y)
                .sides([72, 14, 32, 46])
                .draw(part)?;
            for (index, points) in &panel.series {
                let (stroke, marker) = kind(*index);
                let inside = chart.plotting_area();
                curve(inside, points.iter().copied(), stroke)?;
                for &point in points {
                    mark(inside, point, marker, stroke.colour)?;
                }
            }
        }
        Ok(())
    })
}
