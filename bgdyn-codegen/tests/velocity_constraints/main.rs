//! Tests wheels, balls and knife edges: reference solutions, random mechanisms against the open tree with
//! multipliers, also with loops beside them, the generator's own check, counts, faults.

#[path = "../common/allocator.rs"]
mod allocator;

#[path = "../joints/findings.rs"]
#[allow(dead_code, reason = "shared with the tests of joints")]
mod findings;
#[path = "../loops/frame_rows.rs"]
#[allow(dead_code, reason = "shared with the tests of loops")]
mod frame_rows;
#[path = "../joints/free_bodies.rs"]
mod free_bodies;
#[path = "../joints/maker.rs"]
mod maker;
#[path = "../joints/motion_of_tree.rs"]
mod motion_of_tree;
#[path = "../joints/multiplier_system.rs"]
mod multiplier_system;
#[path = "../loops/random_loops.rs"]
#[allow(dead_code, reason = "shared with the tests of loops")]
mod random_loops;
#[path = "../joints/robot.rs"]
#[allow(dead_code, reason = "shared with the tests of joints")]
mod robot;
#[path = "../joints/turned_signs.rs"]
mod turned_signs;

mod beside_loops;
mod counts;
mod derivatives;
mod faults;
mod files;
mod free_bases;
mod multipliers;
mod planar_references;
mod random_mechanisms;
mod rattleback;
mod reactions;
mod slip_rows;
mod spatial_references;
mod starts;
mod verified;
