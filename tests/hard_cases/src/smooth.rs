//! Smooth motions by the integrator of order 8 with a tolerance of 1e-13; chaotic ones as long as rounding
//! errors have grown to less than 1e-3.

use bgdyn_sim::{Dop853, HybridState, Plant, Run, ScenePlant, StateVector};

use crate::follow::{alike, controlled, of};
use crate::outcome::Outcome;
use crate::reference::{Reference, reference};
use crate::{Extent, scenes};

/// Samples with a larger permitted deviation due to rounding are not compared.
pub(crate) const LARGEST: f64 = 1e-3;

/// Compares a motion with its reference, until rounding errors separate them.
fn within<P>(
    case: &'static str,
    plant: &P,
    begin: &HybridState<P::State, P::Modes>,
    reference: Reference,
    tolerances: &[f64],
) -> Vec<Outcome>
where
    P: Plant<State: StateVector<Scalar = f64>>,
{
    let reference = reference.only(|k, _| tolerances[k] < LARGEST);
    let states = controlled(Dop853, alike(1e-13), plant, begin, &reference.times);
    let found = of(&states, |y| y.entries().to_vec());
    let kept: Vec<f64> = tolerances
        .iter()
        .copied()
        .filter(|&t| t < LARGEST)
        .collect();
    let deviations = reference.all(&found, |k| kept[k]);
    vec![Outcome::worst(
        case,
        "6",
        "state; dop853 at 1e-13",
        deviations,
    )]
}

macro_rules! smooth {
    ($(#[$doc:meta])* $name:ident, $file:literal, $model:ident) => {
        $(#[$doc])*
        pub(crate) fn $name(_: Extent) -> Vec<Outcome> {
            let reference = reference!($file);
            let tolerances = reference.tolerances();
            let scene = scenes::$name::$model::<f64>::default();
            within($file, &ScenePlant::new(&scene), &Run::begin(&scene), reference, &tolerances)
        }
    };
}

smooth!(
    /// A double pendulum released above its pivot.
    double_pendulum_chaotic,
    "double_pendulum_chaotic",
    DoublePendulumChaotic
);
smooth!(
    /// A planar chain of eight rods.
    chain8_rods,
    "chain8_rods",
    Chain8Rods
);
smooth!(
    /// A spatial arm with full tensors and a spring.
    arm6_3d,
    "arm6_3d",
    Arm63d
);
smooth!(
    /// A light pendulum on one that is a million times heavier.
    mass_ratio_1e6_1,
    "mass_ratio_1e6_1",
    MassRatio1e61
);
smooth!(
    /// A light pendulum on one that is 1e9 times heavier.
    mass_ratio_1e9_1,
    "mass_ratio_1e9_1",
    MassRatio1e91
);

/// The pendulum of IFToMM's problem A01, to 1e-12 in every sample.
pub(crate) fn a01_simple_pendulum(_: Extent) -> Vec<Outcome> {
    let reference = reference!("a01_simple_pendulum");
    let tolerances = vec![1e-12; reference.times.len()];
    let scene = scenes::a01_simple_pendulum::A01SimplePendulum::<f64>::default();
    let (plant, begin) = (ScenePlant::new(&scene), Run::begin(&scene));
    let case = "a01_simple_pendulum";
    within(case, &plant, &begin, reference, &tolerances)
}
