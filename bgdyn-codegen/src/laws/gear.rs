//! Losses of a gear, in proportion to its load.
//!
//! Of an effort τ at the motor's side η τ arrives at the joint where the effort drives it, τ/η where
//! the joint drives the motor. Which of the two is a matter of the direction of motion: at rest the
//! gear holds, as dry friction does, with whatever effort lies between the two.

use super::{Hold, Laws, Port};
use crate::declaration::Element;
use crate::expr::{Builder, Ex};
use crate::spec::Key;

/// A gear with losses.
#[derive(Clone, Copy, Debug)]
pub struct Gear<'g> {
    /// η
    pub efficiency: Ex<'g>,
    /// The sign of the joint's rate; 0 where the gear holds it.
    pub mode: Ex<'g>,
}

impl<'g> Gear<'g> {
    /// What arrives of an effort at the joint: all of it at rest.
    pub fn behind(self, b: &'g Builder, effort: Ex<'g>) -> Ex<'g> {
        let driving = self.choose(b, effort, effort * self.efficiency);
        (effort * self.mode).if_less(b.zero(), effort / self.efficiency, driving)
    }

    /// The effort of which this arrives.
    pub fn before(self, b: &'g Builder, effort: Ex<'g>) -> Ex<'g> {
        let driving = self.choose(b, effort, effort / self.efficiency);
        (effort * self.mode).if_less(b.zero(), effort * self.efficiency, driving)
    }

    /// `rest` where the gear holds the joint, else `moving`.
    fn choose(self, b: &'g Builder, rest: Ex<'g>, moving: Ex<'g>) -> Ex<'g> {
        self.mode.abs().if_less(b.number(0.5), rest, moving)
    }

    /// The efforts that the gear can hold with besides the one it passes on.
    fn hold(self, effort: Ex<'g>) -> Hold<'g> {
        let [less, more] = [effort * self.efficiency, effort / self.efficiency].map(|e| e - effort);
        Hold::Between([less.min(more), less.max(more)])
    }
}

/// The name of the event of the load's change of sign.
pub fn load_event(element: &Element) -> String {
    format!("{}_load", element.name)
}

impl<'g> Laws<'g, '_> {
    /// A gear with losses, whose efficiency is the number behind this key and whose mode has this
    /// name; `None` where no efficiency is given.
    ///
    /// # Panics
    /// Where the effect declares no such key, or no effect such a mode.
    pub fn gear(&self, element: &Element, efficiency: &Key, mode: &str) -> Option<Gear<'g>> {
        let efficiency = self.optional(element, efficiency)?;
        let mode = self.mode(mode);
        Some(Gear { efficiency, mode })
    }

    /// The events of a gear under an effort at its motor's side, and what it can hold.
    pub fn load(
        &mut self,
        (element, mode): (&Element, &str),
        gear: Gear<'g>,
        port: &Port<'g>,
        effort: Ex<'g>,
    ) {
        let zero = self.b.zero();
        self.event(&load_event(element), effort);
        self.contact(mode, port, [zero, zero], gear.hold(effort));
    }

    /// A gear between a coordinate's own effort and the coordinate.
    pub fn gear_of_drive(&mut self, element: &Element, efficiency: &Key) {
        let joint = element.name("joint").unwrap_or_default();
        let found = self.scene.layout.coordinate_named(joint);
        if let (Some(j), Some(gear)) = (found, self.gear(element, efficiency, &element.name)) {
            self.gears.insert(j, gear);
            let lost = (self.own_effort(j) - self.drive(j)) * self.v[j];
            self.dissipate(lost);
            let port = self.coordinate(joint);
            let effort = self.before_the_gear(j);
            self.load((element, &element.name), gear, &port, effort);
        }
    }
}
