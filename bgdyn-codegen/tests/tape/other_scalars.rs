//! Compares a function's tape with the evaluator in double-double and in `f32`.

use bgdyn_codegen::engine::CallArguments;
use bgdyn_codegen::expr::Inputs;
use bgdyn_codegen::function::Function;
use bgdyn_codegen::system::SceneEquations;
use bgdyn_codegen::tape::Program;
use bgdyn_runtime::{Dd, Scalar};

use super::agreement::{same, states};

/// Number of states of each function.
const STATES: usize = 3;

/// Compares a function's tape with the evaluator.
pub fn agree(name: &str, function: &Function, scene: Option<&SceneEquations>) {
    let program = Program::new(function);
    for (k, at) in states(function, scene).take(STATES).enumerate() {
        let what = || format!("{name}, state {k}: {at:?}");
        let bits = |x: Dd| [x.hi().to_bits(), x.lo().to_bits()];
        in_scalar::<Dd, _>(&program, function, &at, &bits, what);
        in_scalar::<f32, _>(&program, function, &at, &f32::to_bits, what);
    }
}

fn in_scalar<T: Scalar<Refused = Option<usize>>, B: PartialEq>(
    program: &Program,
    function: &Function,
    at: &Inputs<f64>,
    bits: &dyn Fn(T) -> B,
    what: impl Fn() -> String,
) {
    let all = |x: &[f64]| x.iter().map(|&x| T::from_f64(x)).collect::<Vec<T>>();
    let at = Inputs {
        q: all(&at.q),
        v: all(&at.v),
        a: all(&at.a),
        x: all(&at.x),
        u: all(&at.u),
        modes: all(&at.modes),
        parameters: all(&at.parameters),
        t: at.t.map(T::from_f64),
        passed: vec![],
    };
    let (wanted, refused) = function.evaluate(at.clone());
    let (found, of_tape) = program.value(&CallArguments::from(&at));
    same(&found, &wanted, bits, &what);
    assert_eq!(of_tape, refused, "{}", what());
}
