//! Bars 15 and 16: energy, momenta and lengths of quaternions over 1e6 steps.
//!
//! A step has about 1/50 rad at the largest rate w of a motion. In the products of Euler's equations rates
//! are up to twice that; with z = 2 h w the theory of the linear oscillator gives what a method may change:
//!
//! - `rk4` damps by z⁶/72 a step, which adds up, and oscillates by z⁴/120;
//! - Gauss–Legendre methods conserve a modified energy, from which the energy differs by z⁴/720 (two
//!   stages) or z⁶/100800 (three): the error is bounded, and the last tenth of a run is at most 1.5 times
//!   the first;
//! - quadratic invariants they conserve: the kinetic energy of a free body, the length of its angular
//!   momentum.
//!
//! Beside these the rounding errors of the steps add up like a random walk, to 4 eps √steps.

use bgdyn_runtime::{Dd, FixedVector, HybridSystem};
use bgdyn_sim::{
    FixedModes, Gauss2, Gauss3, Integrator, Rk4, Run, ScenePlant, Solver, StateVector,
};

use crate::body::{Body, Freedom, Invariants};
use crate::outcome::Outcome;
use crate::tenths::Tenths;
use crate::turning::{BODY, ROD, TOP, TUMBLING};
use crate::vectors::{Vector, dot, excess};
use crate::{Extent, Measured, scenes};

/// Returns what the rounding errors of so many steps add up to.
pub(crate) fn adding_up(steps: u32) -> f64 {
    4.0 * f64::EPSILON * f64::from(steps).sqrt()
}

/// A motion, with its steps.
struct Motion {
    case: &'static str,
    body: Body,
    /// The largest angular rate, rad/s, rounded up.
    rate: f64,
    /// Length of a step, s.
    h: f64,
    /// Number of steps of the quick run, of which a tenth is a period at least.
    quick: u32,
}

const FREE_BODY: Motion = Motion {
    case: "free_body_generic",
    body: BODY,
    rate: 2.6,
    h: 1e-2,
    quick: 20_000,
};
const CUSP: Motion = Motion {
    case: "heavy_top_slow_cusp",
    body: TOP,
    rate: 40.4,
    h: 5e-4,
    quick: 40_000,
};
const SLEEPING: Motion = Motion {
    case: "heavy_top_sleeping_stable",
    body: TOP,
    rate: 210.0,
    h: 1e-4,
    quick: 400_000,
};
const PENDULUM: Motion = Motion {
    case: "spherical_pendulum",
    body: ROD,
    rate: 7.8,
    h: 2e-3,
    quick: 20_000,
};
const FLIPS: Motion = Motion {
    case: "body_tumbling",
    body: TUMBLING,
    rate: 4.1,
    h: 5e-3,
    quick: 40_000,
};

/// Errors along a run: of the energy in units of the first kinetic energy, of momenta relative to the first
/// ones.
struct Kept {
    energy: Tenths,
    /// The angular momentum: all of it for a floating body, the vertical component about a ball.
    angular: Tenths,
    /// Its length, which is constant without moments of force.
    length: Tenths,
    linear: Tenths,
    /// The largest | |q|² − 1 |.
    excess: f64,
}

/// The values of one state.
struct Values {
    energy: Dd,
    angular: Vector,
    linear: Vector,
}

impl Values {
    fn of(invariants: &Invariants, y: &[f64]) -> Self {
        Values {
            energy: invariants.energy(y),
            angular: invariants.angular(y),
            linear: invariants.linear(y),
        }
    }
}

/// The largest component of a − b.
fn apart(a: Vector, b: Vector) -> f64 {
    let off = [0, 1, 2].map(|i| (a[i] - b[i]).to_f64().abs());
    off.into_iter().fold(0.0, f64::max)
}

fn length(a: Vector) -> f64 {
    dot(a, a).to_f64().sqrt()
}

impl Kept {
    /// Follows a run.
    fn new<S, M>(motion: &Motion, scene: &S, method: M, steps: u32) -> Self
    where
        S: HybridSystem<f64>,
        M: Integrator<S::State>,
    {
        let (plant, begin) = (ScenePlant::new(scene), Run::begin(scene));
        let (plant, modes) = (&plant, &begin.modes);
        let held = FixedModes { plant, modes };
        let mut solver = Solver::new(method, 0.0, begin.y);
        let invariants = motion.body.invariants();
        let first = Values::of(&invariants, begin.y.entries());
        let kinetic = invariants.kinetic(begin.y.entries()).to_f64();
        let sizes = [first.angular, first.linear].map(length);
        let floats = motion.body.freedom == Freedom::Floating;
        let none = || Tenths::new(steps);
        let mut kept = Kept {
            energy: none(),
            angular: none(),
            length: none(),
            linear: none(),
            excess: 0.0,
        };
        for i in 1..=steps {
            solver.advance(&held, motion.h).expect("it turns");
            let y = solver.y().entries();
            let now = Values::of(&invariants, y);
            let energy = (now.energy - first.energy).to_f64() / kinetic;
            kept.energy.add(i, energy);
            let turned = match floats {
                true => apart(now.angular, first.angular),
                false => (now.angular[2] - first.angular[2]).to_f64(),
            };
            kept.angular.add(i, turned / sizes[0]);
            let square = dot(now.angular, now.angular) - dot(first.angular, first.angular);
            kept.length
                .add(i, square.to_f64() / (2.0 * sizes[0] * sizes[0]));
            if sizes[1] > 0.0 {
                kept.linear
                    .add(i, apart(now.linear, first.linear) / sizes[1]);
            }
            kept.excess = kept.excess.max(excess(y, invariants.quaternion()).abs());
        }
        kept
    }
}

