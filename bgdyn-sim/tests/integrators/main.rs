//! Tests integrators: orders, stability, energy, step control, events, failures.

mod controlled;
mod events;
mod failures;
mod order;
mod orders;
mod plants;
mod problems;
mod spaces;
mod stiff;
mod symplectic;
