//! Terms that an effect's law adds.

use bgdyn_runtime::Dd;

use super::{Condition, Contact, EffortSums, Hold, Port, Reading};
use crate::declaration::{Element, undeclared};
use crate::expr::Expr;

impl<'g> EffortSums<'g, '_> {
    /// Adds an effort along a port.
    pub fn push(&mut self, port: &Port<'g>, effort: Expr<'g>) {
        for &(j, transformer) in &port.transformers {
            self.efforts[j] = self.efforts[j] + transformer * effort;
        }
    }

    /// Adds an effort on the element's own coordinate.
    ///
    /// # Panics
    /// If the element adds no coordinate.
    pub fn push_own(&mut self, element: &Element, effort: Expr<'g>) {
        let j = self.coordinate_index(&element.name);
        self.efforts[j] = self.efforts[j] + effort;
    }

    /// Adds an effort on one coordinate, by its index.
    pub fn push_on(&mut self, coordinate: usize, effort: Expr<'g>) {
        self.efforts[coordinate] = self.efforts[coordinate] + effort;
    }

    /// Sets the inertia of the coordinate that the element adds, and adds its kinetic (magnetic) energy ½
    /// I v².
    ///
    /// # Panics
    /// If the element adds no coordinate.
    pub fn inertia(&mut self, element: &Element, inertia: Expr<'g>) {
        let j = self.coordinate_index(&element.name);
        self.inertias.insert(j, inertia);
        let rate = self.v[j];
        self.store(inertia * rate * rate * Dd::from_f64(0.5));
    }

    /// Adds to the rate ẋ of a first-order state; several effects may add to it.
    ///
    /// # Panics
    /// If no effect of the scene declares the state.
    pub fn flow(&mut self, state: &str, rate: Expr<'g>) {
        let i = self.part("state", &self.scene.layout.states, state);
        self.rates[i] = self.rates[i] + rate;
    }

    /// Adds power from outside to the element, W.
    pub fn supply(&mut self, power: Expr<'g>) {
        let balance = &mut self.balances[self.at];
        balance.supplied = balance.supplied + power;
    }

    /// Adds power from outside to another element, W: a source of pressure supplies the elements through
    /// which fluid flows.
    ///
    /// # Panics
    /// If the scene has no element with this name.
    pub fn supply_by(&mut self, element: &str, power: Expr<'g>) {
        let found = self.scene.elements.iter().position(|e| e.name == element);
        let at = found.unwrap_or_else(|| undeclared(self.element_at_work(), "element", element));
        let balance = &mut self.balances[at];
        balance.supplied = balance.supplied + power;
    }

    /// Adds energy that the element stores, J.
    pub fn store(&mut self, energy: Expr<'g>) {
        let balance = &mut self.balances[self.at];
        balance.stored = balance.stored + energy;
    }

    /// Adds power that the element dissipates, W.
    pub fn dissipate(&mut self, power: Expr<'g>) {
        let balance = &mut self.balances[self.at];
        balance.dissipated = balance.dissipated + power;
    }

    /// Sets the event function of this name; the event occurs where the value falls through zero.
    ///
    /// # Panics
    /// If no effect of the scene declares the event.
    pub fn event(&mut self, name: &str, value: Expr<'g>) {
        self.part("event", &self.scene.layout.events, name);
        self.events.insert(name.to_owned(), value);
    }

    /// Adds a contact that can hold its coordinate at the rate of a counterpart; `reference` is the rate
    /// and acceleration of the counterpart. A contact of a joint that follows another holds its leader: slip, reference
    /// and efforts become those of the leader.
    ///
    /// # Panics
    /// If no effect of the scene declares the mode.
    pub fn contact(
        &mut self,
        mode: &str,
        port: &Port<'g>,
        reference: [Expr<'g>; 2],
        hold: Hold<'g>,
    ) {
        let mode = self.part("mode", &self.scene.layout.modes, mode);
        if let Some(&(coordinate, _)) = port.transformers.first() {
            let factor = port.factor();
            let reference = reference.map(|x| x / self.b.constant(factor));
            self.contacts.push(Contact {
                element: self.at,
                mode,
                coordinate,
                slip: self.v[coordinate] - reference[0],
                reference,
                hold: hold.times(factor),
            });
        }
    }

    /// Adds an output quantity, in this SI unit.
    pub fn reading(&mut self, name: String, value: Expr<'g>, unit: &'static str, about: String) {
        self.readings.push(Reading {
            name,
            value,
            unit,
            about,
        });
    }

    /// Adds a value that must be positive; it is checked at the start and over the limits of the joints.
    pub fn stays_positive(&mut self, value: Expr<'g>, what: String, way_out: &'static str) {
        self.conditions.push(Condition {
            element: self.at,
            value,
            what,
            way_out,
        });
    }

    /// Shares a value of this element with other elements: the pressure of a node.
    pub fn share(&mut self, node: &str, what: &'static str, value: Expr<'g>) {
        self.shared.insert((node.to_owned(), what), value);
    }
}
