//! `bgdyn graph`: draws the bond graph.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use clap::{Args, ValueEnum};

use crate::graph::Chart;
use crate::output::print;
use crate::spec_file::SpecFile;
use crate::usage::Usage;

/// Draw the bond graph
#[derive(Args)]
#[command(
    after_help = "Example:\n  bgdyn graph specs/scara.yaml -o scara.svg\n  bgdyn graph specs/scara.yaml --format dot | dot -Tpdf > scara.pdf\n\ndocs/graph.md explains how to read it."
)]
pub(crate) struct Graph {
    /// The mechanism or the scene
    file: PathBuf,
    /// Output file [default: stdout]
    #[arg(short, long)]
    output: Option<PathBuf>,
    /// Output format: SVG or Graphviz [default: from the extension of the output file, else SVG]
    #[arg(long, value_enum)]
    format: Option<DrawingFormat>,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum DrawingFormat {
    Svg,
    Dot,
}

impl Graph {
    pub(crate) fn run(self) -> Result<()> {
        let format = self.format()?;
        let spec = SpecFile::open(&self.file)?;
        let chart = match spec.is_scene() {
            true => Chart::of_scene(&spec.scene()?),
            false => Chart::new(&spec.mechanism()?),
        };
        let text = match format {
            DrawingFormat::Svg => chart.svg(),
            DrawingFormat::Dot => chart.dot(),
        };
        match &self.output {
            None => print(&text),
            Some(path) => std::fs::write(path, text)
                .with_context(|| format!("{} cannot be written", path.display())),
        }
    }

    /// Returns the selected format, or that of the output's name.
    fn format(&self) -> Result<DrawingFormat> {
        let ending = self.output.as_deref().and_then(Path::extension);
        let ending = ending.map(|e| e.to_string_lossy().to_lowercase());
        match (self.format, ending.as_deref()) {
            (Some(format), _) => Ok(format),
            (None, None | Some("svg")) => Ok(DrawingFormat::Svg),
            (None, Some("dot" | "gv")) => Ok(DrawingFormat::Dot),
            (None, Some(other)) => {
                let message = format!(
                    "`.{other}` is no format of drawings: end the name with .svg or .dot, or say --format svg or --format dot"
                );
                Err(Usage(message).into())
            }
        }
    }
}
