//! Every method of a robot by both formulations, to be evaluated and differentiated.

use bgdyn_codegen::expr::{Graph, Leaf, Signed, Tangent, evaluate};
use bgdyn_codegen::function::Function;
use bgdyn_codegen::method::Method;
use bgdyn_runtime::{Dd, Scalar};

use super::{Robot, State, full};

/// The functions of one formulation.
pub struct Methods {
    functions: Vec<Function>,
}

impl Methods {
    pub fn new(robot: &Robot, formulation: &str) -> Self {
        let functions = Method::OF_TRAIT.map(|m| robot.whole(formulation, m));
        Methods {
            functions: functions.into(),
        }
    }

    pub fn function(&self, method: Method) -> &Function {
        let mut found = self.functions.iter().filter(|f| f.method == method);
        found.next().expect("every method")
    }

    /// Returns a method's value; no pivot may be refused.
    pub fn value<T: Scalar<Refused = Option<usize>>>(&self, method: Method, s: &State) -> Vec<T> {
        s.value(self.function(method))
    }

    /// M, both triangles.
    pub fn mass<T: Scalar<Refused = Option<usize>>>(&self, s: &State) -> Vec<Vec<T>> {
        full(&self.value(Method::MassMatrix, s), s.q.len())
    }

    /// The method's result differentiated along a direction of (q, v, a), in double-double.
    pub fn derivative(&self, method: Method, s: &State, along: &Direction<'_>) -> Vec<Dd> {
        derivative(self.function(method), s, along)
    }
}

/// A function of one block differentiated along a direction of (q, v, a), in double-double.
pub fn derivative(function: &Function, s: &State, along: &Direction<'_>) -> Vec<Dd> {
    assert_eq!(function.blocks.len(), 1);
    let mut graph = function.graph.clone();
    let seed = |g: &mut Graph, leaf| {
        let x = match leaf {
            Leaf::Position(j) => along.q?[j],
            Leaf::Velocity(j) => along.v?[j],
            Leaf::Acceleration(j) => along.a?[j],
            _ => return None,
        };
        Some(g.constant(Dd::from_f64(x)))
    };
    let mut tangent = Tangent::new(seed);
    let outputs: Vec<Signed> = function.blocks[0]
        .outputs
        .iter()
        .map(|&e| tangent.of(&mut graph, e))
        .collect();
    evaluate(&graph, &outputs, &s.inputs(), &mut None)
}

/// Rates of q, v and a; missing ones are zero.
#[derive(Default)]
pub struct Direction<'a> {
    pub q: Option<&'a [f64]>,
    pub v: Option<&'a [f64]>,
    pub a: Option<&'a [f64]>,
}

/// Σ x_k y_k
pub fn dot(x: &[Dd], y: &[f64]) -> Dd {
    let products = x.iter().zip(y).map(|(&x, &y)| x * Dd::from_f64(y));
    products.fold(Dd::ZERO, |sum, p| sum + p)
}
