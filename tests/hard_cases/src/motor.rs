//! Bar 9 beyond the files: a motor whose current settles within 1e-6 s, with a pendulum on its shaft,
//! against its equations in double-double.

use bgdyn_runtime::{Dd, matrix, vector};
use bgdyn_sim::{Extrapolation, Gauss, Integrator, Jacobian, Ode, Rodas4, Run, ScenePlant, Solver};
use nalgebra::SVector;

use crate::follow::{controlled, fixed, relative};
use crate::outcome::{Deviation, Outcome};
use crate::{Extent, scenes};

type Y = SVector<Dd, 3>;

/// J θ̈ = k i − b θ̇ − m g l sin θ, L i̇ = U − R i − k θ̇: the state is θ, θ̇, i.
struct Equations;

/// The numbers of the scene and its mechanism, in SI units.
const VOLTAGE: f64 = 1.2;
const RESISTANCE: f64 = 1.0;
const INDUCTANCE: f64 = 1e-6;
const CONSTANT: f64 = 0.05;
const DAMPING: f64 = 1e-4;
const ROTOR: f64 = 0.0025;
const MASS: f64 = 0.01;
const LENGTH: f64 = 0.05;
const GRAVITY: f64 = 9.81;

/// Returns the moment of inertia about the shaft, and the moment of gravity.
fn sizes() -> [Dd; 2] {
    let [rotor, mass, length, g] = [ROTOR, MASS, LENGTH, GRAVITY].map(Dd::from_f64);
    [rotor + mass * length * length, mass * g * length]
}

impl Ode for Equations {
    type State = Y;
    type Error = ();

    fn rates(&self, _: Dd, y: &Y) -> Result<Y, ()> {
        let [u, r, l, k, b] =
            [VOLTAGE, RESISTANCE, INDUCTANCE, CONSTANT, DAMPING].map(Dd::from_f64);
        let [inertia, pull] = sizes();
        let turned = k * y[2] - b * y[1] - pull * y[0].sin_cos().0;
        Ok(vector([
            y[1],
            turned / inertia,
            (u - r * y[2] - k * y[1]) / l,
        ]))
    }

    fn jacobian(&self, _: Dd, y: &Y) -> Option<Result<Jacobian<Y>, ()>> {
        let [r, l, k, b] = [RESISTANCE, INDUCTANCE, CONSTANT, DAMPING].map(Dd::from_f64);
        let [inertia, pull] = sizes();
        let zero = Dd::ZERO;
        let state = matrix([
            [zero, -(pull * y[0].sin_cos().1) / inertia, zero],
            [Dd::ONE, -b / inertia, -k / l],
            [zero, k / inertia, -r / l],
        ]);
        let time = vector([zero; 3]);
        Some(Ok(Jacobian { state, time }))
    }
}

/// Time at which the initial transient of the current has decayed, s.
const SETTLED: f64 = 1e-4;

fn advanced<M: Integrator<Y>>(solver: &mut Solver<Y, M>, to: f64, steps: u32) {
    let h = (Dd::from_f64(to) - solver.t()) / Dd::from_f64(f64::from(steps));
    for _ in 0..steps {
        solver.advance(&Equations, h).expect("regular");
    }
}

/// Returns the solution at some times: 100 time constants of the current with steps of a tenth of one,
/// then with steps of 1 ms and order 12, or of 2 ms.
fn solution(times: &[f64], per_sample: u32) -> Vec<Y> {
    let mut first = Solver::new(Extrapolation::<6>, Dd::ZERO, Y::repeat(Dd::ZERO));
    advanced(&mut first, SETTLED, 1000);
    let mut solver = Solver::new(Gauss::<Dd, 6>::new(), Dd::from_f64(SETTLED), *first.y());
    let to = |&t: &f64| {
        advanced(&mut solver, t, per_sample);
        *solver.y()
    };
    times.iter().map(to).collect()
}

/// The motor with long steps of an L-stable integrator, and with step control.
pub(crate) fn motor_pendulum(_: Extent) -> Vec<Outcome> {
    let case = "motor_pendulum";
    let times: Vec<f64> = (1..=30).map(|k| f64::from(k) / 10.0).collect();
    let exact = solution(&times, 100);
    let coarse = solution(&times, 50);
    let scene = scenes::motor_pendulum::MotorPendulum::<f64>::default();
    let (plant, begin) = (ScenePlant::with_slope(&scene), Run::begin(&scene));
    let long = fixed(Rodas4, 1e-2, &plant, &begin, &times);
    let short = controlled(Rodas4, relative(1e-10), &plant, &begin, &times);
    // Angle and rate are each in units of their largest value.
    let sizes = [0, 1].map(|i| {
        exact
            .iter()
            .map(|y| y[i].to_f64().abs())
            .fold(0.0, f64::max)
    });
    let deviations = |found: Vec<Y>, allowed: f64| -> Vec<Deviation> {
        let rows = times.iter().zip(found.iter().zip(&exact));
        rows.map(|(&t, (x, y))| {
            let off = [0, 1].map(|i| (x[i] - y[i]).to_f64().abs() / sizes[i]);
            Deviation {
                t,
                measured: off[0].max(off[1]),
                allowed,
            }
        })
        .collect()
    };
    let wide = |states: &[SVector<f64, 3>]| -> Vec<Y> {
        states.iter().map(|y| y.map(Dd::from_f64)).collect()
    };
    vec![
        Outcome::worst(
            case,
            "ref",
            "equations, against steps twice as long",
            deviations(coarse, 1e-15),
        ),
        Outcome::worst(
            case,
            "9",
            "angle, rate; rodas4, 10 ms",
            deviations(wide(&long), 1e-6),
        ),
        Outcome::worst(
            case,
            "9",
            "angle, rate; rodas4 at 1e-10",
            deviations(wide(&short), 1e-6),
        ),
    ]
}
