//! Writes the page that replays a run: one self-contained HTML file.

mod bodies;
mod body;
mod contact_forces;
mod contacts;
mod curve;
mod poses;
mod stops;

use bgdyn_codegen::system::SceneEquations;
use serde::Serialize;

use self::bodies::Bodies;
use self::body::{Body, End};
use self::contacts::{Contacts, contacts};
use self::curve::{Curve, LEVELS};
use self::poses::{TURN, poses, turns};
use super::difference::range;
use super::report::{changes, short};
use super::run_table::{Column, Record, Row};
use crate::template::{embedded, filled, head};

/// Largest number of poses in a page: for more, rows are omitted.
const POSES: usize = 36_000;
/// Largest number of rows in a page.
const ROWS: usize = 4_000;
/// Digits of a time.
const DIGITS: usize = 9;

const PARTS: [&str; 5] = [
    include_str!("data.js"),
    include_str!("solid.js"),
    include_str!("view.js"),
    include_str!("plots.js"),
    include_str!("player.js"),
];

/// The texts about a run.
#[derive(Clone, Debug)]
pub struct Words {
    /// The title of the page.
    pub name: String,
    /// How the run was integrated.
    pub method: String,
    /// The report ([`super::report`]).
    pub report: String,
}

#[derive(Serialize)]
struct Data<'a> {
    name: &'a str,
    description: &'a str,
    method: &'a str,
    report: &'a str,
    failure: Option<String>,
    levels: f64,
    /// The unit of positions, m.
    grain: f64,
    t: Vec<f64>,
    bodies: Vec<Body>,
    between: Vec<Between>,
    #[serde(skip_serializing_if = "Option::is_none")]
    contacts: Option<Contacts>,
    outputs: Vec<Curve>,
    states: Vec<Curve>,
    modes: Vec<ModeCurve>,
    events: Vec<Mark>,
    energy: Energy,
}

/// An element between two points.
#[derive(Serialize)]
struct Between {
    name: String,
    kind: &'static str,
    ends: [End; 2],
    /// The least distance of the ends in the run, m.
    shortest: f64,
}

#[derive(Serialize)]
struct ModeCurve {
    name: String,
    at: Vec<i8>,
}

#[derive(Serialize)]
struct Mark {
    t: f64,
    text: String,
}

#[derive(Serialize)]
struct Energy {
    t: Vec<f64>,
    curves: Vec<Curve>,
}

/// Returns the page of a run.
pub fn page(system: &SceneEquations, columns: &[Column], run: &Record, words: &Words) -> String {
    let data = serde_json::to_string(&data(system, columns, run, words));
    let data = embedded(&data.unwrap_or_default());
    let head = head(&words.name, include_str!("style.css"));
    let parts = [
        ("@HEAD@", head.as_str()),
        ("@DATA@", &data),
        ("@SCRIPT@", &PARTS.concat()),
    ];
    filled(include_str!("page.html"), &parts)
}

fn data<'a>(
    system: &'a SceneEquations,
    columns: &[Column],
    run: &Record,
    words: &'a Words,
) -> Data<'a> {
    let rows = rows_to_show(system, run);
    let (mut bodies, grain) = replayed(system, &rows);
    let contacts = contacts(system, &mut bodies, grain, &rows);
    let between = between(system, &bodies, grain, rows.len());
    let outputs = columns.iter().enumerate();
    let outputs = outputs.map(|(i, c)| Curve::new(c, rows.iter().map(|row| row.values[i])));
    let mark = |event: &super::Event| Mark {
        t: instant(event.t),
        text: changes(system, event),
    };
    Data {
        name: &words.name,
        description: system.scene.description.as_deref().unwrap_or(""),
        method: &words.method,
        report: &words.report,
        failure: run
            .failure
            .as_ref()
            .map(|reason| format!("ends early at t = {} s: {reason}", short(run.t))),
        levels: LEVELS,
        grain,
        t: rows.iter().map(|row| instant(row.t)).collect(),
        outputs: outputs.collect(),
        states: states(system, &rows),
        modes: modes(system, &rows),
        events: run.events.iter().map(mark).collect(),
        energy: energy(run),
        between,
        contacts,
        bodies: bodies.all,
    }
}

/// Returns the rows of the page: all of them, or evenly spaced ones with the last.
fn rows_to_show<'r>(system: &SceneEquations, run: &'r Record) -> Vec<&'r Row> {
    let bodies = system.scene.mechanism.nv().max(1);
    let room = (POSES / bodies).clamp(100, ROWS);
    let stride = run.rows.len().div_ceil(room).max(1);
    let last = run.rows.len().saturating_sub(1);
    let kept = |&(i, _): &(usize, &Row)| i % stride == 0 || i == last;
    let rows = run.rows.iter().enumerate().filter(kept);
    rows.map(|(_, row)| row).collect()
}

/// Returns a time rounded to the digits of the page.
fn instant(t: f64) -> f64 {
    format!("{t:.DIGITS$e}").parse().unwrap_or(t)
}

