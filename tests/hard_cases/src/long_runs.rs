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
//!   momentum;
//! - the linear momentum of a free body turns. In link axes a vector rotates by the rate w, the quaternion
//!   that takes it to world axes by w/2: the errors of their phases differ by up to z⁵/120, z⁵/720 or
//!   z⁷/100800 a step with z = h w, which adds up for every method.
//!
//! Beside these the rounding errors of the steps add up like a random walk, to 4 eps √steps. Energies are in
//! units of the first kinetic energy, momenta of their largest length in the run.

use bgdyn_runtime::{Dd, HybridSystem};
use bgdyn_sim::{
    FixedModes, Gauss2, Gauss3, Integrator, Rk4, Run, ScenePlant, Solver, StateVector,
};

use crate::bars::part;
use crate::body::{Body, Freedom, Invariants};
use crate::outcome::Outcome;
use crate::reference::larger;
use crate::tenths::Tenths;
use crate::turning::{BODY, ROD, TOP, TUMBLING};
use crate::vectors::{Vector, apart, dot, excess, length};
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
    /// Number of steps of the quick run, of which a tenth is a period at least where growth is measured.
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
    quick: 40_000,
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

/// Errors along a run, in SI units.
struct Kept {
    energy: Tenths,
    /// The first kinetic energy.
    kinetic: f64,
    /// The first lengths of the angular and the linear momentum.
    first: [f64; 2],
    /// The largest ones.
    sizes: [f64; 2],
    /// The angular momentum: all of it for a floating body, the vertical component about a ball.
    angular: Tenths,
    /// Its length.
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
        let lengths = [first.angular, first.linear].map(length);
        let floats = motion.body.freedom == Freedom::Floating;
        let none = || Tenths::new(steps);
        let mut kept = Kept {
            energy: none(),
            kinetic,
            first: lengths,
            sizes: lengths,
            angular: none(),
            length: none(),
            linear: none(),
            excess: 0.0,
        };
        for i in 1..=steps {
            solver.advance(&held, motion.h).expect("it turns");
            let y = solver.y().entries();
            let now = Values::of(&invariants, y);
            kept.energy.add(i, (now.energy - first.energy).to_f64());
            let turned = match floats {
                true => apart(now.angular, first.angular),
                false => (now.angular[2] - first.angular[2]).to_f64(),
            };
            kept.angular.add(i, turned);
            let square = dot(now.angular, now.angular) - dot(first.angular, first.angular);
            kept.length.add(i, square.to_f64() / (2.0 * lengths[0]));
            kept.linear.add(i, apart(now.linear, first.linear));
            let now = [now.angular, now.linear].map(length);
            kept.sizes = [0, 1].map(|k| kept.sizes[k].max(now[k]));
            kept.excess = larger(kept.excess, excess(y, invariants.quaternion()).abs());
        }
        kept
    }
}

/// What a method may change, by its theory.
#[derive(Clone, Copy)]
struct Theory {
    /// Whether quadratic invariants are conserved.
    quadratic: bool,
    /// The error of other invariants, relative.
    error: f64,
    /// The turn of a constant vector per step, rad.
    turn: f64,
}

/// Rows of a table for one method on one motion.
struct Rows<'a> {
    motion: &'a Motion,
    method: &'static str,
    steps: u32,
    rows: Vec<Outcome>,
}

impl Rows<'_> {
    /// Adds a row; `asked` is the limit as it was set before anything was measured.
    fn add(&mut self, bar: &'static str, what: &str, measured: f64, allowed: f64, asked: f64) {
        let (ms, steps) = (self.motion.h * 1e3, self.steps);
        let quantity = format!("{what}; {}, {ms} ms, {steps} steps", self.method);
        let row = Outcome::new(self.motion.case, bar, quantity, measured, allowed);
        let asked = part(measured, asked);
        self.rows.push(Outcome { asked, ..row });
    }

    /// Adds the growth of an error that is bounded, unless the error is only that of rounding.
    fn add_growth(&mut self, what: &str, errors: &Tenths, size: f64) {
        if errors.most() / size > adding_up(self.steps) {
            let what = format!("{what}, last tenth over first");
            self.add("15", &what, errors.grown(), 1.5, 1.5);
        }
    }
}

/// One method on one motion: rows of energy, momenta, lengths.
fn rows<S, M>(motion: &Motion, scene: &S, method: M, theory: Theory, steps: u32) -> Vec<Outcome>
where
    S: HybridSystem<f64>,
    M: Integrator<S::State>,
{
    let (name, keeps_lengths) = (method.info().name, method.keeps_lengths());
    let kept = Kept::new(motion, scene, method, steps);
    let floats = motion.body.freedom == Freedom::Floating;
    let rounded = adding_up(steps);
    let bounded = theory.error + rounded;
    // Without gravity the energy is quadratic, and so is the square of the angular momentum in link axes.
    let quadratic = if theory.quadratic && floats {
        rounded
    } else {
        bounded
    };
    let angular = ["vertical angular momentum", "angular momentum"][usize::from(floats)];
    let mut rows = Rows {
        motion,
        method: name,
        steps,
        rows: vec![],
    };
    let energy = kept.energy.most() / kept.kinetic;
    rows.add("15", "energy, relative", energy, quadratic, quadratic);
    let ([size, moving], [first, _]) = (kept.sizes, kept.first);
    let most = kept.angular.most();
    // As asked, in units of the first angular momentum.
    let asked = bounded * first / size;
    rows.add(
        "15",
        &format!("{angular}, relative"),
        most / size,
        bounded,
        asked,
    );
    if floats {
        let what = "length of the angular momentum, relative";
        rows.add("15", what, kept.length.most() / size, quadratic, quadratic);
    }
    if floats && moving > 0.0 {
        let turned = f64::from(steps) * theory.turn + rounded;
        let measured = kept.linear.most() / moving;
        rows.add("15", "linear momentum, relative", measured, turned, bounded);
    }
    if theory.quadratic {
        rows.add_growth(angular, &kept.angular, size);
        if !floats {
            rows.add_growth("energy", &kept.energy, kept.kinetic);
        }
    }
    // An integrator that keeps lengths is projected beyond 64 eps, as the scalar computes them.
    let (allowed, asked) = if keeps_lengths {
        (66.0, 64.0)
    } else {
        (4.0, 4.0)
    };
    let excess = kept.excess / f64::EPSILON;
    rows.add(
        "16",
        "squared length of the quaternion less 1, in eps",
        excess,
        allowed,
        asked,
    );
    rows.rows
}

/// The motion by three methods.
fn by_all<S: HybridSystem<f64>>(motion: &Motion, scene: &S, extent: Extent) -> Measured {
    let steps = extent.of(1_000_000, motion.quick);
    let once: f64 = motion.h * motion.rate;
    let twice = 2.0 * once;
    let rk4 = Theory {
        quadratic: false,
        error: f64::from(steps) * twice.powi(6) / 72.0 + twice.powi(4) / 120.0,
        turn: once.powi(5) / 120.0,
    };
    let two = Theory {
        quadratic: true,
        error: twice.powi(4) / 720.0,
        turn: once.powi(5) / 720.0,
    };
    let three = Theory {
        quadratic: true,
        error: twice.powi(6) / 100_800.0,
        turn: once.powi(7) / 100_800.0,
    };
    let mut all = rows(motion, scene, Rk4, rk4, steps);
    all.extend(rows(motion, scene, Gauss2::new(), two, steps));
    all.extend(rows(motion, scene, Gauss3::new(), three, steps));
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
