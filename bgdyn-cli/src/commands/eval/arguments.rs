//! The arguments and the printed results of `bgdyn eval`.

use std::path::PathBuf;

use anyhow::{Result, bail};
use clap::Args;
use serde::Serialize;
use serde_json::Value;

use super::states::Failure;
use crate::engine::EngineChoice;
use crate::output::print;
use crate::spec_file::Choice;

/// Evaluate a method at the states of a file, without a compiler
#[derive(Args)]
#[command(
    after_help = "Example:\n  bgdyn eval specs/scara.yaml inverse_dynamics --states states.json\n  bgdyn eval arm.yaml gravity --states states.json --parameter payload=2.5\n  bgdyn eval specs/scenes/stick_slip.scene.yaml derivative --states states.json\n\nstates.json: {\"states\": [{\"q\": [...], \"v\": [...], \"a\": [...], \"tau_in\": [...]}, ...]}\nfor a scene: {\"states\": [{\"y\": [...] or {\"shoulder\": 0.3, ...}, \"modes\", \"input\" or \"given\", \"acceleration\", \"t\"}, ...]}"
)]
pub(crate) struct Eval {
    /// The spec or the scene
    pub(super) file: PathBuf,
    /// The method, by its name in generated code; for a scene `derivative`, `power`, …
    pub(super) method: String,
    /// The states; fields that the method does not need are ignored
    #[arg(long, value_name = "STATES.json")]
    pub(super) states: PathBuf,
    #[command(flatten)]
    pub(super) choice: Choice,
    /// Set a run-time parameter, such as `payload=500 g` [default: the value in the spec]. May be repeated
    #[arg(long = "parameter", value_name = "NAME=VALUE")]
    pub(super) parameters: Vec<String>,
    #[command(flatten)]
    pub(super) engine: EngineChoice,
}

/// The printed report.
#[derive(Serialize)]
struct EvalReport<'a> {
    function: &'a str,
    /// Names of the parts of a scene's results.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    names: Vec<String>,
    /// One value per state; null if it failed.
    results: Vec<Value>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    errors: Vec<NoClosedForm>,
}

/// A state without a result.
#[derive(Serialize)]
struct NoClosedForm {
    state: usize,
    #[serde(flatten)]
    failure: Failure,
}

impl Eval {
    /// Prints the value at each state.
    pub(super) fn report(
        &self,
        names: Vec<String>,
        states: &[Value],
        value: impl Fn(&Value) -> Result<Value, Failure>,
    ) -> Result<()> {
        let mut report = EvalReport {
            function: &self.method,
            names,
            results: Vec::new(),
            errors: Vec::new(),
        };
        for (i, state) in states.iter().enumerate() {
            let value = value(state).unwrap_or_else(|failure| {
                report.errors.push(NoClosedForm { state: i, failure });
                Value::Null
            });
            report.results.push(value);
        }
        print(&(serde_json::to_string(&report)? + "\n"))?;
        match report.errors.len() {
            0 => Ok(()),
            failed => bail!("{failed} of {} states failed", states.len()),
        }
    }
}
