//! Bodies that turn freely, with quaternions in their states: motions by the integrator of order 8 with a
//! tolerance of 1e-13 against reference solutions, and what remains constant along them.

use bgdyn_runtime::manifold::rotation;
use bgdyn_runtime::{Dd, HybridSystem};
use bgdyn_sim::{Dop853, Run, ScenePlant, StateVector};

use crate::body::{Body, Freedom};
use crate::follow::{alike, controlled, of};
use crate::outcome::{Deviation, Outcome};
use crate::reference::{Reference, reference};
use crate::smooth::LARGEST;
use crate::vectors::{Vector, apart, length};
use crate::{Extent, growth, scenes};

/// The rule of the files where nothing grows: 1e4 roundings.
pub(crate) const ROUNDING: f64 = 1e4 * f64::EPSILON;

/// The heavy top.
pub(crate) const TOP: Body = Body {
    freedom: Freedom::Spherical,
    mass: 15.0,
    com: [0.0, 1.0, 0.0],
    moments: [0.234375, 0.46875, 0.234375],
    gravity: 9.81,
};

/// The rod on a ball joint.
pub(crate) const ROD: Body = Body {
    freedom: Freedom::Spherical,
    mass: 1.2,
    com: [0.0, 0.0, -0.5],
    moments: [0.1, 0.1, 0.0009],
    gravity: 9.81,
};

/// The free body with its centre of mass at its origin.
pub(crate) const BODY: Body = Body {
    freedom: Freedom::Floating,
    mass: 1.0,
    com: [0.0; 3],
    moments: [1.0, 2.0, 3.0],
    gravity: 0.0,
};

/// The free body that flips.
pub(crate) const TUMBLING: Body = Body {
    freedom: Freedom::Floating,
    mass: 2.0,
    com: [0.05, -0.02, 0.08],
    moments: [0.011, 0.021, 0.029],
    gravity: 0.0,
};

/// The states of a scene at the times of a reference.
fn states<S: HybridSystem<f64>>(scene: &S, reference: &Reference) -> Vec<Vec<f64>> {
    let (plant, begin) = (ScenePlant::new(scene), Run::begin(scene));
    let states = controlled(Dop853, alike(1e-13), &plant, &begin, &reference.times);
    of(&states, |y| y.entries().to_vec())
}

/// Returns the columns of the files of tops and of the free body: ω in body axes, the quaternion with w
/// first, and the rotation matrix row by row. A state has the quaternion x, y, z, w at one index, ω at
/// another.
fn columns(y: &[f64], quaternion: usize, rate: usize) -> Vec<f64> {
    let [a, b, c, d] = [0, 1, 2, 3].map(|i| y[quaternion + i]);
    let r = rotation([a, b, c, d]);
    let entries = (0..9).map(|k| r[(k / 3, k % 3)]);
    let rates = y[rate..rate + 3].iter().copied();
    rates.chain([d, a, b, c]).chain(entries).collect()
}

/// Compares all columns of a file, whose quaternion is in these four columns from an index, with its
/// tolerance per sample.
fn compared(
    case: &str,
    reference: &Reference,
    found: Vec<Vec<f64>>,
    quaternion: usize,
    what: &str,
) -> Outcome {
    let tolerances = reference.tolerances();
    let found = reference.with_signs(found, quaternion);
    let deviations = reference.all(&found, |k| tolerances[k]);
    Outcome::worst(case, "6", &format!("{what}; dop853 at 1e-13"), deviations)
}

/// Checks that functions of the state are constant to 1e4 roundings of a size.
fn constant(
    case: &str,
    what: &str,
    (times, states): (&[f64], &[Vec<f64>]),
    size: f64,
    value: impl Fn(&[f64]) -> Vector,
) -> Outcome {
    let start = value(&states[0]);
    let deviations = times.iter().zip(states).map(|(&t, y)| Deviation {
        t,
        measured: apart(value(y), start) / size,
        allowed: ROUNDING,
    });
    let quantity = format!("{what}, relative; dop853 at 1e-13");
    Outcome::worst(case, "15", &quantity, deviations)
}

