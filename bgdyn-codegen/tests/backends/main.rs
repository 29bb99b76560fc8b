//! The backends: what each of them says of itself, and that generated C has the evaluator's bits.

mod c_program;
mod controller;
mod counted;
mod list;
mod same_bits;
mod values;
