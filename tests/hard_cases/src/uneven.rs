//! Bar 6 beyond the files: double pendulums with mass ratios of 1e12, heavy first and heavy last, against
//! their equation in closed form.

use bgdyn_runtime::{Dd, vector};
use bgdyn_sim::{
    Dop853, Extrapolation, HybridState, Jacobian, Ode, Plant, Run, ScenePlant, Solver,
};
use nalgebra::SVector;

use crate::follow::{alike, controlled};
use crate::outcome::{Deviation, Outcome};
use crate::{Extent, scenes};

type Y<T> = SVector<T, 4>;

/// Point masses on massless rods of 1 m in double-double: q₁, q₂ relative to the first rod, their rates.
/// Computed in the absolute angles of the rods (any textbook of mechanics).
struct Equation {
    masses: [f64; 2],
}

impl Ode for Equation {
    type State = Y<Dd>;
    type Error = ();

    fn rates(&self, _: Dd, y: &Y<Dd>) -> Result<Y<Dd>, ()> {
        let [first, second] = self.masses.map(Dd::from_f64);
        let [g, two] = [9.81, 2.0].map(Dd::from_f64);
        let (a, b) = (y[0], y[0] + y[1]);
        let (u, w) = (y[2], y[2] + y[3]);
        let (sin, cos) = (a - b).sin_cos();
        let both = first + second;
        // 2 m₁ + m₂ − m₂ cos 2Δ
        let size = two * (first + second * sin * sin);
        let upper = -(g * (two * first + second) * a.sin_cos().0)
            - second * g * (a - two * b).sin_cos().0
            - two * sin * second * (w * w + u * u * cos);
        let lower = two * sin * (u * u * both + g * both * a.sin_cos().1 + w * w * second * cos);
        let (upper, lower) = (upper / size, lower / size);
        Ok(vector([y[2], y[3], upper, lower - upper]))
    }

    fn jacobian(&self, _: Dd, _: &Y<Dd>) -> Option<Result<Jacobian<Y<Dd>>, ()>> {
        None
    }
}

/// Returns the equation's states at some times, with steps of order 12.
fn solution(equation: &Equation, start: Y<Dd>, times: &[f64], h: f64) -> Vec<Y<Dd>> {
    let mut solver = Solver::new(Extrapolation::<6>, Dd::ZERO, start);
    let mut states = vec![];
    let mut before = 0.0;
    for &t in times {
        let steps = ((t - before) / h).ceil();
        let h = (Dd::from_f64(t) - solver.t()) / Dd::from_f64(steps);
        for _ in 0..steps as u32 {
            solver.advance(equation, h).expect("regular");
        }
        states.push(*solver.y());
        before = t;
    }
    states
}

fn largest(y: &Y<Dd>) -> f64 {
    y.iter().fold(0.0, |most, x| most.max(x.to_f64().abs()))
}

/// Compares a compiled plant with the equation. The limit is the effect of rounding: 1e4 eps times the
/// growth of a change of the initial state.
fn against<P>(
    case: &str,
    plant: &P,
    begin: &HybridState<P::State, P::Modes>,
    masses: [f64; 2],
    end: f64,
) -> Vec<Outcome>
where
    P: Plant<State = Y<f64>>,
{
    let times: Vec<f64> = (1..=20).map(|k| end * f64::from(k) / 20.0).collect();
    let equation = Equation { masses };
    let start = begin.y.map(Dd::from_f64);
    let (h, nudge) = (end / 2000.0, 1e-20);
    let exact = solution(&equation, start, &times, h);
    let coarse = solution(&equation, start, &times, 2.0 * h);
    let mut amplified = vec![1.0_f64; times.len()];
    for k in 0..4 {
        let mut moved = start;
        moved[k] += Dd::from_f64(nudge);
        let moved = solution(&equation, moved, &times, h);
        for (most, (x, y)) in amplified.iter_mut().zip(moved.iter().zip(&exact)) {
            *most = most.max(largest(&(x - y)) / nudge);
        }
    }
    let allowed = amplified.iter().map(|a| 1e4 * f64::EPSILON * a);
    let found = controlled(Dop853, alike(1e-13), plant, begin, &times);
    let deviations = |found: Vec<Y<Dd>>, part: f64| -> Vec<Deviation> {
        let rows = times
            .iter()
            .zip(allowed.clone())
            .zip(found.iter().zip(&exact));
        rows.map(|((&t, allowed), (x, y))| Deviation {
            t,
            measured: largest(&(x - y)),
            allowed: part * allowed,
        })
        .collect()
    };
    let wide = found.iter().map(|y| y.map(Dd::from_f64)).collect();
    vec![
        Outcome::worst(
            case,
            "ref",
            "closed form, against steps twice as long",
            deviations(coarse, 1e-4),
        ),
        Outcome::worst(case, "6", "state; dop853 at 1e-13", deviations(wide, 1.0)),
    ]
}

/// A light pendulum on one that is 1e12 times heavier.
pub(crate) fn heavy_first(_: Extent) -> Vec<Outcome> {
    let scene = scenes::mass_ratio_1e12_1::MassRatio1e121::<f64>::default();
    let (plant, begin) = (ScenePlant::new(&scene), Run::begin(&scene));
    against("mass_ratio_1e12_1", &plant, &begin, [1e12, 1.0], 2.0)
}

/// A pendulum on one that is 1e12 times lighter: it falls freely until the rods are almost in line.
pub(crate) fn heavy_last(_: Extent) -> Vec<Outcome> {
    let scene = scenes::mass_ratio_1_1e12::MassRatio11e12::<f64>::default();
    let (plant, begin) = (ScenePlant::new(&scene), Run::begin(&scene));
    against("mass_ratio_1_1e12", &plant, &begin, [1.0, 1e12], 0.3)
}
