//! Which function is generated for each method.
//!
//! | file | job |
//! |---|---|
//! | `choose.rs` | asks the formulations for their offers, makes the functions, takes one |
//! | `keep_digits.rs` | sorts candidates by cost among those that keep their digits |
//! | `most_accurate.rs` | the function that loses the fewest digits, whatever it costs |
//! | `prefer.rs` | takes the one or the other, after the last passes |
//!
//! Formulations know nothing of this: an [`Offer`](crate::formulation::Offer) is all that they say.

mod choose;
mod keep_digits;
mod most_accurate;
mod prefer;

pub use choose::Choice;
pub use prefer::{Preference, prefer};
