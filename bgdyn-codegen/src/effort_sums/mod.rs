//! The sums on the junctions of one scene: the arguments of the effects' laws, and the terms that laws add.

mod attitude;
mod contact_motion;
mod gear;
mod gears;
mod loops;
mod parts;
mod poses;
mod read;
mod result;
mod rigid_contacts;
mod undeclared;
mod write;

use std::cell::OnceCell;
use std::collections::BTreeMap;

use crate::bond_graph::SiteId;
use crate::choice::GraphMethods;
use crate::expr::{Builder, Expr, Graph, Leaf, Signed, copy_with_pivots};
use crate::formulation::Formulation;
use crate::function::Function;
use crate::math::{Mat3, Vec3};
use crate::method::Method;
use crate::scene::{Level, Scene};

pub use attitude::Attitude;
pub(crate) use attitude::angular_velocity;
pub use contact_motion::ContactMotion;
pub use gear::{LossyGear, load_event};
pub(crate) use parts::Condition;
pub use parts::{ActuatorEfforts, Balance, Contact, ContactSpring, Hold, Port, Reading, RigidLaw};

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
    /// S of the loops, once a law reads it.
    velocity_map: OnceCell<Vec<Vec<Expr<'g>>>>,
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
    jacobians: BTreeMap<SiteId, Vec<[Expr<'g>; 6]>>,
    /// Contact points and forces on spheres.
    contact_forces: Vec<(Vec3<Expr<'g>>, Vec3<Expr<'g>>)>,
    /// Rigid contacts.
    rigid: Vec<RigidLaw<'g>>,
    /// Springs of compliant contacts.
    springs: Vec<ContactSpring<'g>>,
    /// Moment and force of contacts at the origins of links, world axes.
    wrenches: BTreeMap<SiteId, [Expr<'g>; 6]>,
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
        let mut sums = EffortSums {
            b,
            q: leaves(layout.nq(), Leaf::Position),
            v: leaves(layout.nv(), Leaf::Velocity),
            t: b.leaf(Leaf::Time),
            own,
            asked,
            velocity_map: OnceCell::new(),
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
            jacobians: BTreeMap::new(),
            contact_forces: Vec::new(),
            rigid: Vec::new(),
            springs: Vec::new(),
            wrenches: BTreeMap::new(),
        };
        sums.push_drives_of_dependents();
        sums
    }

    /// Begins the law of the element with this index.
    pub(crate) fn begin(&mut self, at: usize) {
        self.at = at;
    }
}

impl<'g> EffortSums<'g, '_> {
    /// Copies the expressions of a method of the mechanism, by the selected formulation; `leaf` may replace
    /// leaves.
    pub(crate) fn copied(
        &self,
        (graph, asked): (&GraphMethods, Option<&'static dyn Formulation>),
        method: Method,
        leaf: impl FnMut(&mut Graph, Leaf) -> Option<Signed>,
    ) -> Vec<Expr<'g>> {
        match graph.function(asked, method) {
            Some(function) => self.results(&function, leaf),
            None => vec![],
        }
    }

    /// Copies the results of a function of the mechanism; `leaf` may replace leaves.
    pub(crate) fn results(
        &self,
        function: &Function,
        mut leaf: impl FnMut(&mut Graph, Leaf) -> Option<Signed>,
    ) -> Vec<Expr<'g>> {
        let parameters = self.mechanism_parameters();
        let placed = |g: &mut Graph, l: Leaf| match l {
            Leaf::Parameter(p) if !parameters.is_empty() => Some(parameters[p]),
            l => leaf(g, l),
        };
        let outputs = &function.blocks[0].outputs;
        // Pivots of loops follow those of the joints in the mechanism, and those of all rates here.
        let joints = self.graph.coordinates.len();
        let pivot = |index: usize| match index.checked_sub(joints) {
            Some(closes) => Some(self.first_loop_pivot() + closes),
            None => Some(index),
        };
        let copies = self
            .b
            .with_graph(|g| copy_with_pivots(g, &function.graph, outputs, placed, pivot));
        copies.into_iter().map(|e| self.b.expr(e)).collect()
    }

    /// Returns the expressions of the mechanism's run-time parameters: the motions of prescribed joints are inputs,
    /// the others are those of the scene. Empty without prescribed joints: both have the same numbers.
    fn mechanism_parameters(&self) -> Vec<Signed> {
        let Some(released) = &self.graph.released else {
            return vec![];
        };
        let levels = [Level::Position, Level::Rate, Level::Acceleration];
        let input = |p: usize| {
            let mut all = released.prescribed.iter();
            all.find_map(|own| {
                let k = own.motion.iter().position(|parameter| parameter.0 == p)?;
                Some(self.input(&levels[k].name(&own.name)))
            })
        };
        let own = |name: &str| {
            let mut parameters = self.scene.parameters.iter();
            let found = parameters.position(|p| p.name == name);
            let found = found.expect("the parameters of the mechanism are those of the scene");
            self.b.leaf(Leaf::Parameter(found))
        };
        let all = self.graph.parameters.iter().enumerate();
        all.map(|(p, parameter)| input(p).unwrap_or_else(|| own(&parameter.name)).signed())
            .collect()
    }
}
