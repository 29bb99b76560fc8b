//! Bars 1 to 5 in single states: long chains, uneven masses, the repository's mechanisms.

use bgdyn_runtime::Dd;
use serde_json::Value;

use crate::bars::{Digits, Found, Hard, Reference, SINGULAR, Subject, apart, norm, rounded};
use crate::literal::Literal;
use crate::outcome::{Outcome, Worst};
use crate::rng::Rng;
use crate::written::{cases, list};
use crate::{Extent, State};
use hard_cases_compiled::{Compiled, model, spec};

/// Number of seeded states of a mechanism in the full run: each twice, with efforts of its own
/// accelerations and with others, which makes 30,000.
pub(crate) const STATES: usize = 15_000;

/// Largest number of joints for which `f32` has enough digits for every bar.
pub(crate) const SHORT: usize = 8;

/// Forward dynamics may refuse the most uneven masses if 1/(cond M · eps) is at most this. For them the
/// check of the pivots is stricter: a pivot is refused within 64 units of rounding of the subtracted
/// terms.
const UNEVEN: f64 = 64.0;

/// The state of a case of a file.
fn state_of(case: &Value) -> State {
    State {
        q: list(&case["q"]),
        v: list(&case["qd"]),
        a: list(&case["qdd"]),
        tau: list(&case["tau"]),
        parameters: vec![],
    }
}

/// Checks that the reference is that of the file: biases and accelerations to the digits of `f64`.
fn agrees(reference: &Literal, state: &State, case: &Value) -> Vec<Found> {
    let compare = |what, found: Vec<Dd>, wanted: Vec<f64>, eps: f64| {
        let measured = apart(&rounded(&found), &wanted);
        Found::new("ref", what, measured, eps * f64::EPSILON * norm(&wanted))
    };
    let bias = list(&case["h_bias"]);
    vec![
        compare("bias, against the file", reference.bias(state), bias, 2.0),
        compare(
            "accelerations, against the file",
            reference.forward(state),
            state.a.clone(),
            4.0,
        ),
    ]
}

/// Checks bars 1 to 5 in one state in the scalar T.
fn bars<T: Digits + Compiled>(
    worst: &mut Worst,
    name: &str,
    (case, at): (&str, &str),
    reference: &impl Reference,
    (state, cond): (&State, Option<f64>),
    singular: f64,
) {
    let hard = Hard::new::<T>(reference, state, cond);
    let found = hard.all::<T>(&model::<T>(name), reference, singular);
    worst.add(case, T::MARK, at, found);
}

/// Cases of a file in the model of a name.
fn of_file<'a>(name: &str, case: &str, states: impl Iterator<Item = &'a Value>, worst: &mut Worst) {
    let reference = Literal::new(spec(name));
    let mut seen = 0;
    for of in states {
        let (state, cond) = (state_of(of), of["cond_M"].as_f64());
        let at = of["config"].as_str().unwrap_or(name);
        let n = state.q.len();
        worst.add(case, "", at, agrees(&reference, &state, of));
        let at = (case, at);
        bars::<f64>(worst, name, at, &reference, (&state, cond), SINGULAR);
        if n <= SHORT {
            bars::<f32>(worst, name, at, &reference, (&state, cond), SINGULAR);
        }
        seen += 1;
    }
    assert!(seen > 0, "{case}: no case of the file");
}

/// Chains of 2 to 64 rods, straight, nearly straight and bent: condition numbers to 7e7.
pub(crate) fn chains(_: Extent) -> Vec<Outcome> {
    let all = cases(include_str!("../static_chain_conditioning.json"));
    let mut outcomes = vec![];
    for (kind, of_file_as) in [("planar", "planar y"), ("spatial", "3D alternating z,y")] {
        for links in [2, 4, 8, 16, 32, 64] {
            let mut worst = Worst::default();
            let states = all
                .iter()
                .filter(|c| c["n"] == links && c["chain"] == of_file_as);
            let case = format!("{kind} chain, {links} rods");
            of_file(&format!("{kind}_{links}"), &case, states, &mut worst);
            outcomes.extend(worst.finish());
        }
    }
    outcomes
}

