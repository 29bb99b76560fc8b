//! The search for the cheapest functions of one mechanism. It remembers what it has found, so that
//! methods that rest on the same thing share it.

use std::cell::{OnceCell, RefCell};
use std::collections::BTreeMap;
use std::rc::Rc;

use super::derivatives::by_differentiation;
use super::{Formulation, recursion};
use crate::bond_graph::BondGraph;
use crate::function::Function;
use crate::method::Method;
use crate::passes::{cheapest, factor};

/// What is searched for the functions of one mechanism, and what was found so far.
pub struct Search<'a> {
    /// The mechanism's bond graph.
    pub graph: &'a BondGraph,
    /// The formulation asked for.
    asked: Option<&'static dyn Formulation>,
    /// What the recursion has found.
    pub(super) recursion: recursion::Found,
    forward: OnceCell<recursion::ForwardCandidates>,
    effort_derivatives: OnceCell<Option<Function>>,
    chosen: RefCell<BTreeMap<Method, Option<Rc<Function>>>>,
}

impl<'a> Search<'a> {
    /// Nothing found yet. Where a formulation is asked for, the methods it knows are its own.
    pub fn new(graph: &'a BondGraph, asked: Option<&'static dyn Formulation>) -> Self {
        Search {
            graph,
            asked,
            recursion: recursion::Found::default(),
            forward: OnceCell::new(),
            effort_derivatives: OnceCell::new(),
            chosen: RefCell::default(),
        }
    }

    /// The method's function by the formulation asked for, where it knows the method, else by the
    /// recursion, and for forward dynamics by the cheapest way that keeps its digits.
    ///
    /// The literal sum stands aside: its graph grows with the cube of the number of links. It stays
    /// as equation (6) is written; functions whose order of operations is not what they are made
    /// for are factored.
    pub fn function(&self, method: Method) -> Option<Rc<Function>> {
        if let Some(known) = self.chosen.borrow().get(&method) {
            return known.clone();
        }
        let found = self.choose(method).map(Rc::new);
        self.chosen.borrow_mut().insert(method, found.clone());
        found
    }

    fn choose(&self, method: Method) -> Option<Function> {
        let ways = match method {
            // These are compared, and shared, as they are after factoring.
            Method::InverseDynamicsDerivatives => return self.effort_derivatives().cloned(),
            Method::CoriolisMatrix => return by_differentiation::function(self, method),
            Method::ForwardDynamicsDerivatives => by_differentiation::function(self, method)
                .into_iter()
                .collect(),
            Method::ForwardDynamics => {
                let ways = self.ways().accepted.iter();
                return cheapest(ways.map(|way| way.generated.clone()));
            }
            Method::MassMatrix => self.mass_matrix(),
            _ => self.own(method),
        };
        cheapest(ways.into_iter().map(factor))
    }

    /// The function of the formulation asked for, or of the recursion, before factoring.
    fn own(&self, method: Method) -> Vec<Function> {
        let asked = self.asked.and_then(|f| f.function(self, method));
        let own = asked.or_else(|| recursion::Recursion.function(self, method));
        own.into_iter().collect()
    }

    /// The cheaper way to the mass matrix before factoring, unless one is asked for.
    fn mass_matrix(&self) -> Vec<Function> {
        let method = Method::MassMatrix;
        let joint_by_joint = self.own(method);
        if self.asked.is_some() {
            return joint_by_joint;
        }
        let limit = joint_by_joint.first().map(|way| way.cost().unfinished());
        let common = recursion::CommonAxes.cheaper(self, method, limit);
        common.map_or(joint_by_joint, |common| vec![common])
    }

    /// The ways to forward dynamics that keep their digits, the cheapest first, as their formulations
    /// write them.
    pub(crate) fn forward_dynamics(&self) -> impl Iterator<Item = &Function> {
        self.ways().accepted.iter().map(|way| &way.plain)
    }

    /// The ways to forward dynamics that its derivatives may rest on.
    pub(super) fn differentiable(&self) -> impl Iterator<Item = &Function> {
        let ways = self.ways();
        ways.accepted
            .iter()
            .chain(&ways.borderline)
            .map(|way| &way.plain)
    }

    fn ways(&self) -> &recursion::ForwardCandidates {
        let asked = || {
            let plain = self.asked?.function(self, Method::ForwardDynamics)?;
            let way = recursion::ForwardCandidate {
                generated: factor(plain.clone()),
                plain,
            };
            Some(recursion::ForwardCandidates {
                accepted: vec![way],
                borderline: Vec::new(),
            })
        };
        self.forward
            .get_or_init(|| asked().unwrap_or_else(|| recursion::forward_dynamics(self)))
    }

    /// The derivatives of inverse dynamics.
    pub(super) fn effort_derivatives(&self) -> Option<&Function> {
        let made = || by_differentiation::function(self, Method::InverseDynamicsDerivatives);
        self.effort_derivatives.get_or_init(made).as_ref()
    }

    /// Whether the formulation of this name is asked for.
    pub(super) fn asks_for(&self, name: &str) -> bool {
        self.asked.is_some_and(|f| f.name() == name)
    }
}
