//! The backends: what each of them says of itself, and that generated C has the evaluator's bits.

#[path = "../common/allocator.rs"]
mod allocator;

mod assembled;
mod bundles;
mod c_program;
mod closed_mechanisms;
mod controller;
mod counted;
mod lanes;
mod list;
mod positions;
mod runtime_polygons;
mod runtime_positions;
mod same_bits;
mod scenes;
mod still;
mod undetermined;
mod values;
