//! The plot: position, error and effort of each joint over time; below, the path of the tool.

mod panel;

use std::path::{Path, PathBuf};

use bgdyn_accuracy::dark::with_dark_mode;
use bgdyn_accuracy::fine::{FINE, shown_at};
use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::cycle::Gripper;
use super::report::tool_error;
use super::simulate::{PERIOD, Sample};
use super::{Cell, Joints};
use panel::{Line, Panel};

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;

// The palette of Okabe and Ito, which is distinguishable for colour-blind readers.
const BLUE: RGBColor = RGBColor(0, 114, 178);
const VERMILION: RGBColor = RGBColor(213, 94, 0);
const GREY: RGBColor = RGBColor(190, 190, 190);
const CARRIED: RGBColor = RGBColor(255, 243, 205);
const INK: RGBColor = RGBColor(40, 40, 40);

const WIDTH: u32 = 1500;
const HEADER: u32 = 110;
const ROW: u32 = 185;
const TOOL_ROW: u32 = 400;
const FONT: &str = "sans-serif";

/// Converts whole pixels to the drawing's units.
const fn px(pixels: u32) -> u32 {
    FINE * pixels
}

/// Converts a position in whole pixels to the drawing's units.
const fn at(x: i32, y: i32) -> (i32, i32) {
    (FINE as i32 * x, FINE as i32 * y)
}

/// The samples of both laws.
struct Runs<'a, const N: usize> {
    computed: &'a [Sample<N>],
    baseline: &'a [Sample<N>],
}

/// Draws `NAME.svg` into the folder `out` and returns its path.
pub fn draw<G, C, E, L, const N: usize>(
    cell: &Cell<G, C, E, L, N>,
    computed: &[Sample<N>],
    baseline: &[Sample<N>],
    out: &Path,
) -> Result<PathBuf, String> {
    std::fs::create_dir_all(out)
        .map_err(|e| format!("the folder {} cannot be made: {e}", out.display()))?;
    let path = out.join(format!("{}.svg", cell.name));
    let runs = Runs { computed, baseline };
    let mut svg = String::new();
    let size = (WIDTH, HEADER + rows::<N>() + TOOL_ROW);
    draw_all(cell, &runs, &mut svg, size)
        .map_err(|e| format!("{} cannot be drawn: {e}", path.display()))?;
    std::fs::write(&path, with_dark_mode(&shown_at(&svg, size)))
        .map_err(|e| format!("{} cannot be written: {e}", path.display()))?;
    Ok(path)
}

type Drawn = Result<(), Box<dyn std::error::Error>>;

/// Height of the joints' rows.
const fn rows<const N: usize>() -> u32 {
    ROW * N as u32 + 20
}

fn draw_all<G, C, E, L, const N: usize>(
    cell: &Cell<G, C, E, L, N>,
    runs: &Runs<'_, N>,
    svg: &mut String,
    (width, height): (u32, u32),
) -> Drawn {
    let root = SVGBackend::with_string(svg, (px(width), px(height))).into_drawing_area();
    root.fill(&WHITE)?;
    let (header, rest) = root.split_vertically(px(HEADER));
    let (joints, tool) = rest.split_vertically(px(rows::<N>()));
    draw_header(cell, &header)?;
    for (i, row) in joints.split_evenly((N, 1)).iter().enumerate() {
        draw_joint(cell, runs, i, row)?;
    }
    let tool = tool.split_evenly((1, 3));
    draw_plan(cell, runs, &tool[0])?;
    draw_tool(cell, runs, &tool[1], &tool[2])?;
    root.present()?;
    Ok(())
}

/// Title and legend.
fn draw_header<G, C, E, L, const N: usize>(cell: &Cell<G, C, E, L, N>, area: &Area<'_>) -> Drawn {
    let text = |size: u32| (FONT, px(size)).into_font().color(&INK);
    area.draw_text(cell.title, &text(27), at(30, 18))?;
    let y = 76;
    let entries: [(i32, &str, RGBColor, u32); 3] = [
        (30, "wanted", GREY, 6),
        (150, "computed torque with the generated model", BLUE, 2),
        (520, "PD + gravity, same gains", VERMILION, 2),
    ];
    let middle = text(17).pos(Pos::new(HPos::Left, VPos::Center));
    for (x, name, color, width) in entries {
        let line = vec![at(x, y), at(x + 36, y)];
        area.draw(&PathElement::new(line, color.stroke_width(px(width))))?;
        area.draw_text(name, &middle, at(x + 44, y))?;
    }
    let swatch = [at(760, y - 10), at(796, y + 10)];
    area.draw(&Rectangle::new(swatch, CARRIED.filled()))?;
    area.draw_text("part of 2 kg carried", &middle, at(804, y))?;
    for x in [990, 1002, 1014] {
        let dash = vec![at(x, y), at(x + 7, y)];
        area.draw(&PathElement::new(dash, INK.stroke_width(px(1))))?;
    }
    area.draw_text("limit of the drive", &middle, at(1030, y))?;
    Ok(())
}

