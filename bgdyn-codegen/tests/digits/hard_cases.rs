//! Tests default functions in single states that are hard to compute: long chains (condition numbers to
//! 7e7), a last link that is lighter or heavier by up to 1e12, angles to 1e12 rad, a base 1e9 m away.
//!
//! The data in `tests/hard_cases` are solutions in quadruple precision, found by two methods that
//! agree to 20 digits; the reference for a scalar with fewer digits than `f64` is the evaluator in
//! double-double, at the rounded arguments.

use crate::common::bars::{Generated, Hard, Reference, all, apart, fine, norm, off, rounded};
use crate::common::hard::{Chain, cases, list, robot};
use crate::common::rng::Rng;
use crate::common::{Robot, State};
use bgdyn_codegen::formulation::FORMULATIONS;
use bgdyn_codegen::function::Function;
use bgdyn_codegen::method::Method;
use serde_json::Value;

fn state_of(case: &Value) -> State {
    State {
        q: list(&case["q"]),
        v: list(&case["qd"]),
        a: list(&case["qdd"]),
        tau: list(&case["tau"]),
        parameters: Vec::new(),
    }
}

/// All bars in `f64`, and in `f32` for short chains.
fn check(case: &Value, what: &str, generated: &Generated) {
    let n = case["n"].as_u64().expect("n");
    let state = state_of(case);
    let exact = &state.a;
    let cond = case["cond_M"].as_f64();
    assert!(cond.is_some(), "a condition number");
    let expected = list(&case["h_bias"]);
    let rest = apart(&rounded(&generated.bias(&state)), &expected);
    let allowed = 2.0 * f64::EPSILON * norm(&expected);
    assert!(rest <= allowed, "{what}: {rest:e}, allowed {allowed:e}");
    let found = rounded(&fine(&generated.forward, &state));
    let (error, allowed) = (apart(&found, exact), 4.0 * f64::EPSILON * norm(exact));
    assert!(error <= allowed, "{what}: {error:e}, allowed {allowed:e}");
    all::<f64>(what, generated, &state, cond);
    if n <= 8 {
        all::<f32>(&format!("{what}, f32"), generated, &state, cond);
    }
}

#[test]
fn long_chains() {
    for planar in [true, false] {
        for links in [2, 4, 8, 16, 32, 64] {
            let generated = Generated::new(&robot(&Chain::rods(links, planar)));
            let kind = if planar {
                "planar y"
            } else {
                "3D alternating z,y"
            };
            let mut found = 0;
            for case in cases("static_chain_conditioning") {
                if case["n"] == links && case["chain"] == kind {
                    let what = format!("{kind}, {links} links, {}", case["config"]);
                    check(&case, &what, &generated);
                    found += 1;
                }
            }
            assert_eq!(found, 3, "{kind}, {links} links");
        }
    }
}

#[test]
fn light_and_heavy_last_links() {
    for case in cases("static_mass_ratio") {
        let links = case["n"].as_u64().expect("n") as usize;
        let last = case["mass_ratio_last"].as_f64().expect("a ratio");
        let chain = Chain::of_ratio(links, last);
        let what = format!("{links} links, the last {last:e} times the others");
        check(&case, &what, &Generated::new(&robot(&chain)));
    }
}

/// If efforts almost balance gravity, (16 + cond M) eps ‖q̈‖ cannot be reached: rounding the arguments
/// changes q̈ by more, and every known function has a larger error in `f64`.
#[test]
fn balanced_efforts_leave_fewer_digits() {
    let case = cases("static_chain_conditioning").into_iter().find(|case| {
        case["n"] == 2 && case["chain"] == "planar y" && case["config"] == "near_straight"
    });
    let case = case.expect("the case");
    let robot = robot(&Chain::rods(2, true));
    let generated = Generated::new(&robot);
    let state = state_of(&case);
    let cond = case["cond_M"].as_f64();
    let hard = Hard::new::<f64>(&generated, &state, cond);
    let exact = fine(&generated.forward, &state);
    let bar = hard.forward_bar::<f64>(&exact);
    let rounding = hard.rounding::<f64>(&generated);
    assert!(rounding > bar, "{rounding:e}, the bar {bar:e}");
    for formulation in FORMULATIONS {
        let forward = robot.function(formulation.name(), Method::ForwardDynamics);
        let found: Vec<f64> = hard.state.value(&forward);
        let error = norm(&off(&found, &fine(&forward, &hard.state)));
        assert!(
            error > bar,
            "{}: {error:e}, the bar {bar:e}",
            formulation.name()
        );
        assert!(
            error <= rounding,
            "{}: {error:e}, rounding {rounding:e}",
            formulation.name()
        );
    }
}

