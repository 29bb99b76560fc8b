//! The satellite's closed cycle against its file, and many cycles: the pose after n cycles is the n-th power
//! of that after one, and momentum remains zero.

use bgdyn_runtime::Dd;
use bgdyn_runtime::manifold::{floating, spherical};
use bgdyn_sim::{Dop853, Extrapolation, Gauss2, Integrator, Ode, Real, Rk4, Solver, StateVector};
use nalgebra::SVector;

use crate::follow::alike;
use crate::long_runs::adding_up;
use crate::outcome::Outcome;
use crate::reference::{Reference, larger, reference};
use crate::satellite::{ARM, Arm, ByEfforts, ByMomentum, Cycle, halves};
use crate::turning::ROUNDING;
use crate::vectors::{part, turned};
use crate::{Extent, Measured};

const CASE: &str = "satellite_cycle";
/// Steps of a cycle in the runs of many cycles.
const STEPS: u32 = 8000;
/// The sum of the arm's largest rates, rad/s: 5.6 rad · 2π/8 s.
const RATE: f64 = 4.4;

fn file() -> Reference {
    reference!("satellite_cycle")
}

/// The satellite with the arm's motion of the file.
fn cycle<T: Real>(reference: &Reference) -> Cycle<T> {
    let [amplitudes, phases] = ["A", "p"].map(|name| reference.parameters(name));
    assert_eq!(amplitudes.len(), ARM);
    Cycle::new(Arm::new(&amplitudes, &phases, 8.0))
}

/// The base at the beginning: at its origin, with the velocity of zero momentum.
fn start<T: Real>(cycle: &Cycle<T>) -> SVector<T, 13> {
    let (pose, twist) = (floating::neutral(), cycle.velocity(T::from_f64(0.0)));
    SVector::from_fn(|i, _| if i < 7 { pose[i] } else { twist[i - 7] })
}

/// The pose at the beginning.
fn origin() -> SVector<f64, 7> {
    SVector::from(floating::neutral())
}

/// Returns an equation's states at some times, by controlled steps.
fn controlled<O>(ode: &O, times: &[f64], start: O::State) -> Vec<O::State>
where
    O: Ode<State: StateVector<Scalar = f64>, Error = ()>,
{
    let mut solver = Solver::new(Dop853, 0.0, start).with_tolerance(alike(1e-13));
    let to = |&t: &f64| {
        solver.advance_to(ode, t).expect("regular");
        solver.y().clone()
    };
    times.iter().map(to).collect()
}

/// Returns the states in double-double at whole seconds, with steps of order 12.
fn exact(cycle: &Cycle<Dd>, start: SVector<Dd, 13>, per_second: u32) -> Vec<SVector<Dd, 13>> {
    let mut solver = Solver::new(Extrapolation::<6>, Dd::ZERO, start);
    let h = Dd::ONE / Dd::from_f64(per_second.into());
    let mut states = vec![start];
    for _ in 0..8 {
        for _ in 0..per_second {
            solver.advance(&ByEfforts(cycle), h).expect("regular");
        }
        states.push(*solver.y());
    }
    states
}

/// Returns by how much a change of the initial pose or velocity has grown at whole seconds.
fn growth(cycle: &Cycle<Dd>) -> Vec<f64> {
    const NUDGE: f64 = 1e-12;
    let from = start(cycle);
    let states = exact(cycle, from, 4);
    let mut most = vec![1.0_f64; states.len()];
    for k in 0..13 {
        let mut moved = from;
        moved[k] += Dd::from_f64(NUDGE);
        for (most, (x, y)) in most
            .iter_mut()
            .zip(exact(cycle, moved, 4).iter().zip(&states))
        {
            let off = (x - y).iter().fold(0.0_f64, |m, x| m.max(x.to_f64().abs()));
            *most = most.max(off / NUDGE);
        }
    }
    most
}

/// Compares rows with the file's samples, signs of quaternions apart.
fn compared(
    reference: &Reference,
    bar: &'static str,
    what: &str,
    found: Vec<Vec<f64>>,
    allowed: impl Fn(usize) -> f64,
) -> Outcome {
    let found = reference.with_signs(found, 3);
    Outcome::worst(CASE, bar, what, reference.all(&found, allowed))
}

/// One cycle in two ways: base velocities from momentum, base accelerations from inverse dynamics.
fn one(reference: &Reference) -> Vec<Outcome> {
    let (times, wide) = (&reference.times, cycle::<Dd>(reference));
    let cycle = cycle::<f64>(reference);
    let fine = exact(&wide, start(&wide), 16);
    let rows = times.iter().zip(&fine).map(|(&t, y)| {
        let (pose, twist) = halves(y);
        let columns = wide.columns(Dd::from_f64(t), pose, twist);
        columns.into_iter().map(Dd::to_f64).collect()
    });
    let what = "inverse dynamics in double-double, against the file";
    let mut outcomes = vec![compared(reference, "ref", what, rows.collect(), |_| 1e-15)];
    let poses = controlled(&ByMomentum(&cycle), times, origin());
    let rows = times.iter().zip(&poses).map(|(&t, y)| {
        let [pose] = y.data.0;
        cycle.columns(t, pose, cycle.velocity(t))
    });
    let what = "state, by the mass matrix; dop853 at 1e-13";
    outcomes.push(compared(reference, "6", what, rows.collect(), |_| ROUNDING));
    let states = controlled(&ByEfforts(&cycle), times, start(&cycle));
    let rows = times.iter().zip(&states).map(|(&t, y)| {
        let (pose, twist) = halves(y);
        cycle.columns(t, pose, twist)
    });
    let (what, grown) = ("state, by inverse dynamics; dop853 at 1e-13", growth(&wide));
    let allowed = |k: usize| ROUNDING * grown[k];
    outcomes.push(compared(reference, "6", what, rows.collect(), allowed));
    let angle = reference.invariant("final_rotation_angle");
    let turn = spherical::difference(quaternion(states[8].as_slice()), spherical::neutral());
    let found = turn.iter().map(|x| x * x).sum::<f64>().sqrt();
    let what = "turn after the cycle, rad; dop853 at 1e-13";
    outcomes.push(Outcome::new(
        CASE,
        "6",
        what,
        (found - angle).abs(),
        ROUNDING,
    ));
    outcomes
}