/// How much a method changes what remains constant.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Theory {
    /// The error grows with the steps.
    Grows,
    /// The error is bounded, and quadratic invariants are kept.
    Bounded {
        /// Whether the bound is far above rounding, so that growth would show.
        shows: bool,
    },
}

/// One method on one motion: rows of energy, momenta, lengths.
fn rows<S, M>(
    motion: &Motion,
    scene: &S,
    method: M,
    theory: Theory,
    error: f64,
    steps: u32,
) -> Vec<Outcome>
where
    S: HybridSystem<f64>,
    M: Integrator<S::State>,
{
    let name = method.info().name;
    let lengths = if method.keeps_lengths() { 64.0 } else { 4.0 };
    let kept = Kept::new(motion, scene, method, steps);
    let (ms, rounded) = (motion.h * 1e3, adding_up(steps));
    let row = |bar, what: &str, measured: f64, allowed: f64| {
        let quantity = format!("{what}; {name}, {ms} ms, {steps} steps");
        Outcome::new(motion.case, bar, quantity, measured, allowed)
    };
    let floats = motion.body.freedom == Freedom::Floating;
    // Without gravity the energy is quadratic, and so is the square of the angular momentum in link axes.
    let quadratic = match theory {
        Theory::Bounded { .. } if floats => rounded,
        _ => error + rounded,
    };
    let angular = ["vertical angular momentum", "angular momentum"][usize::from(floats)];
    let mut rows = vec![
        row("15", "energy, relative", kept.energy.most(), quadratic),
        row(
            "15",
            &format!("{angular}, relative"),
            kept.angular.most(),
            error + rounded,
        ),
    ];
    if floats {
        let what = "length of the angular momentum, relative";
        rows.push(row("15", what, kept.length.most(), quadratic));
        if kept.linear.most() > 0.0 {
            let what = "linear momentum, relative";
            rows.push(row("15", what, kept.linear.most(), error + rounded));
        }
    }
    if theory == (Theory::Bounded { shows: true }) {
        let what = format!("{angular}, last tenth over first");
        rows.push(row("15", &what, kept.angular.grown(), 1.5));
        if !floats {
            let what = "energy, last tenth over first";
            rows.push(row("15", what, kept.energy.grown(), 1.5));
        }
    }
    let what = "| |q|² − 1 |, in eps";
    rows.push(row("16", what, kept.excess / f64::EPSILON, lengths));
    rows
}

/// The motion by three methods.
fn by_all<S>(motion: &Motion, scene: &S, extent: Extent) -> Measured
where
    S: HybridSystem<f64, State: FixedVector>,
{
    let steps = extent.of(1_000_000, motion.quick);
    let z: f64 = 2.0 * motion.h * motion.rate;
    let damped = f64::from(steps) * z.powi(6) / 72.0 + z.powi(4) / 120.0;
    let [two, three] = [true, false].map(|shows| Theory::Bounded { shows });
    let mut all = rows(motion, scene, Rk4, Theory::Grows, damped, steps);
    all.extend(rows(
        motion,
        scene,
        Gauss2::new(),
        two,
        z.powi(4) / 720.0,
        steps,
    ));
    all.extend(rows(
        motion,
        scene,
        Gauss3::new(),
        three,
        z.powi(6) / 100_800.0,
        steps,
    ));
    all.into()
}

macro_rules! long_run {
    ($name:ident, $module:ident, $model:ident, $motion:expr) => {
        /// The motion of this name over many steps.
        pub(crate) fn $name(extent: Extent) -> Measured {
            by_all(&$motion, &scenes::$module::$model::<f64>::default(), extent)
        }
    };
}

long_run!(free_body, free_body_generic, FreeBodyGeneric, FREE_BODY);
long_run!(cusp, heavy_top_slow_cusp, HeavyTopSlowCusp, CUSP);
long_run!(
    sleeping,
    heavy_top_sleeping_stable,
    HeavyTopSleepingStable,
    SLEEPING
);
long_run!(pendulum, spherical_pendulum, SphericalPendulum, PENDULUM);
long_run!(flips, body_tumbling, BodyTumbling, FLIPS);
