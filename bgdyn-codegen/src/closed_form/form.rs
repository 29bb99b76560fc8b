//! The data of printed equations: sums of products.

use bgdyn_runtime::Dd;

use super::polynomial::Angle;
use crate::mechanism::{Motion, NumberSymbol};

/// P_j(q, q̇, q̈) of a mechanism in closed form.
#[derive(Clone, Debug)]
pub struct ClosedForm {
    /// The mechanism's name.
    pub name: String,
    /// The joints of the coordinates with their motions, in the order of q.
    pub joints: Vec<(String, Motion)>,
    /// The links, whose indices number the letters.
    pub links: Vec<String>,
    /// The letters of the equations.
    pub letters: Vec<NumberSymbol>,
    /// Sums of letters that have a name of their own: a₁, a₂, …
    pub constants: Vec<NamedSum>,
    /// P_j: terms with accelerations, then with velocities, then without either; N·m or N.
    pub efforts: Vec<Sum>,
}

/// A long sum of products of letters that occurs often and therefore has a name.
#[derive(Clone, Debug)]
pub struct NamedSum {
    /// The sum.
    pub definition: Sum,
    /// Its value for the letters' values, SI units.
    pub value: Dd,
    /// Its powers of kilogram, metre and second.
    pub dimension: [i32; 3],
}

/// Terms; none is zero.
pub type Sum = Vec<Term>;

/// A product with a sign; the product of no factors is 1.
#[derive(Clone, Debug, PartialEq)]
pub struct Term {
    /// Whether it is subtracted.
    pub negative: bool,
    /// The factors in printed order.
    pub factors: Vec<Factor>,
}

/// A factor.
#[derive(Clone, Debug, PartialEq)]
pub enum Factor {
    /// A positive number.
    Number(Dd),
    /// A power.
    Power(Atom, u32),
    /// A sum in parentheses.
    Sum(Sum),
    /// The square of a sum.
    Square(Sum),
}

/// A factor with a symbol of its own.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Atom {
    /// One of [`ClosedForm::letters`].
    Letter(usize),
    /// One of [`ClosedForm::constants`].
    Constant(usize),
    /// q_j
    Position(usize),
    /// The cosine of Σ n_j q_j.
    Cosine(Angle),
    /// The sine of Σ n_j q_j.
    Sine(Angle),
    /// q̇_j
    Velocity(usize),
    /// q̈_j
    Acceleration(usize),
}

impl ClosedForm {
    /// Removes the component index of a letter if no other component of its vector occurs in the
    /// equations.
    pub(super) fn name_alone(mut self) -> Self {
        let met = self.letters_met();
        for &l in &met {
            let letter = &self.letters[l];
            let beside = |&k: &usize| {
                let other = &self.letters[k];
                k != l && other.symbol == letter.symbol && other.of == letter.of
            };
            if matches!(letter.symbol.as_str(), "c" | "l") && !met.iter().any(beside) {
                self.letters[l].component = "";
            }
        }
        self
    }

    /// Returns the letters that occur in the efforts or in a named sum.
    pub fn letters_met(&self) -> Vec<usize> {
        let mut met = Vec::new();
        let sums = self.constants.iter().map(|c| &c.definition);
        for sum in self.efforts.iter().chain(sums) {
            gather(sum, &mut met);
        }
        met.sort_unstable();
        met.dedup();
        met
    }
}

fn gather(sum: &Sum, met: &mut Vec<usize>) {
    for factor in sum.iter().flat_map(|term| &term.factors) {
        match factor {
            Factor::Power(Atom::Letter(letter), _) => met.push(*letter),
            Factor::Sum(sum) | Factor::Square(sum) => gather(sum, met),
            _ => {}
        }
    }
}
