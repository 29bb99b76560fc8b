//! Collects the offers of the formulations, creates the functions, and chooses one for each method.
//!
//! 1. The candidates are the functions of the formulations that offer themselves in place of the others;
//!    if there are none, of those that offer themselves as candidates.
//! 2. The accuracy of forward dynamics is checked ([`super::keep_digits`]). If no candidate meets its
//!    bounds, or there is no candidate, the reserves are created one by one, then the last resorts.
//! 3. The function with the least cost after factoring is chosen.
//!
//! If the user selected a formulation, it provides all methods that it supports. Formulations that
//! differentiate the functions of other methods still make offers, because those functions are then of the
//! selected formulation.

use std::cell::{OnceCell, RefCell};
use std::collections::BTreeSet;
use std::rc::Rc;

use super::keep_digits::{CheckedCandidate, check, sort};
use crate::bond_graph::{BondGraph, FreeBase, with_moved_masses};
use crate::conditioning::error_bounds::{BoundReport, ErrorBounds};
use crate::formulation::{
    Candidate, Candidates, DERIVED, FORMULATIONS, Formulation, Offer, Prepared,
    base_parameter_formulas, create,
};
use crate::function::Function;
use crate::method::Method;
use crate::passes::{cheapest, factor};

/// The functions chosen for one mechanism. Results are cached, because methods use each other's functions.
pub struct Choice<'a> {
    pub(super) prepared: Prepared<'a>,
    pub(super) asked: Option<&'static dyn Formulation>,
    bounds: OnceCell<ErrorBounds>,
    forward: OnceCell<Rc<Candidates>>,
    /// Methods whose choice is in progress.
    open: RefCell<BTreeSet<Method>>,
    /// The functions of the open tree, for a mechanism with loops.
    tree: Option<Box<Choice<'a>>>,
    /// The open tree with masses moved across the pins of planar loops.
    moved: Option<Box<BondGraph>>,
    /// The open tree on each free base.
    free_bases: Vec<BondGraph>,
    /// Whether formulations may compute dependent positions of loops.
    closes_loops: bool,
    /// The choice without such formulations: derivatives are along all positions.
    eliminated: OnceCell<Box<Choice<'a>>>,
}

