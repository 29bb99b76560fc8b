//! What formulations are given of one mechanism: its bond graph, its geometry, and what is computed once.

use std::cell::{OnceCell, RefCell};
use std::collections::BTreeMap;
use std::rc::Rc;

use super::recursion::geometry::{Geometry, geometry};
use super::recursion::plan_search::BestPlan;
use crate::bond_graph::BondGraph;
use crate::function::Function;
use crate::method::Method;

/// A function for a method.
#[derive(Clone)]
pub(crate) struct Candidate {
    /// As its formulation writes it: other functions are made of it.
    pub plain: Function,
    /// As it is generated.
    pub generated: Function,
}

/// The functions for a method, sorted by the choice.
#[derive(Clone, Default)]
pub(crate) struct Candidates {
    /// Those that keep their digits, the cheapest first; where none does, the one that loses least.
    pub accepted: Vec<Candidate>,
    /// Those that exceed an error bound by a digit at most: derivatives may rest on them.
    pub borderline: Vec<Candidate>,
}

/// The functions for a method, and the one that is generated.
struct Chosen {
    candidates: Rc<Candidates>,
    function: Option<Rc<Function>>,
}

/// A mechanism, prepared for formulations. It remembers what several of them compute, and holds the
/// chosen functions of methods that others are made of.
pub struct Prepared<'a> {
    /// The mechanism's bond graph.
    pub graph: &'a BondGraph,
    geometry: OnceCell<Geometry>,
    /// The cheapest plans of the recursion.
    pub(super) plans: RefCell<BTreeMap<Method, BestPlan>>,
    chosen: RefCell<BTreeMap<Method, Chosen>>,
}

impl<'a> Prepared<'a> {
    /// Nothing computed yet.
    pub fn new(graph: &'a BondGraph) -> Self {
        Prepared {
            graph,
            geometry: OnceCell::new(),
            plans: RefCell::default(),
            chosen: RefCell::default(),
        }
    }

    /// The chosen function of another method; `None` unless [`super::Formulation::reads`] names it.
    pub fn function(&self, method: Method) -> Option<Rc<Function>> {
        self.chosen.borrow().get(&method)?.function.clone()
    }

    /// All functions of another method that derivatives may rest on, under the same condition.
    pub(super) fn candidates(&self, method: Method) -> Rc<Candidates> {
        let chosen = self.chosen.borrow();
        let known = chosen.get(&method).map(|chosen| chosen.candidates.clone());
        known.unwrap_or_default()
    }

    /// The frames of the recursion.
    pub(crate) fn geometry(&self) -> &Geometry {
        self.geometry.get_or_init(|| geometry(self.graph))
    }

    /// What was chosen for a method, if anything was.
    pub(crate) fn chosen(&self, method: Method) -> Option<(Rc<Candidates>, Option<Rc<Function>>)> {
        let chosen = self.chosen.borrow();
        let chosen = chosen.get(&method)?;
        Some((chosen.candidates.clone(), chosen.function.clone()))
    }

    /// Notes what is chosen for a method.
    pub(crate) fn choose(
        &self,
        method: Method,
        candidates: Candidates,
        function: Option<Rc<Function>>,
    ) {
        let chosen = Chosen {
            candidates: Rc::new(candidates),
            function,
        };
        self.chosen.borrow_mut().insert(method, chosen);
    }
}
