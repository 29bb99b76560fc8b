//! Tests choices by accuracy: forward dynamics that meets its bars, and `prefer: accuracy`. Functions
//! chosen at the generator's states must be better at other states.

use crate::common::bars::near_aligned;
use crate::common::hard::Chain;
use crate::common::rng::Rng;
use crate::common::{Robot, State, largest};
use bgdyn_codegen::conditioning::rounding_error::{RoundingError, rounding_error};
use bgdyn_codegen::formulation::{FORMULATIONS, Formulation};
use bgdyn_codegen::function::Function;
use bgdyn_codegen::method::Method;
use bgdyn_codegen::options::{Options, Preference, preference_named};
use bgdyn_codegen::selection;
use bgdyn_runtime::Dd;

fn accurate(robot: &Robot, method: Method) -> Function {
    accurate_by(robot, method, None)
}

/// Returns the most accurate function by one formulation, or by any.
fn accurate_by(robot: &Robot, method: Method, by: Option<&'static dyn Formulation>) -> Function {
    let options = Options {
        prefer: Preference::Accuracy,
        formulation: by,
        ..Options::default()
    };
    selection::function(&robot.mechanism, method, &options)
        .unwrap_or_else(|| panic!("no function of {method:?}"))
}

/// The worst error of a function over many random states, in roundings of the largest component.
fn worst(robot: &Robot, f: &Function, seed: u64) -> f64 {
    let mut rng = Rng::new(seed);
    let mut worst = 0.0_f64;
    for _ in 0..400 {
        let s = near_aligned(&mut rng, robot);
        let (exact, found): (Vec<Dd>, Vec<f64>) = (s.value(f), s.value(f));
        let off: Vec<f64> = exact
            .iter()
            .zip(&found)
            .map(|(x, &y)| (*x - Dd::from_f64(y)).to_f64())
            .collect();
        let exact: Vec<f64> = exact.iter().map(|x| x.to_f64()).collect();
        worst = worst.max(largest(&off) / largest(&exact) / f64::EPSILON);
    }
    worst
}

fn heavy(last: f64) -> Robot {
    crate::common::hard::robot(&Chain::of_ratio(6, last))
}

/// Errors are measured at states with every argument.
#[test]
fn every_method_has_a_most_accurate_function() {
    let robot = crate::common::golden::robot("scara4");
    let methods = Method::possible_of(robot.graph);
    assert!(methods.len() > 30);
    for method in methods {
        let function = accurate(&robot, method);
        assert!(function.output_count() > 0, "{}", function.name());
    }
}

/// A gimbal with light rings: if its first and last axis coincide, only the rings have inertia.
fn gimbal(ring: &str) -> Robot {
    let ring = format!("inertia: {{ xx: {ring}, yy: {ring}, zz: {ring} }}");
    let text = format!(
        "
format: 1
name: gimbal
links:
  - name: outer
    joint: {{ name: yaw, type: revolute, axis: z }}
    {ring}
  - name: inner
    parent: outer
    joint: {{ name: pitch, type: revolute, axis: y }}
    {ring}
  - name: rotor
    parent: inner
    joint: {{ name: roll, type: revolute, axis: z }}
    mass: 1
    inertia: {{ xx: 1, yy: 1, zz: 1.2 }}
"
    );
    Robot::read(&text, None)
}

/// Every own inertia ratio is large enough; the sampled states decide which function is accurate.
#[test]
fn states_decide_where_shares_do_not() {
    let method = Method::ForwardDynamics;
    for (robot, way, better) in [
        (gimbal("1e-5"), "articulated_base: ", 1000.0),
        (heavy(1e4), "articulated: ", 4.0),
    ] {
        let chosen = robot.chosen(method);
        let text = &chosen.formulation;
        assert!(text.starts_with(way), "{text}");
        assert!(text.contains("; recursion: up to "), "{text}");
        let other = robot.function("recursion", method);
        let (ours, theirs) = (worst(&robot, &chosen, 12), worst(&robot, &other, 12));
        assert!(ours * better < theirs, "{ours} against {theirs}");
    }
    for (robot, way) in [
        (gimbal("0.1"), "articulated_base: "),
        (heavy(100.0), "recursion: "),
    ] {
        let text = robot.chosen(method).formulation;
        assert!(text.starts_with(way) && !text.contains(" up to "), "{text}");
    }
}

