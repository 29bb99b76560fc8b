//! The plot: position, error and effort of each joint over time; below, the path of the tool.

mod panel;

use std::path::{Path, PathBuf};

use bgdyn_accuracy::plot::{Area, Drawn, INK, RGBColor, Sign, legend, px, text, write};

use super::cycle::Gripper;
use super::report::tool_error;
use super::simulate::{PERIOD, Sample};
use super::{Cell, Joints};
use panel::{BASELINE, COMPUTED, LIMIT, Line, Panel, WANTED};

const CARRIED: RGBColor = RGBColor(255, 243, 205);

const WIDTH: u32 = 1500;
const HEADER: u32 = 100;
const ROW: u32 = 185;
const TOOL_ROW: u32 = 400;

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
    let size = (WIDTH, HEADER + rows::<N>() + TOOL_ROW);
    let svg = bgdyn_accuracy::plot::draw(size, |area| draw_all(cell, &runs, area));
    std::fs::write(&path, svg).map_err(|e| format!("{} cannot be written: {e}", path.display()))?;
    Ok(path)
}

/// Height of the joints' rows.
const fn rows<const N: usize>() -> u32 {
    ROW * N as u32 + 20
}

fn draw_all<G, C, E, L, const N: usize>(
    cell: &Cell<G, C, E, L, N>,
    runs: &Runs<'_, N>,
    area: &Area<'_>,
) -> Drawn {
    write(area, (30.0, 32.0), cell.title, text(22, INK))?;
    let entries = [
        (Sign::Line(WANTED), "wanted"),
        (
            Sign::Line(COMPUTED),
            "computed torque with the generated model",
        ),
        (Sign::Line(BASELINE), "PD + gravity, same gains"),
        (Sign::Shade(CARRIED), "part of 2 kg carried"),
        (Sign::Line(LIMIT), "limit of the drive"),
    ];
    legend(area, (30.0, 74.0), &entries)?;
    let (_, rest) = area.split_vertically(px(HEADER));
    let (joints, tool) = rest.split_vertically(px(rows::<N>()));
    for (i, row) in joints.split_evenly((N, 1)).iter().enumerate() {
        draw_joint(cell, runs, i, row)?;
    }
    let tool = tool.split_evenly((1, 3));
    draw_plan(cell, runs, &tool[0])?;
    draw_tool(cell, runs, &tool[1], &tool[2])
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
    let seen = |q: &Joints<N>| (tool(q).y, tool(q).x);
    let mark = |gripper, name: &'static str| {
        let call = (cell.cycle.time_of(gripper).unwrap_or(0.0) / PERIOD).round() as usize;
        (seen(&runs.computed[call].wanted.q), name)
    };
    let way = |samples: &[Sample<N>], place: &dyn Fn(&Sample<N>) -> (f64, f64)| {
        samples.iter().step_by(4).map(place).collect::<Vec<_>>()
    };
    let lines = [
        Line::new(WANTED, way(runs.computed, &|s| seen(&s.wanted.q))),
        Line::new(BASELINE, way(runs.baseline, &|s| seen(&s.q))),
        Line::new(COMPUTED, way(runs.computed, &|s| seen(&s.q))),
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
        Line::new(BASELINE, over_time(runs.baseline, &value)),
        Line::new(COMPUTED, over_time(runs.computed, &value)),
    ]
}

/// Draws the desired quantity, and that of both runs.
fn three_lines<const N: usize>(
    runs: &Runs<'_, N>,
    wanted: impl Fn(&Sample<N>) -> f64,
    value: impl Fn(&Sample<N>) -> f64,
) -> Vec<Line> {
    let mut lines = vec![Line::new(WANTED, over_time(runs.computed, &wanted))];
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
