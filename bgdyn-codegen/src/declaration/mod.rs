//! Declarations of effects: their kinds, keys, checks and names.
//!
//! Their equations are in [`crate::effect`].

mod called;
mod check;
mod declared;
mod element;
mod given;
mod joints;
mod kinds;
mod once;
mod refused;
mod scope;
mod series;

pub use called::{called, declared};
pub use declared::Declared;
pub use element::{Beside, Checked, Declaration, Element, Given, Quantity};
pub use joints::keys_declared;
pub use kinds::Kinds;
pub(crate) use once::once_per_joint;
pub use refused::Refused;
pub use scope::Context;
pub(crate) use scope::check_unique_names;
pub use series::Chain;
