//! Adds gears with losses between efforts and coordinates.

use super::{EffortSums, LossyGear, Port, load_event};
use crate::declaration::{Element, undeclared};
use crate::expr::Expr;
use crate::format::Key;

impl<'g> EffortSums<'g, '_> {
    /// Returns a gear with losses at a port, with the efficiency of this key and the mode with this name; `None`
    /// without an efficiency.
    ///
    /// # Panics
    /// If the effect does not declare the key, or no effect declares the mode.
    pub fn gear(
        &self,
        element: &Element,
        efficiency: &Key,
        (port, mode): (&Port<'g>, &str),
    ) -> Option<LossyGear<'g>> {
        let efficiency = self.optional(element, efficiency)?;
        let mode = self.mode_at_port(port, mode);
        Some(LossyGear { efficiency, mode })
    }

    /// Adds the events of a gear under an effort at its motor's side, and its contact.
    pub fn load(
        &mut self,
        (element, mode): (&Element, &str),
        gear: LossyGear<'g>,
        port: &Port<'g>,
        effort: Expr<'g>,
    ) {
        let zero = self.b.zero();
        self.event(&load_event(element), effort);
        self.contact(mode, port, [zero, zero], gear.hold(effort));
    }

    /// Adds a gear between a coordinate's drive and the coordinate.
    pub fn gear_of_drive(&mut self, element: &Element, efficiency: &Key) {
        let joint = element.joint();
        let joint = joint.unwrap_or_else(|| undeclared(element, "value of the key", "joint"));
        let (j, port) = (self.coordinate_index(joint), self.coordinate(joint));
        if let Some(gear) = self.gear(element, efficiency, (&port, &element.name)) {
            self.gears.insert(j, gear);
            let lost = (self.own_effort(j) - self.drive(j)) * self.v[j];
            self.dissipate(lost);
            let effort = self.before_the_gear(j);
            self.load((element, &element.name), gear, &port, effort);
        }
    }
}
