//! The figures of a study.

mod bars;
mod diagram;

use crate::contender::Pace;
use crate::converge::{Verdict, verdicts};
use crate::pareto::targets;
use crate::row::{Row, Status};
use crate::study::Study;
use crate::svg::Marker;
use crate::text::{short, step, time};
use bars::{Bar, Bars};
use diagram::{Diagram, Series};

/// A figure.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// The file's name: `arm_methods.svg`.
    pub name: String,
    /// What it shows, in a sentence.
    pub caption: String,
    /// SVG.
    pub svg: String,
}

/// How a method is drawn: colour and marker. Okabe and Ito's palette, which colour-blind readers tell
/// apart; circles are explicit methods, squares implicit ones, triangles methods on momenta.
fn look(method: &str) -> (&'static str, Marker) {
    let plain = method.strip_prefix("canonical_");
    let (colour, marker) = match plain.unwrap_or(method) {
        "semi_implicit_euler" => ("#999999", Marker::Circle),
        "rk4" => ("#0072b2", Marker::Circle),
        "midpoint" => ("#56b4e9", Marker::Square),
        "gauss2" => ("#e69f00", Marker::Square),
        "gauss3" => ("#d55e00", Marker::Square),
        "gauss4" => ("#7f3b08", Marker::Square),
        "rodas4" => ("#009e73", Marker::Square),
        "dopri5" => ("#cc79a7", Marker::Circle),
        _ => ("#000000", Marker::Circle),
    };
    match plain {
        Some(_) => (colour, Marker::Triangle),
        None => (colour, marker),
    }
}

/// The figures of a study: methods, scalars and momenta, formulations, effects left out, effects
/// added one after the other. Those that would have nothing to compare are left away.
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

/// "~" before a time that is an estimate.
fn about(study: &Study) -> &'static str {
    if study.is_measured() { "" } else { "~" }
}

/// "gauss2 at 2 ms", "dopri5 with the tolerance 1e-6".
pub(crate) fn way(row: &Row) -> String {
    let scalar = match row.scalar.as_str() {
        "f64" => "",
        scalar => &format!(" in {scalar}"),
    };
    match row.pace {
        Pace::Step(h) => format!("{}{scalar} at {}", row.method, step(h)),
        Pace::Tolerance(t) => format!("{}{scalar} with the tolerance {t:e}", row.method),
    }
}

/// What an error of a good run costs: for a title.
fn message(study: &Study) -> String {
    let facts = &study.facts;
    let choices = targets(study);
    let wanted = choices
        .iter()
        .find(|c| c.target <= 1.01e-6)
        .or_else(|| choices.last());
    match wanted {
        Some(choice) => format!(
            "{}: {:.0e} {} at `{}` costs {}{} per simulated ms, by {}",
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

/// A curve of the rows for which this holds.
fn series<'a>(
    study: &'a Study,
    verdict: &Verdict,
    label: String,
    (colour, marker): (&'static str, Marker),
    dashes: &'static str,
) -> Series<'a> {
    let of = |r: &&Row| {
        r.effects == "all"
            && r.method == verdict.method
            && r.scalar == verdict.scalar
            && r.formulation == verdict.formulation
    };
    // The first row of a pace: the level `all` repeats the scene's own.
    let mut rows: Vec<&Row> = Vec::new();
    for row in study.rows.iter().filter(of) {
        if !rows.iter().any(|r| r.pace == row.pace) {
            rows.push(row);
        }
    }
    // The scene's own pace comes last in the study.
    rows.sort_by(|a, b| b.pace.value().total_cmp(&a.pace.value()));
    Series {
        label,
        note: verdict.words(),
        alarming: verdict.is_failure(),
        colour,
        marker,
        dashes,
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
        y: format!("largest error of `{}`, {}", facts.output, facts.unit),
        size: facts.size,
        floor: facts.floor,
        series,
    }
    .draw()
}

/// Error against time, one curve per method.
fn methods(study: &Study) -> Option<Figure> {
    let found = verdicts(study);
    let shown = found
        .iter()
        .filter(|v| v.scalar == "f64" && v.formulation == "cheapest");
    let all = shown.map(|v| series(study, v, v.method.clone(), look(&v.method), ""));
    Some(Figure {
        name: format!("{}_methods.svg", study.facts.scene),
        caption: "Error against time by method: down and to the left is better. Crosses on top are runs that fail or leave the motion.".into(),
        svg: diagram(study, message(study), all.collect()),
    })
}

/// The same in `f32`, and on momenta.
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
            let dashes = if v.scalar == "f32" { "5 3" } else { "" };
            let dashes = if v.formulation == "canonical" {
                "2 3"
            } else {
                dashes
            };
            series(study, v, label, look(&v.method), dashes)
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

/// What each formulation takes at the same step, and the least error that it reaches.
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
    let shared = |r: &&&Row| names.iter().all(|n| by(n).iter().any(|o| o.pace == r.pace));
    let pace = base.iter().rev().find(shared)?.pace;
    let bar = |name: &&str| {
        let rows = by(name);
        let at = rows.iter().find(|r| r.pace == pace);
        let errors = rows.iter().filter_map(|r| r.error);
        Bar {
            label: (*name).to_owned(),
            left: at.and_then(|r| r.ns),
            right: errors.reduce(f64::min),
            failed: None,
        }
    };
    let facts = &study.facts;
    let bars: Vec<Bar> = names.iter().map(bar).collect();
    let costs = bars.iter().filter_map(|b| b.left);
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
            left: format!(
                "{}time by rk4 at {}, ns per simulated ms",
                about(study),
                step(pace.value())
            ),
            right: format!(
                "least error of `{}`, {} (log scale)",
                facts.output, facts.unit
            ),
            bars,
            noise: 0.0,
        }
        .draw(),
    })
}