/// Returns energy and momenta of a body along a motion: all of the angular momentum of a floating body, its
/// vertical component about a ball.
fn kept(case: &str, body: &Body, reference: &Reference, states: &[Vec<f64>]) -> Vec<Outcome> {
    let invariants = body.invariants();
    let zero = Dd::ZERO;
    let (times, first) = (&reference.times[..], &states[0][..]);
    let run = (times, states);
    let kinetic = invariants.kinetic(first).to_f64();
    let energy = constant(case, "energy", run, kinetic, |y| {
        [invariants.energy(y), zero, zero]
    });
    let size = length(invariants.angular(first));
    let angular = constant(case, "angular momentum", run, size, |y| {
        let all = invariants.angular(y);
        match body.freedom {
            Freedom::Floating => all,
            Freedom::Spherical => [zero, zero, all[2]],
        }
    });
    let mut outcomes = vec![energy, angular];
    let size = length(invariants.linear(first));
    if body.freedom == Freedom::Floating && size > 0.0 {
        outcomes.push(constant(case, "linear momentum", run, size, |y| {
            invariants.linear(y)
        }));
    }
    outcomes
}

macro_rules! turning {
    ($(#[$doc:meta])* $name:ident, $module:ident, $model:ident, $body:expr, $quaternion:literal, $columns:expr) => {
        $(#[$doc])*
        pub(crate) fn $name(_: Extent) -> Vec<Outcome> {
            let (case, reference) = (stringify!($module), reference!($module));
            let states = states(&scenes::$module::$model::<f64>::default(), &reference);
            let found = of(&states, |y| $columns(y));
            let what = "velocities, orientation";
            let mut outcomes = vec![compared(case, &reference, found, $quaternion, what)];
            outcomes.extend(kept(case, &$body, &reference, &states));
            outcomes
        }
    };
}

turning!(
    /// A free body with three different moments.
    free_body_generic,
    free_body_generic,
    FreeBodyGeneric,
    BODY,
    3,
    |y: &[f64]| columns(y, 3, 10)
);
turning!(
    /// A heavy top whose nutation has cusps.
    heavy_top_slow_cusp,
    heavy_top_slow_cusp,
    HeavyTopSlowCusp,
    TOP,
    3,
    |y: &[f64]| columns(y, 0, 4)
);
turning!(
    /// A heavy top that sleeps, almost upright.
    heavy_top_sleeping_stable,
    heavy_top_sleeping_stable,
    HeavyTopSleepingStable,
    TOP,
    3,
    |y: &[f64]| columns(y, 0, 4)
);
turning!(
    /// A rod that swings over the pole of its ball joint. The columns are the state.
    spherical_pendulum,
    spherical_pendulum,
    SphericalPendulum,
    ROD,
    0,
    <[f64]>::to_vec
);
turning!(
    /// A free body that flips about its intermediate axis. The columns are the state.
    flips,
    body_tumbling,
    BodyTumbling,
    TUMBLING,
    3,
    <[f64]>::to_vec
);

/// The body that flips. Its file says how much a change at the start has grown; what changes later grows
/// more, because the motion returns to where it began. Beside the file's tolerance per sample, which no
/// method keeps, a row has the same by the growth since any sample before.
pub(crate) fn body_tumbling(extent: Extent) -> Vec<Outcome> {
    let mut outcomes = flips(extent);
    let reference = reference!("body_tumbling");
    let scene = scenes::body_tumbling::BodyTumbling::<f64>::default();
    let found = states(&scene, &reference);
    let grown = growth::since_any(&scene, &found, &reference.times);
    let found = reference.with_signs(found, 3);
    let deviations = reference.all(&found, |k| ROUNDING * grown[k]);
    let comparable = deviations.into_iter().filter(|d| d.allowed < LARGEST);
    let what = "the same, by the growth since any sample; dop853 at 1e-13";
    let outcome = Outcome::worst("body_tumbling", "6", what, comparable);
    outcomes.insert(1, outcome);
    outcomes
}

/// Compares the satellite under torques in its arm with its file. The columns are the state.
pub(crate) fn satellite_motion() -> (Reference, Vec<Vec<f64>>, Outcome) {
    let reference = reference!("satellite_torques");
    let scene = scenes::satellite_torques::SatelliteTorques::<f64>::default();
    let states = states(&scene, &reference);
    let case = "satellite_torques";
    let outcome = compared(case, &reference, states.clone(), 3, "state");
    (reference, states, outcome)
}
