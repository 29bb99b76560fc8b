//! Checks regressors: their products with any parameters, against the literal regressor of all parameters.
//!
//! All follow from the literal Y(q, v, a), which is a polynomial of second degree in v and linear in a.

use bgdyn_runtime::Dd;

use super::compare::{SizedLaw, dot, largest, minus, plus, times};
use crate::expr::Inputs;
use crate::formulation::{Prepared, columns, create, specification};
use crate::function::Function;
use crate::method::{Method, Regressor};
use crate::random::Random;

/// The functions that the laws of regressors read.
pub(super) struct LiteralRegressors {
    /// Y by equation (6).
    whole: Function,
    /// K π.
    base: Function,
    /// P(q, v, a) by equation (6), without rotors.
    without_rotors: Function,
}

impl LiteralRegressors {
    pub(super) fn new(prepared: &Prepared<'_>) -> Option<Self> {
        let mut graph = prepared.graph.clone();
        graph.multibody.rotors.clear();
        let bare = Prepared::new(&graph);
        let base = Method::Regressor(Regressor::BaseParameters);
        Some(LiteralRegressors {
            whole: literal(prepared, Method::Regressor(Regressor::Full))?,
            base: create(columns(), prepared, base)?,
            without_rotors: literal(&bare, Method::InverseDynamics)?,
        })
    }

    /// Returns K π and Y(q, v, a) π for these parameters.
    pub(super) fn by_any(&self, at: &Inputs<Dd>, parameters: Vec<Dd>) -> (Vec<Dd>, Vec<Dd>) {
        let of = self.reference(at, parameters);
        (of.base_parameters(), of.efforts(&at.v, &at.a))
    }

    /// Returns (M a_r + C(q, v) v_r + g) π for these parameters.
    pub(super) fn two_velocities(&self, at: &Inputs<Dd>, parameters: Vec<Dd>) -> Vec<Dd> {
        self.reference(at, parameters).two_velocities()
    }

    fn reference<'a>(&'a self, at: &'a Inputs<Dd>, parameters: Vec<Dd>) -> Reference<'a> {
        Reference {
            of: self,
            parameters,
            at,
        }
    }
}

fn literal(prepared: &Prepared<'_>, method: Method) -> Option<Function> {
    create(specification(), prepared, method)
}

/// The literal functions, any parameters, and the state.
struct Reference<'a> {
    of: &'a LiteralRegressors,
    parameters: Vec<Dd>,
    at: &'a Inputs<Dd>,
}

impl Reference<'_> {
    /// Returns Y(q, v, a) π.
    fn efforts(&self, v: &[Dd], a: &[Dd]) -> Vec<Dd> {
        let inputs = Inputs {
            v: v.to_vec(),
            a: a.to_vec(),
            ..self.at.clone()
        };
        times(&self.of.whole.evaluate(inputs).0, &self.parameters)
    }

    /// Returns Y(q, 0, a) π.
    fn at_rest(&self, a: &[Dd]) -> Vec<Dd> {
        self.efforts(&zeros(a.len()), a)
    }

    /// Returns (Y(q, v, 0) − Y(q, 0, 0)) π.
    fn velocity_products(&self, v: &[Dd]) -> Vec<Dd> {
        let none = zeros(v.len());
        minus(&self.efforts(v, &none), &self.at_rest(&none))
    }

    /// Returns (Y(q, 0, v) − Y(q, 0, 0)) π = M v.
    fn momenta(&self, v: &[Dd]) -> Vec<Dd> {
        minus(&self.at_rest(v), &self.at_rest(&zeros(v.len())))
    }

    /// Returns (M a_r + C(q, v) v_r + g) π: the products of two velocities by those of their sum and their difference,
    /// and half the sum of the terms that are linear in a velocity, of a base that turns.
    fn two_velocities(&self) -> Vec<Dd> {
        let (v, reference) = (&self.at.v, &self.at.x);
        let opposite = |x: &[Dd]| x.iter().map(|&x| -x).collect::<Vec<Dd>>();
        let (sum, difference) = (plus(v, reference), minus(v, reference));
        let [both, apart] = [&sum, &difference].map(|v| {
            let turned = self.velocity_products(&opposite(v));
            (self.velocity_products(v), turned)
        });
        let quadratic = |(x, turned): &(Vec<Dd>, Vec<Dd>)| plus(x, turned);
        let linear = minus(&both.0, &both.1);
        let quarters = minus(&quadratic(&both), &quadratic(&apart));
        let scaled = |x: Vec<Dd>, by: f64| -> Vec<Dd> {
            x.into_iter().map(|x| x * Dd::from_f64(by)).collect()
        };
        let mixed = plus(&scaled(quarters, 0.125), &scaled(linear, 0.25));
        plus(&self.at_rest(&self.at.a), &mixed)
    }

    /// Returns K π.
    fn base_parameters(&self) -> Vec<Dd> {
        let inputs = Inputs {
            u: self.parameters.clone(),
            ..Inputs::default()
        };
        self.of.base.evaluate(inputs).0
    }
}

