//! What comes of a case.

use std::fmt;

/// How far a quantity is from its reference, beside what is allowed: at the instant where the first is
/// the largest part of the second.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// The case, by the name of its file in `tests/hard_cases`.
    pub case: &'static str,
    /// What is compared, and how it was integrated.
    pub quantity: &'static str,
    /// Largest deviation from the reference, absolute or relative as the quantity says.
    pub measured: f64,
    /// The deviation that is allowed.
    pub allowed: f64,
    /// When that was, s.
    pub at: f64,
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
    /// The worst of the deviations, one that is no number before all others.
    ///
    /// # Panics
    /// Where there is no deviation: nothing was compared.
    pub(crate) fn worst(
        case: &'static str,
        quantity: &'static str,
        deviations: impl IntoIterator<Item = Deviation>,
    ) -> Outcome {
        let part = |d: &Deviation| (d.measured / d.allowed).abs();
        let worst = deviations
            .into_iter()
            .max_by(|a, b| part(a).total_cmp(&part(b)))
            .expect("something to compare");
        Outcome {
            case,
            quantity,
            measured: worst.measured,
            allowed: worst.allowed,
            at: worst.t,
        }
    }

    /// Whether the deviation is within what is allowed.
    pub fn met(&self) -> bool {
        self.measured <= self.allowed
    }
}

/// A line of a table.
impl fmt::Display for Outcome {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let verdict = if self.met() { "met" } else { "missed" };
        write!(
            f,
            "{:<24} {:<46} {:>8.1e} {:>8.1e} at {:>7.3} s  {verdict}",
            self.case, self.quantity, self.measured, self.allowed, self.at
        )
    }
}
