//! Compares the rounding errors of a forward dynamics in `f64` with bounds.
//!
//! With ε = 2⁻⁵², M and h = bias in double-double, q̈ the exact result and q̈ + δ the computed one:
//! - backward: |M δ|_i ≤ 8 n ε (Σ_j |M_ij||q̈_j| + |τ_i| + |h_i|) for each joint i, or the change of the
//!   joint's effort due to rounding of the arguments, whichever is larger;
//! - forward: ‖δ‖ ≤ (16 + cond M) ε ‖q̈‖ + ε ‖M⁻¹‖‖h‖, or four times the change of q̈ due to rounding of
//!   the arguments, whichever is larger;
//! - round trip: if τ is the rounded effort of chosen accelerations a, the computed accelerations are a to
//!   within 8 n ε ‖M⁻¹‖ (‖M‖‖a‖ + ‖h‖);
//! - digits: ‖δ‖ ≤ 1000 (ε ‖q̈‖ + the change due to rounding of the arguments), so that the condition
//!   number does not excuse losses that the mechanism itself does not cause;
//! - a function must return a result if one exists.
//!
//! Arguments are rounded by half an ε each: the exact result for arguments that round to the same numbers
//! counts as correct, and no digit is lost. `tests/hard_cases` defines its bars in the same way. Without
//! this rule, 37 of 74 forward dynamics (`specs/`, `tests/outside`, eight arms with random bodies) would
//! need more operations, up to 49 % more, 13 % in total.
//!
//! In one state of many thousands every known function exceeds these bounds by a small factor: if several
//! joints are at quarter turns, the sines have errors that no rounding of an angle explains. A function
//! loses digits if it exceeds the bounds in several of the sampled states, or by more than [`LITTLE`].

use bgdyn_runtime::Dd;

use super::reference_solution::{MassAndBias, ReferenceSolution, Rounding, norm, product};
use super::sample_states::{least_inertia, near_singular, random, subsample};
use crate::expr::{Graph, Inputs, Signed, copy_into, evaluate};
use crate::formulation::{Prepared, mass_and_bias, mass_and_bias_of_any_joint};
use crate::function::{Function, in_triangle};

const EPS: f64 = f64::EPSILON;

/// Largest ratio of an error to the effect of rounding the arguments: three digits.
const LOST: f64 = 1e3;

/// Factor on the change of q̈ due to rounding of the arguments: if efforts and bias almost balance, q̈ is
/// known only to within this change.
const BALANCED: f64 = 4.0;

/// Largest ratio by which a function may exceed the bounds in a single state: one bit.
const LITTLE: f64 = 2.0;

/// A function may exceed the bounds in one of this number of states; a function that loses digits does so
/// in more.
const SINGLE: usize = 20;

/// Numbers of sampled states: generic ones, near aligned axes, and those in which a joint moves the least
/// inertia.
const STATES: [usize; 3] = [8, 24, 12];

/// A function is close to the bounds above this ratio: other states than the sampled ones can be worse.
const MARGIN: f64 = 0.5;

/// Largest number of joints for which all of these states are used; for larger mechanisms fewer, in
/// inverse proportion to the square of the number of joints, to which the work per state is proportional.
const ALL: usize = 8;

/// The errors of a function relative to the bounds. The order is by severity.
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
pub(crate) struct BoundReport {
    /// Number of states with an exact result and a failure in `f64`.
    failures: usize,
    /// The largest ratio of error to bound.
    ratio: f64,
    /// The same ratio for bounds without rounding of arguments.
    strict_ratio: f64,
    /// Number of states in which an error exceeds its bound.
    exceeded: usize,
    /// Number of states.
    states: usize,
}

impl BoundReport {
    /// Returns whether every bound is met.
    pub fn holds(&self) -> bool {
        self.failures == 0 && self.ratio <= 1.0
    }

    /// Returns whether no digit is lost: the bounds are exceeded by at most one bit and in single states
    /// only.
    pub fn almost_holds(&self) -> bool {
        self.failures == 0 && self.ratio <= LITTLE && self.exceeded * SINGLE <= self.states
    }

