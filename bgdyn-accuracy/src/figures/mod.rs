//! The figures of a study.

mod bars;
mod diagram;
mod effects;
mod figure;

use crate::format::{short, step, time};
use crate::order_check::{Verdict, verdicts};
use crate::pareto::targets;
use crate::plot::{BLUE, GREEN, Marker, ORANGE, PURPLE, RGBColor, SKY, Stroke, VERMILION};
use crate::row::Row;
use crate::study::Study;
use bars::{Bars, Column, Line};
use diagram::{Diagram, Series};
use effects::{added, left_out};
pub use figure::Figure;
use figure::about;
pub(crate) use figure::way;

/// Returns the colour and marker of an integrator. The palette of Okabe and Ito is distinguishable for
/// colour-blind readers; circles are explicit integrators, squares implicit ones, triangles integrators of
/// the canonical form.
fn look(method: &str) -> (RGBColor, Marker) {
    let plain = method.strip_prefix("canonical_");
    let (colour, marker) = match plain.unwrap_or(method) {
        "semi_implicit_euler" => (RGBColor(153, 153, 153), Marker::Disc),
        "rk4" => (BLUE, Marker::Disc),
        "midpoint" => (SKY, Marker::Square),
        "gauss2" => (ORANGE, Marker::Square),
        "gauss3" => (VERMILION, Marker::Square),
        "gauss4" => (RGBColor(127, 59, 8), Marker::Square),
        "rodas4" => (GREEN, Marker::Square),
        "dopri5" => (PURPLE, Marker::Disc),
        _ => (RGBColor(0, 0, 0), Marker::Disc),
    };
    match plain {
        Some(_) => (colour, Marker::Triangle),
        None => (colour, marker),
    }
}

/// Returns the figures of a study: integrators, scalars and canonical form, formulations, effects left
/// out, effects added one after the other. Figures with nothing to compare are omitted.
pub fn figures(study: &Study) -> Vec<Figure> {
    let all = [
        methods(study),
        scalars(study),
        formulations(study),
        left_out(study),
        added(study),
    ];
    all.into_iter().flatten().collect()
}

/// Returns the cost of a small error, for a title.
fn message(study: &Study) -> String {
    let facts = &study.facts;
    let choices = targets(study);
    let wanted = choices
        .iter()
        .find(|c| c.target <= 1.01e-6)
        .or_else(|| choices.last());
    match wanted {
        Some(choice) => format!(
            "{}: {:.0e} {} at {} costs {}{} per simulated ms, by {}",
            facts.scene,
            choice.target,
            facts.unit,
            facts.output,
            about(study),
            time(choice.row.ns.unwrap_or(0.0)),
            way(&choice.row)
        ),
        None => format!("{}: no method follows the motion", facts.scene),
    }
}

/// Returns a curve of the rows that satisfy a condition.
fn series<'a>(
    study: &'a Study,
    verdict: &Verdict,
    label: String,
    (stroke, marker): (Stroke, Marker),
) -> Series<'a> {
    let of = |r: &&Row| {
        r.effects == "all"
            && r.method == verdict.method
            && r.scalar == verdict.scalar
            && r.formulation == verdict.formulation
    };
    // The first row of a step control: the ablation `all` repeats the scene's own step control.
    let mut rows: Vec<&Row> = Vec::new();
    for row in study.rows.iter().filter(of) {
        if !rows.iter().any(|r| r.step_control == row.step_control) {
            rows.push(row);
        }
    }
    // The scene's own step control is the last one in the study.
    rows.sort_by(|a, b| b.step_control.value().total_cmp(&a.step_control.value()));
    Series {
        label,
        note: verdict.words(),
        alarming: verdict.is_failure(),
        stroke,
        marker,
        rows,
    }
}

fn diagram<'a>(study: &'a Study, title: String, series: Vec<Series<'a>>) -> String {
    let facts = &study.facts;
    let estimated = match study.is_measured() {
        true => "",
        false => " (estimated from operations)",
    };
    Diagram {
        title,
        x: format!("time of compiled code per simulated ms, ns{estimated}"),
        y: format!("largest error of {}, {}", facts.output, facts.unit),
        size: facts.size,
        floor: facts.floor,
        series,
    }
    .draw()
}