/// The quaternion of a pose.
fn quaternion(y: &[f64]) -> [f64; 4] {
    std::array::from_fn(|i| y[3 + i])
}

/// Returns the pose after some cycles, by the pose after one.
fn power(once: &[f64], cycles: u32) -> Vec<f64> {
    let one: Vec<Dd> = once.iter().map(|&x| Dd::from_f64(x)).collect();
    let turn = [one[3], one[4], one[5], one[6]];
    let turn = spherical::difference(turn, spherical::neutral());
    let mut pose = floating::neutral::<Dd>();
    for _ in 0..cycles {
        let rounded = pose.map(Dd::to_f64);
        let step = turned(&rounded, 3, part(once, 0));
        let [x, y, z, a, b, c, d] = pose;
        let [a, b, c, d] = spherical::integrate([a, b, c, d], turn);
        pose = [x + step[0], y + step[1], z + step[2], a, b, c, d];
    }
    pose.map(Dd::to_f64).to_vec()
}

/// The largest component of the difference of two poses.
fn apart(a: &[f64], b: &[f64]) -> f64 {
    let sign = (3..7).map(|i| a[i] * b[i]).sum::<f64>().signum();
    let off = (0..7).map(|i| match i {
        0..3 => (a[i] - b[i]).abs(),
        _ => (sign * a[i] - b[i]).abs(),
    });
    off.fold(0.0, larger)
}

/// Takes steps of a cycle's 8000th part; calls a function with time and state after each of every hundred.
fn run<O, M>(method: M, ode: &O, start: O::State, steps: u32, mut see: impl FnMut(f64, &O::State))
where
    O: Ode<State: StateVector<Scalar = f64>, Error = ()>,
    M: Integrator<O::State>,
{
    let mut solver = Solver::new(method, 0.0, start);
    for i in 1..=steps {
        solver
            .advance(ode, 8.0 / f64::from(STEPS))
            .expect("regular");
        if i % 100 == 0 || i == steps {
            see(8.0 * f64::from(i) / f64::from(STEPS), solver.y());
        }
    }
}

/// Many cycles by a method: momentum, and the pose at the end.
fn many<M>(method: M, name: &str, steps: u32, error: f64) -> Vec<Outcome>
where
    M: Integrator<SVector<f64, 7>> + Integrator<SVector<f64, 13>> + Clone,
{
    let reference = file();
    let cycle = cycle::<f64>(&reference);
    let (cycles, rounded) = (steps / STEPS, adding_up(steps));
    let allowed = f64::from(steps) * error + rounded;
    let once = &reference.rows()[8][..7];
    let wanted = power(once, cycles);
    let mut pose = vec![];
    run(
        method.clone(),
        &ByMomentum(&cycle),
        origin(),
        steps,
        |_, y| {
            pose = y.as_slice().to_vec();
        },
    );
    let (mut most, mut size) = ([0.0_f64; 2], [0.0_f64; 2]);
    run(method, &ByEfforts(&cycle), start(&cycle), steps, |t, y| {
        let (found, terms) = cycle.momenta(t, halves(y).1);
        for k in 0..2 {
            most[k] = larger(most[k], found[k]);
            size[k] = size[k].max(terms[k]);
        }
    });
    let row = |what: &str, measured: f64| {
        let quantity = format!("{what}; {name}, 1 ms, {steps} steps");
        Outcome::new(CASE, "15", quantity, measured, allowed)
    };
    vec![
        row("pose by the mass matrix", apart(&pose, &wanted)),
        row("linear momentum, relative", most[0] / size[0]),
        row("angular momentum, relative", most[1] / size[1]),
    ]
}

/// The satellite through one cycle.
pub(crate) fn satellite_cycle(_: Extent) -> Vec<Outcome> {
    one(&file())
}

/// The satellite through 125 cycles in 1e6 steps. The error of a step is that of quadrature for a harmonic of
/// the arm's rates: Simpson's rule h⁵/2880, Gauss's h⁵/4320.
pub(crate) fn satellite_cycles(extent: Extent) -> Measured {
    let steps = extent.of(1_000_000, 2 * STEPS);
    let z: f64 = RATE * 8.0 / f64::from(STEPS);
    let mut outcomes = many(Rk4, "rk4", steps, z.powi(5) / 2880.0);
    outcomes.extend(many(Gauss2::new(), "gauss2", steps, z.powi(5) / 4320.0));
    outcomes.into()
}
