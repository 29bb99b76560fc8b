//! Runs of mechanisms with loops, as JSON: `loops MECHANISM STEP END`.
//!
//! `parallel_rods` are two parallelograms with `branch: parallel`, closed by joints that follow; `parallelograms` the same
//! with pins that dependent joints close; `five_bar` a driven five-bar. Each is run twice by RK4 in the independent
//! velocities: for its largest gap and its end, then for its time.

use std::hint::black_box;
use std::time::Instant;

use bgdyn::Dynamics;
use bgdyn::nalgebra::SVector;
use bgdyn_sim::{State, rk4_step};

bgdyn::bgdyn!("../../../specs/loops/parallel_rods.yaml");
bgdyn::bgdyn!("../../../specs/loops/parallelograms.yaml");
bgdyn::bgdyn!("../../../specs/loops/five_bar.yaml");

/// What a run gives: the state at its end, or the time when it was refused; and the largest gap on the way, m.
struct Run<const NQ: usize, const NV: usize> {
    state: State<f64, NQ, NV>,
    refused: Option<f64>,
    gap: f64,
    seconds: f64,
}

/// Runs a model from a state; `gap` measures the loops.
fn run<M: Dynamics<f64, NQ, NV>, const NQ: usize, const NV: usize>(
    model: &M,
    start: &State<f64, NQ, NV>,
    (step, end): (f64, f64),
    tau: impl Fn(f64, &SVector<f64, NQ>) -> SVector<f64, NV>,
    gap: impl Fn(&SVector<f64, NQ>) -> f64,
) -> Run<NQ, NV> {
    let steps = (end / step).round() as usize;
    let h = end / steps as f64;
    let efforts = |t, s: &State<f64, NQ, NV>| tau(t, &s.q);
    let mut run = Run {
        state: *start,
        refused: None,
        gap: gap(&start.q),
        seconds: 0.0,
    };
    for k in 0..steps {
        let t = k as f64 * h;
        match rk4_step(model, t, &run.state, h, efforts) {
            Ok(next) => run.state = next,
            Err(_) => {
                run.refused = Some(t);
                return run;
            }
        }
        run.gap = run.gap.max(gap(&run.state.q));
    }
    let begun = Instant::now();
    let mut state = *start;
    for k in 0..steps {
        let moved = rk4_step(model, k as f64 * h, black_box(&state), h, efforts);
        let Ok(next) = moved else { return run };
        state = next;
    }
    black_box(&state);
    run.seconds = begun.elapsed().as_secs_f64() / end;
    run
}

/// Prints a run with the positions of the joints that the page compares.
fn print<const NQ: usize, const NV: usize>(run: &Run<NQ, NV>, energy: f64, positions: &[f64]) {
    let number = |x: f64| match x.is_finite() {
        true => format!("{x:e}"),
        false => "null".to_owned(),
    };
    let positions: Vec<String> = positions.iter().map(|&x| number(x)).collect();
    println!(
        "{{\"positions\": [{}], \"energy\": {}, \"gap\": {}, \"refused\": {}, \"seconds\": {}}}",
        positions.join(", "),
        number(energy),
        number(run.gap),
        run.refused.map_or("null".to_owned(), number),
        number(run.seconds)
    );
}

/// The angle of the rods at the start: upright, and its rate.
const UPRIGHT: (f64, f64) = (std::f64::consts::FRAC_PI_2, -1.0);

fn parallel_rods(times: (f64, f64)) {
    let model = parallel_rods::ParallelRods::<f64>::default();
    let start = State {
        q: SVector::from([UPRIGHT.0]),
        v: SVector::from([UPRIGHT.1]),
    };
    let gap = |q: &SVector<f64, 1>| {
        let first = model.pose_pin1_rod(q).translation - model.pose_pin1_coupler(q).translation;
        let second = model.pose_pin2_rod(q).translation - model.pose_pin2_coupler(q).translation;
        first.norm().max(second.norm())
    };
    let run = run(&model, &start, times, |_, _| SVector::from([0.0]), gap);
    let energy = energy(&model, &run.state);
    print(&run, energy, &[run.state.q[0]]);
}

fn parallelograms(times: (f64, f64)) {
    let model = parallelograms::Parallelograms::<f64>::default();
    let (angle, rate) = UPRIGHT;
    let start = State {
        q: SVector::from([angle, -angle, angle, -angle, angle]),
        v: SVector::from([rate]),
    };
    let gap = |q: &SVector<f64, 5>| model.constraint_residual(q).amax();
    let run = run(&model, &start, times, |_, _| SVector::from([0.0]), gap);
    let energy = energy(&model, &run.state);
    print(&run, energy, &[run.state.q[0]]);
}

fn five_bar(times: (f64, f64)) {
    let model = five_bar::FiveBar::<f64>::default();
    let start = State {
        q: SVector::from([2.0, -1.269_858_316_944_471, 1.1, 1.293_970_919_622_041]),
        v: SVector::from([0.0, 0.0]),
    };
    let tau = |t: f64, q: &SVector<f64, 4>| {
        SVector::from([
            -20.0 * (q[0] - 1.9) + 3.0 * (4.0 * t).sin() + 1.2,
            -20.0 * (q[2] - 1.2) + 2.0 * (3.0 * t).cos() - 0.5,
        ])
    };
    let gap = |q: &SVector<f64, 4>| model.constraint_residual(q).norm();
    let run = run(&model, &start, times, tau, gap);
    let energy = energy(&model, &run.state);
    print(&run, energy, &[run.state.q[0], run.state.q[2]]);
}

fn energy<M: Dynamics<f64, NQ, NV>, const NQ: usize, const NV: usize>(
    model: &M,
    state: &State<f64, NQ, NV>,
) -> f64 {
    model.kinetic_energy(&state.q, &state.v) + model.potential_energy(&state.q)
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let number = |k: usize| arguments.get(k).and_then(|x| x.parse::<f64>().ok());
    let (Some(step), Some(end)) = (number(1), number(2)) else {
        eprintln!("loops parallel_rods|parallelograms|five_bar STEP END");
        std::process::exit(2);
    };
    match arguments[0].as_str() {
        "parallel_rods" => parallel_rods((step, end)),
        "parallelograms" => parallelograms((step, end)),
        "five_bar" => five_bar((step, end)),
        other => {
            eprintln!("no mechanism {other}");
            std::process::exit(2);
        }
    }
}
