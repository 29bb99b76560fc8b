//! Values of the literal sum at a state, which the laws of several methods read.

use std::cell::OnceCell;

use bgdyn_runtime::Dd;

use super::compare::{largest, minus, turned};
use super::dual::{Direction, along, rates, with_rates};
use super::regressor::LiteralRegressors;
use crate::bond_graph::BondGraph;
use crate::expr::Inputs;
use crate::formulation::{Prepared, create, specification};
use crate::function::Function;
use crate::method::Method;

/// The literal sum of a bond graph.
pub(super) struct LiteralValues<'a> {
    pub(super) prepared: Prepared<'a>,
    pub(super) inverse: Function,
    /// What the laws of regressors read, created on demand.
    regressors: OnceCell<Option<LiteralRegressors>>,
}

impl<'a> LiteralValues<'a> {
    pub(super) fn new(graph: &'a BondGraph) -> Self {
        let prepared = Prepared::new(graph);
        let inverse = create(specification(), &prepared, Method::InverseDynamics);
        LiteralValues {
            inverse: inverse.expect("the literal sum knows inverse dynamics"),
            regressors: OnceCell::new(),
            prepared,
        }
    }

    /// Returns the method by the literal sum.
    pub(super) fn form(&self, method: Method) -> Option<Function> {
        create(specification(), &self.prepared, method)
    }

    /// Returns what the laws of regressors read.
    pub(super) fn regressors(&self) -> Option<&LiteralRegressors> {
        let new = || LiteralRegressors::new(&self.prepared);
        self.regressors.get_or_init(new).as_ref()
    }

    /// Returns P(q, v, a), with all other arguments as in `at`.
    pub(super) fn efforts(&self, at: &Inputs<Dd>, v: &[Dd], a: &[Dd]) -> Vec<Dd> {
        let inputs = Inputs {
            v: v.to_vec(),
            a: a.to_vec(),
            ..at.clone()
        };
        self.inverse.evaluate(inputs).0
    }

    /// Returns dP for the position that moves from q with the rates q̇, v + ε dv, a + ε da.
    pub(super) fn effort_rates(
        &self,
        at: &Inputs<Dd>,
        dq: &[Dd],
        dv: &[Dd],
        a: (&[Dd], &[Dd]),
    ) -> Vec<Dd> {
        let direction = Direction {
            q: dq.to_vec(),
            v: dv.to_vec(),
            x: vec![],
            t: Dd::ZERO,
        };
        let mut inputs = along(at, &direction);
        inputs.a = with_rates(a.0, a.1);
        rates(&self.inverse.evaluate(inputs).0)
    }

    /// Returns dP(q, v, a)/dt for constant q and v, along the motion of the prescribed joints with constant rates.
    pub(super) fn prescribed_rates(&self, at: &Inputs<Dd>, a: &[Dd]) -> Vec<Dd> {
        let none = Direction {
            q: vec![Dd::ZERO; at.q.len()],
            v: vec![Dd::ZERO; at.v.len()],
            x: vec![],
            t: Dd::ZERO,
        };
        let mut inputs = along(at, &none);
        inputs.a = with_rates(a, &vec![Dd::ZERO; a.len()]);
        let mut moved = vec![Dd::ZERO; at.parameters.len()];
        let released = self.prepared.graph.released.iter();
        for prescribed in released.flat_map(|r| &r.prescribed) {
            let [position, velocity, _] = prescribed.motion;
            moved[position.0] = at.parameters[velocity.0];
        }
        inputs.parameters = with_rates(&at.parameters, &moved);
        rates(&self.inverse.evaluate(inputs).0)
    }
}

/// A state, with quantities that several laws use.
pub(super) struct State {
    pub(super) at: Inputs<Dd>,
    /// P(q, 0, 0)
    pub(super) at_rest: Vec<Dd>,
    /// P(q, v, a)
    pub(super) efforts: Vec<Dd>,
    /// The size of the terms that add up to efforts: of P(q, v, a), and of M times the squares of the
    /// velocities, the size of centrifugal terms before they cancel.
    pub(super) size: f64,
}

impl State {
    pub(super) fn new(literal: &LiteralValues<'_>, at: Inputs<Dd>) -> Self {
        let zero = vec![Dd::ZERO; at.v.len()];
        let mut state = State {
            at_rest: literal.efforts(&at, &zero, &zero),
            efforts: literal.efforts(&at, &at.v, &at.a),
            size: 0.0,
            at,
        };
        let squares: Vec<Dd> = state.at.v.iter().map(|&v| v * v).collect();
        let centrifugal = largest(&state.inertial(literal, &squares));
        state.size = largest(&state.efforts).max(centrifugal);
        state
    }

    pub(super) fn zero(&self) -> Vec<Dd> {
        vec![Dd::ZERO; self.at.v.len()]
    }

    /// Returns M(q) x = P(q, 0, x) − P(q, 0, 0).
    pub(super) fn inertial(&self, literal: &LiteralValues<'_>, x: &[Dd]) -> Vec<Dd> {
        let moved = literal.efforts(&self.at, &self.zero(), x);
        minus(&moved, &self.at_rest)
    }

    /// Returns the size of the terms of M(q) x, which cancel if x is large and M almost singular: the
    /// largest product with other signs of the components of x.
    pub(super) fn size_of_product(&self, literal: &LiteralValues<'_>, x: &[Dd]) -> f64 {
        let products = turned(x).map(|x| largest(&self.inertial(literal, &x)));
        products.into_iter().fold(0.0, f64::max)
    }
}
