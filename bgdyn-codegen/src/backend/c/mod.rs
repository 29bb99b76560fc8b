//! C99: a header and a source file, without heap, static variables, or a library but libm.

mod assembly;
mod block;
mod bundle;
mod closing;
mod context;
mod difference;
mod expression;
mod files;
mod function;
mod helpers;
mod mechanism;
mod newton;
mod parameters;
mod polygon;
mod position_function;
mod positions;
mod result;
mod sample;
mod scene;
mod scene_result;
mod scene_tables;
mod sines;
mod style;
mod table;
mod tables;
mod tail;
mod undetermined;
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
        const OPTIONS: [BackendOption; 4] = [
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
            BackendOption {
                name: "cmake",
                summary: "`yes` for a file NAME.cmake with the library and its flags; by default `no`",
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
        let (style, files);
        match input {
            BackendInput::Mechanism(model) => {
                style = Style::new(model.mechanism.name(), given)?;
                files = mechanism::mechanism_files(model, &style);
            }
            BackendInput::Scene(system, functions) => {
                style = Style::new(&system.scene.name, given)?;
                files = scene::scene_files(system, functions, &style);
            }
        }
        let file = |ending: &str, text| GeneratedFile {
            name: format!("{}.{ending}", style.file),
            text,
        };
        let library = given.choice("cmake", &["no", "yes"])? == 1;
        let library = library.then(|| file("cmake", cmake(&style.file)));
        let both = [
            file("h", files.header(&style)),
            file("c", files.source(&style)),
        ];
        Ok(both.into_iter().chain(library).collect())
    }
}

/// Returns the CMake file of a library of the source file with this stem, with the flags of its bits.
fn cmake(stem: &str) -> String {
    format!(
        "add_library({stem} STATIC ${{CMAKE_CURRENT_LIST_DIR}}/{stem}.c)\n\
         target_include_directories({stem} PUBLIC ${{CMAKE_CURRENT_LIST_DIR}})\n\
         target_compile_options({stem} PRIVATE -std=c99 -ffp-contract=off)\n\
         target_link_libraries({stem} PUBLIC m)\n"
    )
}
