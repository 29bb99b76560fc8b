//! The result of a case.

use std::fmt;

use crate::bars::{Found, part};

/// A measured error, with its limit.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// The case: the name of a file in this folder, or a description.
    pub case: String,
    /// The number of the bar in `docs/hard_cases.md`.
    pub bar: &'static str,
    /// The measured quantity, and the integrator or scalar.
    pub quantity: String,
    /// The measured value with the largest ratio to its limit.
    pub measured: f64,
    /// Its limit, by the applied reading of the bar.
    pub allowed: f64,
    /// The largest ratio to the bar by its original reading. If both readings are equal, that is the
    /// measured value over its limit.
    pub asked: f64,
    /// The time or state. May be empty.
    pub at: String,
}

/// A deviation at an instant.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Deviation {
    /// Time, s.
    pub t: f64,
    /// The distance of the two values.
    pub measured: f64,
    /// Its limit.
    pub allowed: f64,
}

impl Outcome {
    /// Returns a value and its limit.
    pub(crate) fn new(
        case: impl Into<String>,
        bar: &'static str,
        quantity: impl Into<String>,
        measured: f64,
        allowed: f64,
    ) -> Outcome {
        Outcome {
            case: case.into(),
            bar,
            quantity: quantity.into(),
            measured,
            allowed,
            asked: part(measured, allowed),
            at: String::new(),
        }
    }

    /// Adds the time or state.
    pub(crate) fn at(self, at: impl Into<String>) -> Outcome {
        let at = at.into();
        Outcome { at, ..self }
    }

    /// Returns the worst of the deviations; a NaN is worse than all others.
    ///
    /// # Panics
    /// If there is no deviation: nothing was compared.
    pub(crate) fn worst(
        case: &str,
        bar: &'static str,
        quantity: &str,
        deviations: impl IntoIterator<Item = Deviation>,
    ) -> Outcome {
        let of = |d: Deviation| {
            let outcome = Outcome::new(case, bar, quantity, d.measured, d.allowed);
            outcome.at(format!("t = {} s", d.t))
        };
        let outcomes = deviations.into_iter().map(of);
        let worst = outcomes.max_by(|a, b| a.part().total_cmp(&b.part()));
        worst.expect("something to compare")
    }

    /// Returns the ratio of the measured value to its limit; a NaN is larger than all others.
    fn part(&self) -> f64 {
        part(self.measured, self.allowed)
    }

    /// Returns whether the measured value is within its limit.
    pub fn met(&self) -> bool {
        self.measured <= self.allowed
    }
}

/// The worst of many states, bar by bar.
#[derive(Default)]
pub(crate) struct Worst {
    outcomes: Vec<Outcome>,
}

impl Worst {
    /// Adds the results of a state; `mark` is a suffix of the quantity.
    pub fn add(&mut self, case: &str, mark: &str, at: &str, found: Vec<Found>) {
        for found in found {
            let quantity = format!("{}{mark}", found.what);
            let mut new = Outcome::new(case, found.bar, quantity, found.measured, found.allowed);
            new.asked = found.asked;
            let new = new.at(at);
            let same = |o: &&mut Outcome| o.bar == new.bar && o.quantity == new.quantity;
            match self.outcomes.iter_mut().find(same) {
                Some(old) => {
                    let asked = old.asked.max(new.asked);
                    if old.part().total_cmp(&new.part()).is_lt() {
                        *old = new;
                    }
                    old.asked = asked;
                }
                None => self.outcomes.push(new),
            }
        }
    }

    /// Returns the outcomes by bar.
    pub fn finish(mut self) -> Vec<Outcome> {
        self.outcomes
            .sort_by_key(|o| (o.quantity.contains("f32"), o.bar));
        self.outcomes
    }
}

/// A line of a table.
impl fmt::Display for Outcome {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let verdict = if self.met() { "pass" } else { "FAIL" };
        write!(
            f,
            "{:<28} {:>3}  {:<48} {:>8.1e} {:>8.1e} {:>8.1e}  {verdict}",
            self.case, self.bar, self.quantity, self.measured, self.allowed, self.asked
        )?;
        match self.met() || self.at.is_empty() {
            true => Ok(()),
            false => write!(f, "  at {}", self.at),
        }
    }
}
