//! Checks the functions of a mechanism against the literal sum.

use std::cell::OnceCell;

use bgdyn_runtime::Dd;

use super::Difference;
use super::actuated;
use super::compare::{EXACT, Law, SOLVED, SizedLaw, differs, dot, largest, minus, plus, times};
use super::contacts;
use super::directional;
use super::literal_values::{LiteralValues, State};
use super::open_tree;
use super::operational;
use super::parameters;
use super::payload;
use super::regressor;
use super::states::{direction, of_mechanism};
use crate::bond_graph::BondGraph;
use crate::conditioning::tree_states::of_method;
use crate::expr::Inputs;
use crate::function::{Function, in_triangle};
use crate::method::Method;
use crate::model::Model;
use crate::random::Random;

/// Compares the functions of a model with the literal sum, as [`check_functions`] does.
pub fn check_model(model: &Model) -> Vec<Difference> {
    let of = |functions: &[Function]| {
        check_functions(model.mechanism.name(), &model.bond_graph, functions)
    };
    let mut found = of(&model.functions);
    for bundle in &model.bundles {
        let parts = bundle.parts.iter().map(|part| bundle.function_of(part));
        found.extend(of(&parts.collect::<Vec<_>>()));
    }
    found
}

/// Compares functions of a mechanism with the literal sum for its bond graph: at three states, or at one
/// for more than ten coordinates. Returns at most one difference per function.
pub fn check_functions(name: &str, graph: &BondGraph, functions: &[Function]) -> Vec<Difference> {
    let literal = LiteralValues::new(graph);
    let states = of_mechanism(graph).into_iter();
    let states: Vec<State> = states.map(|at| State::new(&literal, at)).collect();
    let found = functions.iter().filter_map(|function| {
        let subject = Subject {
            name,
            function,
            literal: &literal,
            form: OnceCell::new(),
        };
        let refused = subject.refuses_all(&states);
        refused.or_else(|| states.iter().find_map(|state| subject.check(state)))
    });
    found.collect()
}

/// Permitted relative error of a step of Newton's method at a position that is open by 1e-12.
const NEARLY_CLOSED: f64 = 1e-9;

/// One function of a mechanism.
struct Subject<'a> {
    name: &'a str,
    function: &'a Function,
    literal: &'a LiteralValues<'a>,
    /// The function by the literal sum, created on demand.
    form: OnceCell<Option<Function>>,
}

