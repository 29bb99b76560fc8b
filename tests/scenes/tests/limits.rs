//! Checks that states outside of a scene's domain give an error with a coordinate or a state, never a
//! number.

use bgdyn_runtime::{Canonical, FixedVector, Slope, StateVector};
use nalgebra::SVector;

/// The results at a state; `None` if it is refused.
type Function<'a, Y> = &'a dyn Fn(&Y) -> Option<Vec<f64>>;

/// No result that depends on a NaN component of the state is finite.
fn nan_is_told<S: Slope<f64> + Canonical<f64>>(scene: &S) {
    let (start, modes) = scene.start();
    let given = S::Inputs::from_entries(|_| 0.1);
    // No component is at a kink or at rest.
    let start = S::State::from_entries(|i| start.entries()[i] * 1.01 + 1e-3 * (i + 1) as f64);
    let rates = |y: &S::State| {
        let input = scene.input(y, &modes, &given, 0.3);
        let rates = scene.derivative(y, &modes, &input, 0.3);
        rates.map(|r| r.entries().to_vec()).ok()
    };
    let slopes = |y: &S::State| {
        let slope = scene.slope(y, &modes, &given, 0.3);
        slope
            .map(|(s, t)| [S::State::columns(&s), t.entries()].concat())
            .ok()
    };
    let canonical = |z: &S::State| {
        let rates = scene.canonical_rates(z, &modes, &given, 0.3);
        rates.map(|r| r.entries().to_vec()).ok()
    };
    let functions: [(&str, Function<'_, S::State>); 3] = [
        ("derivative", &rates),
        ("slope", &slopes),
        ("canonical rates", &canonical),
    ];
    for (what, function) in functions {
        let usual = function(&start).expect("a regular state");
        for i in 0..S::State::LEN {
            let (mut moved, mut spoiled) = (start, start);
            moved.entries_mut()[i] *= 1.001;
            spoiled.entries_mut()[i] = f64::NAN;
            let (moved, spoiled) = (function(&moved).expect("regular"), function(&spoiled));
            for k in 0..usual.len() {
                let depends = usual[k] != moved[k];
                let finite = spoiled.as_ref().is_some_and(|s| s[k].is_finite());
                let part = scene.state_names().as_ref()[i];
                assert!(
                    !(depends && finite),
                    "{what}: NaN in `{part}` leaves entry {k} finite"
                );
            }
        }
    }
}

/// The error of the derivative names the part of the state, the input or the time that is NaN.
#[test]
fn what_is_nan_is_named() {
    use scenes::hydraulic_cylinder::{HydraulicCylinder, INPUT_NAMES, Input, STATE_NAMES, State};
    let scene = HydraulicCylinder::<f64>::default();
    let (state, input) = (State::<f64>::default(), Input::<f64>::default());
    let named = |y: &SVector<f64, _>, u: &SVector<f64, _>, t: f64| {
        let state = State::from_vectors(y, &state.modes());
        let result = scene.derivative(&state, &Input::from_vector(u), t);
        result.err().map(|error| error.to_string())
    };
    let (y, u) = (state.vector(), input.vector());
    assert_eq!(named(&y, &u, 0.0), None);
    let message = |name: &str, i: usize, argument: &str| {
        format!(
            "no accelerations: component {i} (`{name}`) of argument `{argument}` is NaN or infinite"
        )
    };
    for (i, name) in STATE_NAMES.into_iter().enumerate() {
        let mut y = y;
        y[i] = f64::NAN;
        if let Some(found) = named(&y, &u, 0.0) {
            assert_eq!(found, message(name, i, "state"));
        }
    }
    for (i, name) in INPUT_NAMES.into_iter().enumerate() {
        let mut u = u;
        u[i] = f64::NAN;
        assert_eq!(named(&y, &u, 0.0), Some(message(name, i, "input")));
    }
}

macro_rules! nan {
    ($module:ident, $scene:ident, $path:literal) => {
        nan_is_told(&scenes::$module::$scene::<f64>::default());
    };
}

#[test]
fn nan_never_becomes_a_number() {
    scenes::each_formed!(nan);
}

/// Beyond its end the piston leaves no volume for the fluid: the error names the chamber.
#[test]
fn a_chamber_without_volume_is_an_error() {
    use scenes::hydraulic_cylinder::{HydraulicCylinder, Input, State};
    let scene = HydraulicCylinder::<f64>::default();
    let at = |slide: f64| {
        let state = State {
            slide,
            ..State::default()
        };
        let input = scene.input(&state, &Input::default(), 0.0);
        (
            scene.derivative(&state, &input, 0.0),
            scene.jacobian(&state, &Input::default(), 0.0),
            scene.energy(&state, &input, 0.0).ram,
        )
    };
    let (rates, slope, energy) = at(State::<f64>::default().slide);
    assert!(rates.is_ok() && slope.is_ok() && energy.is_finite());
    for slide in [-10.0, 10.0] {
        let (rates, slope, energy) = at(slide);
        let (rates, slope) = (rates.expect_err("no room"), slope.expect_err("no room"));
        assert!(!rates.name().is_empty() && !slope.name().is_empty() && energy.is_nan());
    }
}
