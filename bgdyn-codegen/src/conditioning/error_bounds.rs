//! Bounds for the rounding error of a forward dynamics, and its errors in `f64` compared with them.
//!
//! With ε = 2⁻⁵², M and h = bias in double-double, q̈ the exact answer and q̈ + δ the one found:
//! - backward: |M δ|_i ≤ 8 n ε (Σ_j |M_ij||q̈_j| + |τ_i| + |h_i|) for each joint i, or what the
//!   joint's effort changes by where the arguments are rounded, whichever is more;
//! - forward: ‖δ‖ ≤ (16 + cond M) ε ‖q̈‖ + ε ‖M⁻¹‖‖h‖, or four times what q̈ changes by where they are,
//!   whichever is more;
//! - round trip: where τ is the rounded effort of chosen accelerations a, they come back to within
//!   8 n ε ‖M⁻¹‖ (‖M‖‖a‖ + ‖h‖);
//! - digits: ‖δ‖ ≤ 1000 (ε ‖q̈‖ + what rounding the arguments costs), so that what cond M excuses
//!   is not lost where the mechanism itself does not lose it;
//! - what has an answer gets one.
//!
//! Arguments are rounded by half an ε each: what is the exact answer for arguments that round to the
//! same numbers is right, and no digit is lost. `tests/hard_cases` reads its bars the same way. Without
//! that, 37 of 74 forward dynamics (`specs/`, `tests/outside`, eight arms with random bodies) would take
//! more operations, up to 49 % more, 13 % in all.
//!
//! In a state of many thousands every way there is goes beyond this by a factor of a few: where several
//! joints are at quarter turns, sines lose what no rounding of an angle makes up for. Digits are lost
//! where a way goes beyond it in several of the states tried, or by [`LITTLE`].

use bgdyn_runtime::Dd;

use super::reference_solution::{MassAndBias, ReferenceSolution, Rounding, norm, product};
use super::sample_states::{least_inertia, near_singular, random, subsample};
use crate::bond_graph::BondGraph;
use crate::expr::{Graph, Inputs, Signed, copy_into, evaluate};
use crate::formulation::geometry::Geometry;
use crate::formulation::mass_and_bias;
use crate::function::{Function, in_triangle};

const EPS: f64 = f64::EPSILON;

/// How much larger than what rounding its arguments costs an error may be: three digits.
const LOST: f64 = 1e3;

/// How often what rounding the arguments changes q̈ by its error may be: where efforts and bias all but
/// balance, that is all there is of q̈.
const BALANCED: f64 = 4.0;

/// How far beyond the bars the same mechanism may be in another state, or by another way that keeps as
/// many digits: one bit.
const LITTLE: f64 = 2.0;

/// Of how many states one may be beyond the bars: a mechanism that loses digits loses them in more.
const SINGLE: usize = 20;

/// States tried: generic ones, near aligned axes, and those in which a joint moves least.
const STATES: [usize; 3] = [8, 24, 12];

/// How near to the bounds is near: the states tried are not all there are.
const MARGIN: f64 = 0.5;

/// Joints up to which all of these are tried; of larger mechanisms fewer, in proportion to the
/// square of their number, to which the work for each grows.
const ALL: usize = 8;

/// How a function stands to the bars. The order is that of harm.
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
pub(crate) struct BoundReport {
    /// States that have an answer, and none in `f64`.
    failures: usize,
    /// The largest error over what is allowed.
    ratio: f64,
    /// The same by bars that round no argument.
    strict_ratio: f64,
    /// States in which an error is larger than what is allowed.
    exceeded: usize,
    /// States tried.
    states: usize,
}

impl BoundReport {
    /// Whether every bar is met.
    pub fn holds(&self) -> bool {
        self.failures == 0 && self.ratio <= 1.0
    }

    /// Whether it loses no digit: hardly beyond them, and that in single states only.
    pub fn almost_holds(&self) -> bool {
        self.failures == 0 && self.ratio <= LITTLE && self.exceeded * SINGLE <= self.states
    }

    /// Whether it is at most a digit beyond them.
    pub fn within_a_digit(&self) -> bool {
        self.failures == 0 && self.ratio <= 10.0
    }

    /// Whether it comes near the bounds, or exceeds them, where no argument is rounded.
    pub fn is_near(&self) -> bool {
        self.failures > 0 || self.strict_ratio > MARGIN
    }

    /// Whether its errors are not larger than those of another function, no argument rounded.
    pub fn is_no_worse_than(&self, other: &Self) -> bool {
        (self.failures, self.strict_ratio) <= (other.failures, other.strict_ratio)
    }

    /// Its errors where no argument is rounded, in words.
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

/// The states of a mechanism with their answers.
pub(crate) struct ErrorBounds {
    answers: Vec<ReferenceSolution>,
    /// The lower triangle of M, row by row, and h.
    made: Graph,
    outputs: Vec<Signed>,
}

impl ErrorBounds {
    /// States of the mechanism, with their answers.
    pub fn new(graph: &BondGraph, geometry: &Geometry) -> Self {
        let n = geometry.bodies.len();
        let (made, outputs) = mass_and_bias(graph, geometry);
        let few = |most: usize| (most * ALL * ALL / n.max(ALL).pow(2)).max(2);
        let mut states = subsample(&random(graph), few(STATES[0]));
        states.extend(subsample(&near_singular(graph), few(STATES[1])));
        let moved = |i: usize| {
            let mut own = Graph::default();
            let diagonal = [outputs[in_triangle(i, i)]];
            let diagonal = copy_into(&mut own, &made, &diagonal, |_, _| None);
            move |state: &Inputs<f64>| evaluate(&own, &diagonal, state, &mut None)[0]
        };
        states.extend(least_inertia(graph, few(STATES[2]), moved));
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

    /// The errors of a function, compared with the bounds.
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

    /// The largest error of what was found, over what is allowed: where no argument is rounded, and as it
    /// counts.
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
        // What rounding changes can only allow more: it is worked out where that decides.
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

/// The largest error of what was found, over what is allowed with this rounding; digits apart.
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