/// The two sides of a law: the actual value, the expected value, the size of their terms.
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
    /// Returns the first law that the function violates at this state. A state in which it refuses a pivot
    /// is skipped.
    fn check(&self, state: &State) -> Option<Difference> {
        let graph = self.literal.prepared.graph;
        if let Method::Regressor(_) | Method::Payload(_) = self.function.method {
            return self.check_regressor(state);
        }
        let at = &self.arguments(self.function.method, state);
        let (found, refused) = self.function.evaluate(at.clone());
        if refused.is_some() {
            return None;
        }
        let speed = largest(&at.v);
        let size = match self.function.method {
            Method::Pose(_) | Method::Jacobian(_) => 1.0,
            Method::Velocity(_) => speed,
            Method::JacobianDotV(_) | Method::ConstraintBias => speed * speed,
            method if method.of_tree() => 0.0,
            Method::Operational(_) | Method::Contact(_) => 0.0,
            _ => state.size,
        };
        let sides = |laws: Vec<SizedLaw>, allowed: f64| -> Vec<Sides> {
            let laws = laws.into_iter();
            laws.map(|(text, found, expected, size)| {
                Sides::new(text, allowed, found, expected).sized(size)
            })
            .collect()
        };
        let form = |method| self.literal.form(method);
        let laws = match (&graph.closed, self.function.method) {
            (Some(closed), method) if method.of_tree() => {
                let laws = open_tree::laws(closed, method, form, (at, found));
                let exact = method == Method::ConstraintBias;
                sides(laws, if exact { EXACT } else { SOLVED })
            }
            (Some(closed), method) if method.of_actuated_joints() => {
                let laws = actuated::laws(closed, method, form, (at, found));
                sides(laws.unwrap_or_default(), SOLVED)
            }
            (_, Method::Operational(of)) => {
                let law = operational::law(&form, of, (at, &found));
                sides(law.into_iter().collect(), SOLVED)
            }
            (_, Method::Contact(of)) => {
                let laws = contacts::laws(graph, &form, of, (at, &found));
                let allowed = if of.is_dynamic() { SOLVED } else { EXACT };
                sides(laws.unwrap_or_default(), allowed)
            }
            (_, Method::Directional(of)) => {
                let law = directional::law(self.literal, of, (state, &found));
                let allowed = if of.is_forward() { SOLVED } else { EXACT };
                sides(law.into_iter().collect(), allowed)
            }
            (_, Method::ParameterDerivatives(of)) => {
                let law = parameters::law(self.literal, of, (state, &found));
                sides(law.into_iter().collect(), SOLVED)
            }
            _ => self.laws(state, found),
        };
        let laws = laws.into_iter();
        laws.filter_map(|sides| {
            let pair = (&sides.found[..], &sides.expected[..]);
            let size = match self.function.method {
                Method::ConstraintResidual | Method::ClosingStep => sides.size,
                _ => sides.size.max(size),
            };
            differs((self.name, self.function), &sides.law, pair, size, at)
        })
        .next()
    }

    /// Returns the arguments of a method at this state.
    fn arguments(&self, method: Method, state: &State) -> Inputs<Dd> {
        match method {
            Method::Directional(of) => directional::extended(of, &state.at),
            // Blocks of a bundle may read what other parts take.
            _ => directional::with_directions(of_method(
                self.literal.prepared.graph,
                method,
                &state.at,
            )),
        }
    }

    /// Returns the first law that a regressor violates at this state.
    fn check_regressor(&self, state: &State) -> Option<Difference> {
        let at = &regressor::extended(&state.at);
        let (prepared, literals) = (&self.literal.prepared, self.literal.regressors()?);
        let laws = match self.function.method {
            Method::Regressor(of) => regressor::laws((prepared, literals), (of, self.function), at),
            Method::Payload(of) => {
                let found = self.function.evaluate(at.clone()).0;
                payload::laws((prepared.graph, literals), (of, &found), at)
            }
            _ => None,
        }?;
        laws.into_iter().find_map(|(text, found, expected, size)| {
            let law = Law {
                text,
                allowed: EXACT,
            };
            let subject = (self.name, self.function);
            differs(subject, &law, (&found, &expected), size, at)
        })
    }

    /// Returns a difference if the function refuses every state and the literal sum refuses none of them.
    fn refuses_all(&self, states: &[State]) -> Option<Difference> {
        let refuses = |function: &Function| {
            let refused = |state: &State| {
                let at = self.arguments(function.method, state);
                function.evaluate(at).1.is_some()
            };
            states.iter().all(refused)
        };
        let method = self.function.method;
        if states.is_empty() || !method.shape().checked() || !refuses(self.function) {
            return None;
        }
        // The joints that move the frame may have parallel axes.
        if method.inverts_task() {
            return None;
        }
        let literal = self.literal.form(Method::ForwardDynamics)?;
        let answered = states
            .iter()
            .find(|state| literal.evaluate(state.at.clone()).1.is_none())?;
        let text = "the literal sum, which accepts this mass matrix";
        let law = Law { text, allowed: 0.0 };
        let subject = (self.name, self.function);
        let sides = (&[Dd::ONE][..], &[Dd::ZERO][..]);
        differs(subject, &law, sides, 0.0, &answered.at)
    }

    fn laws(&self, state: &State, found: Vec<Dd>) -> Vec<Sides> {
        let lit = self.literal;
        let at = &state.at;
        let exact = |text, found, expected| vec![Sides::new(text, EXACT, found, expected)];
        match self.function.method {
            Method::InverseDynamics => exact("τ = P(q, v, a)", found, state.efforts.clone()),
            Method::Bias => {
                let expected = lit.efforts(at, &at.v, &state.zero());
                exact("bias = P(q, v, 0)", found, expected)
            }
            Method::Gravity => exact("gravity = P(q, 0, 0)", found, state.at_rest.clone()),
            Method::MassMatrix => {
                let text = "M x = P(q, 0, x) − P(q, 0, 0)";
                let moved = times(&whole(&found, at.v.len()), &at.a);
                let sides = Sides::new(text, EXACT, moved, state.inertial(lit, &at.a));
                vec![sides.sized(largest(&state.at_rest))]
            }
            Method::ForwardDynamics => vec![self.solved(state, &found)],
            // With prescribed joints it has terms that are linear in v, and terms without v.
            Method::KineticEnergy if lit.prepared.graph.released.is_none() => {
                let twice = dot(&at.v, &state.inertial(lit, &at.v));
                let energy = Dd::from_f64(0.5) * twice;
                exact("T = ½ vᵀ M v", found, vec![energy])
            }
            Method::CoriolisMatrix => self.coriolis(state, &found),
            Method::MassMatrixRate => {
                let moved = times(&whole(&found, at.v.len()), &at.a);
                let size = largest(&lit.efforts(at, &at.v, &state.zero()));
                let expected = self.inertial_rate(state);
                vec![Sides::new("Ṁ x = d/dt M(q) x", EXACT, moved, expected).sized(size)]
            }
            method if method.differentiates_inverse() => vec![self.inverse_slopes(state, &found)],
            method if method.differentiates_forward() => self.forward_slopes(state, &found),
            Method::ConstraintResidual => vec![self.open_loops(at, Dd::from_f64(0.1), EXACT)],
            // J_d of the generated code is that of closed positions.
            Method::ClosingStep => vec![self.open_loops(at, Dd::from_f64(1e-12), NEARLY_CLOSED)],
            method => {
                let form = self.form.get_or_init(|| lit.form(method)).as_ref();
                let expected = form.map(|form| form.evaluate(at.clone()).0);
                let allowed = match method {
                    // With accelerations from the mass matrix.
                    Method::Reactions => SOLVED,
                    _ => EXACT,
                };
                let text = "its literal form";
                expected.map_or(vec![], |e| vec![Sides::new(text, allowed, found, e)])
            }
        }
    }

    /// Compares with the literal form where the loops are open by about this size.
    fn open_loops(&self, at: &Inputs<Dd>, by: Dd, allowed: f64) -> Sides {
        let mut open = at.clone();
        if let Some(closed) = &self.literal.prepared.graph.closed {
            let moving = closed.closure.moving().into_iter().enumerate();
            let step = |(k, j)| (j, by * Dd::from_f64(1.0 + 0.3 * k as f64));
            closed
                .closure
                .displace(&mut open.q, &moving.map(step).collect::<Vec<_>>());
        }
        let form = self
            .form
            .get_or_init(|| self.literal.form(self.function.method))
            .as_ref();
        let found = self.function.evaluate(open.clone()).0;
        let expected = form.map_or_else(Vec::new, |form| form.evaluate(open).0);
        Sides::new(
            "its literal form where the loops are open",
            allowed,
            found,
            expected,
        )
    }

    fn solved(&self, state: &State, accelerations: &[Dd]) -> Sides {
        let at = &state.at;
        let driven = self.literal.efforts(at, &at.v, accelerations);
        let size = state.size_of_product(self.literal, accelerations);
        Sides::new("P(q, v, q̈) = τ", SOLVED, driven, at.u.clone()).sized(size)
    }

    fn coriolis(&self, state: &State, matrix: &[Dd]) -> Vec<Sides> {
        let (lit, at, zero) = (self.literal, &state.at, state.zero());
        let n = at.v.len();
        let bias = lit.efforts(at, &at.v, &zero);
        let size = largest(&bias);
        let moved = plus(&times(matrix, &at.v), &state.at_rest);
        let first = Sides::new("bias = C v + gravity", EXACT, moved, bias).sized(size);
        let along_v = self.inertial_rate(state);
        let at_rest = Inputs {
            v: zero.clone(),
            ..at.clone()
        };
        // The motion of prescribed joints changes M as well.
        let rate = |x: &[Dd]| lit.prescribed_rates(&at_rest, x);
        let along_time = minus(&rate(&at.a), &rate(&zero));
        let expected = plus(&along_v, &plus(&along_time, &along_time));
        let transposed: Vec<Dd> = (0..n * n).map(|k| matrix[k % n * n + k / n]).collect();
        let both = plus(&times(matrix, &at.a), &times(&transposed, &at.a));
        let text = match lit.prepared.graph.released {
            None => "Ṁ x = (C + Cᵀ) x",
            Some(_) => "(Ṁ + ∂M/∂t) x = (C + Cᵀ) x",
        };
        let second = Sides::new(text, EXACT, both, expected);
        vec![first, second.sized(size)]
    }

    /// Returns Ṁ a: the rate of P(q, 0, a) − P(q, 0, 0) along v.
    fn inertial_rate(&self, state: &State) -> Vec<Dd> {
        let (lit, at, zero) = (self.literal, &state.at, state.zero());
        let at_rest = Inputs {
            v: zero.clone(),
            ..at.clone()
        };
        let rates = lit.prepared.graph.position_rates(&at.q, &at.v);
        let rate = |x: &[Dd]| lit.effort_rates(&at_rest, &rates, &zero, (x, &zero));
        minus(&rate(&at.a), &rate(&zero))
    }

    /// Returns ∂τ/∂q d + ∂τ/∂v e along random directions.
    fn inverse_slopes(&self, state: &State, matrices: &[Dd]) -> Sides {
        let at = &state.at;
        let n = at.v.len();
        let [along_q, along_v, _] = directions(self.literal.prepared.graph);
        let accelerations = (&at.a[..], &state.zero()[..]);
        let rates = self.literal.prepared.graph.rates_along(&at.q, &along_q);
        let expected = self
            .literal
            .effort_rates(at, &rates, &along_v, accelerations);
        let (by_q, by_v) = matrices.split_at(n * along_q.len());
        let found = plus(&times(by_q, &along_q), &times(by_v, &along_v));
        let size = largest(&state.efforts);
        Sides::new("dτ = ∂P/∂q dq + ∂P/∂v dv", EXACT, found, expected).sized(size)
    }

    /// Checks that after small displacements along random directions the accelerations still solve the
    /// equations of motion.
    fn forward_slopes(&self, state: &State, result: &[Dd]) -> Vec<Sides> {
        let at = &state.at;
        let n = at.v.len();
        let (accelerations, matrices) = result.split_at(n);
        let [along_q, along_v, along_tau] = directions(self.literal.prepared.graph);
        let (by_q, others) = matrices.split_at(n * along_q.len());
        let (by_v, by_tau) = others.split_at(n * n);
        let parts = [(&along_q, by_q), (&along_v, by_v), (&along_tau, by_tau)];
        let parts = parts.into_iter();
        let moved = parts.fold(vec![Dd::ZERO; n], |sum, (d, m)| plus(&sum, &times(m, d)));
        let solution = (accelerations, &moved[..]);
        let rates = self.literal.prepared.graph.rates_along(&at.q, &along_q);
        let found = self.literal.effort_rates(at, &rates, &along_v, solution);
        let size = state.size_of_product(self.literal, &moved);
        let text = "dP(q, v, q̈) = dτ with dq̈ = ∂q̈/∂q dq + ∂q̈/∂v dv + ∂q̈/∂τ dτ";
        let sides = Sides::new(text, SOLVED, found, along_tau);
        let solved = self.solved(state, accelerations);
        let sides = sides.sized(size.max(solved.size));
        vec![solved, sides]
    }
}

/// Returns directions of position, velocity and effort.
fn directions(graph: &BondGraph) -> [Vec<Dd>; 3] {
    let mut random = Random(11);
    let n = graph.coordinates.len();
    [graph.directions(), n, n].map(|n| direction(&mut random, n))
}

/// Returns a symmetric matrix row by row, from its lower triangle.
fn whole(triangle: &[Dd], n: usize) -> Vec<Dd> {
    let entry = |k: usize| {
        let (row, column) = (k / n, k % n);
        triangle[in_triangle(row.max(column), row.min(column))]
    };
    (0..n * n).map(entry).collect()
}
