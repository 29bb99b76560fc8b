//! The steps in order, from a spec's text to the tokens of its module.
//!
//! | file | from … to |
//! |---|---|
//! | `mechanism.rs` | a mechanism's text to its model and its tokens |
//! | `scene.rs` | a scene's text to its functions and its tokens |
//! | `any_file.rs` | the text of either |
//! | `fallback.rs` | a text that is refused to a module that replaces the one it would have given |

mod any_file;
mod fallback;
mod mechanism;
mod scene;

pub use any_file::generate_file;
pub use fallback::fallback;
pub use mechanism::{function, generate, model};
pub use scene::scene_functions;
