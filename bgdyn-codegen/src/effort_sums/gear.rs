//! Losses of a gear, in proportion to its load.
//!
//! Of an effort τ at the motor's side η τ arrives at the joint where the effort drives it, τ/η where
//! the joint drives the motor. Which of the two is a matter of the direction of motion: at rest the
//! gear holds, as dry friction does, with whatever effort lies between the two.

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
    /// What arrives of an effort at the joint: all of it at rest.
    pub fn behind(self, b: &'g Builder, effort: Expr<'g>) -> Expr<'g> {
        let driving = self.choose(b, effort, effort * self.efficiency);
        (effort * self.mode).if_less(b.zero(), effort / self.efficiency, driving)
    }

    /// The effort of which this arrives.
    pub fn before(self, b: &'g Builder, effort: Expr<'g>) -> Expr<'g> {
        let driving = self.choose(b, effort, effort / self.efficiency);
        (effort * self.mode).if_less(b.zero(), effort * self.efficiency, driving)
    }

    /// `rest` where the gear holds the joint, else `moving`.
    fn choose(self, b: &'g Builder, rest: Expr<'g>, moving: Expr<'g>) -> Expr<'g> {
        self.mode.abs().if_less(b.number(0.5), rest, moving)
    }

    /// The efforts that the gear can hold with besides the one it passes on.
    pub(super) fn hold(self, effort: Expr<'g>) -> Hold<'g> {
        let [less, more] = [effort * self.efficiency, effort / self.efficiency].map(|e| e - effort);
        Hold::Between([less.min(more), less.max(more)])
    }
}

/// The name of the event of the load's change of sign.
pub fn load_event(element: &Element) -> String {
    format!("{}_load", element.name)
}
