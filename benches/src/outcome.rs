//! What a program of the comparison with other systems prints for an operation.

use std::hint::black_box;
use std::process::ExitCode;

use nalgebra::SMatrix;

use crate::clock;
use crate::inputs::{Input, Lanes, inputs_of};
use crate::states::State;

/// The line to print; `None` if the model does not have the operation.
pub type Outcome = Option<String>;

/// Times an operation of a robot in a number of lanes.
pub type Timed = fn(&str, usize) -> Outcome;

/// Prints the line of the operation that the arguments name, `PROGRAM ROBOT OPERATION [LANES]`. The exit code is 2 for
/// another robot, 3 for what the robot does not have.
pub fn answer(program: &str, robots: &[(&str, Timed)]) -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let (robot, operation, lanes) = match &arguments[..] {
        [robot, operation] => (robot, operation, 1),
        [robot, operation, lanes] => (robot, operation, lanes.parse().unwrap_or(0)),
        _ => {
            eprintln!("usage: {program} ROBOT OPERATION [LANES]");
            return ExitCode::from(2);
        }
    };
    let Some((_, timed)) = robots.iter().find(|(name, _)| name == robot) else {
        let known: Vec<&str> = robots.iter().map(|(name, _)| *name).collect();
        eprintln!("no robot is called {robot}: there are {}", known.join(", "));
        return ExitCode::from(2);
    };
    match timed(operation, lanes) {
        Some(line) => {
            println!("{line}");
            ExitCode::SUCCESS
        }
        None => {
            eprintln!("{robot} has no {operation} in {lanes} lanes");
            ExitCode::from(3)
        }
    }
}

/// Times `call`, ns a state, and adds up the `outputs` of its results over all states. With `PEERS_VALUES` it returns all
/// outputs instead, for as many states as this says, a line each.
pub fn measure<T: Lanes, R, const N: usize, const NQ: usize>(
    states: &[State],
    call: impl Fn(&Input<T, N, NQ>) -> R,
    outputs: impl Fn(&R) -> Vec<T>,
) -> Outcome {
    let inputs = inputs_of::<T, N, NQ>(states);
    if let Ok(number) = std::env::var("PEERS_VALUES") {
        let number = number.parse().unwrap_or(0);
        let line = |input| {
            let outputs = outputs(&call(input));
            let words: Vec<String> = outputs.iter().map(|x| format!("{:e}", x.lane(0))).collect();
            words.join(" ")
        };
        let lines: Vec<String> = inputs.iter().take(number).map(line).collect();
        return Some(lines.join("\n"));
    }
    let mut sum = 0.0;
    for input in &inputs {
        for x in outputs(&call(input)) {
            sum += (0..T::LANES).map(|lane| x.lane(lane)).sum::<f64>();
        }
    }
    let time = clock::median(inputs.len(), clock::span(), |k| {
        black_box(&call(black_box(&inputs[k])));
    });
    Some(format!("{:.3} {sum:.12e}", time / T::LANES as f64))
}

/// Returns all entries, column by column.
pub fn entries<T: Lanes, const R: usize, const C: usize>(m: &SMatrix<T, R, C>) -> Vec<T> {
    m.iter().copied().collect()
}

/// Returns the entries of the upper triangle, because some peers compute only that.
pub fn upper<T: Lanes, const N: usize>(m: &SMatrix<T, N, N>) -> Vec<T> {
    let places = (0..N).flat_map(|j| (0..=j).map(move |i| (i, j)));
    places.map(|place| m[place]).collect()
}
