//! Converts a URDF, an MJCF or a table of Denavit–Hartenberg parameters to the text of a mechanism.

use std::path::PathBuf;

use bgdyn_cli::import::{Import, Options, import_table, import_with};
use bgdyn_cli::spec_file::SpecFile;
use pyo3::prelude::*;

use crate::errors::spec_error;

/// Returns the text of the mechanism, its name, and lines about what was left out or is doubtful.
#[pyfunction]
pub fn import_file(py: Python<'_>, path: PathBuf) -> PyResult<(String, String, Vec<String>)> {
    let shown = path.display().to_string();
    let made = py.detach(|| made(path));
    match made {
        Ok(made) => Ok((made.yaml, made.name, made.warnings)),
        Err(error) => {
            let text = error.to_string();
            // Some messages begin with the path, others with a position in the file, which follows it without a space.
            Err(spec_error(
                py,
                &match text {
                    _ if text.starts_with(&shown) => text,
                    _ if text.starts_with(|c: char| c.is_ascii_digit()) => {
                        format!("{shown}:{text}")
                    }
                    _ => format!("{shown}: {text}"),
                },
            ))
        }
    }
}

fn made(path: PathBuf) -> anyhow::Result<Import> {
    let file = SpecFile::read_any(&path)?;
    let options = Options {
        folder: path.parent().map(Into::into),
        ..Options::default()
    };
    let table = path
        .extension()
        .is_some_and(|e| e.eq_ignore_ascii_case("csv"));
    match table {
        true => import_table(&file.text, &file.stem, None, &options),
        false => import_with(&file.text, &options),
    }
}
