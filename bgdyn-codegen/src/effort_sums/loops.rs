//! Velocities of the joints in loops: q̇ = S u, with the independent velocities u of the state.

use bgdyn_runtime::Dd;

use super::{EffortSums, Port};
use crate::expr::{Expr, Graph, Leaf, Signed, Tangent};
use crate::formulation;
use crate::layout::{DependentJoint, StateLayout, StatePosition};

impl<'g, 'a> EffortSums<'g, 'a> {
    /// Returns S, row by row for the velocities of the open tree. Its pivots have the indices of the loops, after
    /// those of the rates.
    fn velocity_map(&self) -> &[Vec<Expr<'g>>] {
        self.velocity_map.get_or_init(|| {
            let Some(closed) = &self.graph.closed else {
                return vec![];
            };
            let q = (&self.q[..closed.tree.positions.len()], self.graph.rows);
            let first = Some(self.first_loop_pivot());
            formulation::velocity_map(self.b, &closed.closure, q, first)
        })
    }

    /// Returns the index of the pivots of the first loop: after those of the velocities and first-order states.
    pub(super) fn first_loop_pivot(&self) -> usize {
        self.scene.layout.nv() + self.scene.layout.nx()
    }

    /// Returns the velocities of the open tree; without loops those of the state.
    fn tree_velocities(&self) -> Vec<Expr<'g>> {
        if self.graph.closed.is_none() {
            return self.v.clone();
        }
        let row = |row: &Vec<Expr<'g>>| {
            let terms = row.iter().zip(&self.v);
            terms.fold(self.b.zero(), |sum, (&s, &v)| sum + s * v)
        };
        self.velocity_map().iter().map(row).collect()
    }

    /// Returns the joint as a port, with the entries of its row of S as moduli.
    pub(super) fn dependent(&self, joint: &DependentJoint) -> Port<'g> {
        let row = self.velocity_map()[joint.velocity.0].iter().copied();
        let moving = row.enumerate().filter(|(_, s)| !s.is_zero());
        let transformers: Vec<(usize, Expr<'g>)> = moving.collect();
        let rate = transformers.iter();
        Port {
            displacement: joint.position.map_or(self.b.zero(), |p| self.q[p]),
            rate: rate.fold(self.b.zero(), |sum, &(k, s)| sum + s * self.v[k]),
            transformers,
        }
    }

    /// Adds the drives of dependent joints.
    pub(super) fn push_drives_of_dependents(&mut self) {
        for (joint, drive) in self.drives_of_dependents() {
            let port = self.dependent(joint);
            self.push(&port, drive);
        }
    }

    /// Returns the dependent joints with drives that are inputs, and these.
    fn drives_of_dependents(&self) -> Vec<(&'a DependentJoint, Expr<'g>)> {
        let layout: &'a StateLayout = &self.scene.layout;
        let inputs = layout.inputs.iter().zip(&self.u);
        let driven = inputs
            .filter_map(|(part, &drive)| Some((&layout.dependents[part.drives_dependent?], drive)));
        driven.collect()
    }

    /// Returns the power of the drives that are inputs.
    pub(crate) fn drive_power(&self) -> Expr<'g> {
        let own = (0..self.scene.layout.motions()).map(|j| self.own_effort(j) * self.v[j]);
        let dependent = self.drives_of_dependents().into_iter();
        let dependent = dependent.map(|(joint, drive)| drive * self.dependent(joint).rate);
        own.chain(dependent)
            .fold(self.b.zero(), |sum, power| sum + power)
    }

    /// Returns q̇ = N(q) v; in mechanisms with loops N(q) S(q) v.
    pub(crate) fn position_rates(&self) -> Vec<Expr<'g>> {
        let positions = &self.scene.layout.positions;
        let coupled = match positions.iter().all(|p| p.coordinate.is_some()) {
            true => vec![],
            false => {
                let closed = self.graph.closed.as_deref();
                let tree = closed.map_or(&**self.graph, |closed| &closed.tree);
                let v = self.tree_velocities();
                formulation::position_rates(self.b, tree, (&self.q, &v))
            }
        };
        let rate = |(p, position): (usize, &StatePosition)| match position.coordinate {
            Some(j) => self.v[j],
            None => coupled[p],
        };
        positions.iter().enumerate().map(rate).collect()
    }

    /// Returns the rates of the positions that are not the integrals of single velocities.
    pub(crate) fn coupled_rates(&self) -> Vec<Expr<'g>> {
        let coupled = self.scene.layout.coupled();
        if coupled.is_empty() {
            return vec![];
        }
        let rates = self.position_rates();
        coupled.into_iter().map(|p| rates[p]).collect()
    }

    /// Returns the rate of x at constant velocities: ∂x/∂q · N(q) S(q) v.
    pub(crate) fn rate_at_constant_velocity(&self, x: Expr<'g>) -> Expr<'g> {
        let rates: Vec<Signed> = self
            .position_rates()
            .into_iter()
            .map(Expr::signed)
            .collect();
        let seed = |_: &mut Graph, leaf| match leaf {
            Leaf::Position(p) => rates.get(p).copied(),
            _ => None,
        };
        let x = x.signed();
        self.b
            .expr(self.b.with_graph(|g| Tangent::new(seed).of(g, x)))
    }

    /// Returns ∂x/∂q_j along the tangent: d/dε x(integrate(q, ε e_j)).
    pub(crate) fn slope(&self, x: Expr<'g>, j: usize) -> Expr<'g> {
        let x = x.signed();
        let one = |g: &mut Graph| g.constant(Dd::ONE);
        if self.scene.layout.coupled().is_empty() {
            let seed = |g: &mut Graph, leaf| (leaf == Leaf::Position(j)).then(|| one(g));
            return self
                .b
                .expr(self.b.with_graph(|g| Tangent::new(seed).of(g, x)));
        }
        let rates = self.unit_tangents(j);
        let seed = |_: &mut Graph, leaf| match leaf {
            Leaf::Position(p) => rates.get(p).copied(),
            _ => None,
        };
        self.b
            .expr(self.b.with_graph(|g| Tangent::new(seed).of(g, x)))
    }

    /// Returns the rates of the positions for a unit velocity of coordinate `j`.
    fn unit_tangents(&self, j: usize) -> Vec<Signed> {
        let Some(closed) = &self.graph.closed else {
            return formulation::unit_tangents(self.b, self.graph, j);
        };
        let column: Vec<Expr<'g>> = self.velocity_map().iter().map(|row| row[j]).collect();
        let rates = formulation::position_rates(self.b, &closed.tree, (&self.q, &column));
        rates.into_iter().map(Expr::signed).collect()
    }

    /// Returns the Newton steps that close the loops, by position; 0 for those that do not change.
    pub(crate) fn closing_steps(&self) -> Vec<Expr<'g>> {
        let mut steps = vec![self.b.zero(); self.q.len()];
        let closing = !self.scene.layout.closing.is_empty();
        let Some(closed) = self.graph.closed.as_ref().filter(|_| closing) else {
            return steps;
        };
        let of_velocities = self.method(crate::method::Method::ClosingStep);
        let of_positions =
            formulation::position_rates(self.b, &closed.tree, (&self.q, &of_velocities));
        steps[..of_positions.len()].copy_from_slice(&of_positions);
        steps
    }
}
