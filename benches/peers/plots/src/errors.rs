//! The error of each run over its time for a simulated second, or over its step where times were not measured.

use bgdyn_accuracy::plot::plotters::style::text_anchor::HPos;
use bgdyn_accuracy::plot::{
    Axis, INK, Marker, Panel, Sign, at, draw as drawing, legend, mark, px, text, write,
};
use serde::Deserialize;

use super::COLOURS;

/// The numbers of the plot.
#[derive(Deserialize)]
pub struct Errors {
    /// The systems, in the order of their colours.
    systems: Vec<String>,
    /// Whether times were measured: they are the numbers along the axis, else the steps.
    timed: bool,
    mechanisms: Vec<Mechanism>,
}

#[derive(Deserialize)]
struct Mechanism {
    title: String,
    runs: Vec<Run>,
}

#[derive(Deserialize)]
struct Run {
    /// The index of its system.
    system: usize,
    /// Time or step, s.
    along: f64,
    error: f64,
    /// Whether Python takes part in each step.
    python: bool,
}

const SIZE: (u32, u32) = (850, 390);
const HEADER: u32 = 40;

/// Returns the plot, as SVG.
pub fn draw(errors: &Errors) -> String {
    drawing(SIZE, |area| {
        let systems = errors.systems.iter().zip(COLOURS);
        let signs = systems.map(|(name, c)| (Sign::Points(Marker::Disc, c), name.as_str()));
        legend(area, (60.0, 22.0), &signs.collect::<Vec<_>>())?;
        if errors.timed {
            let hollow = "hollow: with Python in each step";
            write(area, (830.0, 22.0), hollow, &text(13, INK, HPos::Right))?;
        }
        let (_, rest) = area.split_vertically(px(HEADER));
        let parts = rest.split_evenly((1, errors.mechanisms.len().max(1)));
        for (mechanism, part) in errors.mechanisms.iter().zip(&parts) {
            let runs = &mechanism.runs;
            let label = match errors.timed {
                true => "time for a simulated second, s",
                false => "step, s",
            };
            let x = Axis::decades(runs.iter().map(|r| r.along), 9).label(label);
            let y = Axis::decades(runs.iter().map(|r| r.error), 9);
            let panel = Panel::new(&mechanism.title, x, y).sides([60, 20, 32, 46]);
            let chart = panel.draw(part)?;
            for run in runs {
                let marker = match errors.timed && run.python {
                    true => Marker::Hollow,
                    false => Marker::Disc,
                };
                let (x, y) = chart.backend_coord(&(run.along, run.error));
                // Over the step, systems are side by side.
                let beside = match errors.timed {
                    true => 0.0,
                    false => 9.0 * (run.system as f64 - 1.5),
                };
                mark(
                    area,
                    (x + at(beside, 0.0).0, y),
                    marker,
                    COLOURS[run.system],
                )?;
            }
        }
        Ok(())
    })
}
