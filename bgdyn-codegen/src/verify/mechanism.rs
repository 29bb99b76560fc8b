//! The functions of a mechanism against the literal sum.

use bgdyn_runtime::Dd;

use super::Difference;
use super::compare::{
    DIFFERENCED, EXACT, Law, SOLVED, beside, differs, dot, largest, minus, plus, slope, times,
    turned,
};
use super::states::{Random, of_mechanism};
use crate::bond_graph::BondGraph;
use crate::expr::Inputs;
use crate::formulation::{Search, specification};
use crate::function::{Function, in_triangle};
use crate::method::Method;

/// Compares functions of a mechanism with the literal sum for its bond graph: at three states, or
/// at one beyond ten coordinates. At most one difference for each function.
pub fn check_functions(name: &str, graph: &BondGraph, functions: &[Function]) -> Vec<Difference> {
    let literal = Literal::new(graph);
    let states: Vec<State> = of_mechanism(graph)
        .into_iter()
        .map(|at| (literal.size(&at), at))
        .collect();
    let found = functions.iter().filter_map(|function| {
        let subject = Subject {
            name,
            function,
            literal: &literal,
        };
        let refused = subject.refuses_all(&states);
        refused.or_else(|| states.iter().find_map(|state| subject.check(state)))
    });
    found.collect()
}

/// A state, and the size of the efforts in it: [`Literal::size`].
type State = (f64, Inputs<Dd>);

/// The literal sum of a bond graph.
pub(super) struct Literal<'a> {
    search: Search<'a>,
    inverse: Function,
}

impl<'a> Literal<'a> {
    pub fn new(graph: &'a BondGraph) -> Self {
        let search = Search::new(graph, None);
        let inverse = specification().function(&search, Method::InverseDynamics);
        Literal {
            inverse: inverse.expect("the literal sum knows inverse dynamics"),
            search,
        }
    }

    fn value(&self, method: Method, at: &Inputs<Dd>) -> Option<Vec<Dd>> {
        let function = specification().function(&self.search, method)?;
        Some(function.evaluate(at.clone()).0)
    }

    /// P(q, v, a), the rest as in `at`.
    fn efforts(&self, at: &Inputs<Dd>, q: &[Dd], v: &[Dd], a: &[Dd]) -> Vec<Dd> {
        let inputs = Inputs {
            q: q.to_vec(),
            v: v.to_vec(),
            a: a.to_vec(),
            ..at.clone()
        };
        self.inverse.evaluate(inputs).0
    }

    /// The size of the terms that add up to efforts: of P(q, v, a), and of M times the squares of the
    /// velocities, which is what centrifugal terms are like before they cancel.
    fn size(&self, at: &Inputs<Dd>) -> f64 {
        let squares: Vec<Dd> = at.v.iter().map(|&v| v * v).collect();
        let whole = largest(&self.efforts(at, &at.q, &at.v, &at.a));
        whole.max(largest(&self.inertial(at, &at.q, &squares)))
    }

    /// The size of the terms of M(q) x, which cancel where x is large and M nearly singular: the
    /// largest product with other signs of the components of x.
    fn size_of_product(&self, at: &Inputs<Dd>, x: &[Dd]) -> f64 {
        let products = turned(x).map(|x| largest(&self.inertial(at, &at.q, &x)));
        products.into_iter().fold(0.0, f64::max)
    }

    /// M(q) x = P(q, 0, x) − P(q, 0, 0)
    fn inertial(&self, at: &Inputs<Dd>, q: &[Dd], x: &[Dd]) -> Vec<Dd> {
        let zero = vec![Dd::ZERO; x.len()];
        let moved = self.efforts(at, q, &zero, x);
        minus(&moved, &self.efforts(at, q, &zero, &zero))
    }
}

/// One function of a mechanism.
struct Subject<'a> {
    name: &'a str,
    function: &'a Function,
    literal: &'a Literal<'a>,
}

/// What a law compares: what is found, what is expected, the size of the terms in them.
struct Sides {
    law: Law,
    found: Vec<Dd>,
    expected: Vec<Dd>,
    size: f64,
}