/// The rows of levels: the scene with all effects by its own way, then those that `name` takes.
fn levels<'a>(
    study: &'a Study,
    name: impl Fn(&'a str) -> Option<&'a str>,
) -> Option<(&'a Row, Vec<(&'a str, &'a Row)>)> {
    let named = study
        .rows
        .iter()
        .filter_map(|r| Some((name(&r.effects)?, r)));
    let named: Vec<(&str, &Row)> = named.collect();
    let pace = named.first()?.1.pace;
    let method = &named.first()?.1.method;
    let own = |r: &&Row| r.effects == "all" && r.pace == pace && r.method == *method;
    let own = |r: &&Row| own(r) && r.scalar == "f64" && r.formulation == "cheapest";
    // The level comes after the method's own ladder, and is timed beside the other levels.
    Some((study.rows.iter().rfind(own)?, named))
}

fn why(row: &Row) -> Option<String> {
    match &row.status {
        Status::Failed(why) => Some(why.clone()),
        _ => None,
    }
}

/// By how much of its time a scene may seem faster or slower for no more than where its code comes to
/// lie: effects that cost nothing were seen to make that difference.
const NOISE: f64 = 0.05;

/// What each effect costs, and what it changes.
fn left_out(study: &Study) -> Option<Figure> {
    let (own, named) = levels(study, |e| e.strip_prefix("all but "))?;
    let bar = |(effect, row): &(&str, &Row)| Bar {
        label: (*effect).to_owned(),
        left: row.ns.zip(own.ns).map(|(without, with)| with - without),
        right: row.error,
        failed: why(row),
    };
    let facts = &study.facts;
    let bars: Vec<Bar> = named.iter().map(bar).collect();
    let most = bars
        .iter()
        .filter(|b| b.right.is_some())
        .max_by(|a, b| a.right.partial_cmp(&b.right).expect("numbers"));
    let what = most.map_or(String::new(), |b| {
        format!(
            ": `{}` changes the motion most, by {} {}",
            b.label,
            short(b.right.unwrap_or(0.0)),
            facts.unit
        )
    });
    Some(Figure {
        name: format!("{}_effects.svg", facts.scene),
        caption: format!(
            "What each effect costs and changes: time of the scene with all effects ({}{} per simulated ms, {}) less that of the scene without this one, and how far `{}` moves away from its course without it. Differences below {:.0} % of the scene's time, in grey, are no more than where the code comes to lie.",
            about(study),
            time(own.ns.unwrap_or(0.0)),
            way(own),
            facts.output,
            100.0 * NOISE,
        ),
        svg: Bars {
            title: format!("{}{what}", facts.scene),
            left: format!("{}cost of the effect, ns per simulated ms", about(study)),
            right: format!(
                "change of `{}` without it, {} (log scale)",
                facts.output, facts.unit
            ),
            bars,
            noise: NOISE * own.ns.unwrap_or(0.0),
        }
        .draw(),
    })
}

/// Effects added one after the other.
fn added(study: &Study) -> Option<Figure> {
    let (own, named) = levels(study, |e| {
        (!e.starts_with("all")).then(|| e.rsplit('+').next().unwrap_or(e))
    })?;
    let bar = |(i, (effect, row)): (usize, &(&str, &Row))| Bar {
        label: if i == 0 {
            (*effect).to_owned()
        } else {
            format!("+ {effect}")
        },
        left: row.ns,
        right: row.error,
        failed: why(row),
    };
    let mut bars: Vec<Bar> = named.iter().enumerate().map(bar).collect();
    bars.push(Bar {
        label: "all".into(),
        left: own.ns,
        right: own.error,
        failed: why(own),
    });
    let facts = &study.facts;
    let first = bars.iter().find_map(|b| b.left);
    let title = match (first, own.ns) {
        (Some(first), Some(last)) => format!(
            "{}: all effects take {:.1} times as long as the first stage that runs",
            facts.scene,
            last / first
        ),
        _ => format!("{}: effects added one after the other", facts.scene),
    };
    Some(Figure {
        name: format!("{}_stages.svg", facts.scene),
        caption: format!(
            "Effects added one after the other, by {}: what each stage takes, and how far `{}` is from its course in the scene with all effects. In the last line that is the error of the method alone.",
            way(own),
            facts.output
        ),
        svg: Bars {
            title,
            left: format!("{}time, ns per simulated ms", about(study)),
            right: format!("distance from the full scene, {} (log scale)", facts.unit),
            bars,
            noise: 0.0,
        }
        .draw(),
    })
}