    /// Returns whether the bounds are exceeded by at most one digit.
    pub fn within_a_digit(&self) -> bool {
        self.failures == 0 && self.ratio <= 10.0
    }

    /// Returns whether it is close to the bounds, or exceeds them, without rounding of arguments.
    pub fn is_near(&self) -> bool {
        self.failures > 0 || self.strict_ratio > MARGIN
    }

    /// Returns whether its errors are not larger than those of another function, without rounding of
    /// arguments.
    pub fn is_no_worse_than(&self, other: &Self) -> bool {
        (self.failures, self.strict_ratio) <= (other.failures, other.strict_ratio)
    }

    /// Describes its errors without rounding of arguments, in words.
    pub fn in_strict_words(&self) -> String {
        match self.failures {
            0 => format!("up to {:.1e} times the error allowed", self.strict_ratio),
            _ => self.to_string(),
        }
    }
}

impl std::fmt::Display for BoundReport {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self.failures {
            0 => write!(
                f,
                "up to {:.1e} times the error allowed, in {} of {} states beyond it",
                self.ratio, self.exceeded, self.states
            ),
            n => write!(f, "no answer in {n} states that have one"),
        }
    }
}

/// The sampled states of a mechanism with their reference solutions.
pub(crate) struct ErrorBounds {
    answers: Vec<ReferenceSolution>,
    /// The lower triangle of M, row by row, and h.
    made: Graph,
    outputs: Vec<Signed>,
}

impl ErrorBounds {
    /// Returns sampled states of the mechanism, with their reference solutions.
    pub fn new(prepared: &Prepared<'_>) -> Self {
        let graph = prepared.graph;
        let n = graph.coordinates.len();
        let few = |most: usize| (most * ALL * ALL / n.max(ALL).pow(2)).max(2);
        let mut states = subsample(&random(graph), few(STATES[0]));
        if !graph.plain() {
            // Aligned axes are known for rotations and translations only.
            let (made, outputs) = mass_and_bias_of_any_joint(graph);
            return Self::solved(made, outputs, states, n);
        }
        let (made, outputs) = mass_and_bias(graph, prepared.geometry());
        states.extend(subsample(&near_singular(graph), few(STATES[1])));
        let moved = |i: usize| {
            let mut own = Graph::default();
            let diagonal = [outputs[in_triangle(i, i)]];
            let diagonal = copy_into(&mut own, &made, &diagonal, |_, _| None);
            move |state: &Inputs<f64>| evaluate(&own, &diagonal, state, &mut None)[0]
        };
        states.extend(least_inertia(graph, few(STATES[2]), moved));
        Self::solved(made, outputs, states, n)
    }

    /// Returns these states with their reference solutions; `made` and `outputs` are M and h.
    fn solved(made: Graph, outputs: Vec<Signed>, states: Vec<Inputs<f64>>, n: usize) -> Self {
        let states = states.into_iter().enumerate();
        let terms = |inputs: &Inputs<Dd>| {
            MassAndBias::new(&evaluate(&made, &outputs, inputs, &mut None), n)
        };
        let answers =
            states.filter_map(|(i, state)| ReferenceSolution::new(state, terms, i % 2 == 1));
        ErrorBounds {
            answers: answers.collect(),
            made,
            outputs,
        }
    }

    /// Compares the errors of a function with the bounds.
    pub fn measure(&self, function: &Function) -> BoundReport {
        let mut all = BoundReport::default();
        for answer in &self.answers {
            all.states += 1;
            match function.evaluate(answer.inputs.clone()) {
                (_, Some(_)) => all.failures += 1,
                (found, None) => {
                    let (strict, ratio) = self.error_ratio(answer, &found);
                    all.strict_ratio = all.strict_ratio.max(strict);
                    all.ratio = all.ratio.max(ratio);
                    all.exceeded += usize::from(ratio > 1.0);
                }
            }
        }
        all
    }

