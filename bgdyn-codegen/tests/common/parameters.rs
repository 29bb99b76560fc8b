//! Random mechanisms with run-time parameters: numbers of their links, written as parameters.

use std::fmt::Write;

use bgdyn_codegen::mechanism::{Mechanism, Tensor, Value};

use super::random::Draft;
use super::rng::Rng;

/// The draft with some masses, centres of mass and inertia entries written as parameters.
pub fn parametrised(draft: &Draft, rng: &mut Rng) -> Draft {
    let mut draft = draft.clone();
    let last = draft.links.len() - 1;
    for (i, link) in draft.links.iter_mut().enumerate() {
        // At least one link has parameters.
        if i < last && rng.chance(0.4) {
            continue;
        }
        let number = link.name.trim_start_matches("link_");
        link.body = body(&link.body, number, rng);
    }
    // The same name in two places.
    if draft.links.len() > 2 && rng.chance(0.3) {
        for link in draft.links.iter_mut().take(2) {
            let other = |line: &&str| !line.starts_with("    mass:");
            let rest: Vec<&str> = link.body.lines().filter(other).collect();
            let rest = rest.join("\n");
            link.body = format!("    mass: {{ parameter: mass_shared, value: 1250 g }}\n{rest}\n");
        }
    }
    draft
}

/// Returns values of a possible body: another mass, another centre of mass, another tensor.
pub fn values(mechanism: &Mechanism, rng: &mut Rng) -> Vec<f64> {
    let factor = 0.25 + rng.unit();
    let mut values: Vec<f64> = (mechanism.parameters().iter())
        .map(|p| {
            let default = p.default.to_f64();
            match p.unit {
                "kg" => 0.05 + 3.0 * rng.unit(),
                "m" => rng.within(0.3),
                _ if p.name.starts_with("whole") => default * factor,
                _ => default,
            }
        })
        .collect();
    for link in mechanism.links() {
        vary_entries(&link.inertial.inertia, mechanism, &mut values, rng);
    }
    values
}

/// Changes the entries of a tensor that are parameters, while it remains that of a possible body: by up to
/// a third of its trace, or half of that, and so on.
fn vary_entries(tensor: &Tensor, mechanism: &Mechanism, values: &mut [f64], rng: &mut Rng) {
    let place = |k: usize| match tensor.entries[k] {
        Value::Parameter(id) if mechanism.parameters()[id.0].name.starts_with("part") => Some(id.0),
        _ => None,
    };
    let number = |value: &Value, values: &[f64]| match value {
        Value::Fixed(x) => x.to_f64(),
        Value::Parameter(id) => values[id.0],
    };
    let moved: [f64; 6] = std::array::from_fn(|_| rng.within(1.0));
    let of = |values: &[f64]| tensor.entries.each_ref().map(|e| number(e, values));
    let before = of(values);
    let trace = before[0] + before[1] + before[2];
    for halved in 1..12 {
        let size = trace / 3.0 * 0.5_f64.powi(halved - 1);
        for k in 0..6 {
            if let Some(at) = place(k) {
                values[at] = before[k] + size * moved[k];
            }
        }
        if is_of_a_body(of(values)) {
            return;
        }
    }
    for k in 0..6 {
        if let Some(at) = place(k) {
            values[at] = before[k];
        }
    }
}

/// Returns whether ½ tr(J) − J, the body's second moments of mass, is positive definite with a margin.
fn is_of_a_body([xx, yy, zz, xy, xz, yz]: [f64; 6]) -> bool {
    let half = (xx + yy + zz) / 2.0;
    let (a, b, c) = (half - xx, half - yy, half - zz);
    let minor = a * b - xy * xy;
    let whole = c * minor - a * yz * yz - b * xz * xz - 2.0 * xy * xz * yz;
    let size = half.max(1e-300);
    a > 1e-3 * size && minor > 1e-5 * size * size && whole > 1e-7 * size.powi(3)
}

fn body(body: &str, link: &str, rng: &mut Rng) -> String {
    let mut text = String::new();
    let mut lines: Vec<String> = body.lines().map(str::to_owned).collect();
    let has = |lines: &[String], key: &str| lines.iter().any(|l| l.trim().starts_with(key));
    // Zero by default, nonzero at run time.
    if !has(&lines, "mass") {
        lines.push("    mass: 0".into());
    }
    if !has(&lines, "com") && rng.chance(0.5) {
        lines.push("    com: [0, 0, 0]".into());
    }
    for line in &lines {
        let (key, value) = line.trim().split_once(": ").expect("a key and its value");
        let line = match key {
            "mass" => maybe(rng, 0.7, &format!("mass_{link}"), value),
            "com" => {
                let numbers = value
                    .trim_matches(['[', ']'])
                    .split(", ")
                    .zip(["x", "y", "z"]);
                let numbers: Vec<String> = numbers
                    .map(|(number, axis)| maybe(rng, 0.5, &format!("com_{axis}_{link}"), number))
                    .collect();
                format!("[{}]", numbers.join(", "))
            }
            "inertia" => tensor(rng, link, value),
            other => panic!("an unknown key {other}"),
        };
        writeln!(text, "    {key}: {line}").unwrap();
    }
    text
}

fn tensor(rng: &mut Rng, link: &str, text: &str) -> String {
    let share = *rng.pick(&[0.0, 0.5, 1.0]);
    let word = if share == 1.0 { "whole" } else { "part" };
    // The rotation does not change.
    let (entries, rest) = text.split_once(", rpy").unwrap_or((text, " }"));
    let entries = entries
        .trim_matches(['{', '}', ' '])
        .split(", ")
        .map(|entry| {
            let (name, number) = entry.split_once(": ").expect("a name and a number");
            let number = maybe(rng, share, &format!("{word}_{name}_{link}"), number);
            format!("{name}: {number}")
        });
    let entries: Vec<String> = entries.collect();
    let rpy = if rest == " }" { "" } else { ", rpy" };
    format!("{{ {}{rpy}{rest}", entries.join(", "))
}

fn maybe(rng: &mut Rng, share: f64, name: &str, number: &str) -> String {
    if rng.chance(share) {
        format!("{{ parameter: {name}, value: {number} }}")
    } else {
        number.to_owned()
    }
}
