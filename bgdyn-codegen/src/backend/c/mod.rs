//! C99: a header and a source file, without heap, static variables, or a library but libm.

mod block;
mod context;
mod expression;
mod function;
mod header;
mod helpers;
mod parameters;
mod result;
mod sines;
mod source;
mod style;
mod tail;
mod words;

use super::contract::{Backend, BackendInput, GeneratedFile};
use super::given::{BackendError, BackendOption, GivenOptions};
use crate::plan::PlanLimits;
use style::Style;

/// The backend `c`.
pub(super) struct C99;

impl Backend for C99 {
    fn name(&self) -> &'static str {
        "c"
    }

    fn summary(&self) -> &'static str {
        "C99: a header and a source file"
    }

    fn options(&self) -> &'static [BackendOption] {
        const OPTIONS: [BackendOption; 3] = [
            BackendOption {
                name: "prefix",
                summary: "beginning of all names; by default the name of the mechanism",
            },
            BackendOption {
                name: "float",
                summary: "type of all numbers, `double` or `float`; by default `double`",
            },
            BackendOption {
                name: "sincos",
                summary: "sines of the file itself (`own`), with the bits of Rust's, or those of libm (`libm`); by default `own`",
            },
        ];
        &OPTIONS
    }

    fn limits(&self) -> PlanLimits {
        function::LIMITS
    }

    fn files(
        &self,
        input: &BackendInput<'_>,
        given: &GivenOptions,
    ) -> Result<Vec<GeneratedFile>, BackendError> {
        let BackendInput::Mechanism(model) = input else {
            let what = "the backend `c` writes mechanisms, no scenes: use the backend `rust`";
            return Err(BackendError::Unsupported(what.into()));
        };
        let style = Style::new(model.mechanism.name(), given)?;
        source::check_supported(model)?;
        let name = model.mechanism.name();
        let file = |ending: &str, text| GeneratedFile {
            name: format!("{name}.{ending}"),
            text,
        };
        let header = header::header(model, &style);
        let source = source::source(model, &style);
        Ok(vec![file("h", header), file("c", source)])
    }
}
