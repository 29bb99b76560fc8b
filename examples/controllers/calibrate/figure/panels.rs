//! The panels.

use bgdyn_accuracy::plot::{
    Area, Axis, BLUE, Drawn, FAINT, GREEN, INK, Marker, ORANGE, PURPLE, Panel, RGBColor, SKY, Sign,
    Stroke, VERMILION, curve, legend, mark, name_ends,
};

use crate::acts::{Carried, Tracking, miss};
use crate::plant::{PART_MASS, Sample};
use crate::results::{Results, SETTLED};
use crate::{JOINTS, Joints};

/// Colours of the joints, from the base on.
const COLOURS: [RGBColor; JOINTS] = [BLUE, VERMILION, GREEN, PURPLE, ORANGE, SKY, INK];
/// With the model of the spec, or without adaptation.
const BEFORE: Stroke = Stroke::new(VERMILION, 2.0);
/// With the calibrated model, or with adaptation.
const AFTER: Stroke = Stroke::new(BLUE, 2.0);
/// What is measured: broad and pale, so that lines on it remain visible.
const MEASURED: Stroke = Stroke::new(RGBColor(190, 190, 190), 6.0);
/// What is true, and bounds.
const TRUE: Stroke = Stroke::new(INK, 1.2).dashed(7.0, 5.0);
/// The time in which the part is held.
const HELD: RGBColor = RGBColor(255, 243, 205);
/// Where legends begin, px.
const LEGEND: (f64, f64) = (92.0, 46.0);
/// The joint whose efforts are drawn.
const JOINT: usize = 1;
/// Points of a curve at most.
const POINTS: usize = 700;

/// Points of a curve over time.
type Points = Vec<(f64, f64)>;

/// The planned motion.
pub fn motion(results: &Results, area: &Area<'_>) -> Drawn {
    let motion = &results.calibration.motion.motion;
    let period = motion.period();
    let times = (0..=400).map(|k| f64::from(k) / 400.0 * period);
    let states: Vec<(f64, Vec<f64>)> = times.map(|t| (t, motion.at(t).q)).collect();
    let degrees = {
        states
            .iter()
            .flat_map(|(_, q)| q.iter().map(|q| q.to_degrees()))
    };
    let x = Axis::linear(0.0, period, 6).label("time / s");
    let y = Axis::around(degrees, 7).label("position / °");
    let panel = Panel::new("The planned motion of the seven joints", x, y);
    let chart = panel.sides([78, 40, 32, 46]).draw(area)?;
    for (j, colour) in COLOURS.into_iter().enumerate() {
        let points = states.iter().map(|(t, q)| (*t, q[j].to_degrees()));
        curve(chart.plotting_area(), points, Stroke::new(colour, 1.8))?;
    }
    let ends = states.last().map(|(t, q)| {
        let end = |j: usize| ((*t, q[j].to_degrees()), format!("q{}", j + 1), COLOURS[j]);
        (0..JOINTS).map(end).collect::<Vec<_>>()
    });
    name_ends(area, &chart, ends.unwrap_or_default())
}

/// Efforts of another motion: measured, and predicted by both models.
pub fn efforts(results: &Results, area: &Area<'_>) -> Drawn {
    let judged = &results.calibration.found.judgement;
    let series = |values: &[f64]| -> Points {
        let own = values.iter().skip(JOINT).step_by(JOINTS);
        thinned(judged.samples.time.iter().copied().zip(own.copied()))
    };
    let [spec, _, found] = judged.predicted.each_ref().map(|p| series(p));
    let measured = series(&judged.samples.tau);
    let values = || {
        [&spec, &found, &measured]
            .into_iter()
            .flatten()
            .map(|p| p.1)
    };
    let x = Axis::linear(0.0, 10.0, 6).label("time / s");
    let y = above(values, 0.12).label("effort / N·m");
    let title = format!("Efforts of joint {} in another motion", JOINT + 1);
    let chart = Panel::new(&title, x, y).draw(area)?;
    for (points, stroke) in [(measured, MEASURED), (spec, BEFORE), (found, AFTER)] {
        curve(chart.plotting_area(), points, stroke)?;
    }
    let entries = [
        (Sign::Line(MEASURED), "measured"),
        (Sign::Line(BEFORE), "by the spec"),
        (Sign::Line(AFTER), "calibrated"),
    ];
    legend(area, LEGEND, &entries)
}

