//! bgdyn for a page: requests and answers in JSON.
//!
//! ```text
//! page ──text──▶ door ──▶ call ──▶ request ──▶ answer ──▶ what the command uses: bgdyn-cli, bgdyn-codegen
//! ```
//!
//! `door.rs` is what WebAssembly exports, the only file that a page depends on; [`call`] is the same for Rust. An
//! answer has the numbers and the text of the command `bgdyn` for the same files.

mod answer;
mod door;
mod request;
mod run;

pub use request::call;
