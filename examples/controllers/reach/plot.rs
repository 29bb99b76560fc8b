//! The figure: the cost and the way of the last joint by iteration; positions and efforts of the optimum.

use std::path::{Path, PathBuf};

use bgdyn_accuracy::plot::{
    self, Area, Axis, BLUE, Drawn, INK, Marker, Panel, RGBColor, Sign, Stroke, VERMILION, curve,
    legend, mark, px, text, write,
};

use super::task::{JOINTS, Joints, NODES, Reach, STEP, place};
use super::{Panda7, Solver};

const WIDTH: u32 = 1300;
const HEADER: u32 = 60;
const ROW: u32 = 400;
/// Colours of the joints, from the base on.
const COLOURS: [RGBColor; JOINTS] = [
    BLUE,
    VERMILION,
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
    INK,
];
const GREY: RGBColor = RGBColor(150, 150, 150);

/// Draws `reach.svg` into the folder `out` and returns its path.
pub fn draw(
    arm: &Panda7<f64>,
    cost: &Reach,
    motions: &[Solver],
    costs: &[f64],
    out: &Path,
) -> Result<PathBuf, String> {
    std::fs::create_dir_all(out)
        .map_err(|e| format!("the folder {} cannot be made: {e}", out.display()))?;
    let path = out.join("reach.svg");
    let svg = plot::draw((WIDTH, HEADER + 2 * ROW), |area| {
        let title = "Panda reaches a point in 1 s: the motion of least cost, by iLQR";
        write(area, (30.0, 30.0), title, text(22, INK))?;
        let (_, rest) = area.split_vertically(px(HEADER));
        let panels = rest.split_evenly((2, 2));
        draw_costs(costs, &panels[0])?;
        draw_distances(arm, cost, motions, &panels[1])?;
        let Some(best) = motions.last() else {
            return Ok(());
        };
        let time = |(k, y): (usize, f64)| (k as f64 * STEP, y);
        let states: Vec<Joints> = best.states().chain([best.last()]).map(|s| s.q).collect();
        let positions = |j: usize| states.iter().map(move |q| q[j].to_degrees()).collect();
        draw_joints(
            "Positions of the optimum",
            ("position", "°"),
            positions,
            time,
            &panels[2],
        )?;
        let efforts: Vec<Joints> = best.efforts().copied().collect();
        let of_joint = |j: usize| efforts.iter().map(move |tau| tau[j]).collect();
        draw_joints(
            "Efforts of the optimum",
            ("effort", "N·m"),
            of_joint,
            time,
            &panels[3],
        )
    });
    std::fs::write(&path, svg).map_err(|e| format!("{} cannot be written: {e}", path.display()))?;
    Ok(path)
}

/// Draws the cost after each iteration.
fn draw_costs(costs: &[f64], area: &Area<'_>) -> Drawn {
    let x = Axis::linear(0.0, (costs.len() - 1) as f64, 9).label("iteration");
    let y = Axis::decades(costs.iter().copied(), 6).label("cost");
    let panel = Panel::new("Cost after each iteration", x, y);
    let chart = panel.draw(area)?;
    let points: Vec<(f64, f64)> = costs
        .iter()
        .enumerate()
        .map(|(k, &c)| (k as f64, c))
        .collect();
    curve(
        chart.plotting_area(),
        points.iter().copied(),
        Stroke::new(BLUE, 2.0),
    )?;
    for point in points {
        mark(chart.plotting_area(), point, Marker::Disc, BLUE)?;
    }
    Ok(())
}

/// Draws the distance from the target over time, for the first iterations and the optimum.
fn draw_distances(arm: &Panda7<f64>, cost: &Reach, motions: &[Solver], area: &Area<'_>) -> Drawn {
    let distances = |motion: &Solver| -> Vec<(f64, f64)> {
        let states = motion.states().chain([motion.last()]);
        let distance = |(k, s): (usize, &super::task::ArmState)| {
            (k as f64 * STEP, (place(arm, &s.q) - cost.target).norm())
        };
        states.enumerate().map(distance).collect()
    };
    let lines: Vec<_> = motions.iter().map(distances).collect();
    let all = || lines.iter().flatten().map(|p| p.1).chain([0.0]);
    let x = Axis::linear(0.0, NODES as f64 * STEP, 6).label("time / s");
    let y = under_legend(all, 7).label("distance / m");
    let chart = Panel::new("Distance of the last joint from the target", x, y).draw(area)?;
    let last = lines.len().saturating_sub(1);
    for (k, line) in lines.into_iter().enumerate() {
        let stroke = match k {
            0 => Stroke::new(VERMILION, 2.0),
            k if k == last => Stroke::new(BLUE, 3.0),
            _ => Stroke::new(GREY, 1.2),
        };
        curve(chart.plotting_area(), line, stroke)?;
    }
    let entries = [
        (Sign::Line(Stroke::new(VERMILION, 2.0)), "start"),
        (Sign::Line(Stroke::new(GREY, 1.2)), "iterations"),
        (Sign::Line(Stroke::new(BLUE, 3.0)), "optimum"),
    ];
    legend(area, (280.0, 48.0), &entries)
}

/// Draws a quantity of all joints over time.
fn draw_joints(
    title: &str,
    (name, unit): (&str, &str),
    values: impl Fn(usize) -> Vec<f64>,
    time: impl Fn((usize, f64)) -> (f64, f64),
    area: &Area<'_>,
) -> Drawn {
    let lines: [Vec<f64>; JOINTS] = std::array::from_fn(values);
    let x = Axis::linear(0.0, NODES as f64 * STEP, 6).label("time / s");
    let y = under_legend(|| lines.iter().flatten().copied(), 7).label(format!("{name} / {unit}"));
    let chart = Panel::new(title, x, y).draw(area)?;
    for (line, colour) in lines.iter().zip(COLOURS) {
        let points = line.iter().copied().enumerate().map(&time);
        curve(chart.plotting_area(), points, Stroke::new(colour, 2.0))?;
    }
    let names: [String; JOINTS] = std::array::from_fn(|j| format!("q{}", j + 1));
    let entries: Vec<(Sign, &str)> = names
        .iter()
        .zip(COLOURS)
        .map(|(name, colour)| (Sign::Line(Stroke::new(colour, 2.0)), name.as_str()))
        .collect();
    legend(area, (90.0, 48.0), &entries)
}

/// Returns an axis over values with room for a legend above them.
fn under_legend<V: Iterator<Item = f64>>(values: impl Fn() -> V, most: usize) -> Axis {
    let (low, high) = (
        values().fold(f64::INFINITY, f64::min),
        values().fold(f64::NEG_INFINITY, f64::max),
    );
    Axis::around([low, high + 0.1 * (high - low)], most)
}
