//! Bar C12: finite arguments of mechanisms with loops give finite results or the typed error.

use std::f64::consts::FRAC_PI_2;

use bgdyn_runtime::{FixedVector, HybridSystem, StateVector};
use hard_cases_compiled::loops::{Closed, CompiledLoops, closed};

use crate::limits::{Range, is_finite, wild};
use crate::loops_states::MECHANISMS;
use crate::outcome::Outcome;
use crate::rng::Rng;
use crate::{Extent, scenes};

/// Sweeps the crank through the position in which the rod is almost upright, most densely there.
pub(crate) fn sweep(extent: Extent) -> Vec<Outcome> {
    let model = closed::<f64>("slider_crank_near_singular");
    let mut q = model.neutral();
    let (angles, mut refused, mut neither, mut spread) = (extent.of(1_000_000, 10_000), 0, 0, 0.0);
    for k in 0..=angles {
        let x = 2.0 * f64::from(k) / f64::from(angles) - 1.0;
        q[0] = FRAC_PI_2 + 1.2 * x * x * x;
        match model.close(&q) {
            Ok(closed) if closed.iter().all(is_finite) => q = closed,
            Ok(_) => neither += 1,
            Err(_) => refused += 1,
        }
        match model.forward_dynamics(&q, &[9.0], &[0.5]) {
            Ok(a) if a[0].is_finite() => spread = f64::max(spread, a[0].abs()),
            Ok(_) => neither += 1,
            Err(_) => refused += 1,
        }
    }
    assert!(spread > 1e3, "the rod was never upright: {spread}");
    let row = |what: &str, count: i32| {
        let case = "slider_crank_near_singular";
        let quantity = format!("{what}; {angles} angles");
        Outcome::new(case, "C12", quantity, f64::from(count), 0.0)
    };
    vec![
        row("neither finite nor refused", neither),
        row("refused, within reach", refused),
    ]
}

/// Results of methods without an error that are not finite: beside accelerations and where these are refused, at
/// positions at which the loops close to 1 µm, and at others.
const BESIDE: usize = 2;
const ALONE: usize = 3;
const BESIDE_OPEN: usize = 4;
const ALONE_OPEN: usize = 5;

/// Counts of faults, with the first occurrence of each.
#[derive(Default)]
struct Count {
    counts: [usize; 6],
    first: [String; 6],
}

impl Count {
    fn note(&mut self, fault: usize, text: impl FnOnce() -> String) {
        self.counts[fault] += 1;
        if self.counts[fault] == 1 {
            self.first[fault] = text();
        }
    }
}

/// Returns positions: closed ones, almost closed ones, or any.
fn positions<T: Range>(model: &dyn Closed<T>, rng: &mut Rng) -> Vec<T> {
    if rng.chance(0.25) {
        return (0..model.nq()).map(|_| wild(rng, T::POSITION)).collect();
    }
    let numbers: Vec<T> = (0..model.nv()).map(|_| T::from_f64(rng.unit())).collect();
    let mut q = model.sample(&numbers);
    let off = *rng.pick(&[0.0, 1e-14, 1e-8, 1e-3, 0.1, 1.0]);
    for x in &mut q {
        *x = T::from_f64(x.to_f64() + rng.within(1.0) * off);
    }
    q
}

/// Tries one state of a mechanism.
fn try_state<T: Range>(name: &str, model: &dyn Closed<T>, rng: &mut Rng, count: &mut Count) {
    let q = positions(model, rng);
    let mut some = || -> Vec<T> { (0..model.nv()).map(|_| wild(rng, T::RATE)).collect() };
    let [v, a, tau] = [some(), some(), some()];
    let finite = |x: &[T]| x.iter().all(is_finite);
    let at = |what: &str| format!("{name}::{what} at {q:?}, {v:?}, {a:?}, {tau:?}");
    if model.close(&q).is_ok_and(|closed| !finite(&closed)) {
        count.note(0, || at("close"));
    }
    let forward = model.forward_dynamics(&q, &v, &tau);
    if forward.as_ref().is_ok_and(|a| !finite(a)) {
        count.note(0, || at("forward_dynamics"));
    }
    // Positions that do not close are NaN, and the next accelerations are refused.
    let moved = model.integrate(&q, &v);
    if !finite(&moved) && model.forward_dynamics(&moved, &v, &tau).is_ok() {
        count.note(1, || at("integrate"));
    }
    // Methods without an error.
    let others = [
        ("inverse_dynamics", model.inverse_dynamics(&q, &v, &a)),
        ("bias", model.bias(&q, &v)),
        ("gravity", model.gravity(&q)),
        ("mass_matrix", model.mass_matrix(&q)),
        ("velocity_map", model.velocity_map(&q)),
        ("tree_acceleration", model.tree_acceleration(&q, &v, &a)),
        ("multipliers", model.multipliers(&q, &v, &a)),
        ("constraint_residual", model.constraint_residual(&q)),
        ("constraint_jacobian", model.constraint_jacobian(&q)),
    ];
    let beside = forward.is_ok_and(|a| finite(&a));
    let residual = model.constraint_residual(&q);
    let closed = residual.iter().all(|x| x.to_f64().abs() < 1e-6);
    for (method, found) in others {
        if !finite(&found) {
            let fault = match (beside, closed) {
                (true, true) => BESIDE,
                (true, false) => BESIDE_OPEN,
                (false, true) => ALONE,
                (false, false) => ALONE_OPEN,
            };
            count.note(fault, || at(method));
        }
    }
}

