//! Motions with loops: bar C8, against reference motions by the integrator of order 8, and bar C9, what 1e6 steps
//! of a slider-crank without torque keep.

use bgdyn_runtime::{Dd, FixedVector, HybridSystem};
use bgdyn_sim::{
    Dop853, FixedModes, Gauss2, Integrator, Rk4, Run, ScenePlant, Solver, StateVector,
};
use hard_cases_compiled::loops::{closed, spec};

use crate::bars::{norm, part};
use crate::follow::{alike, controlled, fixed, of};
use crate::loop_bars::exactly;
use crate::loop_tree::Tree;
use crate::loops_states::golden;
use crate::outcome::Outcome;
use crate::problems::slope;
use crate::reference::{Reference, larger};
use crate::scenes::swing::Swing;
use crate::tenths::Tenths;
use crate::{Extent, scenes};

/// Compares all positions, and the rates in the state, with a reference motion.
fn follows<S: HybridSystem<f64>>(case: &str, scene: &S, text: &str, rates: &[&str]) -> Outcome {
    let reference = Reference::read(text);
    let tolerances = reference.tolerances();
    let positions = scene.positions();
    let mut columns = reference.names();
    columns.truncate(positions);
    columns.extend(rates);
    let (plant, begin) = (ScenePlant::new(scene), Run::begin(scene));
    let states = controlled(Dop853, alike(1e-13), &plant, &begin, &reference.times);
    let found = of(&states, |y| StateVector::entries(y).to_vec());
    let deviations = reference.columns(&columns, &found, |k| tolerances[k]);
    Outcome::worst(case, "C8", "state; dop853 at 1e-13", deviations)
}

/// The four reference motions.
pub(crate) fn motions(_: Extent) -> Vec<Outcome> {
    let platform =
        ["px", "py", "pz", "yaw", "pitch", "platform"].map(|name| format!("{name}_rate"));
    let platform: Vec<&str> = platform.iter().map(String::as_str).collect();
    let near = scenes::slider_crank_near_singular::SliderCrankNearSingular::<f64>::default();
    vec![
        follows(
            "slider_crank",
            &scenes::crank_run::CrankRun::<f64>::default(),
            golden!("slider_crank"),
            &["crank_rate"],
        ),
        follows(
            "slider_crank_near_singular",
            &near,
            golden!("slider_crank_near_singular"),
            &["crank_rate"],
        ),
        follows(
            "five_bar_parallel",
            &scenes::five_bar_run::FiveBarRun::<f64>::default(),
            golden!("five_bar_parallel"),
            &["proximal1_rate", "proximal2_rate"],
        ),
        follows(
            "stewart_platform",
            &scenes::stewart_run::StewartRun::<f64>::default(),
            golden!("stewart_platform"),
            &platform,
        ),
    ]
}

const CASE: &str = "slider_crank without torque";

/// The unit of its energy, J.
const UNIT: f64 = 3.139;

/// What a run of 1 ms keeps.
struct Kept {
    energy: Tenths,
    /// The largest opening of a row, in units of eps and the size of the loop.
    open: f64,
    /// The largest rate of a row, in units of eps and of the terms of its loop.
    rate: f64,
    /// In units of eps and of its own terms.
    rate_alone: f64,
}

/// Follows a run.
fn keep<M: Integrator<<Swing<f64> as HybridSystem<f64>>::State>>(method: M, steps: u32) -> Kept {
    let scene = Swing::<f64>::default();
    let tree = Tree::new(spec("slider_crank"), "slider_crank");
    let (plant, begin) = (ScenePlant::new(&scene), Run::begin(&scene));
    let (plant, modes) = (&plant, &begin.modes);
    let held = FixedModes { plant, modes };
    let mut solver = Solver::new(method, 0.0, begin.y);
    let inputs = <Swing<f64> as HybridSystem<f64>>::Inputs::zero_vector();
    let energy = |y: &_| -> f64 {
        HybridSystem::energy(&scene, y, modes, &inputs, 0.0)
            .iter()
            .sum()
    };
    let start = energy(&begin.y);
    let mut kept = Kept {
        energy: Tenths::new(steps),
        open: 0.0,
        rate: 0.0,
        rate_alone: 0.0,
    };
    let model = closed::<f64>("slider_crank");
    for i in 1..=steps {
        solver.advance(&held, 1e-3).expect("it turns");
        let y = solver.y();
        kept.energy.add(i, (energy(y) - start) / UNIT);
        let mut rates = *y;
        assert!(
            HybridSystem::position_rates(&scene, y, &mut rates),
            "rates of the tree"
        );
        let n = tree.len();
        let q = &StateVector::entries(y)[..n];
        let rates = exactly(&StateVector::entries(&rates)[..n]);
        let at = tree.at(&exactly(q), &rates);
        for (open, size) in at.open.iter().zip(tree.sizes(&exactly(q))) {
            kept.open = larger(kept.open, open.to_f64().abs() / size / f64::EPSILON);
        }
        let rows = exactly(&model.constraint_jacobian(q));
        let rows = rows.chunks(n).map(|row| {
            let terms = row.iter().zip(&rates).map(|(&b, &v)| b * v);
            let (sum, size) = terms.fold((Dd::ZERO, 0.0), |(sum, size), x| {
                (sum + x, size + x.to_f64().abs())
            });
            (sum.to_f64(), size * f64::EPSILON)
        });
        let rows: Vec<(f64, f64)> = rows.collect();
        let size = norm(&rows.iter().map(|(_, size)| *size).collect::<Vec<f64>>());
        for (rate, own) in rows {
            kept.rate = larger(kept.rate, part(rate, size));
            kept.rate_alone = larger(kept.rate_alone, part(rate, own));
        }
    }
    kept
}

