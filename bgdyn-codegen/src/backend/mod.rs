//! The backends: each writes files in a language from a mechanism or a scene. One folder or file, and one line here.

mod c;
mod contract;
mod given;
mod rust;

pub use contract::{Backend, BackendInput, FilesError, GeneratedFile};
pub use given::{BackendError, BackendOption, GivenOptions};

/// All backends; the first one is the default.
pub static BACKENDS: [&dyn Backend; 2] = [&rust::RustText, &c::C99];

/// Returns the backend of this name.
///
/// # Errors
/// The names that exist, if this one does not.
pub fn backend_named(name: &str) -> Result<&'static dyn Backend, String> {
    let found = BACKENDS.iter().find(|backend| backend.name() == name);
    let names = || BACKENDS.map(|backend| format!("`{}`", backend.name()));
    found.copied().ok_or_else(|| {
        let names = names().join(", ");
        format!("there is no backend `{name}`: choose one of {names}")
    })
}