/// Tries the rates of a scene.
fn try_scene<T: Range, S: HybridSystem<T>>(
    name: &str,
    scene: &S,
    states: usize,
    count: &mut Count,
) {
    let (start, modes) = scene.start();
    let mut rng = Rng::new(41);
    for _ in 0..states {
        let usual = rng.chance(0.5);
        let off = *rng.pick(&[0.0, 1e-8, 1e-3, 0.3]);
        let y = S::State::from_entries(|i| {
            let from = start.entries()[i].to_f64();
            match usual || (i < scene.positions() && off < 1e-3) {
                true => T::from_f64(from + rng.within(1.0) * off),
                false => wild(
                    &mut rng,
                    if i < scene.positions() {
                        T::POSITION
                    } else {
                        T::RATE
                    },
                ),
            }
        });
        let u = S::Inputs::from_entries(|_| wild(&mut rng, T::RATE));
        let rates = scene.derivative(&y, &modes, &u, T::from_f64(0.25));
        if rates.is_ok_and(|rates| !rates.entries().iter().all(is_finite)) {
            count.note(0, || format!("{name} at {y:?}"));
        }
    }
}

fn of_scalar<T: Range + CompiledLoops>(states: usize) -> Vec<Outcome> {
    let mut all = Count::default();
    for (seed, name) in MECHANISMS.into_iter().chain(["short_rod"]).enumerate() {
        let (model, mut rng) = (closed::<T>(name), Rng::new(4300 + seed as u64));
        for _ in 0..states {
            try_state(name, &*model, &mut rng, &mut all);
        }
    }
    let mut of_scenes = Count::default();
    macro_rules! tried {
        ($($module:ident, $scene:ident;)*) => {
            $({
                let scene = scenes::$module::$scene::<T>::default();
                try_scene::<T, _>(stringify!($module), &scene, states, &mut of_scenes);
            })*
        };
    }
    tried! {
        crank_run, CrankRun;
        slider_crank_near_singular, SliderCrankNearSingular;
        five_bar_run, FiveBarRun;
        stewart_run, StewartRun;
    }
    let row = |case: &str, what: &str, count: &Count, fault: usize| {
        let quantity = format!("{what}{}", T::MARK);
        let measured = count.counts[fault] as f64;
        Outcome::new(case, "C12", quantity, measured, 0.0).at(&count.first[fault])
    };
    let case = "8 mechanisms with loops";
    let without_error = |ending: &str, beside: usize, alone: usize| {
        let what = format!("no error to return, not finite beside accelerations; loops {ending}");
        let mut found = row(case, &what, &all, beside);
        if all.counts[alone] > 0 {
            // As asked, never; these have no error to return.
            found.asked = f64::INFINITY;
        }
        found
    };
    vec![
        row(case, "neither finite nor refused", &all, 0),
        row(case, "integrate: not closed, and not refused next", &all, 1),
        without_error("closed", BESIDE, ALONE),
        without_error("open", BESIDE_OPEN, ALONE_OPEN),
        row(
            "4 scenes with loops",
            "derivative neither finite nor refused",
            &of_scenes,
            0,
        ),
    ]
}

/// Random states, closed and not, with arguments of any size.
pub(crate) fn any_numbers(extent: Extent) -> Vec<Outcome> {
    let states = extent.of(300_000, 500);
    let mut all = of_scalar::<f64>(states);
    all.extend(of_scalar::<f32>(states));
    all
}
