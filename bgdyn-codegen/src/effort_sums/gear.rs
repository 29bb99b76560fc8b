//! The losses of a gear, proportional to its load.
//!
//! For an effort τ at the motor's side, the joint receives η τ if the effort drives it, and τ/η if the
//! joint drives the motor. The direction of motion decides. At rest the gear holds, as dry friction does,
//! with any effort between the two.

use super::parts::Hold;
use crate::declaration::Element;
use crate::expr::{Builder, Expr};

/// A gear with losses.
#[derive(Clone, Copy, Debug)]
pub struct LossyGear<'g> {
    /// η
    pub efficiency: Expr<'g>,
    /// The sign of the joint's rate; 0 where the gear holds it.
    pub mode: Expr<'g>,
}

impl<'g> LossyGear<'g> {
    /// Returns the effort at the joint of an effort at the motor's side; at rest they are equal.
    pub fn behind(self, b: &'g Builder, effort: Expr<'g>) -> Expr<'g> {
        let driving = self.choose(b, effort, effort * self.efficiency);
        (effort * self.mode).if_less(b.zero(), effort / self.efficiency, driving)
    }

    /// Returns the effort at the motor's side of an effort at the joint.
    pub fn before(self, b: &'g Builder, effort: Expr<'g>) -> Expr<'g> {
        let driving = self.choose(b, effort, effort / self.efficiency);
        (effort * self.mode).if_less(b.zero(), effort * self.efficiency, driving)
    }

    /// Returns `rest` if the gear holds the joint, else `moving`.
    fn choose(self, b: &'g Builder, rest: Expr<'g>, moving: Expr<'g>) -> Expr<'g> {
        self.mode.abs().if_less(b.number(0.5), rest, moving)
    }

    /// Returns the efforts with which the gear can hold, besides the effort that it transmits.
    pub(super) fn hold(self, effort: Expr<'g>) -> Hold<'g> {
        let [less, more] = [effort * self.efficiency, effort / self.efficiency].map(|e| e - effort);
        Hold::Between([less.min(more), less.max(more)])
    }
}

/// Returns the name of the event at which the load changes sign.
pub fn load_event(element: &Element) -> String {
    format!("{}_load", element.name)
}
