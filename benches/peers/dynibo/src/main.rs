//! Times the crate dynibo: `dynibo-peer DESCRIPTION OPERATION`, with the URDF beside the description.
//! Prints the time of a call and the sum of all outputs over all states.
#![forbid(unsafe_code)]

#[path = "../../../src/clock.rs"]
mod clock;
#[path = "../../../src/states.rs"]
#[allow(dead_code, reason = "floating joints are not compared with dynibo")]
mod states;

use std::hint::black_box;
use std::path::Path;
use std::process::ExitCode;

use dynibo::Robot;
use states::{State, states};

/// Its gravity is 9.80665 m/s², that of the specs 9.81 m/s². The same motion at a slower time scale has
/// the same ratio of all accelerations to gravity, so the states are scaled, and the results scaled back.
const SLOWER: f64 = 9.80665 / 9.81;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [description, operation] = &arguments[..] else {
        eprintln!("usage: dynibo-peer DESCRIPTION OPERATION");
        return ExitCode::from(2);
    };
    match measure(Path::new(description), operation) {
        Ok((time, sum)) => {
            println!("{time:.3} {sum:.12e}");
            ExitCode::SUCCESS
        }
        Err(message) => {
            eprintln!("{message}");
            ExitCode::from(3)
        }
    }
}

/// Names of the joints and which are prismatic, from a description.
fn joints(text: &str) -> Result<Vec<(&str, bool)>, String> {
    let mut lines = text.lines().skip(1);
    if lines.next() != Some("gravity 0e0 0e0 -9.81e0") {
        return Err("dynibo knows no gravity but 9.81 m/s² downwards".into());
    }
    let joint = |line| {
        let words: Vec<&str> = str::split_whitespace(line).take(3).collect();
        (words[0], words[2] == "prismatic")
    };
    Ok(lines.skip(1).map(joint).collect())
}

/// A robot, its states, and memory for the results.
struct Peer {
    robot: Robot,
    states: Vec<State>,
    vector: Vec<f64>,
    matrix: Vec<f64>,
}

impl Peer {
    fn new(description: &Path) -> Result<Self, String> {
        let text = std::fs::read_to_string(description).map_err(|e| e.to_string())?;
        let joints = joints(&text)?;
        let robot = Robot::from_urdf(description.with_extension("urdf"));
        let robot = robot.map_err(|e| e.to_string())?;
        // It orders the joints differently.
        let place = |i| {
            let name = robot.joint_name(i).ok()?;
            joints.iter().position(|joint| joint.0 == name)
        };
        let order: Option<Vec<usize>> = (0..joints.len()).map(place).collect();
        let order = order.ok_or("dynibo has other joints")?;
        let sorted = |x: Vec<f64>, scale: f64| order.iter().map(|&i| scale * x[i]).collect();
        let slides: Vec<bool> = joints.iter().map(|joint| joint.1).collect();
        let states = states(&slides).into_iter().map(|s| State {
            q: sorted(s.q, 1.0),
            v: sorted(s.v, SLOWER.sqrt()),
            a: sorted(s.a, SLOWER),
            tau: sorted(s.tau, SLOWER),
        });
        Ok(Peer {
            robot,
            states: states.collect(),
            vector: vec![0.0; order.len()],
            matrix: vec![0.0; order.len().pow(2)],
        })
    }

    fn call(&mut self, operation: &str, k: usize) {
        let State { q, v, a, tau } = black_box(&self.states[k]);
        let done = match operation {
            "inverse_dynamics" => self.robot.inverse_dynamics(q, v, a, &[], &mut self.vector),
            "mass_matrix" => self.robot.mass_matrix(q, &mut self.matrix),
            _ => self
                .robot
                .forward_dynamics(q, v, tau, &[], &mut self.vector),
        };
        done.expect("a regular state");
    }

    /// Sum of the results; of M the upper triangle, as of every peer.
    fn sum(&self) -> f64 {
        let n = self.vector.len();
        let entries = (0..n).flat_map(|i| &self.matrix[i * n + i..(i + 1) * n]);
        self.vector.iter().chain(entries).sum()
    }
}

fn measure(description: &Path, operation: &str) -> Result<(f64, f64), String> {
    if !["inverse_dynamics", "mass_matrix", "forward_dynamics"].contains(&operation) {
        return Err(format!("dynibo has no {operation}"));
    }
    let mut peer = Peer::new(description)?;
    let scale = if operation == "mass_matrix" {
        1.0
    } else {
        SLOWER
    };
    let mut sum = 0.0;
    for k in 0..peer.states.len() {
        peer.call(operation, k);
        sum += peer.sum() / scale;
    }
    let time = clock::median(peer.states.len(), clock::span(), |k| {
        peer.call(operation, k);
        black_box(&mut peer);
    });
    Ok((time, sum))
}
