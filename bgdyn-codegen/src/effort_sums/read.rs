//! Values that an effect's law reads.

use bgdyn_runtime::Dd;

use super::{ActuatorEfforts, EffortSums, Port};
use crate::bond_graph::SiteId;
use crate::declaration::{Chain, Element, Quantity, undeclared};
use crate::expr::{Expr, Leaf, Signed};
use crate::format::{Dimension, Key};
use crate::math::{Mat3, Vec3};
use crate::method::Method;
use crate::scene::{Level, Scene};

impl<'g, 'a> EffortSums<'g, 'a> {
    /// Returns whether the limits of drives are active; they are not if the drives are unknowns.
    pub fn limited(&self) -> bool {
        self.own == ActuatorEfforts::FromInputs
    }

    /// Returns the number of a key; 0 if the file does not give it.
    ///
    /// # Panics
    /// If the element's effect does not declare the key as a number.
    pub fn number(&self, element: &Element, key: &Key) -> Expr<'g> {
        self.optional(element, key).unwrap_or(self.b.zero())
    }

    /// Returns the number of a key; `None` if the file does not give it.
    ///
    /// # Panics
    /// If the element's effect does not declare the key as a number.
    pub fn optional(&self, element: &Element, key: &Key) -> Option<Expr<'g>> {
        element.quantity(key).map(|q| self.quantity(q))
    }

    /// Returns a number as an expression.
    pub fn quantity(&self, quantity: &Quantity) -> Expr<'g> {
        let index = quantity.parameter.as_ref().and_then(|name| {
            let parameters = self.scene.parameters.iter();
            parameters.clone().position(|p| p.name == *name)
        });
        match index {
            Some(p) => self.b.leaf(Leaf::Parameter(p)),
            None => self.b.constant(quantity.value),
        }
    }

    /// Returns the first-order state with this name.
    ///
    /// # Panics
    /// If no effect of the scene declares it.
    pub fn state(&self, name: &str) -> Expr<'g> {
        self.x[self.part("state", &self.scene.layout.states, name)]
    }

    /// Returns the mode of a contact at a port, as the sign of the port's slip. At a joint that follows another
    /// with a negative ratio it is the negative of the mode, which is the sign of the leader's slip.
    ///
    /// # Panics
    /// If no effect of the scene declares the mode.
    pub fn mode_at_port(&self, port: &Port<'g>, name: &str) -> Expr<'g> {
        match port.factor() < Dd::ZERO {
            true => -self.mode(name),
            false => self.mode(name),
        }
    }

    /// Returns the mode with this name.
    ///
    /// # Panics
    /// If no effect of the scene declares it.
    pub fn mode(&self, name: &str) -> Expr<'g> {
        self.modes[self.part("mode", &self.scene.layout.modes, name)]
    }

    /// Returns the input with this name.
    ///
    /// # Panics
    /// If no effect of the scene declares it.
    pub fn input(&self, name: &str) -> Expr<'g> {
        self.u[self.part("input", &self.scene.layout.inputs, name)]
    }

    /// Returns a reference's position, rate or acceleration; 0 without a reference.
    ///
    /// # Panics
    /// If no effect of the scene declares the reference up to this level.
    pub fn reference(&self, name: Option<&str>, level: Level) -> Expr<'g> {
        name.map_or(self.b.zero(), |name| self.input(&level.name(name)))
    }

    /// Returns the velocity of the coordinate that the element adds.
    ///
    /// # Panics
    /// If it adds no coordinate.
    pub fn own_velocity(&self, element: &Element) -> Expr<'g> {
        self.v[self.coordinate_index(&element.name)]
    }

    /// Returns the port of the element: its `joint`, or the line between its two sites.
    ///
    /// # Panics
    /// If it has neither, or the scene does not have it.
    pub fn port(&mut self, element: &Element) -> Port<'g> {
        match (element.joint(), element.ends()) {
            (Some(joint), _) => self.coordinate(joint),
            (None, Some([a, b])) => self.line(self.site(a), self.site(b)),
            (None, None) => undeclared(element, "value of the keys", "joint, between"),
        }
    }

    /// Returns the SI units of displacement, rate and effort at the element's port: those of its `joint`,
    /// or of a length.
    pub fn port_units(&self, element: &Element) -> [&'static str; 3] {
        let layout = &self.scene.layout;
        let joint = element.joint();
        let own = joint.and_then(|joint| layout.dimensions_of(joint));
        let length = [Dimension::Length, Dimension::Speed, Dimension::Force];
        own.unwrap_or(length).map(Dimension::si)
    }

    /// Returns the site with this name.
    ///
    /// # Panics
    /// If no link or frame has the name.
    pub fn site(&self, name: &str) -> SiteId {
        let found = self.graph.sites.iter().position(|s| s.name == name);
        SiteId(found.unwrap_or_else(|| undeclared(self.element_at_work(), "site", name)))
    }

    /// Returns a coordinate as a port. The port of a joint that follows others has a transformer to
    /// each of their coordinates, with the ratio as modulus; that of a joint in a loop to the independent ones.
    ///
    /// # Panics
    /// If the scene has no coordinate and no such joint with this name.
    pub fn coordinate(&self, name: &str) -> Port<'g> {
        if let Some(follower) = self.scene.layout.follower_named(name) {
            let scaled = |of: &[Expr<'g>], terms: &[(usize, Dd)]| {
                let terms = terms.iter().map(|&(k, ratio)| of[k] * ratio);
                terms.fold(self.b.zero(), |sum, term| sum + term)
            };
            let offset = self.b.constant(follower.offset);
            let transformer = |&(j, ratio): &(usize, Dd)| (j, self.b.constant(ratio));
            return Port {
                displacement: scaled(&self.q, &follower.positions) + offset,
                rate: scaled(&self.v, &follower.leaders),
                transformers: follower.leaders.iter().map(transformer).collect(),
            };
        }
        if let Some(joint) = self.scene.layout.dependent_named(name) {
            return self.dependent(joint);
        }
        let j = self.coordinate_index(name);
        Port {
            displacement: self.position_of(j),
            rate: self.v[j],
            transformers: vec![(j, self.b.number(1.0))],
        }
    }

    /// Returns the position whose rate is the velocity of a coordinate; 0 without one.
    pub(crate) fn position_of(&self, j: usize) -> Expr<'g> {
        let position = self.scene.layout.coordinates[j].position;
        position.map_or(self.b.zero(), |p| self.q[p])
    }

    /// Returns the distance of two sites as a port: s = |r_b − r_a|, ∂s/∂q_j = n · (∂r_b/∂q_j − ∂r_a/∂q_j)
    /// with the unit vector n from a to b.
    pub fn line(&mut self, a: SiteId, b: SiteId) -> Port<'g> {
        let apart = self.pose(b).1 - self.pose(a).1;
        let length = apart.dot(apart).sqrt();
        let mut port = Port {
            displacement: length,
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

    /// Returns axes and origin of a site in the world.
    pub fn pose(&mut self, site: SiteId) -> (Mat3<Expr<'g>>, Vec3<Expr<'g>>) {
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

    /// Returns the Jacobian of a site, world axes: a column (angular part first) per joint.
    pub fn jacobian(&mut self, site: SiteId) -> Vec<[Expr<'g>; 6]> {
        let n = self.graph.coordinates.len();
        let rows = self.method(Method::Jacobian(site));
        (0..n)
            .map(|j| std::array::from_fn(|i| rows[i * n + j]))
            .collect()
    }

    /// Returns the energy of the weights; empty without gravity.
    pub fn potential_energy(&self) -> Vec<Expr<'g>> {
        self.method(Method::PotentialEnergy)
    }

    /// Copies the expressions of a method of the mechanism into this graph.
    pub(crate) fn method(&self, method: Method) -> Vec<Expr<'g>> {
        self.copied((self.graph, self.asked), method, |_, _| None)
    }

    /// Copies the expressions of a method of the mechanism with these accelerations into this graph.
    pub(crate) fn method_at(&self, method: Method, accelerations: &[Expr<'g>]) -> Vec<Expr<'g>> {
        let placed: Vec<Signed> = accelerations.iter().map(|a| a.signed()).collect();
        self.copied((self.graph, self.asked), method, |_, leaf| match leaf {
            Leaf::Acceleration(j) => Some(placed[j]),
            _ => None,
        })
    }

    /// Returns the scene.
    pub(crate) fn scene(&self) -> &'a Scene {
        self.scene
    }

    /// Returns a value that an earlier element shared.
    pub fn shared(&self, node: &str, what: &'static str) -> Option<Expr<'g>> {
        self.shared.get(&(node.to_owned(), what)).copied()
    }

    /// Returns the scene's elements.
    pub fn elements(&self) -> &'a [Element] {
        &self.scene.elements
    }

    /// Returns the chains of elements in series.
    pub fn chains(&self) -> &'a [Chain] {
        &self.scene.chains
    }
}
