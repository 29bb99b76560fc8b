//! Requests and answers as JSON.

use std::path::Path;

use bgdyn_cli::spec_file::{SpecFile, written_name};
use serde::Deserialize;
use serde_json::{Value, json};

use crate::answer;
use crate::run;

/// What a page asks for.
#[derive(Deserialize)]
#[serde(tag = "command", rename_all = "snake_case", deny_unknown_fields)]
enum Request {
    /// Findings, and the sizes of what was read.
    Check { file: File },
    /// The bond graph as SVG.
    Graph { file: File },
    /// Efforts in closed form, with at most `limit` terms.
    Equations { file: File, limit: usize },
    /// Operations of each function.
    Counts { file: File },
    /// Generated source text.
    Code { file: File, backend: String },
    /// A run of a scene.
    Run { file: File },
    /// The JSON Schemas of the two formats.
    Schemas,
}

/// A file of the page.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    /// Its name, with its ending.
    name: String,
    /// Its text.
    text: String,
    /// Of a scene: the text of its mechanism, whatever path the scene has for it.
    mechanism: Option<String>,
}

impl File {
    /// A name in the text counts as that of the file, as for standard input.
    fn read(self) -> SpecFile {
        let stem = || bgdyn_codegen::files::stem(Path::new(&self.name));
        SpecFile {
            stem: written_name(&self.text).unwrap_or_else(stem),
            path: self.name.into(),
            text: self.text,
            mechanism: self.mechanism,
        }
    }
}

/// Answers a request: `{"ok": …}`, or `{"error": "why"}`. `watch` receives the finished fraction of a run.
pub fn call(request: &str, watch: &mut dyn FnMut(f64)) -> String {
    let answer = match serde_json::from_str(request) {
        Ok(request) => respond(request, watch),
        Err(error) => Err(format!("this is no request: {error}")),
    };
    match answer {
        Ok(value) => json!({ "ok": value }),
        Err(message) => json!({ "error": message }),
    }
    .to_string()
}

fn respond(request: Request, watch: &mut dyn FnMut(f64)) -> Result<Value, String> {
    match request {
        Request::Check { file } => Ok(answer::check(&file.read())),
        Request::Graph { file } => answer::graph(&file.read()),
        Request::Equations { file, limit } => answer::equations(&file.read(), limit),
        Request::Counts { file } => answer::counts(&file.read()),
        Request::Code { file, backend } => answer::code(&file.read(), &backend),
        Request::Run { file } => run::run(&file.read(), watch),
        Request::Schemas => Ok(answer::schemas()),
    }
}
