//! Sorts candidates for forward dynamics by cost, among those whose rounding errors meet the bounds.
//!
//! 1. Each candidate is measured in sampled states (`conditioning/sample_states.rs`): generic ones, fast
//!    ones, large efforts, and states with neighbouring common normals in line or perpendicular.
//!    `reference_solution.rs` solves M q̈ = τ − h in double-double, and `error_bounds.rs` compares the errors
//!    in `f64` with bounds: backward error joint by joint, forward error by the condition number, the round
//!    trip through the efforts, and at most three digits lost beyond the effect of rounding the arguments.
//!    The exact result for arguments that round to the same numbers counts as correct.
//! 2. The cheapest candidate that meets the bounds is chosen; if there is none, the one closest to them. A
//!    candidate that exceeds them by less than one bit, in at most one state of twenty, counts as losing no
//!    digit: it is chosen unless another one costs at most 5 % more.
//! 3. A function is measured again after factoring. If it then comes close to the bounds or exceeds them,
//!    the order of its operations is not changed. Of 74 functions (`specs/`, `tests/outside`, eight arms with
//!    random bodies) seven cost up to 4.8 % more by this (`crane`: 173 operations instead of 165), 0.25 % in
//!    total.
//!
//! The condition number is no bound if the efforts almost balance the bias: rounding one argument then
//! changes q̈ by more. `tests/common/bars.rs` measures this effect before it permits an error.

use std::cmp::Ordering;

use crate::conditioning::error_bounds::{BoundReport, ErrorBounds};
use crate::formulation::{Candidate, Candidates};
use crate::function::Function;
use crate::passes::factor;

/// The largest accepted cost of a more accurate function, relative to the cheapest one that loses no
/// digit.
const PRICE: f64 = 1.05;

/// A candidate, and its errors compared with the bounds.
pub(super) type CheckedCandidate = (BoundReport, Candidate);

/// Returns a function with its errors: factored, unless factoring brings it close to the bounds or beyond
/// them, and increases its errors. Since factoring saves little, this comparison allows for no rounding of
/// arguments; but if no digit is lost, the extra cost is limited to [`PRICE`].
pub(super) fn check(bounds: &ErrorBounds, plain: Function) -> CheckedCandidate {
    let (report, generated) = factor_with_care(bounds, &plain);
    let candidate = Candidate {
        plain,
        generated,
        factors_mass: true,
    };
    (report, candidate)
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

/// Returns the cost by which functions are compared.
fn cost(function: &Function) -> f64 {
    function.cost().weighted() as f64
}

/// Sorts functions for one method: those that meet the bounds are accepted, the cheapest first; if there
/// are none, the one closest to the bounds. But if a cheaper one loses no digit, and the accepted ones
/// cost more than [`PRICE`] times as much, the cheaper one is accepted. Each function that exceeds the
/// bounds gets a text with the reason.
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

/// Returns the cheapest function that exceeds the bounds and loses no digit, if it is to be used: those
/// that meet the bounds cost too much, or do not exist.
fn spared(accepted: &[CheckedCandidate], borderline: &[CheckedCandidate]) -> Option<usize> {
    let price = |(_, candidate): &CheckedCandidate| cost(&candidate.generated);
    let k = borderline
        .iter()
        .position(|(report, _)| report.almost_holds())?;
    let least = accepted.iter().map(price).fold(f64::INFINITY, f64::min);
    (least > PRICE * price(&borderline[k])).then_some(k)
}
