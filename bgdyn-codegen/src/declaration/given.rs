//! Checks of an element's numbers: signs, order, missing keys.

use bgdyn_runtime::Dd;

use super::{Quantity, ValueCheck};
use crate::fault::{Fault, Help, Location, wording};
use crate::format::Key;

impl ValueCheck<'_> {
    /// Returns the number of a key.
    pub fn number(&self, key: &Key) -> Option<&Quantity> {
        self.element.quantity(key)
    }

    /// Returns its value, or a default.
    pub fn value_or(&self, key: &Key, default: f64) -> f64 {
        self.number(key).map_or(default, |q| q.value.to_f64())
    }

    /// Returns the location of a key's value, or of the element if the key is missing.
    pub fn location(&self, key: &Key) -> Location {
        self.number(key)
            .map_or_else(|| self.element.location.clone(), |q| q.location.clone())
    }

    /// Reports numbers of these keys that are negative.
    pub fn not_negative(&mut self, keys: &[Key], why: Help) {
        for key in keys {
            if let Some(q) = self.number(key).filter(|q| q.value < Dd::ZERO) {
                let fault = wording::negative_value(&q.location, key.name, &q.text, why);
                self.report(fault);
            }
        }
    }

    /// Reports numbers of these keys that are not greater than zero.
    pub fn positive(&mut self, keys: &[Key], why: Help) {
        for key in keys {
            if let Some(q) = self.number(key).filter(|q| q.value <= Dd::ZERO) {
                let fault = wording::value_not_positive(&q.location, key.name, &q.text, why);
                self.report(fault);
            }
        }
    }

    /// Reports a number of this key that is greater than 1.
    pub fn at_most_one(&mut self, key: &Key, why: Help) {
        if let Some(q) = self.number(key).filter(|q| q.value > Dd::ONE) {
            let fault = wording::value_above_one(&q.location, key.name, &q.text, why);
            self.report(fault);
        }
    }

    /// Reports numbers of these keys that are run-time parameters.
    pub fn fixed(&mut self, keys: &[Key]) {
        for key in keys {
            if let Some(q) = self.number(key).filter(|q| q.parameter.is_some()) {
                let kind = self.element.effect.keyword();
                let fault = wording::value_cannot_be_parameter(&q.location, key.name, kind);
                self.report(fault);
            }
        }
    }

    /// Reports a first number that is greater than the second.
    pub fn ordered(&mut self, small: &Key, large: &Key, why: Help) {
        if let (Some(a), Some(b)) = (self.number(small), self.number(large))
            && a.value > b.value
        {
            let (smaller, larger) = ((small.name, a.text.as_str()), (large.name, b.text.as_str()));
            let fault = wording::values_out_of_order(&b.location, smaller, larger, why);
            self.report(fault);
        }
    }

    /// Reports if not exactly one of these keys is present.
    pub fn one_of(&mut self, keys: &[Key]) {
        let given = keys.iter().filter(|key| self.element.has(key));
        let given: Vec<&str> = given.map(|key| key.name).collect();
        if given.len() != 1 {
            let element = self.element;
            self.report(wording::not_one_port(
                &element.location,
                &element.name,
                &given,
                &keys.iter().map(|key| key.name).collect::<Vec<_>>(),
            ));
        }
    }

    /// Records an error.
    pub fn report(&mut self, fault: Fault) {
        self.faults.push(fault);
    }
}
