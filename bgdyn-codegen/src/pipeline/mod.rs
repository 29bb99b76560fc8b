//! Runs the steps in order, from a spec's text to the tokens of its module.
//!
//! | file | from … to |
//! |---|---|
//! | `mechanism.rs` | a mechanism's text to its model and its tokens |
//! | `scene.rs` | a scene's text to its functions and its tokens |
//! | `any_file.rs` | the text of either |
//! | `backend_files.rs` | the text of either to the files of a backend |
//! | `stub.rs` | a refused text to a module that replaces the intended one |

mod any_file;
#[cfg(feature = "source")]
mod backend_files;
mod mechanism;
mod scene;
mod stub;

pub use any_file::generate_file;
#[cfg(feature = "source")]
pub use backend_files::{FilesError, generate_files};
pub use mechanism::{function, generate, model, verify};
pub use scene::scene_functions;
pub use stub::stub;
