//! Derivatives of the accelerations by parameters: M q̈ + h = τ, so that ∂q̈/∂p = −M⁻¹ ∂P/∂p at constant q̈.
//!
//! | parameters | ∂P/∂p |
//! |---|---|
//! | base parameters | the regressor Y_b |
//! | run-time parameters | the efforts, differentiated by their leaves |

use bgdyn_runtime::Dd;

use super::differentiate::{finish, pairs_with_cheapest, reopen};
use crate::expr::{Builder, Expr, Graph, Leaf, Signed, Tangent, copy_into};
use crate::formulation::slopes::{along_efforts, derivatives};
use crate::formulation::{Formulation, Prepared};
use crate::function::Function;
use crate::method::{Method, ParameterDerivatives, Regressor};
use crate::passes::cheapest;

/// Derivatives of the accelerations by parameters.
pub(in crate::formulation) struct ByParameters;

impl Formulation for ByParameters {
    fn name(&self) -> &'static str {
        "by_parameters"
    }

    fn summary(&self) -> &'static str {
        "derivatives of the accelerations by parameters: forward dynamics under the efforts that a change of each needs"
    }

    fn combines(&self) -> bool {
        true
    }

    fn reads(&self, method: Method) -> Vec<Method> {
        match method {
            Method::ParameterDerivatives(of) => vec![Method::ForwardDynamics, efforts(of)],
            _ => Vec::new(),
        }
    }

    fn function(&self, prepared: &Prepared<'_>, method: Method) -> Option<Function> {
        let Method::ParameterDerivatives(of) = method else {
            return None;
        };
        let regressor = match of {
            ParameterDerivatives::Base => Some(prepared.function(efforts(of))?),
            ParameterDerivatives::RunTime(_) => None,
        };
        let inverse = prepared.candidates(efforts(of));
        let efforts: Vec<&Function> = match &regressor {
            Some(regressor) => vec![regressor],
            None => inverse.accepted.iter().map(|c| &c.plain).collect(),
        };
        let forward = prepared.candidates(Method::ForwardDynamics);
        let forward = forward.accepted.iter().chain(&forward.borderline);
        let forward: Vec<&Function> = forward.map(|candidate| &candidate.plain).collect();
        let pairs = pairs_with_cheapest(&efforts, &forward).into_iter();
        let ways = pairs.flat_map(|pair| {
            let ways = [Solution::ByElimination, Solution::ByInverse].into_iter();
            ways.filter_map(move |way| from(prepared, of, pair, way))
        });
        cheapest(ways)
    }
}

/// Returns the method whose derivative by the parameters drives the accelerations.
fn efforts(of: ParameterDerivatives) -> Method {
    match of {
        ParameterDerivatives::Base => Method::Regressor(Regressor::Base),
        ParameterDerivatives::RunTime(_) => Method::InverseDynamics,
    }
}

/// How −∂P/∂p becomes accelerations.
#[derive(Clone, Copy, PartialEq)]
enum Solution {
    /// Forward dynamics along each column.
    ByElimination,
    /// M⁻¹ as a matrix, times the columns.
    ByInverse,
}

/// Returns the function from those of the efforts and of forward dynamics.
fn from(
    prepared: &Prepared<'_>,
    of: ParameterDerivatives,
    (efforts, forward): (&Function, &Function),
    solution: Solution,
) -> Option<Function> {
    let graph = prepared.graph;
    let n = graph.coordinates.len();
    let (b, accelerations) = reopen(forward);
    let placed = |_: &mut Graph, leaf: Leaf| match leaf {
        Leaf::Acceleration(j) => Some(accelerations[j]),
        _ => None,
    };
    let results = &efforts.blocks[0].outputs;
    let columns: Vec<Vec<Signed>> = match of {
        ParameterDerivatives::Base => {
            let width = results.len().checked_div(n)?;
            let regressor = b.with_graph(|g| copy_into(g, &efforts.graph, results, placed));
            let column = |k: usize| (0..n).map(|i| regressor[i * width + k]).collect();
            (0..width).map(column).collect()
        }
        // By constant accelerations: they are leaves until the derivatives are there.
        ParameterDerivatives::RunTime(number) => {
            let own = Builder::from(efforts.graph.clone());
            let slopes: Vec<Signed> = (0..number).flat_map(|p| by(&own, results, p)).collect();
            let from = own.into_graph();
            let slopes = b.with_graph(|g| copy_into(g, &from, &slopes, placed));
            slopes.chunks(n.max(1)).map(<[Signed]>::to_vec).collect()
        }
    };
    let inverse = match solution {
        Solution::ByElimination => Vec::new(),
        Solution::ByInverse => derivatives(&b, &accelerations, n, Leaf::Input),
    };
    let solve = |column: &Vec<Signed>| -> Vec<Signed> {
        let drive: Vec<Expr<'_>> = column.iter().map(|&e| -b.expr(e)).collect();
        if solution == Solution::ByElimination {
            let drive: Vec<Signed> = drive.iter().map(|e| e.signed()).collect();
            return along_efforts(&b, &accelerations, &drive);
        }
        let row = |i: usize| {
            let terms = drive.iter().enumerate();
            // Of two symmetric entries the one nearer to the base needs fewer operations.
            let entry = |j: usize| b.expr(inverse[i.max(j)][i.min(j)]);
            terms.fold(b.zero(), |sum, (j, &e)| sum + entry(j) * e)
        };
        (0..n).map(|i| row(i).signed()).collect()
    };
    let solved: Vec<Vec<Signed>> = columns.iter().map(solve).collect();
    let mut outputs = accelerations;
    outputs.extend((0..n).flat_map(|i| solved.iter().map(move |column| column[i])));
    let method = Method::ParameterDerivatives(of);
    Some(finish(graph, method, forward, b, outputs))
}

/// Returns the derivatives of all results by a run-time parameter.
fn by(b: &Builder, results: &[Signed], parameter: usize) -> Vec<Signed> {
    let mut tangent = Tangent::new(|g: &mut Graph, leaf| {
        (leaf == Leaf::Parameter(parameter)).then(|| g.constant(Dd::ONE))
    });
    let all = results.iter();
    all.map(|&e| b.with_graph(|g| tangent.of(g, e))).collect()
}
