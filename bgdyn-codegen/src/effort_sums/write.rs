//! What an effect's law adds.

use bgdyn_runtime::Dd;

use super::undeclared::undeclared;
use super::{Condition, Contact, EffortSums, Hold, Port, Reading};
use crate::declaration::Element;
use crate::expr::Expr;

impl<'g> EffortSums<'g, '_> {
    /// An effort along a port.
    pub fn push(&mut self, port: &Port<'g>, effort: Expr<'g>) {
        for &(j, transformer) in &port.transformers {
            self.efforts[j] = self.efforts[j] + transformer * effort;
        }
    }

    /// An effort on the element's own coordinate.
    ///
    /// # Panics
    /// Where the element adds no coordinate.
    pub fn push_own(&mut self, element: &Element, effort: Expr<'g>) {
        let j = self.coordinate_index(&element.name);
        self.efforts[j] = self.efforts[j] + effort;
    }

    /// An effort on one coordinate, by its number.
    pub fn push_on(&mut self, coordinate: usize, effort: Expr<'g>) {
        self.efforts[coordinate] = self.efforts[coordinate] + effort;
    }

    /// The inertia of the coordinate that the element adds, and the kinetic (magnetic) energy with
    /// it: ½ I v².
    ///
    /// # Panics
    /// Where the element adds no coordinate.
    pub fn inertia(&mut self, element: &Element, inertia: Expr<'g>) {
        let j = self.coordinate_index(&element.name);
        self.inertias.insert(j, inertia);
        let rate = self.v[j];
        self.store(inertia * rate * rate * Dd::from_f64(0.5));
    }

    /// ẋ of a first-order state; several effects may add to it.
    ///
    /// # Panics
    /// Where no effect of the scene declares the state.
    pub fn flow(&mut self, state: &str, rate: Expr<'g>) {
        let i = self.part("state", &self.scene.layout.states, state);
        self.rates[i] = self.rates[i] + rate;
    }

    /// Power that the element takes from outside, W.
    pub fn supply(&mut self, power: Expr<'g>) {
        let balance = &mut self.balances[self.at];
        balance.supplied = balance.supplied + power;
    }

    /// Power that another element takes from outside, W: a source of pressure gives it to whatever
    /// lets fluid run.
    ///
    /// # Panics
    /// Where the scene has no element with this name.
    pub fn supply_by(&mut self, element: &str, power: Expr<'g>) {
        let found = self.scene.elements.iter().position(|e| e.name == element);
        let at = found.unwrap_or_else(|| undeclared(self.element_at_work(), "element", element));
        let balance = &mut self.balances[at];
        balance.supplied = balance.supplied + power;
    }

    /// Energy that the element stores, J.
    pub fn store(&mut self, energy: Expr<'g>) {
        let balance = &mut self.balances[self.at];
        balance.stored = balance.stored + energy;
    }

    /// Power that the element dissipates, W.
    pub fn dissipate(&mut self, power: Expr<'g>) {
        let balance = &mut self.balances[self.at];
        balance.dissipated = balance.dissipated + power;
    }

    /// A value whose fall through zero is the event with this name.
    ///
    /// # Panics
    /// Where no effect of the scene declares the event.
    pub fn event(&mut self, name: &str, value: Expr<'g>) {
        self.part("event", &self.scene.layout.events, name);
        self.events.insert(name.to_owned(), value);
    }

    /// What can hold its coordinate at the rate of a counterpart, whose rate and acceleration are
    /// the `reference`.
    ///
    /// # Panics
    /// Where no effect of the scene declares the mode.
    pub fn contact(
        &mut self,
        mode: &str,
        port: &Port<'g>,
        reference: [Expr<'g>; 2],
        hold: Hold<'g>,
    ) {
        let mode = self.part("mode", &self.scene.layout.modes, mode);
        if let Some(&(coordinate, _)) = port.transformers.first() {
            self.contacts.push(Contact {
                element: self.at,
                mode,
                coordinate,
                slip: port.rate - reference[0],
                reference,
                hold,
            });
        }
    }

    /// A quantity worth knowing, in this SI unit.
    pub fn reading(&mut self, name: String, value: Expr<'g>, unit: &'static str, about: String) {
        self.readings.push(Reading {
            name,
            value,
            unit,
            about,
        });
    }

    /// A value that must be positive, tried at the start and over the limits of the joints.
    pub fn stays_positive(&mut self, value: Expr<'g>, what: String, way_out: &'static str) {
        self.conditions.push(Condition {
            element: self.at,
            value,
            what,
            way_out,
        });
    }

    /// A value that one element gives to others: the pressure of a node.
    pub fn share(&mut self, node: &str, what: &'static str, value: Expr<'g>) {
        self.shared.insert((node.to_owned(), what), value);
    }
}
