//! Positions of a generated scene: their rates, their change in a step, and the way back to valid ones, with unit
//! quaternions and closed loops.

use bgdyn_runtime::{FixedVector, HybridSystem, QuasiJoint, Scalar, StateVector};

use crate::quasi_joints;
use crate::real::Real;

/// Returns the rates of a scene's positions; the other components are not rates.
pub(crate) fn position_rates<T: Scalar, S: HybridSystem<T>>(scene: &S, y: &S::State) -> S::State {
    let mut rates = *y;
    if !scene.position_rates(y, &mut rates) {
        let (joints, positions) = (scene.quasi_joints(), scene.positions());
        quasi_joints::position_rates(joints, positions, y.entries(), rates.entries_mut());
    }
    rates
}

/// Returns the change of a scene's positions in the time `h` at the velocities of `y`.
pub(crate) fn position_change<T: Scalar, S: HybridSystem<T>>(
    scene: &S,
    y: &S::State,
    h: T,
) -> S::State {
    let mut change = *y;
    if scene.position_rates(y, &mut change) {
        change = change.times(h);
    } else {
        let (joints, positions) = (scene.quasi_joints(), scene.positions());
        quasi_joints::position_change(joints, positions, y.entries(), h, change.entries_mut());
    }
    change
}

/// Returns the joints whose velocities are not the rates of their positions; `None` if a scene has rates of positions of its
/// own.
pub(crate) fn quasi_joints_of<T: Scalar, S: HybridSystem<T>>(
    scene: &S,
) -> Option<&'static [QuasiJoint]> {
    let zero = S::State::zero_vector();
    let own = scene.position_rates(&zero, &mut zero.clone());
    (!own).then(|| scene.quasi_joints())
}

/// Scales quaternions to length 1 and closes loops. Returns whether there are such.
///
/// # Errors
/// As [`HybridSystem::close`].
pub(crate) fn project<T: Scalar, S: HybridSystem<T>>(
    scene: &S,
    y: &mut S::State,
) -> Result<bool, S::Singular> {
    let normalized = quasi_joints::normalize(scene.quasi_joints(), y.entries_mut());
    Ok(scene.close(y)? || normalized)
}

/// Does the same for a state in two words. The dependent positions of loops are closed in the first word.
///
/// # Errors
/// As [`HybridSystem::close`].
pub(crate) fn project_in_two<T: Scalar, S: HybridSystem<T>>(
    scene: &S,
    y: &mut S::State,
    low: &mut S::State,
) -> Result<bool, S::Singular> {
    let joints = scene.quasi_joints();
    let normalized = quasi_joints::normalize_in_two(joints, y.entries_mut(), low.entries_mut());
    let before = *y;
    let closed = scene.close(y)?;
    for ((low, y), before) in low
        .entries_mut()
        .iter_mut()
        .zip(y.entries())
        .zip(before.entries())
    {
        if y != before {
            *low = T::from_f64(0.0);
        }
    }
    Ok(closed || normalized)
}

/// Returns whether a state is off the valid ones: quaternions by more than the rounding errors of many steps. Loops
/// open with every step.
pub(crate) fn strays<T: Real, S: HybridSystem<T>>(scene: &S, y: &S::State) -> bool {
    scene.closes() || quasi_joints::strays(scene.quasi_joints(), y.entries())
}