/// A last link that is lighter or heavier than the others by up to 1e12.
pub(crate) fn ratios(_: Extent) -> Vec<Outcome> {
    let all = cases(include_str!("../static_mass_ratio.json"));
    let mut outcomes = vec![];
    for links in [2, 6] {
        let mut worst = Worst::default();
        let case = format!("static_mass_ratio, {links} links");
        for (i, one) in all.iter().enumerate().filter(|(_, c)| c["n"] == links) {
            of_file(
                &format!("ratio_{i}"),
                &case,
                std::iter::once(one),
                &mut worst,
            );
        }
        outcomes.extend(worst.finish());
    }
    outcomes
}

/// The models of a family in seeded states, with efforts of their own accelerations and with others.
fn seeded(case: &str, names: &[String], states: usize, singular: f64) -> Vec<Outcome> {
    let mut worst = Worst::default();
    for name in names {
        let reference = Literal::new(spec(name));
        let n = model::<f64>(name).nv();
        let mut rng = Rng::new(23);
        for k in 0..states {
            let state = State::seeded(&mut rng, n);
            let driven = State {
                tau: rounded(&reference.inverse(&state)),
                ..state.clone()
            };
            let at = format!("{name}, state {k}");
            for state in [&driven, &state] {
                let at = (case, at.as_str());
                bars::<f64>(&mut worst, name, at, &reference, (state, None), singular);
                if n <= SHORT {
                    bars::<f32>(&mut worst, name, at, &reference, (state, None), singular);
                }
            }
        }
    }
    worst.finish()
}

/// The repository's mechanisms in seeded states, also near aligned axes.
pub(crate) fn robots(extent: Extent) -> Vec<Outcome> {
    let states = extent.of(STATES, 3);
    let named = crate::limits::MECHANISMS.iter();
    named
        .flat_map(|name| seeded(name, &[(*name).to_owned()], states, SINGULAR))
        .collect()
}

/// Four links, the first or the last one heavier than the others by up to 1e12, or masses that increase or
/// decrease by 1e4 from link to link.
pub(crate) fn uneven(extent: Extent) -> Vec<Outcome> {
    let states = extent.of(STATES, 10);
    let family = |kind: &str| [3, 6, 9, 12].map(|e| format!("{kind}_{e}"));
    let mut outcomes = vec![];
    for (case, names) in [
        ("heavy first link, to 1e12", family("heavy_first").to_vec()),
        ("heavy last link, to 1e12", family("heavy_last").to_vec()),
        ("masses growing to 1e12", vec!["growing".into()]),
        ("masses falling from 1e12", vec!["falling".into()]),
    ] {
        outcomes.extend(seeded(case, &names, states, UNEVEN));
    }
    outcomes
}

/// The errors in `f32` without a bar.
#[derive(Clone, Debug)]
pub struct Single {
    /// The chain and its shape.
    pub case: String,
    /// The condition number of its mass matrix.
    pub cond: f64,
    /// Error of inverse dynamics in units of eps (‖M q̈‖ + ‖c‖ + ‖g‖).
    pub inverse: f64,
    /// Relative error of forward dynamics; `None` if it is refused.
    pub forward: Option<f64>,
}

/// `f32` in the chains with more than eight joints.
pub fn single_precision_of_long_chains() -> Vec<Single> {
    let all = cases(include_str!("../static_chain_conditioning.json"));
    let mut rows = vec![];
    for (kind, of_file_as) in [("planar", "planar y"), ("spatial", "3D alternating z,y")] {
        for links in [16, 32, 64] {
            let name = format!("{kind}_{links}");
            let (reference, subject) = (Literal::new(spec(&name)), model::<f32>(&name));
            let chains = all
                .iter()
                .filter(|c| c["n"] == links && c["chain"] == of_file_as);
            for case in chains {
                let cond = case["cond_M"].as_f64();
                let hard = Hard::new::<f32>(&reference, &state_of(case), cond);
                let inverse = hard.inverse_dynamics::<f32>(&subject, &reference);
                let exact = rounded(&reference.forward(&hard.state));
                let found = Subject::<f32>::forward(&subject, &hard.state);
                let config = case["config"].as_str().unwrap_or_default();
                rows.push(Single {
                    case: format!("{kind}, {links} rods, {config}"),
                    cond: hard.most * hard.inverse,
                    inverse: 32.0 * inverse.measured / inverse.allowed,
                    forward: found.map(|found| apart(&found, &exact) / norm(&exact)),
                });
            }
        }
    }
    rows
}
