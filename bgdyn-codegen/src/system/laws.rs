//! What the effects' laws see and what they add: the sums on the junctions of one scene.

use std::collections::BTreeMap;

use bgdyn_runtime::Dd;

use crate::bond_graph::{BondGraph, SiteId};
use crate::effect::{Element, Quantity};
use crate::expr::{Builder, Ex, Graph, Leaf, Tangent, copy_into};
use crate::formulation::Search;
use crate::math::{Mat3, Vec3};
use crate::method::Method;
use crate::scene::{Chain, Level, Scene};

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

/// Dry friction that can hold.
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
    /// The largest effort it holds.
    pub limit: Ex<'g>,
}

/// A quantity worth knowing: a force, a pressure.
#[derive(Clone, Debug)]
pub struct Reading<'g> {
    /// `belt_force`
    pub name: String,
    /// Its value.
    pub value: Ex<'g>,
    /// Unit and meaning.
    pub about: String,
}

/// A value that must be positive.
#[derive(Clone, Debug)]
pub(super) struct Condition<'g> {
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
    scene: &'a Scene,
    graph: &'a BondGraph,
    x: Vec<Ex<'g>>,
    modes: Vec<Ex<'g>>,
    u: Vec<Ex<'g>>,
    /// Which element's law is at work.
    at: usize,
    /// On each coordinate.
    efforts: Vec<Ex<'g>>,
    /// Efficiency of the gear between a coordinate's own effort and the coordinate.
    gears: BTreeMap<usize, Ex<'g>>,
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
    /// Every law of the scene, summed.
    pub(super) fn new(b: &'g Builder, scene: &'a Scene, graph: &'a BondGraph, own: Own) -> Self {
        let layout = &scene.layout;
        let leaves = |n: usize, leaf: fn(usize) -> Leaf| -> Vec<Ex<'g>> {
            (0..n).map(|i| b.leaf(leaf(i))).collect()
        };
        let zeros = |n: usize| vec![b.zero(); n];
        let input = |(i, part): (usize, &crate::scene::Part)| match part.drives {
            Some(_) if own != Own::Inputs => b.zero(),
            _ => b.leaf(Leaf::Input(i)),
        };
        let none = Balance {
            supplied: b.zero(),
            stored: b.zero(),
            dissipated: b.zero(),
        };
        let mut laws = Laws {
            b,
            q: leaves(layout.nq(), Leaf::Position),
            v: leaves(layout.nv(), Leaf::Velocity),
            t: b.leaf(Leaf::Time),
            own,
            scene,
            graph,
            x: leaves(layout.nx(), Leaf::State),
            modes: leaves(layout.modes.len(), Leaf::Mode),
            u: layout.inputs.iter().enumerate().map(input).collect(),
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
        };
        for (at, element) in scene.elements.iter().enumerate() {
            laws.at = at;
            b.section(|| format!("{}: {}", element.name, element.effect.summary()));
            element.effect.law(element, &mut laws);
        }
        laws
    }

    // What an effect reads

    /// Whether the limits of drives act: not where the coordinates' own efforts are sought.
    pub fn limited(&self) -> bool {
        self.own == Own::Inputs
    }

    /// The number behind a key; 0 where it is not there.
    pub fn number(&self, element: &Element, key: &str) -> Ex<'g> {
        self.optional(element, key).unwrap_or(self.b.zero())
    }

    /// The number behind a key.
    pub fn optional(&self, element: &Element, key: &str) -> Option<Ex<'g>> {
        element.quantity(key).map(|q| self.quantity(q))
    }

    /// A number as an expression.
    pub fn quantity(&self, quantity: &Quantity) -> Ex<'g> {
        let index = quantity.parameter.as_ref().and_then(|name| {
            let parameters = self.scene.parameters.iter();
            parameters.clone().position(|p| p.name == *name)
        });
        match index {
            Some(p) => self.b.leaf(Leaf::Parameter(p)),
            None => self.b.constant(quantity.value),
        }
    }

    /// The first-order state with this name.
    pub fn state(&self, name: &str) -> Ex<'g> {
        let found = self.scene.layout.states.iter().position(|s| s.name == name);
        found.map_or(self.b.zero(), |i| self.x[i])
    }

    /// The mode with this name.
    pub fn mode(&self, name: &str) -> Ex<'g> {
        let found = self.scene.layout.modes.iter().position(|m| m.name == name);
        found.map_or(self.b.zero(), |i| self.modes[i])
    }

    /// The input with this name; 0 where there is none.
    pub fn input(&self, name: &str) -> Ex<'g> {
        let found = self.scene.layout.inputs.iter().position(|m| m.name == name);
        found.map_or(self.b.zero(), |i| self.u[i])
    }

    /// A reference's place, rate or acceleration; 0 without one.
    pub fn reference(&self, name: Option<&str>, level: Level) -> Ex<'g> {
        name.map_or(self.b.zero(), |name| self.input(&level.name(name)))
    }

    /// The velocity of the coordinate that the element itself adds.
    pub fn own_velocity(&self, element: &Element) -> Ex<'g> {
        let found = self.scene.layout.coordinate_named(&element.name);
        found.map_or(self.b.zero(), |j| self.v[j])
    }

    /// Where the element acts: on its `joint`, or along the line between its two places.
    pub fn port(&mut self, element: &Element) -> Port<'g> {
        match (element.name("joint"), element.names("between")) {
            (Some(joint), _) => self.coordinate(joint),
            (None, Some([a, b])) => self.line(self.site(a), self.site(b)),
            (None, None) => Port {
                place: self.b.zero(),
                rate: self.b.zero(),
                transformers: vec![],
            },
        }
    }

    /// The place with this name.
    pub fn site(&self, name: &str) -> SiteId {
        let found = self.graph.sites.iter().position(|s| s.name == name);
        SiteId(found.unwrap_or(0))
    }

    /// A coordinate as a port.
    pub fn coordinate(&self, name: &str) -> Port<'g> {
        let j = self.scene.layout.coordinate_named(name).unwrap_or(0);
        Port {
            place: self.q.get(j).copied().unwrap_or(self.b.zero()),
            rate: self.v[j],
            transformers: vec![(j, self.b.number(1.0))],
        }
    }

    /// The distance of two places as a port: s = |r_b − r_a|, ∂s/∂q_j = n · (∂r_b/∂q_j − ∂r_a/∂q_j)
    /// with the unit vector n from a to b.
    pub fn line(&mut self, a: SiteId, b: SiteId) -> Port<'g> {
        let apart = self.pose(b).1 - self.pose(a).1;
        let length = apart.dot(apart).sqrt();
        let mut port = Port {
            place: length,
            rate: self.b.zero(),
            transformers: vec![],
        };
        for j in 0..self.graph.coordinates.len() {
            let slope = apart.map(|x| self.slope(x, j));
            let transformer = apart.dot(slope) / length;
            if !transformer.is_zero() {
                port.rate = port.rate + transformer * self.v[j];
                port.transformers.push((j, transformer));
            }
        }
        port
    }

    /// ∂x/∂q_j
    fn slope(&self, x: Ex<'g>, j: usize) -> Ex<'g> {
        let seed = |g: &mut Graph, leaf| (leaf == Leaf::Position(j)).then(|| g.constant(Dd::ONE));
        let x = x.expr();
        let slope = self.b.with_graph(|g| Tangent::new(seed).of(g, x));
        self.b.ex(slope)
    }

    /// Axes and origin of a place in the world.
    pub fn pose(&mut self, site: SiteId) -> (Mat3<Ex<'g>>, Vec3<Ex<'g>>) {
        if let Some(pose) = self.poses.get(&site) {
            return *pose;
        }
        let p = self.method(Method::Pose(site));
        let pose = (
            Mat3([[p[0], p[1], p[2]], [p[3], p[4], p[5]], [p[6], p[7], p[8]]]),
            Vec3([p[9], p[10], p[11]]),
        );
        self.poses.insert(site, pose);
        pose
    }

    /// Jacobian of a place, world axes: a column (angular part first) per joint.
    pub fn jacobian(&mut self, site: SiteId) -> Vec<[Ex<'g>; 6]> {
        let n = self.graph.coordinates.len();
        let rows = self.method(Method::Jacobian(site));
        (0..n)
            .map(|j| std::array::from_fn(|i| rows[i * n + j]))
            .collect()
    }

    /// Energy of the weights, if anything weighs.
    pub fn potential_energy(&self) -> Vec<Ex<'g>> {
        self.method(Method::PotentialEnergy)
    }

    /// A method of the mechanism, its expressions copied into this graph.
    pub(super) fn method(&self, method: Method) -> Vec<Ex<'g>> {
        copied(self.b, self.graph, method, |_, _| None)
    }

    // What an effect adds

    /// An effort along a port.
    pub fn push(&mut self, port: &Port<'g>, effort: Ex<'g>) {
        for &(j, transformer) in &port.transformers {
            self.efforts[j] = self.efforts[j] + transformer * effort;
        }
    }

    /// An effort on the element's own coordinate.
    pub fn push_own(&mut self, element: &Element, effort: Ex<'g>) {
        if let Some(j) = self.scene.layout.coordinate_named(&element.name) {
            self.efforts[j] = self.efforts[j] + effort;
        }
    }

    /// An effort on one coordinate, by its number.
    pub fn push_on(&mut self, coordinate: usize, effort: Ex<'g>) {
        self.efforts[coordinate] = self.efforts[coordinate] + effort;
    }

    /// A gear between a coordinate's own effort and the coordinate.
    pub fn gear(&mut self, name: &str, efficiency: Ex<'g>) {
        if let Some(j) = self.scene.layout.coordinate_named(name) {
            self.gears.insert(j, efficiency);
            let lost = (self.own_effort(j) - self.drive(j)) * self.v[j];
            self.dissipate(lost);
        }
    }

    /// The inertia of the coordinate that the element adds, and the kinetic (magnetic) energy with
    /// it: ½ I v².
    pub fn inertia(&mut self, element: &Element, inertia: Ex<'g>) {
        if let Some(j) = self.scene.layout.coordinate_named(&element.name) {
            self.inertias.insert(j, inertia);
            let rate = self.v[j];
            self.store(inertia * rate * rate * Dd::from_f64(0.5));
        }
    }

    /// ẋ of a first-order state; several effects may add to it.
    pub fn flow(&mut self, state: &str, rate: Ex<'g>) {
        if let Some(i) = self
            .scene
            .layout
            .states
            .iter()
            .position(|s| s.name == state)
        {
            self.rates[i] = self.rates[i] + rate;
        }
    }

    /// Power that the element takes from outside, W.
    pub fn supply(&mut self, power: Ex<'g>) {
        let balance = &mut self.balances[self.at];
        balance.supplied = balance.supplied + power;
    }

    /// Power that another element takes from outside, W: a source of pressure gives it to whatever
    /// lets fluid run.
    pub fn supply_by(&mut self, element: &str, power: Ex<'g>) {
        let found = self.scene.elements.iter().position(|e| e.name == element);
        if let Some(at) = found {
            let balance = &mut self.balances[at];
            balance.supplied = balance.supplied + power;
        }
    }

    /// Energy that the element stores, J.
    pub fn store(&mut self, energy: Ex<'g>) {
        let balance = &mut self.balances[self.at];
        balance.stored = balance.stored + energy;
    }

    /// Power that the element dissipates, W.
    pub fn dissipate(&mut self, power: Ex<'g>) {
        let balance = &mut self.balances[self.at];
        balance.dissipated = balance.dissipated + power;
    }

    /// A value whose fall through zero is the event with this name.
    pub fn event(&mut self, name: &str, value: Ex<'g>) {
        self.events.insert(name.to_owned(), value);
    }

    /// Dry friction that can hold its coordinate.
    pub fn contact(&mut self, mode: &str, port: &Port<'g>, reference: [Ex<'g>; 2], limit: Ex<'g>) {
        let modes = &self.scene.layout.modes;
        if let (Some(mode), Some(&(coordinate, _))) = (
            modes.iter().position(|m| m.name == mode),
            port.transformers.first(),
        ) {
            self.contacts.push(Contact {
                element: self.at,
                mode,
                coordinate,
                slip: port.rate - reference[0],
                reference,
                limit,
            });
        }
    }

    /// A quantity worth knowing.
    pub fn reading(&mut self, name: String, value: Ex<'g>, about: String) {
        self.readings.push(Reading { name, value, about });
    }

    /// A value that must be positive, tried at the start and over the limits of the joints.
    pub fn stays_positive(&mut self, value: Ex<'g>, what: String, way_out: &'static str) {
        self.conditions.push(Condition {
            element: self.at,
            value,
            what,
            way_out,
        });
    }

    /// A value that one element gives to others: the pressure of a node.
    pub fn share(&mut self, node: &str, what: &'static str, value: Ex<'g>) {
        self.shared.insert((node.to_owned(), what), value);
    }

    /// What an earlier element gave.
    pub fn shared(&self, node: &str, what: &'static str) -> Option<Ex<'g>> {
        self.shared.get(&(node.to_owned(), what)).copied()
    }

    /// The scene's elements, for those that have to know of each other.
    pub fn elements(&self) -> &'a [Element] {
        &self.scene.elements
    }

    /// Elements in series.
    pub fn chains(&self) -> &'a [Chain] {
        &self.scene.chains
    }

    // What the system reads

    /// What a first-order state stores where the scene gives `x` for it.
    pub(super) fn stored_as(&self, state: &str, x: Dd) -> Ex<'g> {
        let given = self.b.constant(x);
        let owner = |e: &&Element| e.effect.keeps(e, state);
        match self.scene.elements.iter().find(owner) {
            Some(element) => element.effect.start(element, self, state, given),
            None => given,
        }
    }

    /// An expression's value at the start, run-time parameters at their defaults.
    pub(super) fn at_start(&self, x: Ex<'g>, initial: &crate::scene::Initial) -> Dd {
        use bgdyn_runtime::Scalar as _;
        let inputs = crate::expr::Inputs {
            q: initial.q.clone(),
            v: initial.v.clone(),
            a: vec![],
            x: initial.x.clone(),
            u: vec![Dd::ZERO; self.u.len()],
            modes: initial.modes.clone(),
            parameters: self.scene.parameters.iter().map(|p| p.default).collect(),
            t: Some(Dd::ZERO),
            passed: vec![],
        };
        let x = x.expr();
        let mut refused = Dd::none_refused();
        let values = self
            .b
            .with_graph(|g| crate::expr::evaluate(g, &[x], &inputs, &mut refused));
        values[0]
    }

    /// Own efforts of the coordinates that are inputs.
    pub(super) fn own_effort(&self, j: usize) -> Ex<'g> {
        let parts = self.scene.layout.inputs.iter().zip(&self.u);
        let own = parts.filter(|(part, _)| part.drives == Some(j));
        own.fold(self.b.zero(), |sum, (_, &u)| sum + u)
    }

    /// Own effort of a coordinate behind its gear. A voltage goes through its motor's law.
    pub(super) fn drive(&self, j: usize) -> Ex<'g> {
        let (stored, everywhere) = (
            self.scene.layout.coordinates[j].stored,
            self.own == Own::Everywhere,
        );
        let own = match (everywhere, stored) {
            (true, _) => self.b.leaf(Leaf::Acceleration(j)),
            (false, true) => self.own_effort(j),
            (false, false) => self.b.zero(),
        };
        match self.gears.get(&j) {
            Some(&efficiency) => behind_gear(self.b, own, self.v[j], efficiency),
            None => own,
        }
    }

    /// The own effort that gives `effort` behind the coordinate's gear.
    pub(super) fn before_gear(&self, j: usize, effort: Ex<'g>) -> Ex<'g> {
        match self.gears.get(&j) {
            Some(&efficiency) => {
                let one = self.b.number(1.0);
                behind_gear(self.b, effort, self.v[j], one / efficiency)
            }
            None => effort,
        }
    }

    /// Effort on a coordinate by everything but its store, its own input included.
    pub(super) fn effort(&self, j: usize) -> Ex<'g> {
        self.efforts[j] + self.drive(j)
    }

    /// Whether an expression depends on any position.
    pub(super) fn reads_positions(&self, x: Ex<'g>) -> bool {
        !self.positions_of(x).is_empty()
    }

    /// The positions that an expression depends on.
    pub(super) fn positions_of(&self, x: Ex<'g>) -> Vec<usize> {
        let x = x.expr();
        self.b.with_graph(|g| {
            let needed = crate::expr::reachable(g, &[x]);
            let needed = (0..g.len()).filter(|&i| needed[i]);
            let position = |i| match g.node(crate::expr::NodeId(i as u32)) {
                crate::expr::Node::Leaf(Leaf::Position(j)) => Some(*j),
                _ => None,
            };
            needed.filter_map(position).collect()
        })
    }

    /// Inertia of a coordinate with a store of its own.
    pub(super) fn inertia_of(&self, j: usize) -> Option<Ex<'g>> {
        self.inertias.get(&j).copied()
    }

    pub(super) fn rates(&self) -> &[Ex<'g>] {
        &self.rates
    }

    pub(super) fn states(&self) -> &[Ex<'g>] {
        &self.x
    }

    pub(super) fn mode_at(&self, k: usize) -> Ex<'g> {
        self.modes[k]
    }

    pub(super) fn inputs(&self) -> &[Ex<'g>] {
        &self.u
    }

    pub(super) fn contacts(&self) -> &[Contact<'g>] {
        &self.contacts
    }

    pub(super) fn balance_of(&mut self, element: usize) -> &mut Balance<'g> {
        &mut self.balances[element]
    }

    pub(super) fn balances(&self) -> &[Balance<'g>] {
        &self.balances
    }

    pub(super) fn event_named(&self, name: &str) -> Option<Ex<'g>> {
        self.events.get(name).copied()
    }

    pub(super) fn conditions(&self) -> &[Condition<'g>] {
        &self.conditions
    }

    pub(super) fn readings(&self) -> &[Reading<'g>] {
        &self.readings
    }
}

/// Effort behind a gear of efficiency η: ητ where τ drives (τ·v ≥ 0), τ/η where it is driven.
pub fn behind_gear<'g>(b: &'g Builder, effort: Ex<'g>, rate: Ex<'g>, efficiency: Ex<'g>) -> Ex<'g> {
    (effort * rate).if_less(b.zero(), effort / efficiency, effort * efficiency)
}

/// A method of the mechanism, its expressions copied; `leaf` may replace leaves.
pub(super) fn copied<'g>(
    b: &'g Builder,
    graph: &BondGraph,
    method: Method,
    leaf: impl FnMut(&mut Graph, Leaf) -> Option<crate::expr::Expr>,
) -> Vec<Ex<'g>> {
    let Some(function) = Search::new(graph, None).function(method) else {
        return vec![];
    };
    let outputs = &function.blocks[0].outputs;
    let copies = b.with_graph(|g| copy_into(g, &function.graph, outputs, leaf));
    copies.into_iter().map(|e| b.ex(e)).collect()
}
