//! Gears against reference solutions of the open tree with multipliers (`tests/golden/constraints`): accelerations
//! of all joints, the multipliers that they leave, and energies at every sample.

use std::fs;
use std::path::PathBuf;

use bgdyn_codegen::method::Method;
use bgdyn_runtime::Dd;
use serde_json::Value;

use super::robot::{Robot, State, WAYS};

fn file(parts: [&str; 2]) -> String {
    let path: PathBuf = [env!("CARGO_MANIFEST_DIR"), "..", parts[0], parts[1]]
        .iter()
        .collect();
    fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

/// A reference, with its mechanism of this project and the open tree.
struct Reference {
    robot: Robot,
    tree: Robot,
    file: Value,
    /// For each joint of the tree its factors of the independent velocities, and its offset.
    relations: Vec<(Vec<Dd>, Dd)>,
}

impl Reference {
    fn new(name: &str) -> Self {
        let text = file(["specs/constraints", &format!("{name}.yaml")]);
        let text = text.replacen("format: 1", &format!("format: 1\nname: {name}"), 1);
        let open = text
            .split("\nconstraints:")
            .next()
            .expect("a text")
            .to_owned();
        let (robot, tree) = (Robot::read(&text), Robot::read(&open));
        let json = file(["tests/golden/constraints", &format!("{name}.json")]);
        let relations = (tree.mechanism.joint_names().iter())
            .map(|name| relation(&robot, name))
            .collect();
        Reference {
            robot,
            tree,
            file: serde_json::from_str(&json).expect("JSON"),
            relations,
        }
    }

    fn columns(&self) -> Vec<&str> {
        let columns = self.file["columns"].as_array().expect("columns").iter();
        columns.map(|c| c.as_str().expect("a name")).collect()
    }

    /// Returns a column of a sample.
    fn at(&self, sample: &Value, column: &str) -> Option<f64> {
        let place = self.columns().iter().position(|c| *c == column)?;
        sample[place].as_f64()
    }

    /// Returns a column for each of these joints.
    fn read(&self, sample: &Value, joints: &[String], ending: &str) -> Vec<f64> {
        let one = |joint: &String| {
            self.at(sample, &format!("{joint}{ending}"))
                .expect("a number")
        };
        joints.iter().map(one).collect()
    }

    /// Returns the efforts of the file, text in t, q and qd of their joint.
    fn efforts(&self, joints: &[String], sample: &Value) -> Vec<f64> {
        let t = self.at(sample, "t").expect("a time");
        let one = |joint: &String| match self.file["efforts"][joint.as_str()].as_str() {
            None => 0.0,
            Some(text) => {
                let q = self.at(sample, joint).expect("a position");
                match text {
                    "-8*(q - 0.2)" => -8.0 * (q - 0.2),
                    "-0.5*(q - 0.4) + 0.05*sin(5*t)" => -0.5 * (q - 0.4) + 0.05 * (5.0 * t).sin(),
                    number => number.parse().expect("a number"),
                }
            }
        };
        joints.iter().map(one).collect()
    }
}

/// Returns a joint of the tree in the independent joints.
fn relation(robot: &Robot, name: &str) -> (Vec<Dd>, Dd) {
    let own = robot.mechanism.joint_names();
    let mut followers = robot.mechanism.followers();
    let unit = |name: &str| {
        own.iter()
            .map(|n| if n == name { Dd::ONE } else { Dd::ZERO })
            .collect()
    };
    match followers.find(|(joint, ..)| joint.name == name) {
        None => (unit(name), Dd::ZERO),
        Some((_, coupling, _)) => {
            let mut row = vec![Dd::ZERO; own.len()];
            for (leader, name) in coupling
                .velocities
                .iter()
                .zip(robot.mechanism.leaders(coupling))
            {
                row[own.iter().position(|n| *n == name).expect("a joint")] = leader.ratio;
            }
            (row, coupling.offset)
        }
    }
}

fn largest(of: &[f64]) -> f64 {
    of.iter().fold(0.0, |most: f64, x| most.max(x.abs()))
}

/// Compares all samples; `tolerance` is relative to the largest component, for rounding of the file's numbers.
fn compare(name: &str, tolerance: f64) {
    let r = Reference::new(name);
    let (own, all) = (
        r.robot.mechanism.joint_names(),
        r.tree.mechanism.joint_names(),
    );
    let samples = r.file["samples"].as_array().expect("samples");
    assert!(samples.len() > 5);
    let mut energies = Vec::new();
    for sample in samples {
        let (q, v) = (r.read(sample, &own, ""), r.read(sample, &own, "_rate"));
        // The positions of the tree follow from the independent ones.
        for (joint, (row, offset)) in all.iter().zip(&r.relations) {
            let sum = row
                .iter()
                .zip(&q)
                .fold(offset.to_f64(), |sum, (k, q)| sum + k.to_f64() * q);
            let off = sum - r.at(sample, joint).expect("a position");
            assert!(
                off.abs() < 1e-13 * (1.0 + sum.abs()),
                "{name}, {joint}: {off:e}"
            );
        }
        let efforts = r.efforts(&all, sample);
        // Sᵀ P
        let drive = |j: usize| {
            let terms = r
                .relations
                .iter()
                .zip(&efforts)
                .map(|((row, _), p)| row[j].to_f64() * p);
            terms.sum()
        };
        let state = State {
            q: q.clone(),
            v: v.clone(),
            a: r.read(sample, &own, "_acceleration"),
            u: (0..own.len()).map(drive).collect(),
        };
        for way in WAYS {
            let found: Vec<f64> = state.value(&r.robot.function(way, Method::ForwardDynamics));
            let size = largest(&state.a);
            for (joint, (a, expected)) in own.iter().zip(found.iter().zip(&state.a)) {
                let off = (a - expected).abs();
                assert!(
                    off <= tolerance * size,
                    "{name}, {way:?}, {joint}: {off:e} of {size}"
                );
            }
            let found: Vec<f64> = state.value(&r.robot.function(way, Method::InverseDynamics));
            let bias: Vec<f64> = state.value(&r.robot.function(way, Method::Bias));
            let size = largest(&efforts).max(largest(&bias));
            for (p, expected) in found.iter().zip(&state.u) {
                let off = (p - expected).abs();
                assert!(
                    off <= tolerance * size * 10.0,
                    "{name}, {way:?}: {off:e} of {size}"
                );
            }
        }
        multipliers(&r, sample, &efforts, tolerance);
        if let Some(energy) = r.at(sample, "energy") {
            let of = |method| -> f64 {
                let values: Vec<f64> = state.value(&r.robot.function(None, method));
                values[0]
            };
            let total = of(Method::KineticEnergy) + of(Method::PotentialEnergy);
            energies.push(total - energy);
        }
    }
    for e in &energies {
        let off = (e - energies[0]).abs();
        assert!(
            off < 1e-13 * largest(&[1.0, energies[0]]),
            "{name}: energy {off:e}"
        );
    }
}

/// Bᵀ λ = M q̈ + h − P of the tree, with the λ of the file.
fn multipliers(r: &Reference, sample: &Value, efforts: &[f64], tolerance: f64) {
    let all = r.tree.mechanism.joint_names();
    let state = State {
        q: r.read(sample, &all, ""),
        v: r.read(sample, &all, "_rate"),
        a: r.read(sample, &all, "_acceleration"),
        u: efforts.to_vec(),
    };
    let lambda: Vec<f64> = (r.columns().iter())
        .filter(|column| column.starts_with("lambda"))
        .map(|column| r.at(sample, column).expect("a number"))
        .collect();
    let found: Vec<f64> = state.value(&r.tree.function(None, Method::InverseDynamics));
    let rows = r.file["constraints"].as_array().expect("constraints");
    let size = largest(efforts).max(largest(&lambda)).max(largest(&found));
    for (j, joint) in all.iter().enumerate() {
        let terms = rows.iter().zip(&lambda);
        let terms = terms.map(|(row, l)| row["joints"][joint.as_str()].as_f64().unwrap_or(0.0) * l);
        let off = (found[j] - efforts[j] - terms.sum::<f64>()).abs();
        assert!(off < 50.0 * tolerance * size, "{joint}: {off:e} of {size}");
    }
}

#[test]
fn the_gripper_moves_as_with_multipliers() {
    compare("mimic_gripper", 2e-13);
}

#[test]
fn the_pendulum_behind_a_gear_moves_as_in_closed_form() {
    compare("gear_pair", 2e-14);
}

#[test]
fn the_planetary_gear_moves_as_in_closed_form() {
    compare("planetary_gear", 2e-14);
}
