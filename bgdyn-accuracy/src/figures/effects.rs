//! Draws what effects cost and change: left out one at a time, and added one after the other.

use super::bars::{Bars, Column, Line, Number};
use super::figure::{Figure, about, way};
use crate::cost::{Cost, METHOD, TOLERANCE};
use crate::format::short;
use crate::row::{Row, Status};
use crate::study::Study;

/// Prefix of a family of effects that is left out, in the names of ablations.
const ALL_BUT: &str = "all but ";

/// Returns the rows of ablations: the scene with all effects and its own settings, then those selected by
/// `name`.
fn ablations<'a>(
    study: &'a Study,
    name: impl Fn(&'a str) -> Option<&'a str>,
) -> Option<(&'a Row, Vec<(&'a str, &'a Row)>)> {
    let named = study
        .rows
        .iter()
        .filter_map(|r| Some((name(&r.effects)?, r)));
    let named: Vec<(&str, &Row)> = named.collect();
    let step_control = named.first()?.1.step_control;
    let method = &named.first()?.1.method;
    let own =
        |r: &&Row| r.effects == "all" && r.step_control == step_control && r.method == *method;
    let own = |r: &&Row| own(r) && r.scalar == "f64" && r.formulation == "cheapest";
    // The ablation comes after the integrator's own sequence of steps, and is timed with the other
    // ablations.
    Some((study.rows.iter().rfind(own)?, named))
}

fn why(row: &Row) -> Option<String> {
    match &row.status {
        Status::Failed(why) => Some(why.clone()),
        _ => None,
    }
}

/// Draws the cost of each effect, and its influence: the scene with all effects, and without each.
pub(super) fn left_out(study: &Study) -> Option<Figure> {
    let (_, named) = ablations(study, |e| e.strip_prefix(ALL_BUT))?;
    let of = |effects: &str| study.costs.iter().find(|c| c.effects == effects);
    let whole = of("all")?;
    let values = |cost: Option<&Cost>, error: Option<f64>| {
        vec![
            cost.map(|c| Number::exact(c.operations as f64)),
            cost.map(|c| Number {
                value: c.ns.median,
                range: (c.ns.least < c.ns.quartiles[1]).then_some([c.ns.least, c.ns.quartiles[1]]),
            }),
            cost.and_then(|c| c.steps).map(|n| Number::exact(n as f64)),
            error.map(Number::exact),
        ]
    };
    let without = |(effect, row): &(&str, &Row)| Line {
        label: format!("without {effect}"),
        values: values(of(&row.effects), row.error),
        failed: why(row),
    };
    let mut lines = vec![Line {
        label: "all effects".into(),
        values: values(Some(whole), None),
        failed: None,
    }];
    lines.extend(named.iter().map(without));
    let facts = &study.facts;
    let changes = named
        .iter()
        .filter_map(|(effect, row)| Some((effect, row.error?)));
    let most = changes.max_by(|a, b| a.1.total_cmp(&b.1));
    let what = most.map_or(String::new(), |(effect, change)| {
        format!(
            ": {effect} changes the motion most, by {} {}",
            short(change),
            facts.unit
        )
    });
    let of_call = "one call of derivative";
    Some(Figure {
        name: format!("{}_effects.svg", facts.scene),
        caption: format!(
            "What each effect costs and changes: the scene with all effects, and without each in turn. Operations (additions, multiplications, divisions, roots, pairs of sine and cosine) and time of one call of `derivative`; the steps that {METHOD} takes for the run with the tolerance {TOLERANCE:e}; and how far `{}` departs from its trajectory. The dashed line is the scene with all effects. A time is the median of its rounds; the thin line goes from the shortest round to the third quartile. The sign ≈ marks a time whose range overlaps that of the scene with all effects: the two do not differ measurably. Fewer operations can take as long if the processor executes them in parallel. Without an effect a run may also take more steps: without a damper fast motions go on, and a run in which friction no longer holds a joint meets other events.",
            facts.output,
        ),
        svg: Bars {
            title: format!("{}{what}", facts.scene),
            columns: vec![
                Column::bars("operations".into(), of_call.into()),
                Column::bars(format!("{}time, ns", about(study)), of_call.into()),
                Column::bars("steps".into(), format!("{METHOD}, tolerance {TOLERANCE:e}")),
                Column::dots(format!("change of {}", facts.output), &facts.unit),
            ],
            lines,
            compared: true,
        }
        .draw(),
    })
}

/// Draws effects added one after the other.
pub(super) fn added(study: &Study) -> Option<Figure> {
    let (own, named) = ablations(study, |e| {
        (!e.starts_with("all")).then(|| e.rsplit('+').next().unwrap_or(e))
    })?;
    let line = |(i, (effect, row)): (usize, &(&str, &Row))| Line {
        label: if i == 0 {
            (*effect).to_owned()
        } else {
            format!("+ {effect}")
        },
        values: Line::numbers([row.ns, row.error]),
        failed: why(row),
    };
    let mut lines: Vec<Line> = named.iter().enumerate().map(line).collect();
    lines.push(Line {
        label: "all".into(),
        values: Line::numbers([own.ns, own.error]),
        failed: why(own),
    });
    let facts = &study.facts;
    let first = lines.iter().find_map(|line| line.value(0));
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
            "Effects added one after the other, by {}: the time of each stage, and how far `{}` is from its trajectory in the scene with all effects. In the last line this is the error of the method alone.",
            way(own),
            facts.output
        ),
        svg: Bars {
            title,
            columns: vec![
                Column::bars(
                    format!("{}time", about(study)),
                    "ns per simulated ms".into(),
                ),
                Column::dots("distance from the full scene".into(), &facts.unit),
            ],
            lines,
            compared: false,
        }
        .draw(),
    })
}