    /// Returns the largest ratio of error to bound: without rounding of arguments, and with it.
    fn error_ratio(&self, answer: &ReferenceSolution, found: &[f64]) -> (f64, f64) {
        if found.iter().any(|x| !x.is_finite()) {
            return (f64::INFINITY, f64::INFINITY);
        }
        let found: Vec<Dd> = found.iter().map(|&x| Dd::from_f64(x)).collect();
        let off = found.iter().zip(&answer.exact);
        let off: Vec<Dd> = off.map(|(&x, &y)| x - y).collect();
        let unrounded = Rounding {
            efforts: vec![0.0; off.len()],
            accelerations: 0.0,
        };
        // Rounding of arguments only increases the bounds, so it is computed only if that decides.
        let strict = error_ratio(answer, &off, &found, &unrounded);
        let strict = strict.max(digits(answer, &off, 0.0));
        if strict <= MARGIN {
            return (strict, strict);
        }
        let n = off.len();
        let terms = |inputs: &Inputs<Dd>| {
            let values = evaluate(&self.made, &self.outputs, inputs, &mut None);
            MassAndBias::new(&values, n)
        };
        let rounding = answer.rounding(terms);
        let lost = digits(answer, &off, rounding.accelerations);
        let [strict, read] = [&unrounded, rounding].map(|r| error_ratio(answer, &off, &found, r));
        (strict.max(lost), read.max(lost))
    }
}

/// Returns the largest ratio of error to bound with this rounding, without the bound on digits.
fn error_ratio(answer: &ReferenceSolution, off: &[Dd], found: &[Dd], rounding: &Rounding) -> f64 {
    let round_trip = if answer.round_trip {
        round_trip(answer, found)
    } else {
        0.0
    };
    backward(answer, off, &rounding.efforts)
        .max(forward(answer, off, rounding.accelerations))
        .max(round_trip)
}

fn backward(answer: &ReferenceSolution, off: &[Dd], rounding: &[f64]) -> f64 {
    let unmet = product(&answer.mass, off);
    let row = |i: usize| {
        let terms = answer.mass[i].iter().zip(&answer.exact);
        let terms: f64 = terms.map(|(m, x)| (m.to_f64() * x.to_f64()).abs()).sum();
        let size = terms + answer.inputs.u[i].abs() + answer.bias[i].abs();
        let allowed = 8.0 * off.len() as f64 * EPS * size;
        quotient(unmet[i].to_f64().abs(), allowed.max(rounding[i]))
    };
    (0..off.len()).map(row).fold(0.0, f64::max)
}

fn forward(answer: &ReferenceSolution, off: &[Dd], rounding: f64) -> f64 {
    let moving = norm(answer.exact.iter().map(|x| x.to_f64()));
    let cond = answer.most * answer.inverse;
    let held = norm(answer.bias.iter().copied());
    let allowed = EPS * ((16.0 + cond) * moving + answer.inverse * held);
    quotient(
        norm(off.iter().map(|x| x.to_f64())),
        allowed.max(BALANCED * rounding),
    )
}

fn digits(answer: &ReferenceSolution, off: &[Dd], rounding: f64) -> f64 {
    let moving = norm(answer.exact.iter().map(|x| x.to_f64()));
    let allowed = LOST * (EPS * moving + rounding);
    quotient(norm(off.iter().map(|x| x.to_f64())), allowed)
}

fn round_trip(answer: &ReferenceSolution, found: &[Dd]) -> f64 {
    let chosen = &answer.inputs.a;
    let off = found.iter().zip(chosen);
    let off = norm(off.map(|(&x, &a)| (x - Dd::from_f64(a)).to_f64()));
    let moved = answer.most * norm(chosen.iter().copied()) + norm(answer.bias.iter().copied());
    quotient(off, 8.0 * found.len() as f64 * EPS * answer.inverse * moved)
}

fn quotient(off: f64, allowed: f64) -> f64 {
    if off == 0.0 { 0.0 } else { off / allowed }
}
