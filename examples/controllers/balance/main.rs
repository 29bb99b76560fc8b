//! A cart balances its pole by a linear-quadratic regulator: ∂ẏ/∂y and ∂ẏ/∂u of the generated scene, their discrete
//! A and B by zero-order hold, and the gains by iteration of Riccati's equation. The controller is sampled every 20 ms,
//! acts 15 ms later, and measures with encoders and noise.
//!
//! `cargo run --release -p controllers --example balance` prints the matrices, the gains and how the pole moves.

use std::cell::Cell;
use std::process::ExitCode;

use bgdyn::nalgebra::{SMatrix, SVector};
use bgdyn::runtime::{HybridSystem, InputSlope, SampledControl, Slope};
use bgdyn_sim::{Rk4, Run, ScenePlant, discretised};

bgdyn::bgdyn!("balance.scene.yaml", jacobian = true, input_jacobian = true);

use balance::Balance;

/// y = rail, swing, and their rates.
type State = SVector<f64, 4>;
/// y, and the force that still acts when the next sample is taken.
type Delayed = SVector<f64, 5>;

const PERIOD: f64 = 0.02;
const DELAY: f64 = 0.015;
const END: f64 = 8.0;

/// Weights of rail, swing, their rates, and of the force before: squares of what counts as much as 1 N.
const WEIGHTS: [f64; 5] = [40.0, 40.0, 4.0, 4.0, 0.0];
const FORCE: f64 = 0.2;

/// Sensors: steps of 0.1 mm and of a turn/16384, noise of rates as from differences.
const SAMPLING: SampledControl<'static> = SampledControl {
    period: PERIOD,
    delay: DELAY,
    resolution: &[1e-4, core::f64::consts::TAU / 16384.0, 0.0, 0.0],
    noise: &[1e-4, 2e-4, 5e-3, 1e-2],
    controlled: &[0],
    input_resolution: &[0.01],
    seed: 3,
};

fn main() -> ExitCode {
    let scene = Balance::<f64>::default();
    let upright = State::zeros();
    let (_, modes) = HybridSystem::<f64>::start(&scene);
    let linear = scene
        .slope(&upright, &modes, &SVector::zeros(), 0.0)
        .and_then(|(a, _)| {
            let b = scene.input_slope(&upright, &modes, &SVector::zeros(), 0.0)?;
            Ok((a, b))
        });
    let (a, b) = match linear {
        Ok(linear) => linear,
        Err(singular) => {
            eprintln!("{singular}");
            return ExitCode::FAILURE;
        }
    };
    println!("∂ẏ/∂y, upright:{a:.4}∂ẏ/∂u:{b:.4}");

    // Two regulators: one knows of the delay, the other one takes its force to act at once.
    let (late_a, late_b) = delayed(&a, &b, DELAY);
    let (prompt_a, prompt_b) = delayed(&a, &b, 0.0);
    println!("A, with the force before as the last state:{late_a:.5}B:{late_b:.5}");
    let mut balanced = true;
    for (name, gains) in [
        ("with the delay", regulator(&late_a, &late_b)),
        ("as if there were none", regulator(&prompt_a, &prompt_b)),
    ] {
        let Some(gains) = gains else {
            eprintln!("{name}: the iteration of Riccati's equation does not end");
            return ExitCode::FAILURE;
        };
        let motion = run(&scene, &gains);
        println!("designed {name}: gains {:.3?}", gains.as_slice());
        match motion {
            Some(Motion {
                largest,
                late,
                force,
            }) => println!(
                "  swing at most {largest:.2}°, after 6 s within {late:.3}°; force at most {force:.2} N"
            ),
            None => println!("  the pole falls"),
        }
        balanced &= motion.is_some() || name != "with the delay";
    }
    match balanced {
        true => ExitCode::SUCCESS,
        false => ExitCode::FAILURE,
    }
}

/// Returns A and B of one period for the state (y, force before): the force before acts until the delay τ is over, then
/// the new one. y⁺ = Φ(T) y + Φ(T − τ) Γ(τ) u₋ + Γ(T − τ) u.
fn delayed(
    a: &SMatrix<f64, 4, 4>,
    b: &SMatrix<f64, 4, 1>,
    delay: f64,
) -> (SMatrix<f64, 5, 5>, Delayed) {
    let (before_a, before_b) = discretised(a, b, delay);
    let (after_a, after_b) = discretised(a, b, PERIOD - delay);
    let mut whole = SMatrix::<f64, 5, 5>::zeros();
    whole
        .fixed_view_mut::<4, 4>(0, 0)
        .copy_from(&(after_a * before_a));
    whole
        .fixed_view_mut::<4, 1>(0, 4)
        .copy_from(&(after_a * before_b));
    let mut input = Delayed::zeros();
    input.fixed_view_mut::<4, 1>(0, 0).copy_from(&after_b);
    input[4] = 1.0;
    (whole, input)
}

/// Returns the gains K of u = −K z for which Σ zᵀ Q z + r u² is least: P ← Q + Aᵀ P (A − B K) with
/// K = (r + Bᵀ P B)⁻¹ Bᵀ P A, until P does not change; `None` if it does not end.
fn regulator(a: &SMatrix<f64, 5, 5>, b: &Delayed) -> Option<Delayed> {
    let weights = SMatrix::<f64, 5, 5>::from_diagonal(&Delayed::from(WEIGHTS));
    let mut cost = weights;
    for _ in 0..20_000 {
        let along = b.transpose() * cost;
        let gains = along * a / (FORCE + (along * b)[0]);
        let next = weights + a.transpose() * cost * (a - b * gains);
        let change = (next - cost).amax();
        cost = next;
        if change < 1e-12 * cost.amax() {
            return Some(gains.transpose());
        }
    }
    None
}

/// How the pole moves.
#[derive(Clone, Copy)]
struct Motion {
    /// Largest angle, degrees.
    largest: f64,
    /// Largest angle after 6 s, degrees.
    late: f64,
    /// Largest force, N.
    force: f64,
}

/// Runs the scene under these gains; `None` if the pole falls.
fn run(scene: &Balance<f64>, gains: &Delayed) -> Option<Motion> {
    let before = Cell::new(0.0);
    let law = |y: &State, _: f64| {
        let z = Delayed::from_fn(|i, _| if i < 4 { y[i] } else { before.get() });
        let force = (-gains.dot(&z)).clamp(-15.0, 15.0);
        before.set(force);
        SVector::from([force])
    };
    let plant = ScenePlant::new(scene).with_controller(SAMPLING, &law);
    let mut run = Run::by(Rk4, plant, Run::begin(scene));
    let mut motion = Motion {
        largest: 0.0,
        late: 0.0,
        force: 0.0,
    };
    while run.t() < END {
        run.step(2e-3).ok()?;
        let swing = run.y()[1].to_degrees().abs();
        if swing > 90.0 {
            return None;
        }
        motion.largest = motion.largest.max(swing);
        if run.t() > 6.0 {
            motion.late = motion.late.max(swing);
        }
        let force = run.plant().input(run.t(), run.y(), run.modes())[0];
        motion.force = motion.force.max(force.abs());
    }
    Some(motion)
}
