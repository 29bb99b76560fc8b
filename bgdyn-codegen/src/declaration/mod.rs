//! Declarations of effects: their kinds, keys, checks and names.
//!
//! Their equations are in [`crate::effect`].

mod check;
mod declared;
mod each;
mod element;
mod given;
mod kinds;
mod lookup;
mod once;
mod parse;
mod refused;
mod scope;
mod series;

pub use declared::Declaration;
pub use each::{EachOf, keys_declared};
pub use element::{EffectKind, Element, ElementValue, Quantity, SceneContext, ValueCheck};
pub use kinds::EffectKinds;
pub(crate) use lookup::undeclared;
pub(crate) use once::once_per_joint;
pub(crate) use parse::TYPE;
pub use parse::{parse_declaration, resolve_call};
pub use refused::RejectedEffects;
pub use scope::NameScope;
pub(crate) use scope::check_unique_names;
pub use series::Chain;