impl Sides {
    fn new(text: &'static str, allowed: f64, found: Vec<Dd>, expected: Vec<Dd>) -> Self {
        let law = Law { text, allowed };
        Sides {
            law,
            found,
            expected,
            size: 0.0,
        }
    }

    fn sized(self, size: f64) -> Self {
        Sides { size, ..self }
    }
}

impl Subject<'_> {
    /// The first law that the function does not obey at this state. A state in which it refuses a
    /// pivot has nothing to compare.
    fn check(&self, (efforts, at): &State) -> Option<Difference> {
        let (found, refused) = self.function.evaluate(at.clone());
        if refused.is_some() {
            return None;
        }
        let speed = largest(&at.v);
        let size = match self.function.method {
            Method::Pose(_) | Method::Jacobian(_) => 1.0,
            Method::Velocity(_) => speed,
            Method::JacobianDotV(_) => speed * speed,
            _ => *efforts,
        };
        let laws = self.laws(at, found).into_iter();
        laws.filter_map(|sides| {
            let pair = (&sides.found[..], &sides.expected[..]);
            let size = sides.size.max(size);
            differs((self.name, self.function), &sides.law, pair, size, at)
        })
        .next()
    }

    /// A function that refuses every state though the literal sum refuses none of them.
    fn refuses_all(&self, states: &[State]) -> Option<Difference> {
        let refuses = |function: &Function| {
            let refused = |(_, at): &State| function.evaluate(at.clone()).1.is_some();
            states.iter().all(refused)
        };
        if states.is_empty() || !self.function.shape().checked() || !refuses(self.function) {
            return None;
        }
        let literal = specification().function(&self.literal.search, Method::ForwardDynamics)?;
        let (_, answered) = states
            .iter()
            .find(|(_, at)| literal.evaluate(at.clone()).1.is_none())?;
        let text = "the literal sum, which accepts this mass matrix";
        let law = Law { text, allowed: 0.0 };
        let sides = ([Dd::ONE], [Dd::ZERO]);
        differs(
            (self.name, self.function),
            &law,
            (&sides.0, &sides.1),
            0.0,
            answered,
        )
    }

    fn laws(&self, at: &Inputs<Dd>, found: Vec<Dd>) -> Vec<Sides> {
        let lit = self.literal;
        let n = at.q.len();
        let zero = vec![Dd::ZERO; n];
        let efforts = |v: &[Dd], a: &[Dd]| lit.efforts(at, &at.q, v, a);
        match self.function.method {
            Method::InverseDynamics => {
                vec![Sides::new(
                    "τ = P(q, v, a)",
                    EXACT,
                    found,
                    efforts(&at.v, &at.a),
                )]
            }
            Method::Bias => vec![Sides::new(
                "bias = P(q, v, 0)",
                EXACT,
                found,
                efforts(&at.v, &zero),
            )],
            Method::Gravity => vec![Sides::new(
                "gravity = P(q, 0, 0)",
                EXACT,
                found,
                efforts(&zero, &zero),
            )],
            Method::MassMatrix => {
                let text = "M x = P(q, 0, x) − P(q, 0, 0)";
                let moved = times(&whole(&found, n), &at.a);
                let size = largest(&efforts(&zero, &zero));
                vec![Sides::new(text, EXACT, moved, lit.inertial(at, &at.q, &at.a)).sized(size)]
            }
            Method::ForwardDynamics => vec![self.solved(at, &found)],
            Method::KineticEnergy => {
                let twice = dot(&at.v, &lit.inertial(at, &at.q, &at.v));
                let energy = Dd::from_f64(0.5) * twice;
                vec![Sides::new("T = ½ vᵀ M v", EXACT, found, vec![energy])]
            }
            Method::CoriolisMatrix => self.coriolis(at, &found),
            Method::InverseDynamicsDerivatives => vec![self.inverse_slopes(at, &found)],
            Method::ForwardDynamicsDerivatives => self.forward_slopes(at, &found),
            method => {
                let expected = lit.value(method, at).into_iter();
                let text = "its literal form";
                expected
                    .map(|e| Sides::new(text, EXACT, found.clone(), e))
                    .collect()
            }
        }
    }

    fn solved(&self, at: &Inputs<Dd>, accelerations: &[Dd]) -> Sides {
        let lit = self.literal;
        let driven = lit.efforts(at, &at.q, &at.v, accelerations);
        let size = lit.size_of_product(at, accelerations);
        Sides::new("P(q, v, q̈) = τ", SOLVED, driven, at.u.clone()).sized(size)
    }

    fn coriolis(&self, at: &Inputs<Dd>, matrix: &[Dd]) -> Vec<Sides> {
        let lit = self.literal;
        let n = at.q.len();
        let zero = vec![Dd::ZERO; n];
        let bias = lit.efforts(at, &at.q, &at.v, &zero);
        let gravity = lit.efforts(at, &at.q, &zero, &zero);
        let size = largest(&bias);
        let first = Sides::new(
            "bias = C v + gravity",
            EXACT,
            plus(&times(matrix, &at.v), &gravity),
            bias,
        );
        let side = |s: f64| lit.inertial(at, &beside(&at.q, &at.v, s), &at.a);
        let rate = slope(&side(1.0), &side(-1.0));
        let transposed: Vec<Dd> = (0..n * n).map(|k| matrix[k % n * n + k / n]).collect();
        let both = plus(&times(matrix, &at.a), &times(&transposed, &at.a));
        let second = Sides::new("Ṁ x = (C + Cᵀ) x", DIFFERENCED, both, rate);
        vec![first.sized(size), second.sized(size)]
    }

    /// ∂τ/∂q d + ∂τ/∂v e along random directions.
    fn inverse_slopes(&self, at: &Inputs<Dd>, matrices: &[Dd]) -> Sides {
        let lit = self.literal;
        let n = at.q.len();
        let [along_q, along_v, _] = directions(n);
        let side = |s: f64| {
            let (q, v) = (beside(&at.q, &along_q, s), beside(&at.v, &along_v, s));
            lit.efforts(at, &q, &v, &at.a)
        };
        let expected = slope(&side(1.0), &side(-1.0));
        let (by_q, by_v) = matrices.split_at(n * n);
        let found = plus(&times(by_q, &along_q), &times(by_v, &along_v));
        let size = largest(&lit.efforts(at, &at.q, &at.v, &at.a));
        Sides::new("dτ = ∂P/∂q dq + ∂P/∂v dv", DIFFERENCED, found, expected).sized(size)
    }

    /// Moved along random directions, the accelerations still solve the equations of motion.
    fn forward_slopes(&self, at: &Inputs<Dd>, result: &[Dd]) -> Vec<Sides> {
        let lit = self.literal;
        let n = at.q.len();
        let (accelerations, matrices) = result.split_at(n);
        let [along_q, along_v, along_tau] = directions(n);
        let parts = [&along_q, &along_v, &along_tau]
            .into_iter()
            .zip(matrices.chunks((n * n).max(1)));
        let moved = parts.fold(vec![Dd::ZERO; n], |sum, (d, m)| plus(&sum, &times(m, d)));
        let side = |s: f64| {
            let (q, v) = (beside(&at.q, &along_q, s), beside(&at.v, &along_v, s));
            lit.efforts(at, &q, &v, &beside(accelerations, &moved, s))
        };
        let above = side(1.0);
        let found = slope(&above, &side(-1.0));
        let size = lit.size_of_product(at, &moved).max(largest(&above));
        let text = "dP(q, v, q̈) = dτ with dq̈ = ∂q̈/∂q dq + ∂q̈/∂v dv + ∂q̈/∂τ dτ";
        let sides = Sides::new(text, DIFFERENCED, found, along_tau);
        vec![self.solved(at, accelerations), sides.sized(size)]
    }
}

/// Directions of position, velocity and effort.
fn directions(n: usize) -> [Vec<Dd>; 3] {
    let mut random = Random(11);
    std::array::from_fn(|_| random.direction(n))
}

/// A symmetric matrix row by row, from its lower triangle.
fn whole(triangle: &[Dd], n: usize) -> Vec<Dd> {
    let entry = |k: usize| {
        let (row, column) = (k / n, k % n);
        triangle[in_triangle(row.max(column), row.min(column))]
    };
    (0..n * n).map(entry).collect()
}
