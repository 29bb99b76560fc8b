//! The specs of `specs/loops` without a reference of their own: against the open tree with multipliers, and against the
//! pendulum that two parallelograms are.

use bgdyn_codegen::method::Method;
use bgdyn_runtime::Dd;
use serde_json::Value;

use super::multipliers::compare;
use super::random_loops::{Loop, Text};
use super::references::{file, spec};
use super::robot::{Robot, State};

/// Returns a spec as links and loops between frames; all its places are on links, each on a line of its own.
fn text(name: &str) -> Text {
    let whole = spec(name);
    let (_, rest) = whole.split_once("\nlinks:\n").expect("links");
    let (links, rest) = rest.split_once("\nloops:\n").expect("loops");
    let mut text = Text {
        links: format!("{links}\n"),
        frames: String::new(),
        loops: String::new(),
        origins: Vec::new(),
        all: Vec::new(),
    };
    for entry in rest.split("  - name: ").skip(1) {
        let k = text.all.len();
        let (mut kind, mut more) = ("", String::new());
        let [mut a, mut b] = ["", ""];
        for line in entry
            .lines()
            .skip(1)
            .take_while(|line| line.starts_with("    "))
        {
            match line.trim().split_once(": ").expect("a key") {
                ("type", word) => kind = word,
                ("a", place) => a = place,
                ("b", place) => b = place,
                _ => more += &format!("{line}\n"),
            }
        }
        for (end, place) in [("a", a), ("b", b)] {
            let place = place.strip_prefix("{ ").expect("a place");
            text.frames += &format!("  - {{ name: {end}{k}, {place}\n");
        }
        text.loops += &format!(
            "  - name: loop_{k}\n    type: {kind}\n    a: {{ frame: a{k} }}\n    b: {{ frame: b{k} }}\n{more}"
        );
        text.all.push(Loop {
            kind: ["hinge", "point"]
                .into_iter()
                .find(|x| *x == kind)
                .expect("a type"),
            axis: [Dd::ZERO, Dd::ZERO, Dd::ONE],
        });
    }
    text
}

/// Compares accelerations, efforts, multipliers and the mass matrix with those of the open tree with multipliers.
fn compared(name: &str, nv: usize, rows: usize) {
    let text = text(name);
    let robot = Robot::read(&text.closed());
    let closure = robot.mechanism.closure().expect("loops");
    assert_eq!((robot.nv(), closure.rows.len()), (nv, rows), "{name}");
    compare(&text, name);
}

#[test]
fn the_four_bar_moves_as_with_multipliers() {
    compared("four_bar", 1, 2);
}

#[test]
fn the_six_bar_moves_as_with_multipliers() {
    compared("six_bar", 1, 4);
}

#[test]
fn the_spatial_four_bar_moves_as_with_multipliers() {
    compared("rssr", 1, 3);
}

#[test]
fn the_spherical_four_bar_moves_as_with_multipliers() {
    compared("spherical_four_bar", 1, 2);
}

#[test]
fn andrews_mechanism_moves_as_with_multipliers() {
    compared("andrews", 1, 6);
}

#[test]
fn the_parallelograms_move_as_with_multipliers() {
    compared("parallelograms", 1, 4);
}

fn reference(name: &str) -> (Vec<String>, Vec<Vec<f64>>) {
    let json = file(["tests/golden/loops", &format!("{name}.json")]);
    let value: Value = serde_json::from_str(&json).expect("JSON");
    let columns = value["columns"].as_array().expect("columns").iter();
    let samples = value["samples"].as_array().expect("samples").iter();
    let number = |x: &Value| x.as_f64().expect("a number");
    let row = |row: &Value| row.as_array().expect("a row").iter().map(number).collect();
    (
        columns
            .map(|name| name.as_str().expect("a name").to_owned())
            .collect(),
        samples.map(row).collect(),
    )
}

/// On the branch of parallel couplers the two parallelograms are one pendulum: 3 α̈ = 3.5 g sin α, α from upright. A model
/// serves one side of the flat positions.
#[test]
fn the_parallelograms_accelerate_as_a_pendulum() {
    let upper = spec("parallelograms");
    let lower = upper
        .replace(" 90 deg", " -89 deg")
        .replace(" -90 deg", " 89 deg");
    let (columns, samples) = reference("parallelograms");
    assert_eq!(columns[..3], ["t", "alpha", "alpha_dot"]);
    let mut compared = [0, 0];
    for (side, text) in [&upper, &lower].into_iter().enumerate() {
        let function = Robot::read(text).function(None, Method::ForwardDynamics);
        for sample in &samples {
            let (alpha, rate) = (sample[1], sample[2]);
            let angle = std::f64::consts::FRAC_PI_2 - alpha;
            if (angle.sin() < 0.0) != (side == 1) {
                continue;
            }
            let state = State {
                q: vec![angle, -angle, angle, -angle, angle],
                v: vec![-rate],
                a: vec![0.0],
                u: vec![0.0],
            };
            let found: f64 = state.value(&function)[0];
            let expected = -3.5 * 9.81 / 3.0 * alpha.sin();
            // The pivots are sines of the angle between rods and couplers.
            let allowed = 1e-14 * (1.0 + rate * rate) / angle.sin().abs();
            assert!(
                (found - expected).abs() < allowed,
                "{alpha}: {found} {expected}"
            );
            compared[side] += 1;
        }
    }
    assert!(compared.iter().all(|&n| n >= 10), "{compared:?}");
}
