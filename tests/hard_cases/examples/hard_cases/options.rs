//! The command line: `--quick`, `--only PART`, `--out DIR`, `--help`.

use std::path::PathBuf;

use hard_cases::Extent;

/// The user's options.
pub struct Options {
    /// The extent of the run.
    pub extent: Extent,
    /// Only topics whose names contain this text.
    pub only: String,
    /// Folder of the tables and the figure.
    pub out: PathBuf,
}

/// How to call the example.
pub const USAGE: &str = "Hard cases through compiled code: what is measured, beside what is allowed

Usage: cargo run --release --example hard_cases [-- [--quick] [--only PART] [--out DIR]]

Options:
      --quick    Every case and every bar, with shorter horizons and fewer samples
      --only PART
                 Only topics whose names hold PART: `energy`, `limits`, `robots`, …
      --out DIR  Where to write the tables and the figure [default: target/hard_cases/]
  -h, --help     Print help

The last line says how many bars were met and missed; the exit code is 1 where one was missed.";

impl Options {
    /// Parses the arguments; `None` if help was requested and printed.
    pub fn parse(mut arguments: impl Iterator<Item = String>) -> Result<Option<Self>, String> {
        let mut options = Options {
            extent: Extent::Full,
            only: String::new(),
            out: PathBuf::from("target/hard_cases"),
        };
        while let Some(argument) = arguments.next() {
            match argument.as_str() {
                "-h" | "--help" => {
                    println!("{USAGE}");
                    return Ok(None);
                }
                "--quick" => options.extent = Extent::Quick,
                "--only" => match arguments.next() {
                    Some(part) => options.only = part,
                    None => return Err("`--only` needs a part of a topic's name".into()),
                },
                "--out" => match arguments.next() {
                    Some(folder) => options.out = PathBuf::from(folder),
                    None => return Err("`--out` needs a folder".into()),
                },
                other => match other.strip_prefix("--out=") {
                    Some(folder) => options.out = PathBuf::from(folder),
                    None => return Err(format!("unknown argument `{other}`")),
                },
            }
        }
        Ok(Some(options))
    }
}
