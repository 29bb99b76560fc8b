//! Tests joints with several degrees of freedom and joints that follow others: golden values, laws of
//! mechanics, equal mechanisms written in two ways, the generator's own check, faults.

#[path = "../common/allocator.rs"]
mod allocator;

mod constraint_references;
mod constraints;
mod coupled_scenes;
mod equal;
mod faults_of_constraints;
mod faults_of_keys;
mod faults_of_mimic;
mod faults_of_names;
mod faults_of_prescribed;
mod findings;
mod followers;
#[allow(dead_code, reason = "shared with the tests of loops and contacts")]
mod free_bodies;
mod golden;
mod holds;
mod invariance;
mod joint_loads;
mod laws;
mod maker;
mod mimic;
mod moving_base;
mod noisy;
mod order;
mod orientation_springs;
mod prescribed;
mod prescribed_closed_forms;
mod prescribed_pair;
mod prescribed_scenes;
mod robot;
mod same_motion;
mod scenes;
mod specs;
mod tidy;
mod verified;