/// What both models leave of the efforts of that motion.
pub fn residuals(results: &Results, area: &Area<'_>) -> Drawn {
    let left = &results.calibration.found.judgement.left;
    let of = |k: usize| Joints::from_fn(|j, _| left[k][j].rms);
    by_joint(
        "Efforts not explained in that motion, rms",
        "rest / N·m",
        [of(0), of(2)],
        ["by the spec", "calibrated"],
        area,
    )
}

/// Errors of the base parameters in their deviations.
pub fn deviations(results: &Results, area: &Area<'_>) -> Drawn {
    let errors = &results.deviations;
    let count = errors.len();
    let most = errors.iter().fold(3.0_f64, |m, e| m.max(e.abs())) + 0.4;
    let x = Axis::linear(0.0, (count + 1) as f64, 8).label("base parameter, by its number");
    let y = Axis::linear(-most, most + 0.9, 9).label("(found − true) / deviation");
    let title = format!("Errors of the {count} base parameters, in their deviations");
    let chart = Panel::new(&title, x, y).draw(area)?;
    for level in [-2.0, 2.0] {
        let ends = [(0.0, level), ((count + 1) as f64, level)];
        curve(chart.plotting_area(), ends, TRUE)?;
    }
    for (k, error) in errors.iter().enumerate() {
        mark(
            chart.plotting_area(),
            ((k + 1) as f64, *error),
            Marker::Disc,
            BLUE,
        )?;
    }
    let entries = [
        (Sign::Points(Marker::Disc, BLUE), "base parameters"),
        (Sign::Line(TRUE), "two deviations"),
    ];
    legend(area, LEGEND, &entries)
}

/// The distance of the tool from its path with both models.
pub fn path_errors(results: &Results, area: &Area<'_>) -> Drawn {
    let lines = results.cycles.each_ref().map(|samples| distances(samples));
    let names = ["model of the spec", "calibrated"];
    over_cycle(
        results,
        "Distance of the tool from its path",
        lines,
        names,
        None,
        area,
    )
}

/// Errors of the joints with both models.
pub fn joint_errors(results: &Results, area: &Area<'_>) -> Drawn {
    by_joint(
        "Errors of the positions in the whole cycle, rms",
        "error / mrad",
        mrad(&results.tracking),
        ["model of the spec", "calibrated"],
        area,
    )
}

/// The mass that the adaptive law knows.
pub fn mass(results: &Results, area: &Area<'_>) -> Drawn {
    let held = results.cycle.carried();
    let Carried { samples, loads } = &results.carried[1];
    let points = thinned(samples.iter().map(|s| s.t).zip(loads.iter().map(|l| l[0])));
    let values = || points.iter().map(|p| p.1).chain([0.0, PART_MASS]);
    let x = Axis::linear(0.0, results.cycle.seconds(), 9).label("time / s");
    let y = above(values, 0.14).label("mass / kg");
    let panel = Panel::new("Mass of the load, as the adaptive law knows it", x, y);
    let chart = panel.shaded(held, HELD).draw(area)?;
    let truth = [
        (0.0, 0.0),
        (held.0, 0.0),
        (held.0, PART_MASS),
        (held.1, PART_MASS),
        (held.1, 0.0),
        (results.cycle.seconds(), 0.0),
    ];
    curve(chart.plotting_area(), points, AFTER)?;
    curve(chart.plotting_area(), truth, TRUE)?;
    let entries = [
        (Sign::Shade(HELD), "2 kg held"),
        (Sign::Line(TRUE), "true"),
        (Sign::Line(AFTER), "found"),
    ];
    legend(area, LEGEND, &entries)
}

