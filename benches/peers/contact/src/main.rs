//! Runs of closed forms of contact, as lines of JSON: `contact CASE END MORE STEPS|TOLERANCE ...`.
//!
//! Each run goes to END in so many steps; then, where MORE is not 0, on by MORE s with the same step. A line has the numbers
//! by which `cases.py` compares systems, at END and behind it, and the shortest time to END, s, of repetitions
//! for PEERS_PATIENCE seconds, at least PEERS_REPEATS. Scenes are those of `tests/rigid_contact`, without account of energy.
//! `compliant` is a scene of its own, by `dopri5`.
#![forbid(unsafe_code)]

use std::hint::black_box;
use std::time::Instant;

use bgdyn::nalgebra::{Quaternion, SVector, UnitQuaternion, Vector3};
use bgdyn_runtime::{HybridSystem, Slope, StateVector};
use bgdyn_sim::{Dopri5, HybridState, Integrator, Moreau, Run, ScenePlant, Tolerance};

bgdyn::bgdyn!("../../../tests/rigid_contact/bounces.scene.yaml");
bgdyn::bgdyn!("../../../tests/rigid_contact/sticks.scene.yaml");
bgdyn::bgdyn!("../../../tests/rigid_contact/across.scene.yaml");
bgdyn::bgdyn!("../../../tests/rigid_contact/bowls.scene.yaml");
bgdyn::bgdyn!("../../../tests/rigid_contact/rolls.scene.yaml");
bgdyn::bgdyn!("../../../tests/rigid_contact/slips.scene.yaml");
bgdyn::bgdyn!("../../../tests/rigid_contact/rocks.scene.yaml");
bgdyn::bgdyn!("../../../specs/contact/quadruped_rigid.scene.yaml");
bgdyn::bgdyn!("bounces_compliant.scene.yaml");

/// Repetitions of a run at the most.
const MOST: usize = 2000;

/// What a run does.
struct Order {
    end: f64,
    more: f64,
    /// The number of steps to the end.
    steps: usize,
    /// Repetitions go on for this time, s, but are at least so many.
    patience: f64,
    repeats: usize,
}

/// Runs a plant as ordered, and prints a line. `begin` makes the run; `values` are the numbers of a state.
fn measure<P, M>(
    order: &Order,
    what: &str,
    begin: impl Fn() -> Run<P, M>,
    values: impl Fn(&P::State) -> Vec<f64>,
) where
    P: bgdyn_sim::Plant<State: StateVector<Scalar = f64>>,
    M: Integrator<P::State>,
{
    let h = order.end / order.steps as f64;
    let advance = |run: &mut Run<P, M>, steps: usize| {
        for _ in 0..steps {
            if run.step(h).is_err() {
                return false;
            }
        }
        true
    };
    let mut seconds = f64::INFINITY;
    let all = Instant::now();
    let mut run = begin();
    for repeat in 0..MOST {
        if repeat >= order.repeats && all.elapsed().as_secs_f64() > order.patience {
            break;
        }
        run = black_box(begin());
        let begun = Instant::now();
        assert!(advance(&mut run, order.steps), "{what}: it goes on");
        seconds = seconds.min(begun.elapsed().as_secs_f64());
        black_box(run.y());
    }
    let mut found = values(run.y());
    if order.more > 0.0 {
        let more = (order.more / h).round() as usize;
        assert!(advance(&mut run, more), "{what}: it goes on");
        found.extend(values(run.y()));
    }
    let found: Vec<String> = found.iter().map(|x| format!("{x:e}")).collect();
    let found = found.join(", ");
    println!("{{{what}, \"values\": [{found}], \"seconds\": {seconds:e}}}");
}

/// Runs a scene with rigid contacts from a changed start.
fn rigid<S: HybridSystem<f64> + Slope<f64>>(
    scene: &S,
    order: &Order,
    change: impl Fn(&mut S::State),
    values: impl Fn(&S::State) -> Vec<f64>,
) {
    let what = format!(
        "\"setting\": \"moreau\", \"steps\": {}, \"tolerance\": null",
        order.steps
    );
    let begin = || {
        let mut start: HybridState<_, _> = Run::begin(scene);
        change(&mut start.y);
        Run::by(Moreau::new(), ScenePlant::with_slope(scene), start).unaudited()
    };
    measure(order, &what, begin, values);
}

