//! The command line: `--out DIR` and `--help`.

use std::path::PathBuf;

/// The user's options.
pub struct Options {
    /// Folder of the plot.
    pub out: PathBuf,
}

/// Returns the usage text of the example.
pub fn usage(name: &str) -> String {
    format!(
        "A generated model under control: prints a report and draws a figure

Usage: cargo run --release -p controllers --example {name} [-- --out DIR]

Options:
      --out DIR  Where to write the plot [default: target/{name}/]
  -h, --help     Print help"
    )
}

impl Options {
    /// Parses the arguments; `None` if help was requested and printed.
    pub fn parse(
        name: &str,
        mut arguments: impl Iterator<Item = String>,
    ) -> Result<Option<Self>, String> {
        let mut out = PathBuf::from("target").join(name);
        while let Some(argument) = arguments.next() {
            match argument.as_str() {
                "-h" | "--help" => {
                    println!("{}", usage(name));
                    return Ok(None);
                }
                "--out" => match arguments.next() {
                    Some(folder) => out = PathBuf::from(folder),
                    None => return Err("`--out` needs a folder".into()),
                },
                other => match other.strip_prefix("--out=") {
                    Some(folder) => out = PathBuf::from(folder),
                    None => return Err(format!("unknown argument `{other}`")),
                },
            }
        }
        Ok(Some(Options { out }))
    }
}
