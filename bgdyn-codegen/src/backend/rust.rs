//! Rust: the source text of a module, for `include!`.

use super::contract::{Backend, BackendInput, GeneratedFile};
use super::given::{BackendError, BackendOption, GivenOptions};
use crate::emit::{self, OutputOptions, source_text};
use crate::plan::PlanLimits;

/// The backend `rust`.
pub(super) struct RustText;

impl Backend for RustText {
    fn name(&self) -> &'static str {
        "rust"
    }

    fn summary(&self) -> &'static str {
        "a Rust module, generic over the scalar type"
    }

    fn options(&self) -> &'static [BackendOption] {
        const OPTIONS: [BackendOption; 4] = [
            BackendOption {
                name: "module",
                summary: "name of the module; by default that of the file",
            },
            BackendOption {
                name: "visibility",
                summary: "visibility of the module; by default `pub`",
            },
            BackendOption {
                name: "crate",
                summary: "path of bgdyn in the crate that includes the file; by default `::bgdyn`",
            },
            BackendOption {
                name: "plain",
                summary: "`yes` for infix formulas, for reading and not for compiling; by default `no`",
            },
        ];
        &OPTIONS
    }

    fn limits(&self) -> PlanLimits {
        emit::LIMITS
    }

    fn files(
        &self,
        input: &BackendInput<'_>,
        given: &GivenOptions,
    ) -> Result<Vec<GeneratedFile>, BackendError> {
        let output = output_options(given)?;
        let (name, tokens) = match input {
            BackendInput::Mechanism(model) => {
                (model.mechanism.name(), emit::module(model, &output))
            }
            BackendInput::Scene(system, functions) => (
                system.scene.name.as_str(),
                emit::scene_module(system, functions, &output),
            ),
        };
        let name = output.module.as_deref().unwrap_or(name);
        Ok(vec![GeneratedFile {
            name: format!("{name}.rs"),
            text: source_text(tokens),
        }])
    }
}

fn output_options(given: &GivenOptions) -> Result<OutputOptions, BackendError> {
    let plain = given.choice("plain", &["no", "yes"])? == 1;
    let output = OutputOptions {
        plain,
        ..OutputOptions::source_text(given.source.clone())
    };
    let set = || {
        let output = match given.get("crate") {
            Some(path) => output.with_crate(path)?,
            None => output,
        };
        let output = match given.get("visibility") {
            Some(visibility) => output.with_visibility(visibility)?,
            None => output,
        };
        match given.get("module") {
            Some(module) => output.with_module(module),
            None => Ok(output),
        }
    };
    set().map_err(BackendError::Option)
}
