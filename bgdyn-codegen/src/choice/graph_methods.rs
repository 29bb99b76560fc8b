//! A bond graph whose methods are chosen once.

use std::collections::BTreeMap;
use std::ops::Deref;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use super::Choice;
use crate::bond_graph::BondGraph;
use crate::formulation::{Formulation, RowChoice};
use crate::function::Function;
use crate::method::Method;

/// Functions by the name of the selected formulation, and by method. `None`: no formulation creates it.
type ChosenFunctions = BTreeMap<(Option<&'static str>, Method), Option<Arc<Function>>>;

/// A bond graph, and the functions that were chosen for it. The functions of a scene use the same methods of the
/// mechanism, and the search for the cheapest one takes long. The graph cannot be changed here: the functions would
/// be those of another one.
#[derive(Debug)]
pub struct GraphMethods {
    graph: BondGraph,
    chosen: Mutex<ChosenFunctions>,
    forward: OnceLock<Arc<[Function]>>,
    /// The rows of loops in scenes, which share expressions with functions that write them in the same way.
    pub rows: RowChoice,
}

impl GraphMethods {
    /// Returns a graph without chosen functions.
    pub fn new(graph: BondGraph) -> Self {
        GraphMethods {
            graph,
            chosen: Mutex::default(),
            forward: OnceLock::new(),
            rows: RowChoice::default(),
        }
    }

    /// Returns the function of a method with the least cost, before the last passes, with loops by elimination: scenes
    /// have all positions in their state; by the formulation `asked`, if
    /// the user selected one. `None` if no formulation creates the method.
    pub fn function(
        &self,
        asked: Option<&'static dyn Formulation>,
        method: Method,
    ) -> Option<Arc<Function>> {
        let key = (asked.map(Formulation::name), method);
        let known = |chosen: &ChosenFunctions| chosen.get(&key).cloned();
        if let Some(function) = known(&self.chosen.lock().unwrap_or_else(PoisonError::into_inner)) {
            return function;
        }
        // Not while the lock is held: it takes long.
        let made = Choice::by_elimination(&self.graph, asked).function(method);
        let made = made.map(|function| Arc::new((*function).clone()));
        let mut chosen = self.chosen.lock().unwrap_or_else(PoisonError::into_inner);
        chosen.entry(key).or_insert(made).clone()
    }

    /// Returns the functions for forward dynamics that meet the error bounds, the cheapest first, in the form of their
    /// formulations.
    pub(crate) fn forward_dynamics(&self) -> Arc<[Function]> {
        let made = || {
            let choice = Choice::by_elimination(&self.graph, None);
            choice.forward_dynamics().cloned().collect()
        };
        self.forward.get_or_init(made).clone()
    }
}

impl Clone for GraphMethods {
    fn clone(&self) -> Self {
        let chosen = self.chosen.lock().unwrap_or_else(PoisonError::into_inner);
        GraphMethods {
            graph: self.graph.clone(),
            chosen: Mutex::new(chosen.clone()),
            forward: self.forward.clone(),
            rows: self.rows,
        }
    }
}

impl Deref for GraphMethods {
    type Target = BondGraph;

    fn deref(&self) -> &BondGraph {
        &self.graph
    }
}
