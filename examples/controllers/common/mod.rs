//! Common code of both examples: a pick-and-place cycle under computed torque, simulated with an arm that
//! carries a part unknown to the controller, with a report and a plot.

pub mod control;
pub mod cycle;
pub mod machine;
mod options;
mod plot;
mod report;
mod simulate;
mod stopwatch;

use std::process::ExitCode;

use bgdyn::Dynamics;
use bgdyn::nalgebra::SVector;

use control::{Gains, Law};
use cycle::Cycle;
use machine::Machine;
use options::Options;

/// The data of one example.
pub struct Cell<G, C, E, L, const N: usize> {
    /// Name of the example, and of its folder of results.
    pub name: &'static str,
    /// Title of the plot.
    pub title: &'static str,
    /// One sentence about the plant, for the report.
    pub plant: &'static str,
    /// Data of the arm from its spec: limits, lengths, operation counts.
    pub machine: Machine<N>,
    /// The generated model, whose calls are timed.
    pub generated: G,
    /// The controller's model.
    pub model: C,
    /// The simulated arm with an open gripper.
    pub empty: E,
    /// The simulated arm with the part.
    pub loaded: L,
    /// The desired path over time.
    pub cycle: Cycle<N>,
    /// The gains of the controller.
    pub gains: Gains,
}

/// Runs the cell that `build` creates, prints its report and writes its plot.
pub fn run<G, C, E, L, const N: usize>(
    name: &'static str,
    build: impl FnOnce() -> Result<Cell<G, C, E, L, N>, String>,
) -> ExitCode
where
    G: Dynamics<f64, N, N>,
    C: Dynamics<f64, N, N>,
    E: Dynamics<f64, N, N>,
    L: Dynamics<f64, N, N>,
{
    match Options::parse(name, std::env::args().skip(1)) {
        Ok(Some(options)) => match build().and_then(|cell| run_cell(&cell, &options)) {
            Ok(()) => ExitCode::SUCCESS,
            Err(message) => {
                eprintln!("{name}: {message}");
                ExitCode::FAILURE
            }
        },
        Ok(None) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("{name}: {message}\n\n{}", options::usage(name));
            ExitCode::from(2)
        }
    }
}

fn run_cell<G, C, E, L, const N: usize>(
    cell: &Cell<G, C, E, L, N>,
    options: &Options,
) -> Result<(), String>
where
    G: Dynamics<f64, N, N>,
    C: Dynamics<f64, N, N>,
    E: Dynamics<f64, N, N>,
    L: Dynamics<f64, N, N>,
{
    let fixed_inertia = cell.model.mass_matrix(&cell.cycle.start).diagonal();
    let baseline = simulate::simulate(cell, &Law::PdGravity(fixed_inertia))?;
    let computed = simulate::simulate(cell, &Law::ComputedTorque)?;
    let times = stopwatch::time(&cell.generated, &cell.machine);

    report::tracking(cell, &computed, &baseline);
    report::calls(&cell.machine, &times);
    println!();
    let path = plot::draw(cell, &computed, &baseline, &options.out)?;
    println!("wrote {}", path.display());
    Ok(())
}

/// A vector with one number for each joint.
pub type Joints<const N: usize> = SVector<f64, N>;