/// The angle of the crank at 3 s, with steps of `h`, s.
fn turned<M: Integrator<<Swing<f64> as HybridSystem<f64>>::State>>(method: M, h: f64) -> f64 {
    let scene = Swing::<f64>::default();
    let (plant, begin) = (ScenePlant::new(&scene), Run::begin(&scene));
    let states = fixed(method, h, &plant, &begin, &[3.0]);
    StateVector::entries(&states[0])[0]
}

/// The same in double-double, by order 8 with steps of 0.5 ms.
fn exactly_turned() -> f64 {
    let scene = Swing::<Dd>::default();
    let mut run = Run::by(Dop853, ScenePlant::new(&scene), Run::begin(&scene));
    for _ in 0..6_000 {
        let stepped = run.step(Dd::from_f64(1.0) / Dd::from_f64(2_000.0));
        assert!(stepped.is_ok(), "it turns");
    }
    StateVector::entries(run.y())[0].to_f64()
}

/// Rows of one method: `allowed` are the errors at 3 s with 8, 4, 2 and 1 ms, and that of the energy.
fn rows<M: Integrator<<Swing<f64> as HybridSystem<f64>>::State>>(
    new: fn() -> M,
    exact: f64,
    ([errors, energy], trendless): ([&[f64]; 2], bool),
    steps: u32,
) -> Vec<Outcome> {
    let name = new().info().name;
    let after = format!("{name}, 1 ms, {steps} steps");
    let kept = keep(new(), steps);
    let row = |what: &str, measured: f64, allowed: f64| {
        Outcome::new(CASE, "C9", format!("{what}; {after}"), measured, allowed)
    };
    let mut rows = vec![
        row("loop open, in eps of its size", kept.open, 8.0),
        Outcome {
            asked: kept.rate_alone / 16.0,
            ..row("B q̇ = 0, in eps Σ|B||q̇|", kept.rate, 16.0)
        },
        row("energy, in 3.139 J", kept.energy.most(), 1.5 * energy[0]),
    ];
    if trendless {
        rows.push(row(
            "energy, last tenth over first",
            kept.energy.grown(),
            1.5,
        ));
    }
    let ms = [8.0, 4.0, 2.0, 1.0];
    let found = ms.map(|ms| (turned(new(), ms * 1e-3) - exact).abs());
    for ((ms, found), allowed) in ms.into_iter().zip(found).zip(errors) {
        let what = format!("angle at 3 s; {name}, {ms} ms");
        rows.push(Outcome::new(CASE, "C9", what, found, 1.5 * allowed));
    }
    let what = format!("order 4 less the fitted one; {name}");
    rows.push(Outcome::new(CASE, "C9", what, 4.0 - slope(&found), 0.2));
    rows
}

/// The slider-crank without torque.
pub(crate) fn drift(extent: Extent) -> Vec<Outcome> {
    let (steps, exact) = (extent.of(1_000_000, 20_000), exactly_turned());
    let rk4: [&[f64]; 2] = [&[6.3e-5, 1.9e-6, 5.1e-8, 1.1e-9], &[8.0e-8]];
    let gauss2: [&[f64]; 2] = [&[2.2e-6, 1.4e-7, 8.7e-9, 5.5e-10], &[1.9e-10]];
    let mut all = rows(|| Rk4, exact, (rk4, false), steps);
    all.extend(rows(Gauss2::new, exact, (gauss2, true), steps));
    all
}
