//! Compiled code and the evaluator run the same operations on the same constants, and every arithmetic in
//! these tests rounds x and −x equally: their results are equal, word by word. Only the sign of a zero may
//! differ.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::{Arc, Mutex};

use bgdyn_codegen::function::Function;
use bgdyn_codegen::mechanism::Motion;
use bgdyn_codegen::method::Shape;
use bgdyn_codegen::model::Model;
use compiled::{Compiled, Outcome};

use crate::common::full;
use crate::common::rng::Rng;
use crate::generate;
use crate::tested::{Tested, draw, inputs};

/// Number of states per model and scalar; lanes contain several.
const STATES: usize = 1000;

/// Returns the generator's model of the compiled code, created once for all tests.
pub(crate) fn generated<T: Tested>(compiled: &dyn Compiled<T>) -> Arc<Model> {
    static MADE: Mutex<BTreeMap<&str, Arc<Model>>> = Mutex::new(BTreeMap::new());
    let origin = compiled.origin();
    let make = || generate::model(Path::new(origin.spec), origin.derivatives);
    let mut made = MADE.lock().unwrap();
    Arc::clone(made.entry(origin.name).or_insert_with(|| Arc::new(make())))
}

/// Checks that every method of a model, compiled for `C`, equals the result of the evaluator in `E`: in
/// `C` itself, or in a scalar of the same numbers that rounds constants as compiled code does. Returns the
/// number of outcomes that were errors.
pub(crate) fn agrees<C, E>(compiled: &dyn Compiled<C>) -> usize
where
    C: Tested,
    E: Tested<Refused = C::Refused>,
{
    let model = generated(compiled);
    let motions = motions(&model);
    let (mut rng, mut refused) = (Rng::new(2007), 0);
    for k in 0..STATES / C::LANES {
        let state = draw::<C>(&mut rng.clone(), &motions);
        let evaluated = draw::<E>(&mut rng, &motions);
        for (number, function) in model.functions.iter().enumerate() {
            let found = compiled.run(number, &state);
            refused += usize::from(found.is_err());
            let (values, pivots) = function.evaluate(inputs(evaluated.clone()));
            let values = values.into_iter().map(|x| C::pack(&x.numbers())).collect();
            let wanted = returned(compiled, function, motions.len(), values, pivots);
            let (found, wanted) = (found.map(numbers), wanted.map(numbers));
            let (name, method) = (compiled.origin().name, function.name());
            assert_eq!(found, wanted, "{name}, {method}, state {k}: {state:?}");
        }
    }
    refused
}

/// Returns the motion of each coordinate.
pub(crate) fn motions(model: &Model) -> Vec<Motion> {
    let coordinates = model.bond_graph.coordinates.iter();
    coordinates.map(|c| c.motion).collect()
}

/// Returns the outcome of the compiled method for these values of the evaluator.
fn returned<C: Tested>(
    compiled: &dyn Compiled<C>,
    function: &Function,
    nv: usize,
    values: Vec<C>,
    pivots: C::Refused,
) -> Outcome<C> {
    match function.shape() {
        Shape::Symmetric => Ok(full(&values, nv).concat()),
        Shape::CheckedVector => compiled.outcome(values, pivots),
        Shape::CheckedSquares => compiled.outcome(values, pivots).map(|x| x[nv..].to_vec()),
        Shape::Checked(entries) => compiled
            .outcome(values, pivots)
            .map(|x| entries.spread(&x[nv..], nv)),
        _ => Ok(values),
    }
}

fn numbers<C: Tested>(values: Vec<C>) -> Vec<f64> {
    values.into_iter().flat_map(C::numbers).collect()
}

#[test]
fn compiled_code_equals_the_evaluator_in_every_model() {
    let mut refused = 0;
    for model in compiled::all::<f64>() {
        refused += agrees::<f64, f64>(&*model);
    }
    // Massless ends are singular in every state; errors agree as well.
    assert!(refused > STATES, "{refused}");
}

/// Massless rings have the inertia of the bodies outboard of them.
#[test]
fn a_massless_link_in_between_is_no_fault() {
    let refused = agrees::<f64, f64>(&compiled::gimbal::Gimbal::default());
    assert_eq!(refused, 0);
}
