//! What comes of a case.

use std::fmt;

use crate::bars::{Found, part};

/// What was measured of a case, beside what is allowed.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// The case: the name of a file in this folder, or what it is.
    pub case: String,
    /// The number of the bar, as `docs/hard_cases.md` lists them.
    pub bar: &'static str,
    /// What is measured, and how.
    pub quantity: String,
    /// The measured value, where it is the largest part of what is allowed.
    pub measured: f64,
    /// What is allowed, as the bar is read.
    pub allowed: f64,
    /// The most of the bar as asked that is used anywhere. Where the bar is read as asked, that is the
    /// measured part of what is allowed.
    pub asked: f64,
    /// Where that was: a time, a state. May be empty.
    pub at: String,
}

/// A deviation at an instant.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Deviation {
    /// Time, s.
    pub t: f64,
    /// How far apart the two are.
    pub measured: f64,
    /// How far they may be.
    pub allowed: f64,
}

impl Outcome {
    /// A value and what it may be at most.
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

    /// The same with where it was.
    pub(crate) fn at(self, at: impl Into<String>) -> Outcome {
        let at = at.into();
        Outcome { at, ..self }
    }

    /// The worst of the deviations, one that is no number before all others.
    ///
    /// # Panics
    /// Where there is no deviation: nothing was compared.
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

    /// What is measured in units of what is allowed; what is no number is more than anything.
    fn part(&self) -> f64 {
        part(self.measured, self.allowed)
    }

    /// Whether what is measured is within what is allowed.
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
    /// Takes what was found in a state; `mark` stands behind what is measured.
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

    /// By bar.
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
