//! Samples the states at which functions are compared.

use bgdyn_runtime::Dd;

use crate::bond_graph::BondGraph;
use crate::conditioning::rounding_error::in_double_double;
use crate::conditioning::sample_states;
use crate::expr::Inputs;
use crate::mechanism::closure::Closure;
use crate::random::Random;
use crate::system::SceneEquations;

/// Largest number of coordinates for which all states are used.
const MAX_COORDINATES_WITH_ALL_STATES: usize = 10;

/// Indices of the generic states that are used: slow, fast, under large efforts.
const GENERIC: [usize; 3] = [0, 2, 3];

/// Returns a number in −1 … 1.
pub(super) fn signed(random: &mut Random) -> Dd {
    Dd::from_f64(random.signed())
}

/// Returns a direction: numbers in −1 … 1.
pub(super) fn direction(random: &mut Random, n: usize) -> Vec<Dd> {
    (0..n).map(|_| signed(random)).collect()
}

/// Returns numbers within `size` of these.
fn around(random: &mut Random, start: &[Dd], size: f64) -> Vec<Dd> {
    let size = Dd::from_f64(size);
    start.iter().map(|&x| x + size * signed(random)).collect()
}

/// Returns states of a mechanism: three, or one for more than ten coordinates. In the first one run-time
/// parameters have the values of the spec, in the others positive ones close to these.
pub(super) fn of_mechanism(graph: &BondGraph) -> Vec<Inputs<Dd>> {
    let count = match graph.coordinates.len() {
        0..=MAX_COORDINATES_WITH_ALL_STATES => GENERIC.len(),
        _ => 1,
    };
    let generic = sample_states::random(graph);
    let mut random = Random(7);
    let chosen = GENERIC[..count].iter().enumerate().map(|(k, &i)| {
        let mut state = in_double_double(&generic[i]);
        graph.normalize(&mut state.q);
        if let Some(closed) = &graph.closed {
            closed.closure.close(&mut state.q);
        }
        if k > 0 || count == 1 {
            vary(&mut state.parameters, &mut random);
        }
        state
    });
    chosen.collect()
}

/// Changes run-time parameters: increases them by up to a half, plus up to a tenth of a unit, so that one
/// that is zero in the file changes as well.
fn vary(parameters: &mut [Dd], random: &mut Random) {
    for p in parameters {
        let (part, more) = (signed(random), signed(random));
        *p = *p * (Dd::ONE + Dd::from_f64(0.5) * part * part) + Dd::from_f64(0.1) * more * more;
    }
}

/// Closes the loops at these positions, or closer to the start if they do not close on its branch.
fn close_near(closure: &Closure, start: &[Dd], q: &mut [Dd]) {
    let wanted = q.to_vec();
    for halvings in 0..8 {
        let part = Dd::from_f64(0.5_f64.powi(halvings));
        for ((q, &wanted), &start) in q.iter_mut().zip(&wanted).zip(start) {
            *q = start + (wanted - start) * part;
        }
        if closure.close(q) && closure.signs_at(q) == closure.signs {
            return;
        }
    }
    q.copy_from_slice(start);
}

/// Returns states of a scene near its start: with all modes slipping, or some of them held.
pub(super) fn of_scene(system: &SceneEquations) -> Vec<Inputs<Dd>> {
    let layout = &system.scene.layout;
    let initial = &system.initial;
    let count = match (
        layout.nv() <= MAX_COORDINATES_WITH_ALL_STATES,
        layout.modes.is_empty(),
    ) {
        (false, _) => 1,
        (true, true) => 2,
        (true, false) => 3,
    };
    let state = |k: u64| {
        let mut random = Random(100 + k);
        let v = around(&mut random, &initial.v, 1.0);
        // First-order states differ in size: bristles, volumes of fluid, currents.
        let x = initial.x.iter().map(|&x| {
            let size = if x == Dd::ZERO { Dd::ONE } else { x };
            x + Dd::from_f64(1e-3) * size * signed(&mut random)
        });
        let x = x.collect();
        let modes = layout.modes.iter().map(|_| {
            let value = 1.5 * random.signed();
            let slips = if value < 0.0 { -1.0 } else { 1.0 };
            Dd::from_f64(if k == 0 { slips } else { value.round() })
        });
        let mut state = Inputs {
            modes: modes.collect(),
            q: around(&mut random, &initial.q, 0.3),
            v,
            a: around(&mut random, &vec![Dd::ZERO; layout.nv()], 3.0),
            x,
            u: around(&mut random, &vec![Dd::ZERO; layout.inputs.len()], 2.0),
            parameters: system.scene.parameters.iter().map(|p| p.default).collect(),
            t: Some(signed(&mut random) * signed(&mut random)),
            passed: vec![],
        };
        layout.normalize(&mut state.q);
        if let Some(closure) = system.scene.mechanism.closure() {
            close_near(closure, &initial.q, &mut state.q);
        }
        state
    };
    (0..count).map(state).collect()
}
