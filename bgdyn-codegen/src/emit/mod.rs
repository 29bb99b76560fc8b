//! The emitter: converts a model to the tokens of a Rust module, without knowledge of physics.

mod actuated;
mod assembly;
mod base_access;
mod body;
mod bundles;
mod closed_positions;
mod closure;
mod code;
mod columns;
mod constants;
mod contacts;
mod explain;
mod joint_access;
mod joint_by_joint;
mod legend;
mod module;
mod operand;
mod operation;
mod output_options;
mod polygon_closing;
mod prescribed;
mod products;
mod reactions;
mod scene;
mod sines;
#[cfg(feature = "source")]
mod source_text;
mod statements;
mod store;
mod stub;
mod tokens;
mod traits;
mod writer;

pub use body::LIMITS;
pub use module::module;
pub use output_options::OutputOptions;
pub use scene::{scene_module, scene_stub};
#[cfg(feature = "source")]
pub use source_text::source_text;
pub use stub::stub;
pub use tokens::struct_ident;
