//! The sums on the junctions of one scene: the arguments of the effects' laws, and the terms that laws
//! add.

mod attitude;
mod gear;
mod gears;
mod parts;
mod poses;
mod read;
mod result;
mod undeclared;
mod write;

use std::collections::BTreeMap;

use crate::bond_graph::SiteId;
use crate::choice::GraphMethods;
use crate::expr::{Builder, Expr, Graph, Leaf, copy_into};
use crate::formulation::Formulation;
use crate::math::{Mat3, Vec3};
use crate::method::Method;
use crate::scene::Scene;

pub use attitude::Attitude;
pub(crate) use attitude::angular_velocity;
pub use gear::{LossyGear, load_event};
pub(crate) use parts::Condition;
pub use parts::{ActuatorEfforts, Balance, Contact, Hold, Port, Reading};

/// The sums to which the laws of a scene's effects add.
pub struct EffortSums<'g, 'a> {
    /// The graph under construction.
    pub b: &'g Builder,
    /// Positions.
    pub q: Vec<Expr<'g>>,
    /// Velocities.
    pub v: Vec<Expr<'g>>,
    /// Time.
    pub t: Expr<'g>,
    own: ActuatorEfforts,
    /// The selected formulation; `None` for the cheapest one of each method.
    pub(crate) asked: Option<&'static dyn Formulation>,
    scene: &'a Scene,
    graph: &'a GraphMethods,
    x: Vec<Expr<'g>>,
    modes: Vec<Expr<'g>>,
    u: Vec<Expr<'g>>,
    /// Index of the element whose law runs.
    at: usize,
    /// The effort on each coordinate.
    efforts: Vec<Expr<'g>>,
    /// The gear between a coordinate's drive and the coordinate.
    gears: BTreeMap<usize, LossyGear<'g>>,
    /// Inertia of the coordinates that store their own momentum.
    inertias: BTreeMap<usize, Expr<'g>>,
    /// ẋ
    rates: Vec<Expr<'g>>,
    balances: Vec<Balance<'g>>,
    contacts: Vec<Contact<'g>>,
    events: BTreeMap<String, Expr<'g>>,
    readings: Vec<Reading<'g>>,
    conditions: Vec<Condition<'g>>,
    shared: BTreeMap<(String, &'static str), Expr<'g>>,
    poses: BTreeMap<SiteId, (Mat3<Expr<'g>>, Vec3<Expr<'g>>)>,
}

impl<'g, 'a> EffortSums<'g, 'a> {
    /// Starts without laws, with these inputs and with methods of the mechanism by the formulation
    /// `asked`.
    pub(crate) fn empty(
        b: &'g Builder,
        scene: &'a Scene,
        (graph, asked): (&'a GraphMethods, Option<&'static dyn Formulation>),
        own: ActuatorEfforts,
        inputs: impl FnOnce() -> Vec<Expr<'g>>,
    ) -> Self {
        let layout = &scene.layout;
        let leaves = |n: usize, leaf: fn(usize) -> Leaf| -> Vec<Expr<'g>> {
            (0..n).map(|i| b.leaf(leaf(i))).collect()
        };
        let zeros = |n: usize| vec![b.zero(); n];
        let none = Balance {
            supplied: b.zero(),
            stored: b.zero(),
            dissipated: b.zero(),
        };
        EffortSums {
            b,
            q: leaves(layout.nq(), Leaf::Position),
            v: leaves(layout.nv(), Leaf::Velocity),
            t: b.leaf(Leaf::Time),
            own,
            asked,
            scene,
            graph,
            x: leaves(layout.nx(), Leaf::State),
            modes: leaves(layout.modes.len(), Leaf::Mode),
            u: inputs(),
            at: 0,
            efforts: zeros(layout.nv()),
            gears: BTreeMap::new(),
            inertias: BTreeMap::new(),
            rates: zeros(layout.nx()),
            balances: vec![none; scene.elements.len()],
            contacts: Vec::new(),
            events: BTreeMap::new(),
            readings: Vec::new(),
            conditions: Vec::new(),
            shared: BTreeMap::new(),
            poses: BTreeMap::new(),
        }
    }

    /// Begins the law of the element with this index.
    pub(crate) fn begin(&mut self, at: usize) {
        self.at = at;
    }
}

/// Copies the expressions of a method of the mechanism, by the selected formulation; `leaf` may replace
/// leaves.
pub(crate) fn copied<'g>(
    b: &'g Builder,
    (graph, asked): (&GraphMethods, Option<&'static dyn Formulation>),
    method: Method,
    leaf: impl FnMut(&mut Graph, Leaf) -> Option<crate::expr::Signed>,
) -> Vec<Expr<'g>> {
    let Some(function) = graph.function(asked, method) else {
        return vec![];
    };
    let outputs = &function.blocks[0].outputs;
    let copies = b.with_graph(|g| copy_into(g, &function.graph, outputs, leaf));
    copies.into_iter().map(|e| b.expr(e)).collect()
}