/// The distance of the tool from its path with the load.
pub fn load_errors(results: &Results, area: &Area<'_>) -> Drawn {
    let lines = results
        .carried
        .each_ref()
        .map(|run| distances(&run.samples));
    over_cycle(
        results,
        "Distance of the tool from its path, with the load",
        lines,
        ["without adaptation", "with adaptation"],
        Some(results.cycle.carried()),
        area,
    )
}

/// Errors of the joints with the load.
pub fn load_joint_errors(results: &Results, area: &Area<'_>) -> Drawn {
    let (taken, released) = results.cycle.carried();
    let from = taken + SETTLED;
    by_joint(
        &format!("Errors of the positions from {from:.1} s to {released:.1} s, rms"),
        "error / mrad",
        mrad(&results.settled),
        ["without adaptation", "with adaptation"],
        area,
    )
}

fn mrad(tracking: &[Tracking; 2]) -> [Joints; 2] {
    tracking.map(|t| t.rms * 1e3)
}

/// Returns the distances of the tool from its path, mm, over time.
fn distances(samples: &[Sample]) -> Points {
    thinned(samples.iter().map(|s| (s.t, miss(s).norm() * 1e3)))
}

/// Draws two quantities over the cycle, in mm, on a logarithmic axis.
fn over_cycle(
    results: &Results,
    title: &str,
    lines: [Points; 2],
    names: [&str; 2],
    held: Option<(f64, f64)>,
    area: &Area<'_>,
) -> Drawn {
    let x = Axis::linear(0.0, results.cycle.seconds(), 9).label("time / s");
    let y = Axis::log(1e-3, 1e2, 7).label("distance / mm");
    let mut panel = Panel::new(title, x, y);
    if let Some(held) = held {
        panel = panel.shaded(held, HELD);
    }
    let chart = panel.draw(area)?;
    for (points, stroke) in lines.into_iter().zip([BEFORE, AFTER]) {
        curve(chart.plotting_area(), points, stroke)?;
    }
    before_and_after(names, area)
}

/// Draws two numbers of each joint on a logarithmic axis.
fn by_joint(
    title: &str,
    label: &str,
    values: [Joints; 2],
    names: [&str; 2],
    area: &Area<'_>,
) -> Drawn {
    let all = || values.iter().flat_map(|v| v.iter().copied());
    let (low, high) = ends(all());
    let x = Axis::linear(0.5, JOINTS as f64 + 0.5, 8).label("joint");
    // Room for the legend above the largest.
    let y = Axis::log(0.6 * low, 6.0 * high, 7).label(label);
    let chart = Panel::new(title, x, y).draw(area)?;
    for j in 0..JOINTS {
        let place = (j + 1) as f64;
        let [before, after] = values.map(|v| v[j]);
        let ends = [(place, before), (place, after)];
        curve(chart.plotting_area(), ends, Stroke::new(FAINT, 1.0))?;
        mark(chart.plotting_area(), ends[0], Marker::Disc, VERMILION)?;
        mark(chart.plotting_area(), ends[1], Marker::Disc, BLUE)?;
    }
    let signs = [VERMILION, BLUE].map(|colour| Sign::Points(Marker::Disc, colour));
    legend(area, LEGEND, &[(signs[0], names[0]), (signs[1], names[1])])
}

fn before_and_after([before, after]: [&str; 2], area: &Area<'_>) -> Drawn {
    legend(
        area,
        LEGEND,
        &[(Sign::Line(BEFORE), before), (Sign::Line(AFTER), after)],
    )
}

/// Returns an axis over values with room above them, a share of their range.
fn above<V: Iterator<Item = f64>>(values: impl Fn() -> V, room: f64) -> Axis {
    let (low, high) = ends(values());
    Axis::around([low, high + room * (high - low)], 7)
}

fn ends(values: impl Iterator<Item = f64>) -> (f64, f64) {
    values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| {
        (low.min(x), high.max(x))
    })
}

/// Returns so many points that a panel shows them all.
fn thinned(points: impl Iterator<Item = (f64, f64)>) -> Points {
    let points: Points = points.collect();
    let step = points.len().div_ceil(POINTS).max(1);
    points.into_iter().step_by(step).collect()
}
