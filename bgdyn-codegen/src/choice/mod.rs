//! Chooses the function that is generated for each method.
//!
//! | file | job |
//! |---|---|
//! | `choose.rs` | collects the formulations' offers, creates the functions, chooses one |
//! | `graph_methods.rs` | the chosen functions of a scene's mechanism, each chosen once |
//! | `keep_digits.rs` | sorts candidates by cost among those that meet the error bounds |
//! | `most_accurate.rs` | chooses the function with the smallest error at any cost |
//! | `prefer.rs` | chooses by cost or by accuracy, after the last passes |
//!
//! Formulations are independent of this choice: they only state an [`Offer`](crate::formulation::Offer).

mod choose;
mod graph_methods;
mod keep_digits;
mod most_accurate;
mod prefer;

pub use choose::Choice;
pub use graph_methods::GraphMethods;
pub(crate) use prefer::preferred;
pub use prefer::{Preference, prefer};
