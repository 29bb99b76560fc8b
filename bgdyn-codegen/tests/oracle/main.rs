//! Compares spatial scenes with several effects with an independent oracle: a plain Newton–Euler algorithm
//! in world axes, M from unit accelerations, and each effect's law as on its page. The oracle parses the
//! files itself and shares only the double-double numbers with the generator.

#[allow(dead_code)] // written for more than this
#[path = "../scenes/common.rs"]
mod common;
mod compare;
mod contact;
mod contact_law;
mod draft;
mod hydraulics;
mod laws;
mod mechanism;
#[allow(dead_code)]
#[path = "../common/random.rs"]
mod random;
mod readings;
#[allow(dead_code)]
#[path = "../common/rng.rs"]
mod rng;
mod scene;
mod state;
mod states;
mod touches;
mod tree;
mod vector;
mod yaml;

use std::collections::BTreeMap;

use common::{told, try_scene};
use compare::{Depth, Pair, Worst};
use rng::Rng;

/// Number of scenes in every run of the tests, and in a long one.
const FEW: u64 = 24;
const MANY: u64 = 1000;

fn agree(seeds: std::ops::Range<u64>, depth: impl Fn(u64) -> Depth) {
    let (mut worst, mut kinds) = (Worst::default(), BTreeMap::<String, usize>::new());
    for seed in seeds {
        let mut rng = Rng::new(90_000 + seed);
        let written = draft::written(&mut rng);
        let system = match try_scene(&written.scene, &written.mechanism) {
            Ok((system, _)) => system,
            Err(refusal) => {
                let text = told(&refusal, &written.scene);
                panic!(
                    "seed {seed}: {text}\n{}{}",
                    written.mechanism, written.scene
                );
            }
        };
        let pair = Pair::new(written, system, depth(seed));
        for e in &pair.oracle.effects {
            let kinds_of_it = contact_law::kinds(e, &pair.oracle.mechanism);
            for kind in kinds_of_it.into_iter().chain([e.kind().to_owned()]) {
                *kinds.entry(kind).or_default() += 1;
            }
        }
        if let Err(difference) = pair.compare(&mut rng, &mut worst) {
            panic!("seed {seed}: {difference}");
        }
        // Correct functions are not refused.
        if let Some(refused) = pair.refused() {
            panic!("seed {seed}: {refused}\n{}", pair.written.scene);
        }
    }
    println!("{worst:?}\n{kinds:?}");
    // Every effect that the oracle knows occurred.
    for kind in KINDS {
        assert!(kinds.contains_key(*kind), "no {kind} was tried");
    }
}

const KINDS: &[&str] = &[
    "viscous",
    "coulomb",
    "coulomb_smooth",
    "stribeck",
    "lugre",
    "spring",
    "damper",
    "stop",
    "series_elastic",
    "gear",
    "rotor",
    "dc_motor",
    "wrench",
    "drag",
    "payload",
    "cylinder",
    "orifice",
    "leakage",
    "four_way_valve",
    "line",
    "compliant_contact",
    "contact of a point",
    "contact of a sphere",
    "contact of a capsule",
    "contact of a box",
    "contact with the ground",
    "contact with a plane of the world",
    "contact with a plane of a link",
    "contact with a sphere",
    "contact without friction",
    "contact with smooth friction",
    "contact with bristles",
    "contact with a static coefficient",
    "contact with damping",
    "contact with a restitution",
    "contact with a parameter",
];

#[test]
fn random_scenes_move_as_the_oracle_says() {
    agree(0..FEW, Depth::Part);
}

#[test]
#[ignore = "minutes: part of .ci/long"]
fn many_random_scenes_move_as_the_oracle_says() {
    agree(FEW..FEW + MANY, |_| Depth::Whole);
}