/// Draws error against time, one curve per integrator.
fn methods(study: &Study) -> Option<Figure> {
    let found = verdicts(study);
    let shown = found
        .iter()
        .filter(|v| v.scalar == "f64" && v.formulation == "cheapest");
    let curve = |v: &Verdict| {
        let (colour, marker) = look(&v.method);
        series(study, v, v.method.clone(), (colour.into(), marker))
    };
    let all = shown.map(curve);
    Some(Figure {
        name: format!("{}_methods.svg", study.facts.scene),
        caption: "Error against time by method: down and to the left is better. Crosses on top are runs that fail or leave the motion.".into(),
        svg: diagram(study, message(study), all.collect()),
    })
}

/// Draws the same in `f32`, and in canonical form.
fn scalars(study: &Study) -> Option<Figure> {
    let found = verdicts(study);
    let has = |v: &Verdict, f: &dyn Fn(&Verdict) -> bool| {
        found.iter().any(|w| {
            w.method
                .ends_with(v.method.trim_start_matches("canonical_"))
                && f(w)
        })
    };
    let other = |v: &Verdict| v.scalar == "f32" || v.formulation == "canonical";
    let shown = found
        .iter()
        .filter(|v| other(v) || v.formulation == "cheapest" && has(v, &other));
    let all: Vec<Series<'_>> = shown
        .map(|v| {
            let label = format!("{}, {}", v.method, v.scalar);
            let (colour, marker) = look(&v.method);
            let solid = Stroke::from(colour);
            let stroke = match (v.formulation.as_str(), v.scalar.as_str()) {
                ("canonical", _) => solid.dashed(2.0, 3.0),
                (_, "f32") => solid.dashed(5.0, 3.0),
                _ => solid,
            };
            series(study, v, label, (stroke, marker))
        })
        .collect();
    let least = |scalar: &str| {
        let of = found
            .iter()
            .filter(|v| v.scalar == scalar && v.formulation == "cheapest");
        of.filter_map(|v| v.best).reduce(f64::min)
    };
    let facts = &study.facts;
    let title = match (least("f32"), least("f64")) {
        (Some(single), Some(double)) => format!(
            "{}: f32 ends at {} {}, f64 at {} {}",
            facts.scene,
            short(single),
            facts.unit,
            short(double),
            facts.unit
        ),
        _ => format!("{}: scalars, velocities and momenta", facts.scene),
    };
    (all.len() > 1).then(|| Figure {
        name: format!("{}_scalars.svg", facts.scene),
        caption: "f32 (dashed) against f64, and momenta (dotted, triangles) against velocities."
            .into(),
        svg: diagram(study, title, all),
    })
}

/// Draws the time of each formulation at the same step, and the least error that it reaches.
fn formulations(study: &Study) -> Option<Figure> {
    let by = |name: &str| {
        let of = study.rows.iter().filter(|r| {
            r.effects == "all" && r.method == "rk4" && r.scalar == "f64" && r.formulation == name
        });
        of.filter(|r| r.holds()).collect::<Vec<&Row>>()
    };
    let found = verdicts(study);
    let of_rk4 = found
        .iter()
        .filter(|v| v.method == "rk4" && v.scalar == "f64");
    let names: Vec<&str> = of_rk4.map(|v| v.formulation.as_str()).collect();
    let base = by("cheapest");
    let shared = |r: &&&Row| {
        names
            .iter()
            .all(|n| by(n).iter().any(|o| o.step_control == r.step_control))
    };
    let step_control = base.iter().rev().find(shared)?.step_control;
    let line = |name: &&str| {
        let rows = by(name);
        let at = rows.iter().find(|r| r.step_control == step_control);
        let errors = rows.iter().filter_map(|r| r.error);
        Line {
            label: (*name).to_owned(),
            values: Line::numbers([at.and_then(|r| r.ns), errors.reduce(f64::min)]),
            failed: None,
        }
    };
    let facts = &study.facts;
    let lines: Vec<Line> = names.iter().map(line).collect();
    let costs = lines.iter().filter_map(|line| line.value(0));
    let (low, high) = costs.fold((f64::INFINITY, 0.0_f64), |(l, h), x| (l.min(x), h.max(x)));
    let title = format!(
        "{}: formulations differ by {:.1} times in time",
        facts.scene,
        high / low
    );
    (names.len() > 1).then(|| Figure {
        name: format!("{}_formulations.svg", facts.scene),
        caption: "The same equations written in different ways, by rk4 at the same step.".into(),
        svg: Bars {
            title,
            columns: vec![
                Column::bars(
                    format!(
                        "{}time by rk4 at {}",
                        about(study),
                        step(step_control.value())
                    ),
                    "ns per simulated ms".into(),
                ),
                Column::dots(format!("least error of {}", facts.output), &facts.unit),
            ],
            lines,
            compared: false,
        }
        .draw(),
    })
}
