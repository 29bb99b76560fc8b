//! Measures the cost of accuracy on scenes of the repository: error and time of compiled code by
//! integrator, step, scalar, formulation and set of effects.
//!
//! Writes `accuracy.csv`, `costs.csv`, the figures, `README.md` and `report.html`, which needs only a
//! browser. Exits with 1 if an integrator that should converge does not.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use accuracy_scenes::TEST_CASES;
use bgdyn_accuracy::{
    Cost, Effort, Machine, Study, Verdict, costs_csv, figures, page, readme, rows_csv, study,
    targets, verdicts,
};

const USAGE: &str = "What accuracy costs in time, on scenes of the repository

Usage: cargo run --release --example accuracy [-- OPTIONS] [SCENE …]

Options:
      --quick    Fewer steps and samples: for a look, and for tests
      --out DIR  Where to write [default: target/accuracy/]
  -h, --help     Print help";

/// The command that writes the figures of the documentation.
const AGAIN: &str = "cargo run --release --example accuracy -- --out docs/accuracy";

/// The user's options.
struct Options {
    effort: Effort,
    out: PathBuf,
    scenes: Vec<String>,
}

impl Options {
    /// Parses the arguments; `None` if help was requested and printed.
    fn parse(mut arguments: impl Iterator<Item = String>) -> Result<Option<Self>, String> {
        let mut options = Options {
            effort: Effort::FULL,
            out: PathBuf::from("target/accuracy"),
            scenes: Vec::new(),
        };
        while let Some(argument) = arguments.next() {
            match argument.as_str() {
                "-h" | "--help" => {
                    println!("{USAGE}");
                    return Ok(None);
                }
                "--quick" => options.effort = Effort::QUICK,
                "--out" => options.out = arguments.next().ok_or("`--out` needs a folder")?.into(),
                name if TEST_CASES.iter().any(|(known, _)| *known == name) => {
                    options.scenes.push(argument);
                }
                other if other.starts_with('-') => {
                    return Err(format!("unknown argument `{other}`"));
                }
                other => {
                    let all: Vec<&str> = TEST_CASES.iter().map(|(name, _)| *name).collect();
                    let all = all.join(", ");
                    return Err(format!("there is no scene `{other}`; there are {all}"));
                }
            }
        }
        Ok(Some(options))
    }
}

fn main() -> ExitCode {
    let options = match Options::parse(std::env::args().skip(1)) {
        Ok(Some(options)) => options,
        Ok(None) => return ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("{message}\n\n{USAGE}");
            return ExitCode::from(2);
        }
    };
    match run(&options) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::from(1),
        Err(error) => {
            eprintln!("accuracy: {error}");
            ExitCode::from(1)
        }
    }
}

/// Studies the scenes and writes the results; returns whether every integrator converges that should.
fn run(options: &Options) -> Result<bool, Box<dyn std::error::Error>> {
    let mut studies: Vec<Study> = Vec::new();
    for (name, test_case) in TEST_CASES {
        if options.scenes.is_empty() || options.scenes.iter().any(|s| s == name) {
            eprintln!("{name} …");
            studies.push(study(&test_case(), &options.effort).map_err(|e| format!("{name}: {e}"))?);
        }
    }
    let sound = studies.iter().filter(|study| !print_summary(study)).count() == 0;
    write(&studies, &options.out).map_err(|e| format!("{}: {e}", options.out.display()))?;
    println!("wrote {}", options.out.join("report.html").display());
    Ok(sound)
}

/// Prints the cheapest configurations and those that do not converge; returns whether all do.
fn print_summary(study: &Study) -> bool {
    let facts = &study.facts;
    println!("{}", facts.scene);
    for choice in targets(study) {
        let row = &choice.row;
        let way = format!("{} {} {}", row.method, row.step_control, row.scalar);
        let ns = row.ns.unwrap_or(f64::NAN);
        println!(
            "  {:.0e} {} at {}: {way}, {ns:.0} ns per simulated ms",
            choice.target, facts.unit, facts.output
        );
    }
    let wrong: Vec<Verdict> = verdicts(study)
        .into_iter()
        .filter(Verdict::is_failure)
        .collect();
    for verdict in &wrong {
        let Verdict {
            method,
            scalar,
            formulation,
            ..
        } = verdict;
        println!("  {method} in {scalar}, {formulation}: {}", verdict.words());
    }
    wrong.is_empty()
}

/// Writes table, figures and both reports.
fn write(studies: &[Study], out: &Path) -> std::io::Result<()> {
    std::fs::create_dir_all(out)?;
    let machine = Machine::here();
    let rows = studies.iter().flat_map(|study| &study.rows);
    std::fs::write(out.join("accuracy.csv"), rows_csv(rows))?;
    let named = |study: &'_ Study| -> Vec<(String, Cost)> {
        let all = study.costs.iter();
        all.map(|c| (study.facts.scene.clone(), c.clone()))
            .collect()
    };
    let costs: Vec<(String, Cost)> = studies.iter().flat_map(named).collect();
    let costs = costs.iter().map(|(scene, cost)| (scene.as_str(), cost));
    std::fs::write(out.join("costs.csv"), costs_csv(costs))?;
    for figure in studies.iter().flat_map(figures) {
        std::fs::write(out.join(&figure.name), &figure.svg)?;
    }
    std::fs::write(out.join("README.md"), readme(studies, &machine, AGAIN))?;
    std::fs::write(out.join("report.html"), page(studies, &machine))
}
