//! Checks that default functions meet their error bars on every spec: inverse dynamics, mass matrix and
//! forward dynamics against double-double, at random states and near aligned axes, in `f64`, and in `f32`
//! for up to eight joints.

use std::fs;
use std::path::{Path, PathBuf};

use crate::common::Robot;
use crate::common::bars::{Generated, all, driven, near_aligned};
use crate::common::rng::Rng;
use bgdyn_codegen::files::stem;

/// Largest number of joints for which `f32` has enough digits for every bar.
const SHORT: usize = 8;

fn check(robot: &Robot, name: &str, states: usize) {
    let generated = Generated::new(robot);
    let mut rng = Rng::new(23);
    for k in 0..states {
        let state = near_aligned(&mut rng, robot);
        for state in [driven(&state, &generated), state] {
            let what = format!("{name}, state {k}");
            all::<f64>(&what, &generated, &state, None);
            if robot.nv() <= SHORT {
                all::<f32>(&format!("{what}, f32"), &generated, &state, None);
            }
        }
    }
}

fn specs(folder: &str) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("..")
        .join(folder);
    let entries = fs::read_dir(folder).expect("a folder");
    let mut paths: Vec<PathBuf> = entries.map(|e| e.expect("an entry").path()).collect();
    paths.retain(|p| p.extension().is_some_and(|e| e == "yaml"));
    paths.sort();
    paths
}

#[test]
fn every_spec_meets_the_bars() {
    let mut seen = 0;
    for path in specs("specs")
        .into_iter()
        .chain(specs("tests/golden/specs"))
    {
        let text = fs::read_to_string(&path).expect("a spec");
        let name = stem(&path);
        let robot = Robot::read(&text, Some(&name));
        check(&robot, &name, if robot.nv() <= SHORT { 100 } else { 4 });
        seen += 1;
    }
    assert!(seen >= 24, "{seen}");
}