/// Runs a scene by `dopri5`, with a tolerance in place of a number of steps.
fn compliant<S: HybridSystem<f64>>(
    scene: &S,
    order: &Order,
    tolerance: f64,
    values: impl Fn(&S::State) -> Vec<f64>,
) {
    let what = format!("\"setting\": \"dopri5\", \"steps\": null, \"tolerance\": {tolerance:e}");
    let begin = || {
        Run::by(Dopri5, ScenePlant::new(scene), Run::begin(scene))
            .with_tolerance(Tolerance {
                absolute: tolerance,
                relative: tolerance,
            })
            .unaudited()
    };
    measure(order, &what, begin, values);
}

/// Position x, y and velocity x, y of a ball, in axes of the world.
fn ball(y: &SVector<f64, 13>) -> Vec<f64> {
    let turn = UnitQuaternion::from_quaternion(Quaternion::new(y[6], y[3], y[4], y[5]));
    let velocity = turn * Vector3::new(y[7], y[8], y[9]);
    vec![y[0], y[1], velocity.x, velocity.y]
}

/// Velocity x, z of a body in the plane, in axes of the world.
fn planar(y: &SVector<f64, 6>) -> Vec<f64> {
    let (sin, cos) = y[2].sin_cos();
    vec![cos * y[3] - sin * y[4], sin * y[3] + cos * y[4]]
}

/// Place of the quadruped's trunk, and its joints.
fn quadruped(y: &SVector<f64, 37>) -> Vec<f64> {
    let all = y.as_slice();
    [&all[..3], &all[7..19]].concat()
}

/// Puts the rocking block on its right corner, turned by 0.2 rad.
fn tilt(y: &mut SVector<f64, 6>) {
    let (alpha, size) = (0.1_f64.atan2(0.4), 0.1_f64.hypot(0.4));
    let tilt = 0.2;
    y[0] = 0.1 - size * (alpha - tilt).sin();
    y[1] = size * (alpha - tilt).cos();
    y[2] = -tilt;
}

/// A number that the environment may set.
fn setting(name: &str, otherwise: f64) -> f64 {
    let given = std::env::var(name).ok();
    given.and_then(|x| x.parse().ok()).unwrap_or(otherwise)
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let number = |k: usize| arguments.get(k).and_then(|x| x.parse::<f64>().ok());
    let (Some(end), Some(more), Some(_)) = (number(1), number(2), number(3)) else {
        eprintln!("usage: contact CASE END MORE STEPS|TOLERANCE ...");
        std::process::exit(2);
    };
    for given in (3..arguments.len()).filter_map(number) {
        let steps = (given as usize).max(1);
        let order = &Order {
            end,
            more,
            steps,
            patience: setting("PEERS_PATIENCE", 0.1),
            repeats: setting("PEERS_REPEATS", 3.0) as usize,
        };
        let as_it_is = |_: &mut SVector<f64, 6>| {};
        let place = |y: &SVector<f64, 6>| y.as_slice()[..3].to_vec();
        let velocity = |y: &SVector<f64, 6>| y.as_slice()[3..].to_vec();
        match arguments[0].as_str() {
            "bounces" => rigid(
                &bounces::Bounces::<f64>::default(),
                order,
                |_| {},
                |y| vec![y[2]],
            ),
            "sticks" => rigid(&sticks::Sticks::<f64>::default(), order, as_it_is, place),
            "across" => rigid(&across::Across::<f64>::default(), order, as_it_is, velocity),
            "bowls" => rigid(&bowls::Bowls::<f64>::default(), order, |_| {}, ball),
            "rolls" => rigid(&rolls::Rolls::<f64>::default(), order, as_it_is, planar),
            "slips" => rigid(&slips::Slips::<f64>::default(), order, as_it_is, planar),
            "rocks" => rigid(&rocks::Rocks::<f64>::default(), order, tilt, |y| vec![y[2]]),
            "stands" => {
                let scene = quadruped_rigid::QuadrupedRigid::<f64>::default();
                rigid(&scene, order, |_| {}, quadruped);
            }
            "compliant" => {
                let scene = bounces_compliant::BouncesCompliant::<f64>::default();
                compliant(&scene, order, given, |y| vec![y[2]]);
            }
            other => {
                eprintln!("no case {other}");
                std::process::exit(2);
            }
        }
    }
}
