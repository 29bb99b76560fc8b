//! Tests scenes with the evaluator: laws of every scene file and of scenes in the tests.

#[path = "../common/allocator.rs"]
mod allocator;

mod bench;
mod bodies;
mod causality;
mod combinations;
mod combined;
mod common;
mod constrained_contacts;
mod controller_model;
mod controllers;
mod cylinders;
mod drives;
mod dual;
mod evaluated;
mod forms;
mod friction;
mod hard_cases;
mod hydraulics;
mod input_slopes;
mod joints;
mod kinks;
mod laws;
mod lines;
mod motors;
mod one;
mod page;
mod profiles;
#[allow(dead_code)] // written for more than scenes
#[path = "../common/random.rs"]
mod random;
mod reference;
mod refused;
mod refused_bodies;
mod refused_contacts;
mod refused_fluids;
mod refused_names;
mod refused_phases;
#[allow(dead_code)]
#[path = "../common/rng.rs"]
mod rng;
mod rotors;
mod springs;
mod staged;
mod start;
mod stiction;
mod written;
mod zero;

use common::{read, specs};

/// Every scene of the repository satisfies the laws.
#[test]
fn the_scenes_of_the_repository_are_sound() {
    let mut count = 0;
    for path in specs() {
        let system = read(&path);
        laws::hold(&system);
        count += 1;
    }
    assert!(count > 0, "no scene found");
}
