//! Sorts candidates by cost among those that keep their digits, as far as `conditioning/` can tell.
//!
//! 1. Each is measured in sampled states (`conditioning/sample_states.rs`): generic ones, fast ones, large
//!    efforts, and states with neighbouring common normals in line or across. `reference_solution.rs` solves
//!    M q̈ = τ − h there in double-double, and `error_bounds.rs` compares the errors in `f64` with bounds:
//!    backward error joint by joint, forward error by the condition number, the round trip through the
//!    efforts, and at most three digits lost beyond what rounding the arguments costs. The exact answer for
//!    arguments that round to the same numbers counts as right.
//! 2. The cheapest candidate that meets the bounds wins; if none does, the nearest one. A candidate that
//!    exceeds them by less than a bit, in at most one state of twenty, loses no digit in this sense: it wins
//!    unless another one costs at most 5 % more.
//! 3. A function is measured again after factoring. If it then comes near the bounds or exceeds them, its
//!    operations keep their order. Of 74 functions (`specs/`, `tests/outside`, eight arms with random bodies)
//!    that costs seven up to 4.8 % (`crane`: 173 operations for 165), 0.25 % in all.
//!
//! The condition number is no bound where the efforts almost balance the bias: rounding one argument then
//! moves q̈ by more. `tests/common/bars.rs` measures that before it allows anything.

use std::cmp::Ordering;

use crate::conditioning::error_bounds::{BoundReport, ErrorBounds};
use crate::formulation::{Candidate, Candidates};
use crate::function::Function;
use crate::passes::factor;

/// What may be paid, in units of the cheapest function's cost, where that loses no digit.
const PRICE: f64 = 1.05;

/// A candidate, and its errors compared with the bounds.
pub(super) type CheckedCandidate = (BoundReport, Candidate);

/// A function with its errors: factored, unless that brings it near the bounds, or beyond, and nearer
/// than it was. As factoring saves little, that is judged without rounding any argument; but where no digit
/// is lost, no more is paid than [`PRICE`].
pub(super) fn check(bounds: &ErrorBounds, plain: Function) -> CheckedCandidate {
    let (report, generated) = factor_with_care(bounds, &plain);
    (report, Candidate { plain, generated })
}

fn factor_with_care(bounds: &ErrorBounds, plain: &Function) -> (BoundReport, Function) {
    let before = bounds.measure(plain);
    if plain.ordered {
        return (before, plain.clone());
    }
    let factored = factor(plain.clone());
    let after = bounds.measure(&factored);
    let dear = cost(plain) > PRICE * cost(&factored);
    if after.is_no_worse_than(&before) || !after.is_near() || (dear && after.almost_holds()) {
        return (after, factored);
    }
    let mut kept = plain.clone();
    let to = after.in_strict_words();
    kept.formulation += &format!("; not factored, which would take it {to}");
    (before, kept)
}

/// What a function costs, as functions are compared.
fn cost(function: &Function) -> f64 {
    function.cost().weighted() as f64
}

/// Sorts functions for one method: accepted are those that meet the bounds, the cheapest first; where
/// there are none, the one that comes nearest. But where one that costs less loses no digit, and they cost
/// more than [`PRICE`] times as much, that one. Each says what is wrong with those that exceed them.
pub(super) fn sort(mut tried: Vec<CheckedCandidate>) -> Candidates {
    tried.sort_by_key(|(_, candidate)| candidate.generated.cost().weighted());
    let wrong: String = tried
        .iter()
        .filter(|(report, _)| !report.holds())
        .map(|(report, candidate)| {
            let name = candidate.plain.formulation.split(':').next();
            format!("; {}: {report}", name.unwrap_or_default())
        })
        .collect();
    let (mut accepted, mut borderline): (Vec<CheckedCandidate>, Vec<CheckedCandidate>) =
        tried.into_iter().partition(|(report, _)| report.holds());
    if let Some(k) = spared(&accepted, &borderline) {
        let (report, mut candidate) = borderline.remove(k);
        candidate.generated.formulation += "; no digit is lost";
        accepted.insert(0, (report, candidate));
    }
    if accepted.is_empty() {
        borderline.sort_by(|(x, _), (y, _)| x.partial_cmp(y).unwrap_or(Ordering::Equal));
        accepted.extend((!borderline.is_empty()).then(|| borderline.remove(0)));
    }
    borderline.retain(|(report, _)| report.within_a_digit());
    let explained = |(_, mut candidate): CheckedCandidate| {
        candidate.generated.formulation += &wrong;
        candidate
    };
    Candidates {
        accepted: accepted.into_iter().map(explained).collect(),
        borderline: borderline
            .into_iter()
            .map(|(_, candidate)| candidate)
            .collect(),
    }
}

/// Of the functions that exceed the bounds and lose no digit the cheapest, where it is to be taken: those
/// that meet them cost too much for what they keep, or there are none.
fn spared(accepted: &[CheckedCandidate], borderline: &[CheckedCandidate]) -> Option<usize> {
    let price = |(_, candidate): &CheckedCandidate| cost(&candidate.generated);
    let k = borderline
        .iter()
        .position(|(report, _)| report.almost_holds())?;
    let least = accepted.iter().map(price).fold(f64::INFINITY, f64::min);
    (least > PRICE * price(&borderline[k])).then_some(k)
}
