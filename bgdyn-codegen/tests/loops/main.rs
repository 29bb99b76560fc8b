//! Tests mechanisms with loops: reference solutions with multipliers, random loops against the open tree with
//! multipliers, the generator's own check, faults.

#[path = "../common/allocator.rs"]
mod allocator;

#[path = "../joints/free_bodies.rs"]
mod free_bodies;
#[path = "../joints/maker.rs"]
mod maker;
#[path = "../joints/motion_of_tree.rs"]
mod motion_of_tree;
#[path = "../joints/multiplier_system.rs"]
mod multiplier_system;
#[path = "../joints/robot.rs"]
#[allow(dead_code, reason = "shared with the tests of joints")]
mod robot;
#[path = "../joints/turned_signs.rs"]
mod turned_signs;

#[path = "../joints/findings.rs"]
#[allow(dead_code, reason = "shared with the tests of joints")]
mod findings;

mod actuated;
mod actuated_positions;
mod branches;
mod closed_form;
mod counts;
mod drawn;
mod driven_loads;
mod faults;
mod followed;
mod frame_rows;
mod free_body_cases;
mod locks;
mod multipliers;
mod open_tree;
mod parallel;
mod parallel_faults;
mod random_dyads;
mod random_loops;
mod rank;
mod reactions;
mod references;
mod scenes;
mod several_velocities;
mod specs;
mod starts;
mod verified;
