//! Bar 12: singular mass matrices are refused with the name of a joint; solvable massless links are solved
//! to the last digits.

use crate::bars::Digits;
use crate::outcome::Outcome;
use crate::rng::Rng;
use crate::subject::{narrow, wide};
use crate::written::{cases, list};
use crate::{Extent, State};
use hard_cases_compiled::{Compiled, model};

/// Checks that it is refused in every state, with the name of this joint.
fn refused<T: Digits + Compiled>(case: &str, name: &str, joint: &str, states: usize) -> Outcome {
    let subject = model::<T>(name);
    let mut rng = Rng::new(7);
    let mut wrong = 0;
    for _ in 0..states {
        let s = State::seeded(&mut rng, subject.nv());
        let found = subject.forward_dynamics(&narrow(&s.q), &narrow(&s.v), &narrow(&s.tau));
        let named = |error: &String| error.contains(&format!("\"{joint}\""));
        wrong += usize::from(!found.as_ref().is_err_and(named));
    }
    let quantity = format!("states in which `{joint}` is not refused{}", T::MARK);
    Outcome::new(case, "12", quantity, wrong as f64, 0.0)
}

/// Checks that it is solved to 16 eps, component by component.
fn solved<T: Digits + Compiled>(case: &str, name: &str, s: &State, wanted: &[f64]) -> Outcome {
    let subject = model::<T>(name);
    let found = subject.forward_dynamics(&narrow(&s.q), &narrow(&s.v), &narrow(&s.tau));
    let error = match found {
        Ok(found) => {
            let pairs = wide(found).into_iter().zip(wanted);
            let part = |(x, w): (f64, &f64)| {
                let off = (x - w).abs();
                if off == 0.0 { 0.0 } else { off / w.abs() }
            };
            pairs.map(part).fold(0.0, f64::max)
        }
        Err(_) => f64::INFINITY,
    };
    let quantity = format!("accelerations, relative{}", T::MARK);
    Outcome::new(case, "12", quantity, error, 16.0 * T::EPS)
}

/// Exact results: the joint in the error, or the accelerations.
pub(crate) fn exact_answers(extent: Extent) -> Vec<Outcome> {
    let mut outcomes = vec![];
    let all = cases(include_str!("../singular_mass_matrix.json"));
    for (i, one) in all.iter().enumerate() {
        let id = one["id"].as_str().expect("a name");
        let expected = one["expect_forward"].as_str().expect("an expectation");
        let mut solve = |name: &str, case: &str, of: &serde_json::Value| {
            let n = model::<f64>(name).nv();
            let given = |key: &str| of.get(key).map_or_else(|| vec![0.0; n], list);
            let s = State {
                q: given("q"),
                v: given("qd"),
                tau: given("tau"),
                ..State::default()
            };
            let wanted = list(&of["qdd"]);
            outcomes.push(solved::<f64>(case, name, &s, &wanted));
            // 2⁻¹⁰⁰ and the quotients by it are numbers of `f32` too, and so are the arguments.
            if s.q.iter().chain(&s.tau).all(|&x| f64::from(x as f32) == x) {
                outcomes.push(solved::<f32>(case, name, &s, &wanted));
            }
        };
        if let Some(items) = one["items"].as_array() {
            for (j, item) in items.iter().enumerate() {
                let ratio = format!("{}:{} sliders", item["mA"], item["mB"]);
                solve(&format!("singular_{i}_{j}"), &ratio, item);
            }
        } else if let Some(rest) = expected.strip_prefix("error naming joint ") {
            let joint = rest.split(' ').next().expect("a joint");
            let (name, states) = (format!("singular_{i}"), extent.of(100_000, 1000));
            outcomes.push(refused::<f64>(id, &name, joint, states));
            outcomes.push(refused::<f32>(id, &name, joint, states));
        } else {
            solve(&format!("singular_{i}"), id, one);
        }
    }
    outcomes
}