/// Inverse dynamics at angles up to 1e12 rad: 16 eps, also where axes are parallel and angles are
/// added.
#[test]
fn large_angles() {
    let generated = Generated::new(&robot(&Chain::rods(4, false)));
    let parallel = Generated::new(&robot(&Chain::rods(4, true)));
    for case in cases("static_large_angles") {
        let state = State {
            q: list(&case["q"]),
            v: list(&case["qd"]),
            a: list(&case["qdd"]),
            tau: vec![0.0; 4],
            parameters: Vec::new(),
        };
        let scale = &case["angle_scale"];
        let expected = list(&case["tau"]);
        let bar = 16.0 * f64::EPSILON * norm(&expected);
        let found: Vec<f64> = state.value(&generated.inverse);
        let off = apart(&found, &expected);
        assert!(off <= bar, "{scale}: {off:e}, allowed {bar:e}");
        let found: Vec<f64> = state.value(&parallel.inverse);
        let exact = rounded(&fine(&parallel.inverse, &state));
        let (off, bar) = (apart(&found, &exact), 16.0 * f64::EPSILON * norm(&exact));
        assert!(off <= bar, "parallel, {scale}: {off:e}, allowed {bar:e}");
    }
}

/// For any position of the base, up to 1e9 m from the world's origin: inverse and forward dynamics, mass
/// matrix, derivatives are the same bit for bit, and so are the functions.
#[test]
fn moved_base() {
    for (name, first, parts) in [
        (
            "scara",
            "origin: { xyz: [0, 0, 400 mm] }",
            "origin: { xyz: [X, Y, Z] }",
        ),
        (
            "torso",
            "origin: { xyz: [0, 0, 0.9] }",
            "origin: { xyz: [X, Y, Z] }",
        ),
        (
            "panda",
            "origin: { xyz: [0, 0, 0.333] }",
            "origin: { xyz: [X, Y, Z] }",
        ),
        (
            "puma560",
            "name: waist\n",
            "name: waist\n      origin: { xyz: [X, Y, Z] }\n",
        ),
    ] {
        let file = format!("{}/../specs/{name}.yaml", env!("CARGO_MANIFEST_DIR"));
        let text = std::fs::read_to_string(file).expect("a spec");
        assert_eq!(text.matches(first).count(), 1, "{name}");
        let at = |[x, y, z]: [&str; 3]| {
            let moved = parts.replace('X', x).replace('Y', y).replace('Z', z);
            Robot::read(&text.replace(first, &moved), Some(name))
        };
        let here = at(["0", "0", "0"]);
        let mut rng = Rng::new(29);
        let motions = here.motions();
        let states: Vec<State> = (0..20).map(|_| State::random(&mut rng, &motions)).collect();
        for base in [
            ["1e3", "-1e3", "7"],
            ["0.1", "1e6", "-1e6"],
            ["1e9", "-3e8", "1e9"],
        ] {
            let there = at(base);
            for method in [
                Method::InverseDynamics,
                Method::MassMatrix,
                Method::ForwardDynamics,
                Method::InverseDynamicsDerivatives,
            ] {
                let (one, other) = (here.chosen(method), there.chosen(method));
                let what = format!("{name}, {method:?}, {base:?}");
                assert_eq!(one.operations(), other.operations(), "{what}");
                for state in &states {
                    let bits = |f: &Function| -> Vec<u64> {
                        let found: Vec<f64> = state.value(f);
                        found.into_iter().map(f64::to_bits).collect()
                    };
                    assert_eq!(bits(&one), bits(&other), "{what}");
                }
            }
        }
    }
}
