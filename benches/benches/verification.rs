//! Measures what the comparison of the generated functions with equation (6) adds to the time of writing a
//! module: each module is written with the comparison and without it in turn, and the shortest of the
//! rounds counts.
//!
//! `cargo bench -p benches --bench verification -- panda` measures one file; all take a minute.

use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;

use bgdyn_codegen::build_script::Build;

/// Files that are measured, relative to the root of the repository.
const FILES: [&str; 8] = [
    "specs/scara.yaml",
    "specs/puma560.yaml",
    "specs/panda.yaml",
    "tests/golden/specs/chain32.yaml",
    "specs/scenes/stick_slip.scene.yaml",
    "specs/scenes/scara_everything.scene.yaml",
    "specs/scenes/puma_distributed.scene.yaml",
    "specs/scenes/ur5_contact.scene.yaml",
];
/// Number of rounds.
const ROUNDS: usize = 9;

fn main() -> ExitCode {
    let names = std::env::args().skip(1).filter(|a| !a.starts_with('-'));
    let names: Vec<String> = names.collect();
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    println!("| file | without, ms | with, ms | added |\n|---|---|---|---|");
    for file in FILES {
        if !names.is_empty() && !names.iter().any(|name| file.contains(name.as_str())) {
            continue;
        }
        match times(&root.join(file)) {
            Ok([without, with]) => {
                let added = 100.0 * (with / without - 1.0);
                println!("| `{file}` | {without:.1} | {with:.1} | {added:.1} % |");
            }
            Err(message) => {
                eprintln!("{message}");
                return ExitCode::FAILURE;
            }
        }
    }
    ExitCode::SUCCESS
}

/// Returns the times of writing the module of a file, ms: without the comparison, and with it.
fn times(file: &PathBuf) -> Result<[f64; 2], String> {
    let mut least = [f64::INFINITY; 2];
    for _ in 0..ROUNDS {
        for (verify, least) in [false, true].into_iter().zip(&mut least) {
            let build = Build::new(file).verify(verify);
            let begin = Instant::now();
            build.source().map_err(|error| error.to_string())?;
            *least = least.min(1e3 * begin.elapsed().as_secs_f64());
        }
    }
    Ok(least)
}