/// A formulation with its offer for one method.
type Offered = (&'static dyn Formulation, Offer);

impl<'a> Choice<'a> {
    /// Returns the base parameters as formulas of the parameters of the bodies.
    pub fn base_parameter_formulas(&self) -> Vec<String> {
        base_parameter_formulas(&self.prepared)
    }

    /// Starts with no choices. If the user selected a formulation (`asked`), it provides the methods that
    /// it supports.
    pub fn new(graph: &'a BondGraph, asked: Option<&'static dyn Formulation>) -> Self {
        let closed = graph.closed.as_deref();
        let moved = closed.and_then(|closed| with_moved_masses(&closed.tree, &closed.closure));
        Choice {
            moved: moved.map(Box::new),
            closes_loops: true,
            ..Choice::by_elimination(graph, asked)
        }
    }

    /// Does the same without formulations that compute dependent positions of loops: all functions read these.
    pub fn by_elimination(graph: &'a BondGraph, asked: Option<&'static dyn Formulation>) -> Self {
        let closed = graph.closed.as_deref();
        let wheels = closed.filter(|closed| closed.closure.nonholonomic());
        let bases = wheels.map(FreeBase::all).unwrap_or_default().into_iter();
        Choice {
            prepared: Prepared::new(graph),
            asked,
            bounds: OnceCell::new(),
            forward: OnceCell::new(),
            open: RefCell::default(),
            tree: closed.map(|closed| Box::new(Choice::new(&closed.tree, asked))),
            moved: None,
            free_bases: bases.map(|base| base.graph).collect(),
            closes_loops: false,
            eliminated: OnceCell::new(),
        }
    }

    /// Returns the function of the method with the least cost, before the last passes; for forward
    /// dynamics, among those that meet the error bounds.
    pub fn function(&self, method: Method) -> Option<Rc<Function>> {
        self.choose_once(method).1
    }

    /// Returns the functions of the method that were compared, in the form of their formulations, but for those that
    /// exceed an error bound by more than a digit.
    pub fn compared(&self, method: Method) -> Vec<Function> {
        let candidates = self.choose_once(method).0;
        let all = candidates.accepted.iter().chain(&candidates.borderline);
        all.map(|candidate| candidate.plain.clone()).collect()
    }

    /// Returns further functions of the method, which share expressions with functions of the `others`: those of
    /// formulations that offer themselves, for trees without prescribed joints. Forward dynamics has none: their accuracy
    /// would not be checked.
    pub fn sharing(&self, method: Method, others: &[Method]) -> Vec<Function> {
        let graph = self.prepared.graph;
        let is_tree = graph.closed.is_none() && graph.released.is_none();
        if !is_tree || self.asked.is_some() || method.shape().checked() {
            return Vec::new();
        }
        let others: Vec<Method> = others.iter().copied().filter(|m| *m != method).collect();
        let offered = self.offers(&FORMULATIONS, method).into_iter();
        let candidates = offered.filter(|(_, offer)| *offer == Offer::Candidate);
        candidates
            .flat_map(|(formulation, _)| formulation.sharing(&self.prepared, method, &others))
            .collect()
    }

    /// Returns the functions of the method that were compared and meet the error bounds, in the form of their formulations.
    pub fn accepted(&self, method: Method) -> Vec<Function> {
        let candidates = self.choose_once(method).0;
        let accepted = candidates.accepted.iter();
        accepted.map(|candidate| candidate.plain.clone()).collect()
    }

    /// Returns the functions for forward dynamics that meet the error bounds, the cheapest first, in the
    /// form of their formulations.
    pub(crate) fn forward_dynamics(&self) -> impl Iterator<Item = &Function> {
        let made = || self.choose_once(Method::ForwardDynamics).0;
        let candidates = self.forward.get_or_init(made);
        candidates.accepted.iter().map(|candidate| &candidate.plain)
    }

    /// Returns the candidates for the method, and the chosen one.
    pub(super) fn choose_once(&self, method: Method) -> (Rc<Candidates>, Option<Rc<Function>>) {
        if let Some(chosen) = self.prepared.choice_of(method) {
            return chosen;
        }
        if self.closes_loops && self.prepared.graph.closed.is_some() && differentiates(method) {
            let graph: &'a BondGraph = self.prepared.graph;
            let other = || Box::new(Choice::by_elimination(graph, self.asked));
            return self.eliminated.get_or_init(other).choose_once(method);
        }
        let anew = self.open.borrow_mut().insert(method);
        assert!(anew, "{method:?} is made of what is made of it");
        let candidates = self.candidates(method);
        let generated = candidates.accepted.iter().map(|c| c.generated.clone());
        let function = cheapest(generated).map(Rc::new);
        self.open.borrow_mut().remove(&method);
        self.prepared.choose(method, candidates, function);
        self.prepared.choice_of(method).unwrap_or_default()
    }

    fn candidates(&self, method: Method) -> Candidates {
        let asked = self.requested_candidates(method);
        if !asked.is_empty() {
            return sort(asked);
        }
        let mut offered = self.offers(&FORMULATIONS, method);
        offered.extend(self.offers(&DERIVED, method));
        sort(match method {
            Method::ForwardDynamics => {
                let bounds = || ErrorBounds::new(&self.prepared);
                let bounds = self.bounds.get_or_init(bounds);
                self.make_offered(&offered, method, |plain| check(bounds, plain))
            }
            _ => self.make_offered(&offered, method, unchecked),
        })
    }

    /// Returns the function of the selected formulation, if it supports the method.
    fn requested_candidates(&self, method: Method) -> Vec<CheckedCandidate> {
        let graph = self.prepared.graph;
        // With loops the open tree has the functions of the selected formulation.
        let asked = self.asked.filter(|f| f.knows(method) && f.serves(graph));
        let Some(asked) = asked else {
            return Vec::new();
        };
        let mut offered = vec![(asked, Offer::Candidate)];
        offered.extend(self.offers(&DERIVED, method));
        self.make_offered(&offered, method, unchecked)
    }

    /// Returns the function of the selected formulation in the form of that formulation; `None` if it does
    /// not create the method.
    pub(crate) fn asked_plain(&self, method: Method) -> Option<Function> {
        let made = self.requested_candidates(method).into_iter();
        made.map(|(_, candidate)| candidate.plain).next()
    }

    /// Returns the offers of the formulations that support the method.
    fn offers(&self, all: &[&'static dyn Formulation], method: Method) -> Vec<Offered> {
        let graph = self.prepared.graph;
        let allowed = |f: &dyn Formulation| self.closes_loops || !f.closes_loops();
        let known = all
            .iter()
            .filter(|f| allowed(**f) && f.knows(method) && f.serves(graph));
        let offered = known.map(|&f| (f, f.offer(&self.prepared, method)));
        offered.collect()
    }

    /// Creates the functions of these offers: those in place of the candidates, else the candidates; then
    /// reserves, until one function meets the error bounds.
    fn make_offered(
        &self,
        offered: &[Offered],
        method: Method,
        check: impl Fn(Function) -> CheckedCandidate,
    ) -> Vec<CheckedCandidate> {
        let make = |(formulation, offer): &Offered| {
            let (report, mut candidate) = check(self.make(*formulation, method)?);
            candidate.factors_mass = formulation.factors_mass();
            if let Offer::Instead(Some(reason)) = offer {
                candidate.generated.formulation += &format!("; {reason}");
            }
            Some((report, candidate))
        };
        let level = |wanted: fn(&Offer) -> bool| offered.iter().filter(move |(_, o)| wanted(o));
        let instead = level(|offer| matches!(offer, Offer::Instead(_)));
        let mut made: Vec<CheckedCandidate> = instead.filter_map(make).collect();
        if made.is_empty() {
            made.extend(level(|offer| *offer == Offer::Candidate).filter_map(make));
        }
        let reserves = level(|offer| *offer == Offer::Reserve);
        for waiting in reserves.chain(level(|offer| *offer == Offer::LastResort)) {
            if !made.iter().any(|(report, _)| report.holds()) {
                made.extend(make(waiting));
            }
        }
        made
    }

    /// Creates a formulation's function, after the functions that it depends on.
    fn make(&self, formulation: &dyn Formulation, method: Method) -> Option<Function> {
        for other in formulation.reads(method) {
            self.choose_once(other);
        }
        for other in formulation.reads_of_tree(method) {
            if let Some(function) = self.tree.as_ref().and_then(|tree| tree.function(other)) {
                self.prepared.set_tree_function(other, function);
            }
        }
        for other in formulation.reads_of_moved_tree(method) {
            if let (Some(moved), None) = (&self.moved, self.prepared.moved_tree_function(other))
                && let Some(function) = Choice::new(moved, self.asked).function(other)
            {
                self.prepared.set_moved_tree_function(other, function);
            }
        }
        for (base, other) in formulation.reads_of_free_base(method) {
            let known = self.prepared.function_on_free_base(base, other);
            if let (Some(graph), None) = (self.free_bases.get(base), known)
                && let Some(function) = Choice::new(graph, self.asked).function(other)
            {
                let prepared = &self.prepared;
                prepared.set_function_on_free_base((base, other), function);
            }
        }
        create(formulation, &self.prepared, method)
    }
}

/// Returns whether a method is a derivative of others.
fn differentiates(method: Method) -> bool {
    matches!(
        method,
        Method::CoriolisMatrix | Method::Directional(_) | Method::MassMatrixRate
    ) || method.differentiates_dynamics()
}

/// Returns a function whose accuracy is not checked.
fn unchecked(plain: Function) -> CheckedCandidate {
    let generated = factor(plain.clone());
    let candidate = Candidate {
        plain,
        generated,
        factors_mass: true,
    };
    (BoundReport::default(), candidate)
}
