//! Checks the methods of the actuated joints of mechanisms with loops.

use bgdyn_runtime::Dd;

use super::compare::{SizedLaw, dot, largest, minus, turned};
use crate::bond_graph::ClosedTree;
use crate::expr::Inputs;
use crate::function::Function;
use crate::method::Method;

/// Returns the laws of a method: A P = P(q, v, a), and among several P that of the literal form; P(q, v, q̈) = A τ.
/// `form` creates methods by the literal sum, `at` is the state with the efforts of the actuated joints.
pub(super) fn laws(
    closed: &ClosedTree,
    method: Method,
    form: impl Fn(Method) -> Option<Function>,
    (at, found): (&Inputs<Dd>, Vec<Dd>),
) -> Option<Vec<SizedLaw>> {
    let actuated = closed.closure.drives()?;
    let value = |method, at: &Inputs<Dd>| form(method).map(|f| f.evaluate(at.clone()).0);
    let n = at.v.len();
    let map = value(Method::VelocityMap, at)?;
    let rows: Vec<Vec<Dd>> = map.chunks(n.max(1)).map(<[Dd]>::to_vec).collect();
    let rows = actuated.rows(&rows);
    let along = |efforts: &[Dd]| -> Vec<Dd> {
        let of = |k: usize| rows.iter().map(|row| row[k]).collect::<Vec<Dd>>();
        (0..n).map(|k| dot(&of(k), efforts)).collect()
    };
    let inverse = form(Method::InverseDynamics)?;
    let efforts = |v: &[Dd], a: &[Dd]| {
        let (v, a) = (v.to_vec(), a.to_vec());
        inverse.evaluate(Inputs { v, a, ..at.clone() }).0
    };
    let literal = "its literal form";
    Some(match method {
        Method::ActuatedInverse(number) => {
            let size = largest(&found) * largest(&map);
            let needed = efforts(&at.v, &at.a);
            let first = ("A P = P(q, v, a)", along(&found), needed, size);
            let several = value(method, at).filter(|_| number > n);
            let second = several.map(|expected| (literal, found, expected, size));
            [first].into_iter().chain(second).collect()
        }
        Method::ActuatedForward(_) => {
            let zero = vec![Dd::ZERO; n];
            let at_rest = efforts(&zero, &zero);
            let sizes = turned(&found).map(|x| largest(&minus(&efforts(&zero, &x), &at_rest)));
            let size = sizes.into_iter().fold(0.0, f64::max);
            let driven = efforts(&at.v, &found);
            vec![("P(q, v, q̈) = A τ", driven, along(&at.u), size)]
        }
        _ => {
            let expected = value(method, at)?;
            vec![(literal, found, expected, 0.0)]
        }
    })
}
