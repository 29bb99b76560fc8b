//! Times the macro for each spec, not optimised, as Cargo builds it for development: `cargo run --profile
//! plain -p bgdyn-codegen --example expansion -- specs/panda.yaml …` prints the shortest of five
//! expansions with the default methods, and with the derivatives.

use std::path::Path;
use std::process::ExitCode;
use std::time::{Duration, Instant};

use bgdyn_codegen::SpecText;
use bgdyn_codegen::emit::OutputOptions;
use bgdyn_codegen::files::stem;
use bgdyn_codegen::options::Options;
use bgdyn_codegen::pipeline::generate_module;

const PASSES: usize = 5;

fn expansion(text: &str, name: &str, options: &Options) -> Result<Duration, String> {
    let spec = SpecText::mechanism(text, name);
    let mut least = Duration::MAX;
    for _ in 0..PASSES {
        let start = Instant::now();
        let output = OutputOptions::source_text(String::new());
        generate_module(&spec, options, &output).map_err(|faults| format!("{faults:?}"))?;
        least = least.min(start.elapsed());
    }
    Ok(least)
}

fn main() -> ExitCode {
    let every = Options {
        derivatives: true,
        ..Options::default()
    };
    for path in std::env::args().skip(1) {
        let name = stem(Path::new(&path));
        let times = std::fs::read_to_string(&path)
            .map_err(|error| error.to_string())
            .and_then(|text| {
                let usual = expansion(&text, &name, &Options::default())?;
                Ok((usual, expansion(&text, &name, &every)?))
            });
        match times {
            Ok((usual, every)) => println!(
                "{name}: {:.2} s, with derivatives {:.2} s",
                usual.as_secs_f64(),
                every.as_secs_f64()
            ),
            Err(error) => {
                eprintln!("{path}: {error}");
                return ExitCode::FAILURE;
            }
        }
    }
    ExitCode::SUCCESS
}