/// Returns the bodies with their poses by the mechanism's own functions, and the unit of positions, m.
fn replayed(system: &SceneEquations, rows: &[&Row]) -> (Bodies, f64) {
    let mechanism = &system.scene.mechanism;
    let travel: Vec<(f64, f64)> = (0..mechanism.nq())
        .map(|p| range(rows.iter().map(|row| row.y[p]).filter(|q| q.is_finite())))
        .map(
            |(low, high)| {
                if low <= high { (low, high) } else { (0.0, 0.0) }
            },
        )
        .collect();
    let mut bodies = Bodies::new(&system.scene, &travel);
    let poses: Vec<Vec<[f64; 12]>> = bodies
        .all
        .iter()
        .filter_map(|body| body.link)
        .map(|link| poses(system, link, rows))
        .collect();
    let places = poses.iter().flatten().flat_map(|pose| &pose[9..]);
    let most = places.fold(0.0_f64, |most, x| most.max(x.abs()));
    let grain = if most > 0.0 {
        10_f64.powi(most.log10().ceil() as i32 - 5)
    } else {
        1e-5
    };
    let moving = bodies.all.iter_mut().filter(|body| body.link.is_some());
    for (body, poses) in moving.zip(poses) {
        let place = poses.iter().flat_map(|pose| &pose[9..]);
        body.place = Some(place.map(|x| (x / grain).round() as i64).collect());
        body.turn = Some(turns(&poses));
    }
    (bodies, grain)
}

/// Returns springs, dampers and cylinders between two points.
fn between(system: &SceneEquations, bodies: &Bodies, grain: f64, rows: usize) -> Vec<Between> {
    let mechanism = &system.scene.mechanism;
    let found = system.scene.elements.iter().filter_map(|element| {
        let [from, to] = element.ends()?;
        let ends = [bodies.end(mechanism, from)?, bodies.end(mechanism, to)?];
        let distance = |row| {
            let [a, b] = ends.map(|end| in_world(&bodies.all[end.body], end.at, grain, row));
            (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>().sqrt()
        };
        Some(Between {
            name: element.name.clone(),
            kind: element.effect.keyword(),
            ends,
            shortest: (0..rows).map(distance).fold(f64::INFINITY, f64::min),
        })
    });
    found.collect()
}

/// Returns a point of a body in the world at a row, as the page decodes it.
fn in_world(body: &Body, at: [f64; 3], grain: f64, row: usize) -> [f64; 3] {
    let (Some(place), Some(turn)) = (&body.place, &body.turn) else {
        return at;
    };
    let q: [f64; 4] = std::array::from_fn(|k| turn[4 * row + k] as f64 / TURN);
    let [w, x, y, z] = q;
    // p + 2 u × (u × p + w p), u the vector part.
    let cross = |a: [f64; 3], b: [f64; 3]| {
        [
            a[1] * b[2] - a[2] * b[1],
            a[2] * b[0] - a[0] * b[2],
            a[0] * b[1] - a[1] * b[0],
        ]
    };
    let u = [x, y, z];
    let inner = cross(u, at);
    let twice = cross(u, std::array::from_fn(|k| inner[k] + w * at[k]));
    std::array::from_fn(|k| place[3 * row + k] as f64 * grain + at[k] + 2.0 * twice[k])
}

/// Returns inputs, coordinates other than joints and first-order states.
fn states(system: &SceneEquations, rows: &[&Row]) -> Vec<Curve> {
    let layout = &system.scene.layout;
    let (positions, velocities) = (system.scene.mechanism.nq(), system.scene.mechanism.nv());
    let inputs = layout.inputs.iter().enumerate().map(|(i, part)| {
        let column = column(&part.name, part.dimension.si());
        Curve::new(&column, rows.iter().map(|row| row.inputs[i]))
    });
    let parts = super::run_table::state_columns(system);
    let beside = |i: usize| (i >= positions && i < layout.nq()) || i >= layout.nq() + velocities;
    let own = parts.iter().enumerate().filter(|&(i, _)| beside(i));
    let own = own.map(|(i, column)| Curve::new(column, rows.iter().map(|row| row.y[i])));
    inputs.chain(own).collect()
}

fn column(name: &str, unit: &'static str) -> Column {
    Column {
        name: name.to_owned(),
        unit,
    }
}

fn modes(system: &SceneEquations, rows: &[&Row]) -> Vec<ModeCurve> {
    let modes = system.scene.layout.modes.iter().enumerate();
    let modes = modes.map(|(i, mode)| ModeCurve {
        name: mode.name.clone(),
        at: rows.iter().map(|row| row.modes[i] as i8).collect(),
    });
    modes.collect()
}

fn energy(run: &Record) -> Energy {
    let stride = run.energy.len().div_ceil(ROWS).max(1);
    let kept = run.energy.iter().enumerate();
    let last = run.energy.len().saturating_sub(1);
    let kept = kept.filter(|&(i, _)| i % stride == 0 || i == last);
    let kept: Vec<_> = kept.map(|(_, at)| at).collect();
    let curve = |name, part: fn(&super::run_table::EnergyAt) -> f64| {
        Curve::new(&column(name, "J"), kept.iter().map(|at| part(at)))
    };
    Energy {
        t: kept.iter().map(|at| instant(at.t)).collect(),
        curves: vec![
            curve("supplied", |at| at.supplied),
            curve("stored, change", |at| at.stored),
            curve("dissipated", |at| at.dissipated),
            curve("stored + dissipated − supplied", |at| at.drift),
        ],
    }
}
