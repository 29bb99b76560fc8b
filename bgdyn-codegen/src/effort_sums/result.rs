//! Results of the sums that the scene's functions read.

use bgdyn_runtime::Dd;

use super::{ActuatorEfforts, Balance, Condition, Contact, EffortSums, Hold, Reading};
use crate::expr::{Expr, Leaf};

impl<'g> EffortSums<'g, '_> {
    /// Returns an expression's value at the start, with default run-time parameters.
    pub(crate) fn at_start(&self, x: Expr<'g>, initial: &crate::scene::Initial) -> Dd {
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
        let x = x.signed();
        let mut refused = Dd::none_refused();
        let values = self
            .b
            .with_graph(|g| crate::expr::evaluate(g, &[x], &inputs, &mut refused));
        values[0]
    }

    /// Returns a drive that is an input.
    pub(crate) fn own_effort(&self, j: usize) -> Expr<'g> {
        let parts = self.scene.layout.inputs.iter().zip(&self.u);
        let own = parts.filter(|(part, _)| part.drives == Some(j));
        own.fold(self.b.zero(), |sum, (_, &u)| sum + u)
    }

    /// Returns the drive of a coordinate before its gear. A voltage passes through its motor's law.
    pub(super) fn before_the_gear(&self, j: usize) -> Expr<'g> {
        let (moves, everywhere) = (
            self.scene.layout.coordinates[j].moves(),
            self.own == ActuatorEfforts::Each,
        );
        match (everywhere, moves) {
            (true, _) => self.b.leaf(Leaf::Acceleration(j)),
            (false, true) => self.own_effort(j),
            (false, false) => self.b.zero(),
        }
    }

    /// Returns the drive of a coordinate behind its gear.
    pub(crate) fn drive(&self, j: usize) -> Expr<'g> {
        let own = self.before_the_gear(j);
        let gear = self.gears.get(&j);
        gear.map_or(own, |gear| gear.behind(self.b, own))
    }

    /// Returns the drive that gives `effort` behind the coordinate's gear.
    pub(crate) fn before_gear(&self, j: usize, effort: Expr<'g>) -> Expr<'g> {
        let gear = self.gears.get(&j);
        gear.map_or(effort, |gear| gear.before(self.b, effort))
    }

    /// Returns the total effort on a coordinate without its store, including its input.
    pub(crate) fn effort(&self, j: usize) -> Expr<'g> {
        self.efforts[j] + self.drive(j)
    }

    /// Returns whether an expression depends on any position.
    pub(crate) fn reads_positions(&self, x: Expr<'g>) -> bool {
        !self.positions_of(x).is_empty()
    }

    /// Returns the positions that an expression depends on.
    pub(crate) fn positions_of(&self, x: Expr<'g>) -> Vec<usize> {
        let x = x.signed();
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

    /// Returns the inertia of a coordinate with a store of its own.
    pub(crate) fn inertia_of(&self, j: usize) -> Option<Expr<'g>> {
        self.inertias.get(&j).copied()
    }

    pub(crate) fn rates(&self) -> &[Expr<'g>] {
        &self.rates
    }

    pub(crate) fn states(&self) -> &[Expr<'g>] {
        &self.x
    }

    pub(crate) fn mode_at(&self, k: usize) -> Expr<'g> {
        self.modes[k]
    }

    pub(crate) fn inputs(&self) -> &[Expr<'g>] {
        &self.u
    }

    pub(crate) fn contacts(&self) -> &[Contact<'g>] {
        &self.contacts
    }

    /// Returns the margin of a contact whose coordinate is held with this effort; negative beyond the
    /// limit. Frictions that hold the same coordinate share the effort: they break away together if it
    /// exceeds the sum of their limits.
    pub(crate) fn margin(&self, contact: &Contact<'g>, holding: Expr<'g>) -> Expr<'g> {
        let ranges = match contact.hold {
            Hold::Lowers => return -holding,
            Hold::Raises => return holding,
            Hold::Within(_) | Hold::Between(_) => self.ranges_with(contact),
        };
        if let (Hold::Within(limit), [_]) = (contact.hold, &ranges[..]) {
            return limit - holding.abs();
        }
        let none = [self.b.zero(); 2];
        let [least, most] = ranges
            .into_iter()
            .fold(none, |sum, range| [sum[0] + range[0], sum[1] + range[1]]);
        (holding - least).min(most - holding)
    }

    /// Returns the effort ranges of a friction and of the others that hold its coordinate now.
    fn ranges_with(&self, contact: &Contact<'g>) -> Vec<[Expr<'g>; 2]> {
        let (half, zero) = (self.b.number(0.5), self.b.zero());
        let beside = |c: &&Contact<'g>| c.coordinate == contact.coordinate;
        let all = self.contacts.iter().filter(beside);
        let range = |c: &Contact<'g>| {
            let range = c.hold.range()?;
            let mode = self.modes[c.mode];
            let now = |effort| mode.abs().if_less(half, effort, zero);
            Some(match c.mode == contact.mode {
                true => range,
                false => range.map(now),
            })
        };
        all.filter_map(range).collect()
    }

    pub(crate) fn balance_of(&mut self, element: usize) -> &mut Balance<'g> {
        &mut self.balances[element]
    }

    pub(crate) fn balances(&self) -> &[Balance<'g>] {
        &self.balances
    }

    pub(crate) fn event_named(&self, name: &str) -> Option<Expr<'g>> {
        self.events.get(name).copied()
    }

    pub(crate) fn conditions(&self) -> &[Condition<'g>] {
        &self.conditions
    }

    pub(crate) fn readings(&self) -> &[Reading<'g>] {
        &self.readings
    }
}
