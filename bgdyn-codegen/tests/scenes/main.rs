//! Scenes through the evaluator: laws of every scene file and of scenes written here.

mod bench;
mod bodies;
mod causality;
mod combined;
mod common;
mod cylinders;
mod hydraulics;
mod laws;
mod refused;

use common::{read, specs};

/// Every scene of the repository holds the laws.
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
