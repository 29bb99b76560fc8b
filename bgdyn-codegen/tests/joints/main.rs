//! Tests joints with several degrees of freedom and joints that mimic others: golden values, laws of
//! mechanics, equal mechanisms written in two ways, the generator's own check, faults.

mod equal;
mod faults;
mod golden;
mod invariance;
mod laws;
mod mimic;
mod robot;
mod specs;
mod verified;
