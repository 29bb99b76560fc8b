//! Tests ∂ẏ/∂u against differences in double-double.

use bgdyn_codegen::expr::Inputs;
use bgdyn_codegen::function::Function;
use bgdyn_codegen::method::SceneFunction;
use bgdyn_codegen::random::Random;
use bgdyn_codegen::system::SceneEquations;
use bgdyn_runtime::Dd;

use super::common::{read, specs, state};

/// Half a step of the differences: their error is its square, and the digits of double-double over it.
const STEP: f64 = 1e-9;

/// Returns the rates with one input changed.
fn moved(derivative: &Function, at: &Inputs<Dd>, input: usize, step: f64) -> Vec<Dd> {
    let mut at = at.clone();
    at.u[input] += Dd::from_f64(step);
    derivative.evaluate(at).0
}

/// Compares all ways to ∂ẏ/∂u in one state.
fn compare(system: &SceneEquations, derivative: &Function, ways: &[Function], at: &Inputs<Dd>) {
    let rates = derivative.evaluate(at.clone()).0;
    let largest = rates.iter().map(|x| x.to_f64().abs()).fold(1.0, f64::max);
    for function in ways {
        let (slopes, refused) = function.evaluate(at.clone());
        assert!(refused.is_none(), "{}", system.scene.name);
        assert_eq!(slopes.len(), rates.len() * at.u.len());
        for (input, column) in slopes.chunks(rates.len()).enumerate() {
            let ends = [STEP, -STEP].map(|step| moved(derivative, at, input, step));
            for ((slope, more), less) in column.iter().zip(&ends[0]).zip(&ends[1]) {
                let wanted = (*more - *less).to_f64() / (2.0 * STEP);
                let off = (slope.to_f64() - wanted).abs();
                let size = wanted.abs().max(largest);
                assert!(
                    off < 1e-12 * size,
                    "{}, {}, input {input}: {}, not {wanted}",
                    system.scene.name,
                    function.formulation,
                    slope.to_f64()
                );
            }
        }
    }
}

#[test]
fn slopes_by_inputs_are_those_of_the_rates() {
    let mut compared = 0;
    for path in specs() {
        let system = read(&path);
        assert_eq!(
            system.has_input_jacobian(),
            !system.scene.layout.inputs.is_empty()
        );
        // The arms of six joints take long.
        if !system.has_input_jacobian() || system.graph.coordinates.len() > 4 {
            continue;
        }
        let derivative = system.function(SceneFunction::Derivative);
        let ways = system.ways(SceneFunction::InputJacobian);
        for seed in 0..4 {
            let slipping = seed % 2 == 0 || system.scene.layout.modes.is_empty();
            let at = state(&system, &mut Random(seed), slipping);
            compare(&system, &derivative, &ways, &at);
            compared += 1;
        }
    }
    assert!(compared > 30, "{compared}");
}

/// The chosen function equals the ways from which it was chosen.
#[test]
fn the_function_has_the_values_of_its_ways() {
    let system = read(&specs()[0]);
    let at = state(&system, &mut Random(3), true);
    let wanted = system.ways(SceneFunction::InputJacobian)[0]
        .evaluate(at.clone())
        .0;
    let found = system.function(SceneFunction::InputJacobian).evaluate(at).0;
    for (found, wanted) in found.iter().zip(&wanted) {
        assert!((*found - *wanted).to_f64().abs() < 1e-25);
    }
}
