//! The data that formulations receive about a mechanism: its bond graph, its geometry, and cached results.

use std::cell::{OnceCell, RefCell};
use std::collections::BTreeMap;
use std::rc::Rc;

use super::recursion::geometry::{Geometry, geometry};
use super::recursion::geometry_of_momenta;
use super::recursion::plan_search::BestPlan;
use super::recursion::regressor::BaseParameters;
use crate::bond_graph::BondGraph;
use crate::function::Function;
use crate::method::Method;

/// A function for a method.
#[derive(Clone)]
pub(crate) struct Candidate {
    /// In the form of its formulation, for use in other functions.
    pub plain: Function,
    /// In the generated form.
    pub generated: Function,
    /// Whether it eliminates with the factors of the mass matrix ([`super::Formulation::factors_mass`]).
    pub factors_mass: bool,
}

/// The functions for a method, sorted by `choice/`.
#[derive(Clone, Default)]
pub(crate) struct Candidates {
    /// Those that meet the error bounds, the cheapest first; if there are none, the one closest to the
    /// bounds.
    pub accepted: Vec<Candidate>,
    /// Those that exceed an error bound by at most one digit: derivatives may use them.
    pub borderline: Vec<Candidate>,
}

/// The functions for a method, and the generated one.
struct Chosen {
    candidates: Rc<Candidates>,
    function: Option<Rc<Function>>,
}

/// A mechanism, prepared for formulations. It caches results that several formulations need, and stores
/// the chosen functions of methods that others use.
pub struct Prepared<'a> {
    /// The mechanism's bond graph.
    pub graph: &'a BondGraph,
    geometry: OnceCell<Geometry>,
    geometry_of_momenta: OnceCell<Geometry>,
    base_parameters: OnceCell<BaseParameters>,
    /// The cheapest plans of the recursion.
    pub(super) plans: RefCell<BTreeMap<Method, BestPlan>>,
    chosen: RefCell<BTreeMap<Method, Chosen>>,
    /// Functions of the open tree, for a mechanism with loops.
    of_tree: RefCell<BTreeMap<Method, Rc<Function>>>,
    /// The same with masses moved across the pins of planar loops.
    of_moved_tree: RefCell<BTreeMap<Method, Rc<Function>>>,
    /// Functions of the open tree on each free base.
    on_free_base: RefCell<BTreeMap<(usize, Method), Rc<Function>>>,
    /// The mechanism in which the prescribed joints are free.
    released: OnceCell<Option<Box<Prepared<'a>>>>,
}

impl<'a> Prepared<'a> {
    /// Returns a preparation without cached results.
    pub fn new(graph: &'a BondGraph) -> Self {
        Prepared {
            graph,
            geometry: OnceCell::new(),
            geometry_of_momenta: OnceCell::new(),
            base_parameters: OnceCell::new(),
            plans: RefCell::default(),
            chosen: RefCell::default(),
            of_tree: RefCell::default(),
            of_moved_tree: RefCell::default(),
            on_free_base: RefCell::default(),
            released: OnceCell::new(),
        }
    }

    /// Returns the preparation of the mechanism in which the prescribed joints are free, if there are such joints.
    pub(super) fn released(&self) -> Option<&Prepared<'a>> {
        let graph: &'a BondGraph = self.graph;
        let new = || {
            let released = graph.released.as_deref()?;
            Some(Box::new(Prepared::new(released)))
        };
        self.released.get_or_init(new).as_deref()
    }

    /// Returns the chosen function of another method; `None` unless [`super::Formulation::reads`] names
    /// it.
    pub fn function(&self, method: Method) -> Option<Rc<Function>> {
        self.chosen.borrow().get(&method)?.function.clone()
    }

    /// Returns the function of a method of the open tree; `None` unless
    /// [`super::Formulation::reads_of_tree`] names it.
    pub fn tree_function(&self, method: Method) -> Option<Rc<Function>> {
        self.of_tree.borrow().get(&method).cloned()
    }

    /// Stores the function of a method of the open tree.
    pub(crate) fn set_tree_function(&self, method: Method, function: Rc<Function>) {
        self.of_tree.borrow_mut().insert(method, function);
    }

    /// Returns the function of a method of the open tree in which masses are moved across the pins of planar loops;
    /// `None` without such, and unless [`super::Formulation::reads_of_moved_tree`] names the method.
    pub fn moved_tree_function(&self, method: Method) -> Option<Rc<Function>> {
        self.of_moved_tree.borrow().get(&method).cloned()
    }

    /// Stores the function of a method of the open tree with moved masses.
    pub(crate) fn set_moved_tree_function(&self, method: Method, function: Rc<Function>) {
        self.of_moved_tree.borrow_mut().insert(method, function);
    }

    /// Returns the function of a method of the open tree on the free base with this index; `None` without such, and unless
    /// [`super::Formulation::reads_of_free_base`] names the method.
    pub fn function_on_free_base(&self, base: usize, method: Method) -> Option<Rc<Function>> {
        self.on_free_base.borrow().get(&(base, method)).cloned()
    }

    /// Stores the function of a method of the open tree on a free base.
    pub(crate) fn set_function_on_free_base(
        &self,
        (base, method): (usize, Method),
        function: Rc<Function>,
    ) {
        let mut known = self.on_free_base.borrow_mut();
        known.insert((base, method), function);
    }

    /// Returns all functions of another method that derivatives may use, under the same condition.
    pub(super) fn candidates(&self, method: Method) -> Rc<Candidates> {
        let chosen = self.chosen.borrow();
        let known = chosen.get(&method).map(|chosen| chosen.candidates.clone());
        known.unwrap_or_default()
    }

    /// Returns the frames of the recursion.
    pub(crate) fn geometry(&self) -> &Geometry {
        self.geometry.get_or_init(|| geometry(self.graph))
    }

    /// Returns the frames of the recursion for a method.
    pub(super) fn geometry_of(&self, method: Method) -> &Geometry {
        let of_momenta = || geometry_of_momenta(self.graph);
        match method {
            Method::Centroidal(_) => self.geometry_of_momenta.get_or_init(of_momenta),
            _ => self.geometry(),
        }
    }

    /// Returns the base parameters.
    pub(super) fn base_parameters(&self) -> &BaseParameters {
        let find = || BaseParameters::new(self.graph, self.geometry());
        self.base_parameters.get_or_init(find)
    }

    /// Returns the choice for a method, if it was made.
    pub(crate) fn choice_of(
        &self,
        method: Method,
    ) -> Option<(Rc<Candidates>, Option<Rc<Function>>)> {
        let chosen = self.chosen.borrow();
        let chosen = chosen.get(&method)?;
        Some((chosen.candidates.clone(), chosen.function.clone()))
    }

    /// Stores the choice for a method.
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