/// One joint: position, error, effort.
fn draw_joint<G, C, E, L, const N: usize>(
    cell: &Cell<G, C, E, L, N>,
    runs: &Runs<'_, N>,
    i: usize,
    area: &Area<'_>,
) -> Drawn {
    let joint = cell.machine.joint(i);
    let panels = area.split_evenly((1, 3));
    let last = i + 1 == N;
    let panel = |title: String, y_label: String| Panel {
        title,
        x_label: last.then_some("time / s"),
        y_label,
        x: (0.0, cell.cycle.seconds()),
        carried: Some(cell.cycle.carried()),
        limit: None,
        zero: true,
        least: 0.01,
    };

    let (scale, unit) = joint.position_unit();
    let lines = three_lines(runs, |s| s.wanted.q[i] * scale, |s| s.q[i] * scale);
    let title = format!("{}: position", joint.name);
    let position = Panel {
        zero: false,
        least: 2.0,
        ..panel(title, format!("q / {unit}"))
    };
    position.draw(&panels[0], &lines)?;

    let (scale, unit) = joint.error_unit();
    let lines = two_lines(runs, |s| s.error(i) * scale);
    let title = format!("{}: tracking error", joint.name);
    panel(title, format!("error / {unit}")).draw(&panels[1], &lines)?;

    let unit = joint.effort_unit();
    let lines = two_lines(runs, |s| s.tau[i]);
    let peak = lines.iter().map(Line::peak).fold(0.0, f64::max);
    // A distant limit would flatten the curves: it is printed, not drawn.
    let near = peak > 0.3 * joint.limits.effort;
    let place = if near { "" } else { ", off the scale" };
    let title = format!(
        "{}: effort (limit ±{} {unit}{place})",
        joint.name, joint.limits.effort
    );
    let effort = Panel {
        limit: near.then_some(joint.limits.effort),
        ..panel(title, format!("tau / {unit}"))
    };
    effort.draw(&panels[2], &lines)
}

/// Draws the path of the tool, seen from above.
fn draw_plan<G, C, E, L, const N: usize>(
    cell: &Cell<G, C, E, L, N>,
    runs: &Runs<'_, N>,
    area: &Area<'_>,
) -> Drawn {
    let tool = |q: &Joints<N>| (cell.machine.tool)(q);
    // x is forward: up in the picture; y is to the left.
    let seen = |q: &Joints<N>| (-tool(q).y, tool(q).x);
    let mark = |gripper, name: &'static str| {
        let call = (cell.cycle.time_of(gripper).unwrap_or(0.0) / PERIOD).round() as usize;
        (seen(&runs.computed[call].wanted.q), name)
    };
    let way = |samples: &[Sample<N>], place: &dyn Fn(&Sample<N>) -> (f64, f64)| {
        samples.iter().step_by(4).map(place).collect::<Vec<_>>()
    };
    let lines = [
        Line::wanted(way(runs.computed, &|s| seen(&s.wanted.q))),
        Line::baseline(way(runs.baseline, &|s| seen(&s.q))),
        Line::computed(way(runs.computed, &|s| seen(&s.q))),
    ];
    let marks = [
        ((0.0, 0.0), "base"),
        mark(Gripper::Takes, "pick"),
        mark(Gripper::Releases, "place"),
    ];
    panel::draw_plan(area, "tool from above", &lines, &marks)
}

/// Draws the tool's height and its distance from the desired position, over time.
fn draw_tool<G, C, E, L, const N: usize>(
    cell: &Cell<G, C, E, L, N>,
    runs: &Runs<'_, N>,
    left: &Area<'_>,
    right: &Area<'_>,
) -> Drawn {
    let height = |q: &Joints<N>| (cell.machine.tool)(q).z * 1e3;
    let lines = three_lines(runs, |s| height(&s.wanted.q), |s| height(&s.q));
    let panel = |title: &str, y_label: &str| Panel {
        title: title.into(),
        x_label: Some("time / s"),
        y_label: y_label.into(),
        x: (0.0, cell.cycle.seconds()),
        carried: Some(cell.cycle.carried()),
        limit: None,
        zero: false,
        least: 2.0,
    };
    panel("tool: height", "z / mm").draw(left, &lines)?;
    let lines = two_lines(runs, |s| tool_error(&cell.machine, s));
    panel("tool: distance from its target", "distance / mm").draw(right, &lines)
}

/// A quantity of both runs over time.
fn two_lines<const N: usize>(runs: &Runs<'_, N>, value: impl Fn(&Sample<N>) -> f64) -> Vec<Line> {
    vec![
        Line::baseline(over_time(runs.baseline, &value)),
        Line::computed(over_time(runs.computed, &value)),
    ]
}

/// Draws the desired quantity, and that of both runs.
fn three_lines<const N: usize>(
    runs: &Runs<'_, N>,
    wanted: impl Fn(&Sample<N>) -> f64,
    value: impl Fn(&Sample<N>) -> f64,
) -> Vec<Line> {
    let mut lines = vec![Line::wanted(over_time(runs.computed, &wanted))];
    lines.extend(two_lines(runs, value));
    lines
}

/// Returns at most some 700 points, more than a panel's pixels.
fn over_time<const N: usize>(
    samples: &[Sample<N>],
    value: &impl Fn(&Sample<N>) -> f64,
) -> Vec<(f64, f64)> {
    let step = samples.len().div_ceil(700).max(1);
    samples
        .iter()
        .step_by(step)
        .map(|s| (s.t, value(s)))
        .collect()
}
