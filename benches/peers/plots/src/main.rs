//! Draws the plots of docs/peers.md, docs/peers_loops.md and docs/peers_contact.md: `plots ratios|errors|curves FILE.svg`,
//! with the numbers as JSON on stdin, from Python beside the measurements.

mod curves;

use std::error::Error;

use bgdyn_accuracy::plot::{
    Axis, BLUE, GREEN, GRID, INK, Marker, PURPLE, Panel, RGBColor, SKY, Sign, Stroke, VERMILION,
    bold, curve, draw, legend, mark, px, right_aligned, text, write,
};
use serde::Deserialize;

/// Colours of the systems, in their order.
const COLOURS: [RGBColor; 5] = [VERMILION, BLUE, GREEN, PURPLE, SKY];

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [what, path] = &arguments[..] else {
        return Err("usage: plots ratios|errors|curves FILE.svg <NUMBERS.json".into());
    };
    let svg = match what.as_str() {
        "ratios" => ratios(&serde_json::from_reader(std::io::stdin())?),
        "errors" => errors(&serde_json::from_reader(std::io::stdin())?),
        "curves" => curves::curves(&serde_json::from_reader(std::io::stdin())?),
        what => {
            return Err(format!("unknown plot `{what}`: there are ratios, errors, curves").into());
        }
    };
    std::fs::write(path, svg).map_err(|e| format!("{path} cannot be written: {e}"))?;
    Ok(())
}

/// Returns the entries of a legend.
fn signs(systems: &[String]) -> Vec<(Sign, &str)> {
    let all = systems.iter().zip(COLOURS);
    all.map(|(name, colour)| (Sign::Points(Marker::Disc, colour), name.as_str()))
        .collect()
}

/// Times of other systems over that of bgdyn.
#[derive(Deserialize)]
struct Ratios {
    systems: Vec<String>,
    robots: Vec<(String, Vec<Function>)>,
}

/// The name of a function, and the systems' ratios.
type Function = (String, Vec<Option<f64>>);

const LEFT: u32 = 190;
const TOP: u32 = 62;
const ROW: u32 = 15;
const BELOW: u32 = 46;

/// Draws a row of discs for each robot and function.
fn ratios(ratios: &Ratios) -> String {
    // A row is free between two robots.
    let rows: usize = ratios.robots.iter().map(|r| r.1.len() + 1).sum();
    let functions = ratios.robots.iter().flat_map(|r| &r.1);
    let all: Vec<f64> = functions
        .flat_map(|f| f.1.iter().flatten().copied())
        .collect();
    let [least, most] = [f64::min, f64::max].map(|f| all.iter().copied().fold(1.0, f));
    draw((780, TOP + ROW * rows as u32 + BELOW), |area| {
        let title = "Times as long as bgdyn, one state a call, f64";
        write(area, (10.0, 18.0), title, text(14, INK))?;
        legend(area, (f64::from(LEFT), 42.0), &signs(&ratios.systems))?;
        let least = if least < 1.0 { 0.95 * least } else { 1.0 };
        let x = Axis::log(least, 1.05 * most, 12).label("time over that of bgdyn");
        let panel = Panel::new("", x, Axis::rows(rows)).sides([LEFT, 20, TOP, BELOW]);
        let chart = panel.draw(area)?;
        let (inside, ends) = (chart.plotting_area(), chart.x_range());
        let mut row = 1.0;
        for (robot, functions) in &ratios.robots {
            let height = |row: f64| f64::from(TOP) + f64::from(ROW) * row;
            write(area, (10.0, height(row)), robot, bold(11, INK))?;
            for (function, times) in functions {
                let name = (f64::from(LEFT) - 12.0, height(row));
                write(area, name, function, right_aligned(text(11, INK)))?;
                let line = [(ends.start, row), (ends.end, row)];
                curve(inside, line, Stroke::new(GRID, 0.5))?;
                for (time, colour) in times.iter().zip(COLOURS) {
                    if let Some(time) = time {
                        mark(inside, (*time, row), Marker::Disc, colour)?;
                    }
                }
                row += 1.0;
            }
            row += 1.0;
        }
        curve(
            inside,
            [(1.0, 0.0), (1.0, rows as f64)],
            Stroke::new(INK, 1.0),
        )
    })
}

/// Errors of runs.
#[derive(Deserialize)]
struct Errors {
    systems: Vec<String>,
    /// Whether times were measured: the second number of a run is its time for a simulated second, else its step, s.
    timed: bool,
    mechanisms: Vec<(String, Vec<Run>)>,
}

/// The index of a system, time or step, error, and whether Python takes part in each step.
type Run = (usize, f64, f64, bool);

/// Draws errors over times, or over steps.
fn errors(errors: &Errors) -> String {
    draw((850, 390), |area| {
        legend(area, (60.0, 22.0), &signs(&errors.systems))?;
        let hollow = "hollow: with Python in each step";
        let (hollow, label) = match errors.timed {
            true => (hollow, "time for a simulated second, s"),
            false => ("", "step, s"),
        };
        write(area, (830.0, 22.0), hollow, right_aligned(text(13, INK)))?;
        let (_, rest) = area.split_vertically(px(40));
        let parts = rest.split_evenly((1, errors.mechanisms.len()));
        for ((title, runs), part) in errors.mechanisms.iter().zip(&parts) {
            let x = Axis::decades(runs.iter().map(|r| r.1), 9).label(label);
            let y = Axis::decades(runs.iter().map(|r| r.2), 9);
            let panel = Panel::new(title, x, y).sides([60, 20, 32, 46]);
            let chart = panel.draw(part)?;
            for &(system, along, error, python) in runs {
                let marker = match errors.timed && python {
                    true => Marker::Hollow,
                    false => Marker::Disc,
                };
                let (x, y) = chart.backend_coord(&(along, error));
                // Over the step, systems are side by side.
                let beside = match errors.timed {
                    true => 0,
                    false => 90 * system as i32 - 135,
                };
                mark(area, (x + beside, y), marker, COLOURS[system])?;
            }
        }
        Ok(())
    })
}
