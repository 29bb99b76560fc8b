//! Bar 7: the energy of the double pendulum over 1e6 and 1e7 steps, by the compiled scene in momenta and
//! in velocities.

use bgdyn_runtime::{Dd, vector};
use bgdyn_sim::{
    CanonicalPlant, FixedModes, Gauss2, Gauss3, Integrator, Midpoint, Plant, Real, Rk4, Run,
    ScenePlant, Solver,
};
use nalgebra::SVector;

use crate::outcome::Outcome;
use crate::scenes::double_pendulum_chaotic::DoublePendulumChaotic;
use crate::tenths::Tenths;
use crate::{Curve, Extent, Measured, Panel};

/// Half the energy between hanging down and standing up: the unit of the bars, J.
const UNIT: f64 = 29.43;
const GRAVITY: f64 = 9.81;
/// Number of steps for which the bars are defined.
const MILLION: u32 = 1_000_000;
/// Points per decade of a curve.
const PER_DECADE: f64 = 12.0;

type Y<T> = SVector<T, 4>;

/// Velocities of (q, p), by the determinant of M = [[3 + 2c, 1 + c], [1 + c, 1]].
fn velocities<T: Real>(y: &Y<T>) -> [T; 2] {
    let [one, two, three] = [1.0, 2.0, 3.0].map(T::from_f64);
    let cos = y[1].sin_cos().1;
    let determinant = two - cos * cos;
    let beside = one + cos;
    let first = (y[2] - beside * y[3]) / determinant;
    let second = ((three + two * cos) * y[3] - beside * y[2]) / determinant;
    [first, second]
}

/// (q, p) of (q, v).
fn momenta<T: Real>(y: &Y<T>) -> Y<T> {
    let [one, two, three] = [1.0, 2.0, 3.0].map(T::from_f64);
    let cos = y[1].sin_cos().1;
    let beside = one + cos;
    let first = (three + two * cos) * y[2] + beside * y[3];
    vector([y[0], y[1], first, beside * y[2] + y[3]])
}

/// ½ p·v + V of (q, p), in closed form.
fn energy<T: Real>(y: &Y<T>) -> T {
    let [v1, v2] = velocities(y);
    let [half, two, g] = [0.5, 2.0, GRAVITY].map(T::from_f64);
    let cos = |angle: T| angle.sin_cos().1;
    half * (y[2] * v1 + y[3] * v2) - g * (two * cos(y[0]) + cos(y[0] + y[1]))
}

/// The energy error of a run, in [`UNIT`]s.
struct Kept {
    /// Errors in the tenths of the first 1e6 steps.
    tenths: Tenths,
    /// The largest error of all steps.
    most: f64,
    /// Step numbers, and the largest error since the previous point.
    points: Vec<(f64, f64)>,
}

/// Records the energy error of each step, returned by `next`.
fn follow(steps: u32, mut next: impl FnMut() -> f64) -> Kept {
    let barred = steps.min(MILLION);
    let mut kept = Kept {
        tenths: Tenths::new(barred),
        most: 0.0,
        points: vec![],
    };
    let (mut bin, mut decade) = (0.0_f64, 0.0);
    for i in 1..=steps {
        let off = next() / UNIT;
        kept.most = kept.most.max(off.abs());
        if i <= barred {
            kept.tenths.add(i, off);
        }
        bin = bin.max(off.abs());
        let place = (f64::from(i).log10() * PER_DECADE).floor();
        if place > decade || i == steps {
            kept.points.push((f64::from(i), bin));
            (bin, decade) = (0.0, place);
        }
    }
    kept
}

/// Runs from rest at (0.5, 0), in momenta, in one or two words.
fn swing<M: Integrator<Y<f64>>>(method: M, h: f64, steps: u32, compensated: bool) -> Kept {
    let scene = DoublePendulumChaotic::<f64>::default();
    let (plant, begin) = (CanonicalPlant::new(&scene), Run::begin(&scene));
    let modes = &begin.modes;
    let held = FixedModes {
        plant: &plant,
        modes,
    };
    let mut solver = Solver::new(method, 0.0, vector([0.5, 0.0, 0.0, 0.0]));
    if compensated {
        solver = solver.compensated();
    }
    let wide = |y: &Y<f64>| y.map(Dd::from_f64);
    let now = |solver: &Solver<Y<f64>, M>| {
        let high = wide(solver.y());
        energy(&solver.low().map_or(high, |low| high + wide(low)))
    };
    let start = now(&solver);
    follow(steps, || {
        solver.advance(&held, h).expect("it swings on");
        (now(&solver) - start).to_f64()
    })
}

