//! A Panda is calibrated: a motion is planned and logged, the model's numbers are found from the log, the same controller
//! follows the same path with both models, and then it learns an unknown load while it carries it.
//!
//! `cargo run --release -p controllers --example calibrate` prints a report and draws `target/calibrate/calibrate.svg`. It
//! fails if the errors of the calibrated model are not smaller by a factor of ten, or if the load is not found.

mod acts;
mod control;
#[path = "../common/cycle.rs"]
mod cycle;
mod figure;
mod load;
#[path = "../common/options.rs"]
mod options;
mod plant;
mod report;
mod results;
mod robot;
mod table;
mod timing;
mod truth_numbers;

use std::process::ExitCode;

use bgdyn::nalgebra::SVector;

use options::Options;

// What the controllers know.
bgdyn::bgdyn!(
    "../../specs/panda.yaml",
    methods = [
        regressor,
        base_regressor,
        adaptive_regressor,
        payload_adaptive_step_flange,
        parameters,
        base_parameters,
        pose_link7,
        pose_flange,
        pose_tool
    ],
);
// The arm, and its true numbers, with which results are compared.
bgdyn::bgdyn!("calibrate/truth.scene.yaml");
bgdyn::bgdyn!(
    "plants/panda_truth.yaml",
    methods = [inverse_dynamics, parameters]
);

/// Number of joints.
pub const JOINTS: usize = 7;
/// A vector with one number for each joint.
pub type Joints<const N: usize = JOINTS> = SVector<f64, N>;

fn main() -> ExitCode {
    let options = match Options::parse("calibrate", std::env::args().skip(1)) {
        Ok(Some(options)) => options,
        Ok(None) => return ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("calibrate: {message}\n\n{}", options::usage("calibrate"));
            return ExitCode::from(2);
        }
    };
    match show(&options) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("calibrate: {message}");
            ExitCode::FAILURE
        }
    }
}

/// Runs the acts, prints and draws them, and checks what they show.
fn show(options: &Options) -> Result<(), String> {
    let results = results::Results::new()?;
    report::print(&results);
    println!();
    let logs = results.calibration.logs.iter();
    for (log, name) in logs.zip(["log.csv", "other.csv"]) {
        let path = table::write(log, &options.out, name)?;
        println!("wrote {}", path.display());
    }
    let path = figure::draw(&results, &options.out)?;
    println!("wrote {}", path.display());
    results.check()
}
