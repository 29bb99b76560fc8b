//! What the effects' laws see and what they add: the sums on the junctions of one scene.

mod adds;
mod gear;
mod joined;
mod reads;
mod undeclared;

use std::collections::BTreeMap;

use crate::bond_graph::{BondGraph, SiteId};
use crate::choice::Choice;
use crate::expr::{Builder, Ex, Graph, Leaf, copy_into};
use crate::formulation::Formulation;
use crate::math::{Mat3, Vec3};
use crate::method::Method;
use crate::scene::Scene;

pub use gear::{Gear, load_event};

/// Where an effort acts: a displacement s(q), its rate, and the transformers ∂s/∂q_j.
#[derive(Clone, Debug)]
pub struct Port<'g> {
    /// s, rad or m.
    pub place: Ex<'g>,
    /// ṡ = Σ ∂s/∂q_j q̇_j
    pub rate: Ex<'g>,
    /// Coordinates with their ∂s/∂q_j.
    pub transformers: Vec<(usize, Ex<'g>)>,
}

/// What an element supplies, stores and dissipates.
#[derive(Clone, Copy, Debug)]
pub struct Balance<'g> {
    /// Power that comes from outside, W.
    pub supplied: Ex<'g>,
    /// Energy stored, J.
    pub stored: Ex<'g>,
    /// Power that is lost, W.
    pub dissipated: Ex<'g>,
}

/// What can hold a coordinate at the rate of a counterpart: dry friction, the limit of a rate.
#[derive(Clone, Copy, Debug)]
pub struct Contact<'g> {
    /// The element it belongs to, by its place in the scene.
    pub element: usize,
    /// The mode that tells whether it holds.
    pub mode: usize,
    /// The coordinate it acts on.
    pub coordinate: usize,
    /// Rate of the coordinate against the counterpart.
    pub slip: Ex<'g>,
    /// Speed and acceleration of the counterpart.
    pub reference: [Ex<'g>; 2],
    /// The efforts it can hold with.
    pub hold: Hold<'g>,
}

/// The efforts that a contact can hold with.
#[derive(Clone, Copy, Debug)]
pub enum Hold<'g> {
    /// As large as this in both directions: dry friction.
    Within(Ex<'g>),
    /// From the first to the second, with 0 among them: the losses of a gear under load.
    Between([Ex<'g>; 2]),
    /// Of any size that lowers the rate: an upper limit.
    Lowers,
    /// Of any size that raises the rate: a lower limit.
    Raises,
}

impl<'g> Hold<'g> {
    /// The least and the largest effort of a friction; `None` of the limit of a rate.
    pub fn range(&self) -> Option<[Ex<'g>; 2]> {
        match *self {
            Hold::Within(limit) => Some([-limit, limit]),
            Hold::Between(range) => Some(range),
            Hold::Lowers | Hold::Raises => None,
        }
    }
}

/// A quantity worth knowing: a force, a pressure.
#[derive(Clone, Debug)]
pub struct Reading<'g> {
    /// `belt_force`
    pub name: String,
    /// Its value.
    pub value: Ex<'g>,
    /// Its SI unit.
    pub unit: &'static str,
    /// Unit and meaning.
    pub about: String,
}

/// A value that must be positive.
#[derive(Clone, Debug)]
pub(crate) struct Condition<'g> {
    /// The element that asks for it, by its place in the scene.
    pub element: usize,
    /// The value.
    pub value: Ex<'g>,
    /// What it is, with its unit.
    pub what: String,
    /// What to do where it is not.
    pub way_out: &'static str,
}

/// What the coordinates' own efforts (joint efforts, voltages) are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Own {
    /// Inputs, where the scene has them.
    Inputs,
    /// Sought: the laws run as if there were none, and no drive has a limit.
    Sought,
    /// One at every coordinate, in place of its acceleration among the leaves; no drive has a
    /// limit. Undoes what [`Own::Sought`] finds.
    Everywhere,
}

/// The sums that the laws of a scene's effects add to.
pub struct Laws<'g, 'a> {
    /// The graph under construction.
    pub b: &'g Builder,
    /// Positions.
    pub q: Vec<Ex<'g>>,
    /// Velocities.
    pub v: Vec<Ex<'g>>,
    /// Time.
    pub t: Ex<'g>,
    own: Own,
    /// The formulation asked for; the cheapest of each method where `None`.
    pub(crate) asked: Option<&'static dyn Formulation>,
    scene: &'a Scene,
    graph: &'a BondGraph,
    x: Vec<Ex<'g>>,
    modes: Vec<Ex<'g>>,
    u: Vec<Ex<'g>>,
    /// Which element's law is at work.
    at: usize,
    /// On each coordinate.
    efforts: Vec<Ex<'g>>,
    /// The gear between a coordinate's own effort and the coordinate.
    gears: BTreeMap<usize, Gear<'g>>,
    /// Inertia of the coordinates that store their own momentum.
    inertias: BTreeMap<usize, Ex<'g>>,
    /// ẋ
    rates: Vec<Ex<'g>>,
    balances: Vec<Balance<'g>>,
    contacts: Vec<Contact<'g>>,
    events: BTreeMap<String, Ex<'g>>,
    readings: Vec<Reading<'g>>,
    conditions: Vec<Condition<'g>>,
    shared: BTreeMap<(String, &'static str), Ex<'g>>,
    poses: BTreeMap<SiteId, (Mat3<Ex<'g>>, Vec3<Ex<'g>>)>,
}

impl<'g, 'a> Laws<'g, 'a> {
    /// No law yet, under these inputs, with the mechanism's own methods by the formulation `asked`.
    pub(crate) fn empty(
        b: &'g Builder,
        scene: &'a Scene,
        (graph, asked): (&'a BondGraph, Option<&'static dyn Formulation>),
        own: Own,
        inputs: impl FnOnce() -> Vec<Ex<'g>>,
    ) -> Self {
        let layout = &scene.layout;
        let leaves = |n: usize, leaf: fn(usize) -> Leaf| -> Vec<Ex<'g>> {
            (0..n).map(|i| b.leaf(leaf(i))).collect()
        };
        let zeros = |n: usize| vec![b.zero(); n];
        let none = Balance {
            supplied: b.zero(),
            stored: b.zero(),
            dissipated: b.zero(),
        };
        Laws {
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

    /// That the law of the element at this place is at work.
    pub(crate) fn begin(&mut self, at: usize) {
        self.at = at;
    }
}

/// A method of the mechanism by the formulation asked for, its expressions copied; `leaf` may replace
/// leaves.
pub(crate) fn copied<'g>(
    b: &'g Builder,
    (graph, asked): (&BondGraph, Option<&'static dyn Formulation>),
    method: Method,
    leaf: impl FnMut(&mut Graph, Leaf) -> Option<crate::expr::Expr>,
) -> Vec<Ex<'g>> {
    let Some(function) = Choice::new(graph, asked).function(method) else {
        return vec![];
    };
    let outputs = &function.blocks[0].outputs;
    let copies = b.with_graph(|g| copy_into(g, &function.graph, outputs, leaf));
    copies.into_iter().map(|e| b.ex(e)).collect()
}
