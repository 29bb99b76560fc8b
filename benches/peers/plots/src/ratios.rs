//! How many times as long as bgdyn each peer takes, by robot and function.

use bgdyn_accuracy::plot::plotters::style::text_anchor::HPos;
use bgdyn_accuracy::plot::{
    Axis, GRID, INK, Marker, Panel, Sign, Stroke, bold, curve, draw as drawing, legend, mark, text,
    write,
};
use serde::Deserialize;

use super::COLOURS;

/// The numbers of the plot.
#[derive(Deserialize)]
pub struct Ratios {
    /// The peers, in the order of their colours.
    peers: Vec<String>,
    robots: Vec<Robot>,
}

#[derive(Deserialize)]
struct Robot {
    name: String,
    functions: Vec<Function>,
}

#[derive(Deserialize)]
struct Function {
    name: String,
    /// Times of the peers over bgdyn's, in the order of the peers.
    times: Vec<Option<f64>>,
}

const WIDTH: u32 = 780;
const LEFT: u32 = 190;
const TOP: u32 = 62;
const ROW: u32 = 15;
const BELOW: u32 = 46;

/// Returns the plot, as SVG.
pub fn draw(ratios: &Ratios) -> String {
    // Between two robots, half a row is free above and below.
    let rows: usize = ratios.robots.iter().map(|r| r.functions.len() + 1).sum();
    let all = ratios.robots.iter().flat_map(|r| &r.functions);
    let all = || all.clone().flat_map(|f| f.times.iter().flatten().copied());
    let (least, most) = (all().fold(1.0, f64::min), all().fold(1.0, f64::max));
    let size = (WIDTH, TOP + ROW * rows as u32 + BELOW);
    drawing(size, |area| {
        let title = "Times as long as bgdyn, one state a call, f64";
        write(area, (10.0, 18.0), title, &text(14, INK, HPos::Left))?;
        let signs = ratios.peers.iter().zip(COLOURS);
        let signs = signs.map(|(peer, c)| (Sign::Points(Marker::Disc, c), peer.as_str()));
        legend(area, (f64::from(LEFT), 42.0), &signs.collect::<Vec<_>>())?;
        let least = if least < 1.0 { 0.95 * least } else { 1.0 };
        let x = Axis::log(least, 1.05 * most, 12).label("time over that of bgdyn");
        let panel = Panel::new("", x, Axis::rows(rows)).sides([LEFT, 20, TOP, BELOW]);
        let chart = panel.draw(area)?;
        let inside = chart.plotting_area();
        let ends = chart.x_range();
        let mut row = 0.5;
        for robot in &ratios.robots {
            let height = |row: f64| f64::from(TOP) + f64::from(ROW) * (row + 0.5);
            write(
                area,
                (10.0, height(row)),
                &robot.name,
                &bold(11, INK, HPos::Left),
            )?;
            for function in &robot.functions {
                let name = (f64::from(LEFT) - 12.0, height(row));
                write(area, name, &function.name, &text(11, INK, HPos::Right))?;
                let middle = row + 0.5;
                let line = [(ends.start, middle), (ends.end, middle)];
                curve(inside, line, Stroke::new(GRID, 0.5))?;
                for (time, colour) in function.times.iter().zip(COLOURS) {
                    if let Some(time) = time {
                        mark(inside, (*time, middle), Marker::Disc, colour)?;
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
