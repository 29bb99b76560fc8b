//! Runs of an arm that falls, as lines of JSON: `simulate SCENE HOW STEPS|TOLERANCE ...`.
//!
//! SCENE is `viscous` or `friction`. HOW is `rk4`, with so many steps; `dopri5` or `dop853`, with a tolerance; `lanes`, `rk4` from
//! 8 states at once; or `cores`, lanes on all cores. A line has the positions at the end, and the shortest time for a simulated
//! second of one state, s, of repetitions for PEERS_PATIENCE seconds.
#![forbid(unsafe_code)]

use std::hint::black_box;
use std::time::Instant;

use bgdyn::nalgebra::SVector;
use bgdyn::runtime::HybridSystem;
use bgdyn::runtime::wide::f64x8;
use bgdyn_sim::batch::{batch, cores};
use bgdyn_sim::lanes::{LaneError, LaneRun, SmoothScene, packed, unpacked};
use bgdyn_sim::{Dop853, Dopri5, Integrator, Rk4, Run, ScenePlant, Tolerance};

bgdyn::bgdyn!("panda_viscous.scene.yaml");
bgdyn::bgdyn!("panda_friction.scene.yaml");

/// The end of every run, s.
const END: f64 = 2.0;
/// Groups of 8 states for each core.
const GROUPS: usize = 8;

type State<T> = SVector<T, 14>;

/// A scene of the arm.
trait Scene: HybridSystem<f64, State = State<f64>> + Default {}
impl<S: HybridSystem<f64, State = State<f64>> + Default> Scene for S {}

/// The same scene in lanes.
trait LaneScene:
    HybridSystem<f64x8, State = State<f64x8>, Modes = SVector<f64x8, 0>, Singular: LaneError<f64x8>>
    + Default
{
}
impl<S> LaneScene for S where
    S: HybridSystem<
            f64x8,
            State = State<f64x8>,
            Modes = SVector<f64x8, 0>,
            Singular: LaneError<f64x8>,
        > + Default
{
}

/// Returns the last result and the shortest time of repetitions of some work.
fn shortest<R>(patience: f64, mut work: impl FnMut() -> R) -> (R, f64) {
    let all = Instant::now();
    let mut best = f64::INFINITY;
    loop {
        let begun = Instant::now();
        let result = black_box(work());
        best = best.min(begun.elapsed().as_secs_f64());
        if all.elapsed().as_secs_f64() > patience {
            return (result, best);
        }
    }
}

/// Runs one state in fixed steps; NaN where it cannot go on.
fn fixed<S: Scene>(steps: usize) -> State<f64> {
    let scene = S::default();
    let begin = black_box(Run::begin(&scene));
    let mut run = Run::by(Rk4, ScenePlant::new(&scene), begin).unaudited();
    for _ in 0..steps {
        if run.step(END / steps as f64).is_err() {
            return State::repeat(f64::NAN);
        }
    }
    *run.y()
}

/// Runs one state with a tolerance.
fn controlled<S: Scene, M: Integrator<State<f64>>>(method: M, tolerance: f64) -> State<f64> {
    let scene = S::default();
    let tolerance = Tolerance {
        absolute: tolerance,
        relative: tolerance,
    };
    let run = Run::by(
        method,
        ScenePlant::new(&scene),
        black_box(Run::begin(&scene)),
    );
    let mut run = run.with_tolerance(tolerance).unaudited();
    run.step(END).expect("it falls");
    *run.y()
}

/// Runs 8 states at once, which differ by their first position.
fn lanes<S: Scene, L: LaneScene>(steps: usize) -> [State<f64>; 8] {
    let begin = Run::begin(&S::default()).y;
    let states: [State<f64>; 8] = core::array::from_fn(|k| {
        let mut y = begin;
        y[0] += k as f64 * 1e-3;
        y
    });
    let scene = L::default();
    let smooth = SmoothScene::new(&scene);
    let mut run = LaneRun::new(black_box(packed::<f64x8, 14>(&states)));
    for _ in 0..steps {
        run.step(&Rk4, &smooth, END / steps as f64);
    }
    core::array::from_fn(|k| unpacked::<f64x8, 14>(run.y(), k))
}

/// Runs a scene in this way, and returns the state at the end and the time of one run, s.
fn measured<S: Scene, L: LaneScene>(
    how: &str,
    given: f64,
    patience: f64,
) -> Option<(State<f64>, f64)> {
    let steps = given as usize;
    Some(match how {
        "rk4" => shortest(patience, || fixed::<S>(steps)),
        "dopri5" => shortest(patience, || controlled::<S, _>(Dopri5, given)),
        "dop853" => shortest(patience, || controlled::<S, _>(Dop853, given)),
        "lanes" => {
            let (all, seconds) = shortest(patience, || lanes::<S, L>(steps));
            (all[0], seconds / 8.0)
        }
        "cores" => {
            let inputs = vec![steps; GROUPS * cores().get()];
            let work = || batch(&inputs, cores(), |&steps| lanes::<S, L>(steps), |_| {});
            let (all, seconds) = shortest(patience, work);
            (all[0][0], seconds / (8 * inputs.len()) as f64)
        }
        _ => return None,
    })
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let patience = std::env::var("PEERS_PATIENCE").ok();
    let patience = patience.and_then(|x| x.parse().ok()).unwrap_or(0.3);
    let [scene, how, given @ ..] = &arguments[..] else {
        eprintln!("usage: simulate SCENE HOW STEPS|TOLERANCE ...");
        std::process::exit(2);
    };
    for given in given.iter().filter_map(|x| x.parse::<f64>().ok()) {
        let found = match scene.as_str() {
            "viscous" => measured::<
                panda_viscous::PandaViscous<f64>,
                panda_viscous::PandaViscous<f64x8>,
            >(how, given, patience),
            "friction" => measured::<
                panda_friction::PandaFriction<f64>,
                panda_friction::PandaFriction<f64x8>,
            >(how, given, patience),
            _ => None,
        };
        let Some((y, seconds)) = found else {
            eprintln!("no scene {scene}, or no way to run is called {how}");
            std::process::exit(2);
        };
        let positions = y.as_slice()[..7].iter();
        let positions: Vec<String> = positions
            .map(|x| {
                if x.is_finite() {
                    format!("{x:e}")
                } else {
                    "null".into()
                }
            })
            .collect();
        println!(
            "{{\"given\": {given:e}, \"positions\": [{}], \"seconds\": {:e}}}",
            positions.join(", "),
            seconds / END
        );
    }
}