/// Returns the state with a second velocity and a number for each velocity, as regressors read them.
pub(super) fn extended(at: &Inputs<Dd>) -> Inputs<Dd> {
    let mut random = Random(23);
    let mut any = || -> Vec<Dd> {
        let number = |_| Dd::from_f64(2.0 * random.signed());
        (0..at.v.len()).map(number).collect()
    };
    let (x, u) = (any(), any());
    Inputs { x, u, ..at.clone() }
}

/// Returns the laws of a regressor at an [`extended`] state.
pub(super) fn laws(
    (prepared, literals): (&Prepared<'_>, &LiteralRegressors),
    (regressor, function): (Regressor, &Function),
    at: &Inputs<Dd>,
) -> Option<Vec<SizedLaw>> {
    let mut random = Random(29);
    let count = 10 * prepared.graph.moving_links().len();
    let number = |_| Dd::from_f64(random.signed());
    let parameters: Vec<Dd> = (0..count).map(number).collect();
    let of = literals.reference(at, parameters);
    let found = match regressor {
        Regressor::BaseParameters => of.base_parameters(),
        _ => function.evaluate(at.clone()).0,
    };
    let by_base = |found: &[Dd]| times(found, &of.base_parameters());
    let by_all = |found: &[Dd]| times(found, &of.parameters);
    let at_rest = || of.at_rest(&zeros(at.v.len()));
    let (text, found, expected) = match regressor {
        Regressor::Full => ("Y π", by_all(&found), of.efforts(&at.v, &at.a)),
        Regressor::Base => ("Y_b K π = Y π", by_base(&found), of.efforts(&at.v, &at.a)),
        Regressor::Gravity => ("Y(q, 0, 0) π", by_all(&found), at_rest()),
        Regressor::BaseGravity => ("Y_b K π = Y(q, 0, 0) π", by_base(&found), at_rest()),
        Regressor::Adaptive => (
            "Y_b K π = M a_r + C(q, v) v_r + g",
            by_base(&found),
            of.two_velocities(),
        ),
        Regressor::Momentum => ("Y_p π = M v", by_all(&found), of.momenta(&at.v)),
        Regressor::BaseMomentum => ("Y_p K π = M v", by_base(&found), of.momenta(&at.v)),
        Regressor::AdaptiveStep => (
            "π·Kᵀ Y_bᵀ s = s·(M a_r + C(q, v) v_r + g)",
            vec![dot(&found, &of.base_parameters())],
            vec![dot(&at.u, &of.two_velocities())],
        ),
        Regressor::TransposedTimes => (
            "π·Kᵀ Y_bᵀ s = s·Y π",
            vec![dot(&found, &of.base_parameters())],
            vec![dot(&at.u, &of.efforts(&at.v, &at.a))],
        ),
        Regressor::KineticEnergy => (
            "Y_T π = ½ v·M v",
            vec![dot(&found, &of.parameters)],
            vec![dot(&at.v, &of.momenta(&at.v)) * Dd::from_f64(0.5)],
        ),
        Regressor::PotentialEnergy => {
            let expected = literal(prepared, Method::Regressor(regressor))?;
            let expected = expected.evaluate(at.clone()).0;
            ("its literal form", found, expected)
        }
        Regressor::Parameters => {
            let expected = literal(prepared, Method::Regressor(regressor))?;
            let expected = expected.evaluate(at.clone()).0;
            let own = Reference {
                parameters: found.clone(),
                ..of
            };
            let efforts = literals.without_rotors.evaluate(at.clone()).0;
            let size = largest(&efforts);
            let moved = own.efforts(&at.v, &at.a);
            return Some(vec![
                ("its literal form", found, expected, 0.0),
                ("Y π = P(q, v, a) without rotors", moved, efforts, size),
            ]);
        }
        // Its laws are those of the regressors of base parameters.
        Regressor::BaseParameters => {
            let base = Method::Regressor(Regressor::Base);
            let by_base = create(columns(), prepared, base)?;
            let by_base = by_base.evaluate(at.clone()).0;
            let own = function.evaluate(Inputs {
                u: of.parameters.clone(),
                ..at.clone()
            });
            let efforts = times(&by_base, &own.0);
            ("Y_b K π = Y π", efforts, of.efforts(&at.v, &at.a))
        }
    };
    let speed = largest(&at.v).max(largest(&at.x));
    let size = largest(&of.at_rest(&vec![Dd::from_f64(speed * speed); at.v.len()]));
    Some(vec![(text, found, expected, size)])
}

fn zeros(n: usize) -> Vec<Dd> {
    vec![Dd::ZERO; n]
}
