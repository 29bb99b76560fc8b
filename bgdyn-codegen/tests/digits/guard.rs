//! Checks the price of accuracy in forward dynamics: arms of known geometry with random bodies take at
//! most 5 % more operations than the cheapest formulation, unless that one loses digits in states that the
//! generator did not sample.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use crate::common::Robot;
use crate::common::bars::{Generated, Hard, driven, near_aligned, part};
use crate::common::rng::Rng;
use bgdyn_codegen::function::Function;
use bgdyn_codegen::method::Method;
use bgdyn_codegen::passes::factor;

const METHOD: Method = Method::ForwardDynamics;

/// Largest accepted price without a gain in accuracy.
const PRICE: f64 = 1.05;

/// Number of random arms per geometry.
const BODIES: u64 = 12;

/// Geometries, relative to the package's folder.
const ARMS: [&str; 10] = [
    "tests/outside/rx90",
    "tests/outside/kr6",
    "tests/outside/offset_wrist",
    "tests/outside/general6r",
    "tests/outside/wam7",
    "../specs/puma560",
    "../specs/ur5",
    "../specs/panda",
    "../specs/scara",
    "../specs/stanford",
];

/// The spec with other bodies: masses, centres and tensors of all links replaced.
fn with_bodies(text: &str, rng: &mut Rng) -> String {
    let mut out = String::new();
    let mut inside = false;
    for line in text.lines() {
        let own = |key: &str| line.starts_with(&format!("    {key}:"));
        let begins = line.starts_with("  - name:");
        let ends = !line.is_empty() && !line.starts_with([' ', '#']);
        if inside && (begins || ends) {
            out += &body(rng);
        }
        inside = begins || (inside && !ends);
        if !["mass", "com", "inertia", "nonphysical"]
            .into_iter()
            .any(own)
        {
            out += line;
            out.push('\n');
        }
    }
    if inside {
        out += &body(rng);
    }
    out
}

/// Returns a body of four points of one mass, about a random centre: all its moments are different.
fn body(rng: &mut Rng) -> String {
    let mass = 0.2 + 8.0 * rng.unit();
    let com = [0; 3].map(|_| rng.within(0.15));
    let mut d = [[0.0; 3]; 3];
    for _ in 0..4 {
        let s = [0; 3].map(|_| rng.within(0.15));
        for (i, row) in d.iter_mut().enumerate() {
            for (j, entry) in row.iter_mut().enumerate() {
                *entry += mass / 4.0 * s[i] * s[j];
            }
        }
    }
    let (xx, yy, zz) = (d[1][1] + d[2][2], d[2][2] + d[0][0], d[0][0] + d[1][1]);
    let (xy, xz, yz) = (-d[0][1], -d[0][2], -d[1][2]);
    let mut text = format!("    mass: {mass:?}\n    com: {com:?}\n");
    writeln!(
        text,
        "    inertia: {{ xx: {xx:?}, yy: {yy:?}, zz: {zz:?}, xy: {xy:?}, xz: {xz:?}, yz: {yz:?} }}"
    )
    .expect("text takes it");
    text
}

/// An arm with the bodies of a seed.
fn arm(name: &str, seed: u64) -> Robot {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(name);
    let text = fs::read_to_string(path.with_extension("yaml")).expect("a spec");
    let stem = path.file_name().and_then(|stem| stem.to_str());
    Robot::read(&with_bodies(&text, &mut Rng::new(500 + seed)), stem)
}

/// Returns the formulations' functions, factored if the formulation permits it, the one with the fewest
/// operations first.
fn formulations(robot: &Robot) -> Vec<Function> {
    let names = ["recursion", "articulated_base", "articulated"];
    let mut all = names.map(|f| factor(robot.whole(f, METHOD))).to_vec();
    all.sort_by_key(|f| f.operations().total());
    all
}

/// Returns the largest ratio of a function's errors to bars 2 and 3.
fn used(robot: &Robot, f: &Function, states: usize) -> f64 {
    let generated = Generated::new(robot);
    let mut rng = Rng::new(23);
    let mut most = 0.0_f64;
    for _ in 0..states {
        let state = near_aligned(&mut rng, robot);
        for state in [driven(&state, &generated), state] {
            let (found, refused) = f.evaluate(state.inputs::<f64>());
            if refused.is_some() {
                return f64::INFINITY;
            }
            let hard = Hard::new::<f64>(&generated, &state, None);
            for bar in [
                hard.backward::<f64>(&found, &generated),
                hard.forward::<f64>(&found, &generated),
            ] {
                most = most.max(part(bar.measured, bar.allowed));
            }
        }
    }
    most
}

/// Returns whether the cheapest formulation loses more than a bit that the chosen one does not.
fn really_lost(robot: &Robot, cheapest: &Function, chosen: &Function) -> bool {
    let (cheap, dear) = (used(robot, cheapest, 400), used(robot, chosen, 400));
    println!("  the cheapest uses {cheap:.2} of the bars, the chosen one {dear:.2}");
    cheap > 1.0 && cheap > 2.0 * dear
}

#[test]
fn random_bodies_cost_no_more_unless_digits_are_lost() {
    let mut seen = 0;
    for name in ARMS {
        for seed in 0..BODIES {
            let robot = arm(name, seed);
            let chosen = robot.chosen(METHOD);
            let all = formulations(&robot);
            let (own, least) = (chosen.operations().total(), all[0].operations().total());
            let dear = own as f64 > PRICE * least as f64;
            assert!(
                !dear || really_lost(&robot, &all[0], &chosen),
                "{name}, bodies {seed}: {own} operations where {least} would do: {}",
                chosen.formulation
            );
            seen += 1;
        }
    }
    assert_eq!(seen, 10 * BODIES);
}

/// Of the specs as they are, by what the choice weighs: operations, divisions and sines together.
#[test]
fn specs_cost_no_more_unless_digits_are_lost() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../specs");
    let mut seen = 0;
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.extension().is_none_or(|ending| ending != "yaml") {
            continue;
        }
        let text = fs::read_to_string(&path).expect("a spec");
        let robot = Robot::read(&text, path.file_stem().and_then(|stem| stem.to_str()));
        let chosen = robot.chosen(METHOD);
        let mut all = formulations(&robot);
        all.sort_by_key(|f| f.cost().weighted());
        let (own, least) = (chosen.cost().weighted(), all[0].cost().weighted());
        let dear = own as f64 > PRICE * least as f64;
        assert!(
            !dear || really_lost(&robot, &all[0], &chosen),
            "{}: {own} where {least} would do: {}",
            path.display(),
            chosen.formulation
        );
        seen += 1;
    }
    assert!(seen > 10, "{seen}");
}

/// Bodies for which a sampled state exceeds the bars by every function, or by the cheapest one only, by
/// less than a bit: found among a hundred each.
#[test]
fn a_state_beyond_the_bars_buys_nothing() {
    for (name, seed) in [
        ("tests/outside/rx90", 39),
        ("tests/outside/kr6", 62),
        ("tests/outside/kr6", 66),
        ("tests/outside/offset_wrist", 8),
        ("tests/outside/general6r", 94),
    ] {
        let robot = arm(name, seed);
        let chosen = robot.chosen(METHOD);
        let text = &chosen.formulation;
        let least = formulations(&robot)[0].operations().total();
        let own = chosen.operations().total();
        assert!(own as f64 <= PRICE * least as f64, "{own}, {least}: {text}");
        assert!(text.starts_with("recursion: "), "{text}");
        assert!(
            text.contains("; no digit is lost; recursion: up to 1."),
            "{text}"
        );
    }
}