/// A light arm whose heavy load is on the shoulder's axis when it is folded: the shoulder then moves
/// almost no inertia, the elbow far more. No function meets the bars.
#[test]
fn the_least_evil_is_told() {
    let robot = Robot::read(
        "
format: 1
name: folding
links:
  - name: upper_arm
    joint: { name: shoulder, type: revolute, axis: z }
    mass: 0.001
    inertia: { xx: 1e-5, yy: 1e-5, zz: 1e-5 }
  - name: forearm
    parent: upper_arm
    joint: { name: elbow, type: revolute, axis: z, origin: { xyz: [1, 0, 0] } }
    mass: 10
    com: [1, 0, 0]
    inertia: { xx: 1e-5, yy: 1e-5, zz: 1e-5 }
",
        None,
    );
    let text = robot.chosen(Method::ForwardDynamics).formulation;
    for way in ["recursion", "articulated_base", "articulated"] {
        assert!(text.contains(&format!("; {way}: up to ")), "{text}");
    }
    assert!(text.starts_with("articulated"), "{text}");
}

/// Base parameters and factored sums lose digits.
#[test]
fn accuracy_is_better_at_other_states() {
    let golden = crate::common::golden::robot;
    for (robot, method, better) in [
        (heavy(1e3), Method::ForwardDynamics, 1.8),
        (golden("panda_gen"), Method::ForwardDynamics, 3.0),
        (golden("puma560"), Method::InverseDynamics, 1.3),
    ] {
        let (cheap, fine) = (robot.chosen(method), accurate(&robot, method));
        let (before, after) = (worst(&robot, &cheap, 5), worst(&robot, &fine, 5));
        assert!(
            after * better < before,
            "{method:?}: {before} against {after}"
        );
    }
}

/// No function loses fewer digits at the sampled states, and all functions give the same result.
#[test]
fn accuracy_is_the_best_of_all() {
    for name in ["scara4", "puma560", "dpend2"] {
        let robot = crate::common::golden::robot(name);
        let measured = |f: &Function| rounding_error(f, robot.graph).expect("regular states");
        let s = State::random(&mut Rng::new(3), &robot.motions());
        for method in Method::OF_TRAIT {
            let literal: Vec<Dd> = s.value(&robot.function("literal", method));
            let fine = accurate(&robot, method);
            let RoundingError { failures, ulps } = measured(&fine);
            assert_eq!(failures, 0);
            for way in FORMULATIONS.into_iter().filter(|way| way.knows(method)) {
                let function = accurate_by(&robot, method, Some(way));
                let other = measured(&function);
                let place = format!("{name}, {method:?}, {}", way.name());
                crate::common::assert_close::<Dd>(&s.value(&function), &literal, 1e-24, || {
                    place.clone()
                });
                // Within a tenth of a rounding.
                assert!(ulps <= other.ulps + 0.1, "{place}");
            }
            let x: Vec<Dd> = s.value(&fine);
            crate::common::assert_close(&x, &literal, 1e-24, || format!("{name}, {method:?}"));
        }
    }
}

#[test]
fn operations_are_what_is_preferred_otherwise() {
    assert_eq!(preference_named("accuracy"), Ok(Preference::Accuracy));
    assert_eq!(preference_named("operations"), Ok(Preference::default()));
    let message = preference_named("acuracy").expect_err("no such preference");
    assert_eq!(
        message,
        "no preference is called `acuracy`: did you mean `accuracy`?"
    );
    let message = preference_named("speed").expect_err("no such preference");
    assert_eq!(
        message,
        "no preference is called `speed`; there are operations, accuracy"
    );
}

/// A selected formulation is used; accuracy chooses its variant, and the formulations of other methods.
#[test]
fn a_formulation_asked_for_is_taken() {
    let robot = crate::common::golden::robot("puma560");
    let options = Options {
        prefer: Preference::Accuracy,
        formulation: bgdyn_codegen::formulation::by_name("articulated_base"),
        ..Options::default()
    };
    let of = |method| selection::function(&robot.mechanism, method, &options).expect("known");
    let forward = of(Method::ForwardDynamics).formulation;
    assert!(forward.starts_with("articulated_base: "), "{forward}");
    let inverse = of(Method::InverseDynamics).formulation;
    assert_eq!(
        inverse,
        accurate(&robot, Method::InverseDynamics).formulation
    );
}
