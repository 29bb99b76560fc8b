//! The equations of a scene as data: the scene, its bond graph, its start and its named results.

use crate::bond_graph::BondNetwork;
use crate::choice::GraphMethods;
use crate::expr::{Builder, Expr, Graph, Signed, copy_with_pivots};
use crate::function::Function;
use crate::method::{Method, SceneFunction};
use crate::scene::{Initial, Scene};

/// The equations of a scene.
#[derive(Clone, Debug)]
pub struct SceneEquations {
    /// The scene.
    pub scene: Scene,
    /// The bond graph of its mechanism, with the changes by its effects, and the functions chosen for it.
    pub graph: GraphMethods,
    /// The equations by which controllers compute torques, if they have a model of their own.
    pub controller_model: Option<Box<SceneEquations>>,
    /// The nodes and bonds of the mechanism and of its effects.
    pub network: BondNetwork,
    /// Its initial state, including fluid volumes.
    pub initial: Initial,
    /// The parts of its outputs.
    pub outputs: Vec<Named>,
    /// The entries of its balance of power.
    pub entries: Vec<Named>,
}

/// A named number of a result.
#[derive(Clone, Debug, PartialEq)]
pub struct Named {
    /// Its name.
    pub name: String,
    /// Its SI unit; empty for an entry of the balance of power, whose numbers have several.
    pub unit: &'static str,
    /// Unit and meaning.
    pub about: String,
}

impl SceneEquations {
    /// Returns the coordinate that each mode can hold.
    pub fn mode_coordinates(&self) -> Vec<usize> {
        let b = Builder::silent();
        let sums = self.effort_sums(&b);
        let mut found = vec![0; self.scene.layout.modes.len()];
        for contact in sums.contacts() {
            found[contact.mode] = contact.coordinate;
        }
        found
    }

    /// Returns a scene function in one block, with the outputs of `made`.
    pub(super) fn one(
        &self,
        role: SceneFunction,
        made: impl for<'g> FnOnce(&SceneEquations, &'g Builder) -> Vec<Expr<'g>>,
    ) -> Function {
        let b = Builder::new();
        let outputs: Vec<Signed> = made(self, &b).into_iter().map(Expr::signed).collect();
        self.flat(role, "scene".into(), b, outputs)
    }

    /// Returns a scene function in one block, with these outputs.
    pub(super) fn flat(
        &self,
        role: SceneFunction,
        formulation: String,
        b: Builder,
        outputs: Vec<Signed>,
    ) -> Function {
        let method = Method::Scene(role);
        let graph = b.into_graph();
        if self.graph.closed.is_none() || method.shape().checked() {
            return Function::flat(&self.graph, method, formulation, graph, outputs);
        }
        // A function without errors has the values of S, but not the checks of its pivots.
        let mut unchecked = Graph::default();
        let outputs = copy_with_pivots(&mut unchecked, &graph, &outputs, |_, _| None, |_| None);
        Function::flat(&self.graph, method, formulation, unchecked, outputs)
    }
}
