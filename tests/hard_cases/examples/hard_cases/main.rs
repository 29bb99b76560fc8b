//! Runs every hard case in compiled code and compares the errors with their limits.
//!
//! `cargo run --release --example hard_cases` prints the table of `docs/hard_cases.md` and draws the
//! energy of a double pendulum over 1e7 steps.

mod energy;
mod options;
mod tables;

use std::fs;
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

use hard_cases::{
    Curve, Extent, Measured, Outcome, TOPICS, Topic, single_precision_of_long_chains,
};
use options::Options;

fn main() -> ExitCode {
    let options = match Options::parse(std::env::args().skip(1)) {
        Ok(Some(options)) => options,
        Ok(None) => return ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("{message}\n\n{}", options::USAGE);
            return ExitCode::from(2);
        }
    };
    match report(&options) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(message) => {
            eprintln!("{message}");
            ExitCode::FAILURE
        }
    }
}

/// Runs everything, prints the table and writes the files. Returns whether every bar is met.
fn report(options: &Options) -> Result<bool, String> {
    let folder = &options.out;
    fs::create_dir_all(folder)
        .map_err(|e| format!("the folder {} cannot be made: {e}", folder.display()))?;
    let topics = TOPICS.iter().filter(|t| t.name.contains(&options.only));
    let topics: Vec<&Topic> = topics.collect();
    if topics.is_empty() {
        let names: Vec<&str> = TOPICS.iter().map(|t| t.name).collect();
        let names = names.join(", ");
        return Err(format!(
            "no topic's name holds `{}`: there are {names}",
            options.only
        ));
    }
    if options.extent == Extent::Quick {
        println!("Quick: every case and every bar, but");
        for topic in &topics {
            if let Some(shortened) = topic.shortened {
                println!("  {}: {shortened}", topic.name);
            }
        }
        println!();
    }
    let began = Instant::now();
    let measured = run_all(&topics, options.extent);
    let (outcomes, curves) = sorted(measured);
    println!("{}", tables::HEADER);
    for outcome in &outcomes {
        println!("{outcome}");
    }
    println!();
    for curve in &curves {
        let (steps, _) = curve.points.last().copied().unwrap_or_default();
        println!(
            "energy over {steps:.0} steps, {}: off by at most {:.1e} of 29.43 J",
            curve.name, curve.most
        );
    }
    let files = write(options, &outcomes, &curves)?;
    println!("\nran for {:.0} s", began.elapsed().as_secs_f64());
    for file in files {
        println!("wrote {}", file.display());
    }
    let passed = outcomes.iter().filter(|o| o.met()).count();
    let failed = outcomes.len() - passed;
    println!("{passed} passed, {failed} failed");
    Ok(failed == 0)
}

/// Runs the topics, in parallel on all cores; the results are in the order of the topics.
fn run_all(topics: &[&Topic], extent: Extent) -> Vec<Measured> {
    let next = AtomicUsize::new(0);
    let results: Vec<Mutex<Measured>> = topics.iter().map(|_| Mutex::default()).collect();
    let work = || {
        while let Some((topic, result)) = {
            let k = next.fetch_add(1, Ordering::Relaxed);
            topics.get(k).zip(results.get(k))
        } {
            let began = Instant::now();
            let measured = (topic.run)(extent);
            eprintln!("{}: {:.1} s", topic.name, began.elapsed().as_secs_f64());
            *result.lock().expect("no other holds it") = measured;
        }
    };
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    std::thread::scope(|scope| {
        for _ in 0..cores {
            scope.spawn(work);
        }
    });
    let taken = results.into_iter().map(|r| r.into_inner());
    taken.map(|r| r.expect("no topic panicked")).collect()
}

/// Returns rows and curves of all topics.
fn sorted(measured: Vec<Measured>) -> (Vec<Outcome>, Vec<Curve>) {
    let (mut outcomes, mut curves) = (vec![], vec![]);
    for one in measured {
        outcomes.extend(one.outcomes);
        curves.extend(one.curves);
    }
    (outcomes, curves)
}

/// The tables and the figure.
fn write(
    options: &Options,
    outcomes: &[Outcome],
    curves: &[Curve],
) -> Result<Vec<PathBuf>, String> {
    let single = single_precision_of_long_chains();
    let texts = [
        ("table.md", tables::outcomes(outcomes)),
        ("single_precision.md", tables::single_precision(&single)),
    ];
    let mut files = vec![];
    let refuse = |path: &PathBuf, e: &dyn std::fmt::Display| {
        format!("{} cannot be written: {e}", path.display())
    };
    for (name, text) in texts {
        let path = options.out.join(name);
        fs::write(&path, text).map_err(|e| refuse(&path, &e))?;
        files.push(path);
    }
    let path = options.out.join("energy.svg");
    fs::write(&path, energy::draw(curves)).map_err(|e| refuse(&path, &e))?;
    files.push(path);
    Ok(files)
}
