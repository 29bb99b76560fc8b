//! The energy account of a run.

use bgdyn_runtime::{Scalar, StateVector};

use crate::coefficient::{Words, decimal, ratio};
use crate::plant::Power;
use crate::real::Of;

/// The energy account of a run, J: for each entry the energy supplied, the increase of stored energy since
/// the start, and the energy dissipated.
#[derive(Clone, Debug, PartialEq)]
pub struct Audit<E> {
    /// Work supplied from outside.
    pub supplied: E,
    /// Increase of stored energy since the start.
    pub stored: E,
    /// Dissipated work.
    pub dissipated: E,
}

impl<E: StateVector> Audit<E> {
    /// Returns the sum supplied − stored − dissipated: the energy error of the integration, in J.
    pub fn drift(&self) -> Of<E> {
        let zero = Of::<E>::from_f64(0.0);
        let sum = |x: &E| x.entries().iter().fold(zero, |sum, &x| sum + x);
        sum(&self.stored) + sum(&self.dissipated) - sum(&self.supplied)
    }
}

/// Sums the work step by step.
#[derive(Clone, Debug)]
pub(crate) struct Ledger<E> {
    /// Energy stored at the start and now; `None` before the first step.
    stored: Option<(E, E)>,
    work: Power<E>,
}

/// Time and weight of the midpoint rule.
const ONE: [(Words, Words); 1] = [(ratio(1.0, 2.0), ratio(1.0, 1.0))];

/// Times and weights of Gauss's quadrature with two points, exact to degree 3.
const TWO: [(Words, Words); 2] = [
    (
        decimal("0.211324865405187117745425609749021"),
        ratio(1.0, 2.0),
    ),
    (
        decimal("0.788675134594812882254574390250979"),
        ratio(1.0, 2.0),
    ),
];

/// Times and weights of Gauss's quadrature with four points, exact to degree 7.
const FOUR: [(Words, Words); 4] = [
    (
        decimal("0.069431844202973712388026755553595"),
        decimal("0.173927422568726928686531974611"),
    ),
    (
        decimal("0.330009478207571867598667120448378"),
        decimal("0.326072577431273071313468025389"),
    ),
    (
        decimal("0.669990521792428132401332879551622"),
        decimal("0.326072577431273071313468025389"),
    ),
    (
        decimal("0.930568155797026287611973244446405"),
        decimal("0.173927422568726928686531974611"),
    ),
];

/// Returns the times within a step at which power is evaluated, and their weights, for an integrator of
/// this order.
pub(crate) fn quadrature(order: u32) -> &'static [(Words, Words)] {
    match order {
        0..=1 => &ONE,
        2..=4 => &TWO,
        _ => &FOUR,
    }
}

impl<E: StateVector> Ledger<E> {
    /// Returns an empty ledger.
    pub(crate) fn new(zero: E) -> Self {
        let work = Power {
            supplied: zero.clone(),
            dissipated: zero,
        };
        Ledger { stored: None, work }
    }

    /// Returns whether a step was recorded.
    pub(crate) fn is_open(&self) -> bool {
        self.stored.is_some()
    }

    /// Records the energy stored now.
    pub(crate) fn note(&mut self, energy: E) {
        self.stored = Some(match self.stored.take() {
            Some((start, _)) => (start, energy),
            None => (energy.clone(), energy),
        });
    }

    /// Adds the work of this power over this time.
    pub(crate) fn add(&mut self, time: Of<E>, power: &Power<E>) {
        self.work.supplied.add(time, &power.supplied);
        self.work.dissipated.add(time, &power.dissipated);
    }

    /// Adds an energy that an entry has dissipated.
    pub(crate) fn lose(&mut self, entry: usize, energy: Of<E>) {
        let lost = &mut self.work.dissipated.entries_mut()[entry];
        *lost = *lost + energy;
    }

    /// Returns the account.
    pub(crate) fn audit(&self) -> Audit<E> {
        let Power {
            supplied,
            dissipated,
        } = self.work.clone();
        let stored = match &self.stored {
            Some((start, now)) => now.plus(-Of::<E>::from_f64(1.0), start),
            None => supplied.zero(),
        };
        Audit {
            supplied,
            stored,
            dissipated,
        }
    }
}