/// Runs from rest at (120°, 30°), a chaotic motion, with steps of 1e-2 s.
fn tumble<P, M>(
    plant: &P,
    modes: &P::Modes,
    to_momenta: fn(&Y<f64>) -> Y<f64>,
    method: M,
    steps: u32,
) -> Kept
where
    P: Plant<State = Y<f64>>,
    M: Integrator<Y<f64>>,
{
    let held = FixedModes { plant, modes };
    let start = vector([120_f64.to_radians(), 30_f64.to_radians(), 0.0, 0.0]);
    let mut solver = Solver::new(method, 0.0, start);
    let first = energy(&start);
    follow(steps, || {
        solver.advance(&held, 1e-2).expect("it swings on");
        energy(&to_momenta(solver.y())) - first
    })
}

const CASE: &str = "double pendulum, energy";

fn curve(panel: Panel, name: &'static str, kept: &Kept) -> Curve {
    Curve {
        panel,
        name,
        points: kept.points.clone(),
        most: kept.most,
    }
}

fn one(name: &'static str, kept: &Kept, outcomes: Vec<Outcome>) -> Measured {
    Measured {
        outcomes,
        curves: vec![curve(Panel::Regular, name, kept)],
    }
}

/// The classical Runge–Kutta method: its error grows with each step.
pub(crate) fn rk4(extent: Extent) -> Measured {
    let kept = swing(Rk4, 1e-3, extent.steps(20_000), false);
    let outcome = Outcome::new(
        CASE,
        "7",
        "rk4, 1 ms, in 29.43 J",
        kept.tenths.most(),
        5e-12,
    );
    one("rk4, 1 ms", &kept, vec![outcome])
}

/// Gauss–Legendre with two stages in momenta: the error is bounded.
pub(crate) fn gauss2(extent: Extent) -> Measured {
    let kept = swing(Gauss2::new(), 1e-2, extent.steps(20_000), false);
    let grown = kept.tenths.grown();
    let outcomes = vec![
        Outcome::new(
            CASE,
            "7",
            "gauss2, 10 ms, in 29.43 J",
            kept.tenths.most(),
            1e-10,
        ),
        Outcome::new(
            CASE,
            "7",
            "gauss2, 10 ms, last tenth over first",
            grown,
            1.5,
        ),
    ];
    one("gauss2, 10 ms", &kept, outcomes)
}

/// Gauss–Legendre with three stages in momenta: almost rounding.
pub(crate) fn gauss3(extent: Extent) -> Measured {
    let kept = swing(Gauss3::new(), 1e-3, extent.steps(10_000), false);
    let outcome = Outcome::new(
        CASE,
        "7",
        "gauss3, 1 ms, in 29.43 J",
        kept.tenths.most(),
        3e-14,
    );
    one("gauss3, 1 ms", &kept, vec![outcome])
}

/// The same with compensated sums.
pub(crate) fn compensated(extent: Extent) -> Measured {
    let kept = swing(Gauss3::new(), 1e-3, extent.steps(10_000), true);
    let what = "gauss3, 1 ms, compensated, in 29.43 J";
    let outcome = Outcome::new(CASE, "7", what, kept.tenths.most(), 1e-15);
    one("gauss3, 1 ms, compensated", &kept, vec![outcome])
}

/// Runs in velocities and in momenta, by the same integrator.
fn forms<M: Integrator<Y<f64>>>(
    new: fn() -> M,
    names: [&'static str; 2],
    what: &str,
    steps: u32,
) -> Measured {
    let scene = DoublePendulumChaotic::<f64>::default();
    let begin = Run::begin(&scene);
    let (natural, canonical) = (ScenePlant::new(&scene), CanonicalPlant::new(&scene));
    let in_velocities = tumble(&natural, &begin.modes, momenta, new(), steps);
    let in_momenta = tumble(&canonical, &begin.modes, |z| *z, new(), steps);
    let part = in_momenta.tenths.spread() / in_velocities.tenths.spread();
    Measured {
        outcomes: vec![Outcome::new(
            "chaotic double pendulum, energy",
            "7",
            what,
            part,
            0.2,
        )],
        curves: vec![
            curve(Panel::Chaotic, names[0], &in_velocities),
            curve(Panel::Chaotic, names[1], &in_momenta),
        ],
    }
}

/// Gauss–Legendre methods are symplectic in momenta and only symmetric in velocities: for chaotic motion
/// the mean of the energy drifts randomly.
pub(crate) fn chaotic_gauss2(extent: Extent) -> Measured {
    let names = ["gauss2, 10 ms, (q, v)", "gauss2, 10 ms, (q, p)"];
    let what = "gauss2, 10 ms: wander of the mean, (q, p) over (q, v)";
    forms(Gauss2::new, names, what, extent.steps(100_000))
}

/// The same by the midpoint rule.
pub(crate) fn chaotic_midpoint(extent: Extent) -> Measured {
    let names = ["midpoint, 10 ms, (q, v)", "midpoint, 10 ms, (q, p)"];
    let what = "midpoint, 10 ms: wander of the mean, (q, p) over (q, v)";
    forms(Midpoint::new, names, what, extent.steps(100_000))
}
