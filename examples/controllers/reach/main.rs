//! A Panda reaches a point: the efforts of least cost and the feedback around them, by iterations that take a fraction
//! of a controller's period.
//!
//! `cargo run --release -p controllers --example reach` prints the cost by iteration and the time of an iteration and of
//! the whole solve, and draws `target/reach/reach.svg`. `--times` prints the times alone, as JSON.

#[path = "../common/options.rs"]
mod options;
mod plot;
mod task;

use std::hint::black_box;
use std::process::ExitCode;
use std::time::Instant;

use bgdyn_sim::ilqr::{Ilqr, Iteration};
use task::{JOINTS, Joints, NODES, Reach, Reaching, problem, start};

bgdyn::bgdyn!(
    "../../tests/golden/specs/panda7.yaml",
    derivatives = true,
    frames = [l_panda_joint7],
);
use panda7::Panda7;

/// The solver of the task.
pub type Solver = Ilqr<f64, JOINTS, JOINTS, NODES>;

/// Promised decrease of the cost at which iterations end.
const TOLERANCE: f64 = 1e-9;
/// Most iterations.
const ITERATIONS: usize = 100;
/// Solves that are timed; the shortest time counts.
const ROUNDS: usize = 200;

fn main() -> ExitCode {
    let mut arguments = std::env::args().skip(1).peekable();
    if arguments
        .next_if(|argument| argument == "--times")
        .is_some()
    {
        let arm = Panda7::default();
        let cost = Reach::new(&arm);
        return ended(times(&problem(&arm, &cost)).map(|times| println!("{}", times.json())));
    }
    match options::Options::parse("reach", arguments) {
        Ok(None) => ExitCode::SUCCESS,
        Ok(Some(options)) => ended(report(&options)),
        Err(message) => ended(Err(format!("{message}\n\n{}", options::usage("reach")))),
    }
}

/// Prints an error, if there is one.
fn ended(result: Result<(), String>) -> ExitCode {
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("error: {message}");
            ExitCode::FAILURE
        }
    }
}

/// Solves, prints and draws.
fn report(options: &options::Options) -> Result<(), String> {
    let arm = Panda7::default();
    let cost = Reach::new(&arm);
    let problem = problem(&arm, &cost);
    let mut ilqr = at_rest(&problem)?;
    println!(
        "Panda, {NODES} steps of {} ms, {JOINTS} efforts each",
        task::STEP * 1e3
    );
    println!("\niteration  share of the step  cost");
    println!("{:9}                     {:.10}", 0, ilqr.cost());
    let mut costs = vec![ilqr.cost()];
    let mut motions = vec![ilqr.clone()];
    while let Iteration::Moved { cost, share } = ilqr
        .iterate(&problem, TOLERANCE)
        .map_err(|e| e.to_string())?
    {
        println!("{:9} {share:18} {cost:.10}", costs.len());
        costs.push(cost);
        motions.push(ilqr.clone());
        if costs.len() > ITERATIONS {
            return Err(format!("no optimum after {ITERATIONS} iterations"));
        }
    }
    let miss = cost.miss(&arm, &ilqr.last().q).norm();
    println!("distance from the target in the end: {:.3} mm", miss * 1e3);
    let times = times(&problem)?;
    println!(
        "\none iteration {:.1} µs, the whole solve {:.1} µs; the shortest of {ROUNDS}, this machine, this build",
        times.iteration, times.solve
    );
    if cfg!(debug_assertions) {
        println!("a debug build: pass --release for times worth reading");
    }
    let path = plot::draw(&arm, &cost, &motions, &costs, &options.out)?;
    println!("wrote {}", path.display());
    Ok(())
}

/// Returns the motion that stays at the start.
fn at_rest(problem: &Reaching<'_>) -> Result<Solver, String> {
    let efforts = [problem.cost.holding; NODES];
    Ilqr::new(problem, &start(), &efforts).map_err(|e| e.to_string())
}

/// Shortest times, µs.
struct Times {
    /// Of one sweep and search, from the start.
    iteration: f64,
    /// Of the motion at rest and all iterations up to the tolerance.
    solve: f64,
    /// Of the latter.
    iterations: usize,
    cost: f64,
}

impl Times {
    /// Returns an object of JSON.
    fn json(&self) -> String {
        format!(
            r#"{{"one_iteration_us": {:.1}, "solve_us": {:.1}, "iterations": {}, "cost": {:?}}}"#,
            self.iteration, self.solve, self.iterations, self.cost
        )
    }
}

/// Measures an iteration and the whole solve.
fn times(problem: &Reaching<'_>) -> Result<Times, String> {
    let mut ilqr = at_rest(problem)?;
    let efforts: [Joints; NODES] = [problem.cost.holding; NODES];
    let (mut iteration, mut solve) = (f64::INFINITY, f64::INFINITY);
    let mut outcome = None;
    for _ in 0..ROUNDS {
        ilqr.restart(problem, &start(), &efforts)
            .map_err(|e| e.to_string())?;
        let before = Instant::now();
        black_box(ilqr.iterate(black_box(problem), TOLERANCE)).map_err(|e| e.to_string())?;
        iteration = iteration.min(before.elapsed().as_secs_f64() * 1e6);

        let before = Instant::now();
        ilqr.restart(black_box(problem), &start(), &efforts)
            .map_err(|e| e.to_string())?;
        let solved = black_box(ilqr.solve(problem, TOLERANCE, ITERATIONS));
        solve = solve.min(before.elapsed().as_secs_f64() * 1e6);
        outcome = Some(solved.map_err(|e| e.to_string())?);
    }
    let outcome = outcome.ok_or("nothing was measured")?;
    Ok(Times {
        iteration,
        solve,
        iterations: outcome.iterations,
        cost: outcome.cost,
    })
}
