//! A table bends: modes are resolved there, and no step averages the two sides. Motions of a block with dry
//! friction against their closed form, by steps whose ends meet the corners and by steps whose ends do not.

use bgdyn_runtime::HybridSystem;
use bgdyn_sim::{
    Dop853, Dopri5, Gauss2, HybridState, Integrator, Rk4, Rodas4, Run, ScenePlant,
    SemiImplicitEuler, Tolerance,
};

use super::{Modes, State};

bgdyn::bgdyn!("belt.scene.yaml", jacobian = true);
bgdyn::bgdyn!("brake.scene.yaml");
bgdyn::bgdyn!("carried.scene.yaml", jacobian = true);
bgdyn::bgdyn!("led.scene.yaml", jacobian = true);

/// Lengths of steps, s: of a corner's time a whole part, and not.
const STEPS: [f64; 2] = [1e-3, 0.77e-3];

/// By steps of a length to the end, and what is left there.
fn run_to<S, M>(scene: &S, integrator: M, step: f64, end: f64) -> HybridState<State, Modes>
where
    S: HybridSystem<f64, State = State, Modes = Modes> + bgdyn_runtime::Slope<f64>,
    M: Integrator<State>,
{
    let controlled = integrator.info().estimate.is_some();
    let mut run = Run::by(integrator, ScenePlant::with_slope(scene), Run::begin(scene));
    if controlled {
        run = run.with_tolerance(Tolerance {
            absolute: 1e-12,
            relative: 1e-12,
        });
    }
    while end - run.t() > 1e-9 {
        let left = end - run.t();
        run.step(step.min(left)).expect("a step");
    }
    HybridState {
        t: run.t(),
        y: *run.y(),
        modes: *run.modes(),
    }
}

/// Every kind of integrator, with what its position may be off by.
macro_rules! by_every_kind {
    ($check:expr) => {
        for step in STEPS {
            $check(&|s, end| run_to(s, Rk4, step, end), 1e-9);
            $check(&|s, end| run_to(s, SemiImplicitEuler, step, end), 5e-3);
            $check(&|s, end| run_to(s, Dopri5, step, end), 1e-9);
            $check(&|s, end| run_to(s, Dop853, step, end), 1e-9);
            $check(&|s, end| run_to(s, Rodas4, step, end), 1e-9);
            $check(&|s, end| run_to(s, Gauss2::default(), step, end), 1e-9);
        }
    };
}

type Runs<'a, S> = &'a dyn Fn(&S, f64) -> HybridState<State, Modes>;

fn near(found: f64, expected: f64, allowed: f64) {
    let off = (found - expected).abs();
    assert!(off < allowed, "{found}, not {expected}");
}

/// Where the block on the belt is, and its velocity: carried to 1 s, sliding to 3 s under 1 N, carried again.
fn on_the_belt(t: f64) -> (f64, f64) {
    if t < 1.0 {
        (0.25 * t * t, 0.5 * t)
    } else if t < 3.0 {
        let s = t - 1.0;
        (0.25 + 0.5 * s - 0.5 * s * s, 0.5 - s)
    } else {
        (-0.75 - 1.5 * (t - 3.0), -1.5)
    }
}

#[test]
fn a_belt_that_turns_back_too_fast_leaves_its_block_behind() {
    let scene = belt::Belt::<f64>::default();
    let check = |run: Runs<'_, belt::Belt<f64>>, allowed: f64| {
        for (t, mode) in [(0.6, 0.0), (1.5, 1.0), (2.7, 1.0), (3.6, 0.0)] {
            let found = run(&scene, t);
            near(found.y[0], on_the_belt(t).0, allowed);
            near(found.y[1], on_the_belt(t).1, allowed);
            assert_eq!(found.modes[0].abs(), mode, "at {t}");
        }
    };
    by_every_kind!(check);
}

#[test]
fn a_belt_that_turns_back_slowly_carries_its_block() {
    let scene = carried::Carried::<f64>::default();
    let check = |run: Runs<'_, carried::Carried<f64>>, allowed: f64| {
        let found = run(&scene, 4.0);
        // Areas under the table's lines.
        near(found.y[0], 0.05 - 0.15 + 0.15 + 0.6, allowed);
        near(found.y[1], 0.6, allowed);
        assert_eq!(found.modes[0], 0.0);
    };
    by_every_kind!(check);
}

#[test]
fn a_carried_block_meets_no_event() {
    let scene = carried::Carried::<f64>::default();
    for step in STEPS {
        let mut run = Run::new(&scene);
        for _ in 0..(4.0 / step) as usize {
            run.step(step).expect("a step");
        }
        assert_eq!((run.events, run.modes()[0]), (0, 0.0));
    }
}

/// v̇ = 5 (ṙ − v) ∓ 1 from the moment that the target moves.
#[test]
fn a_target_that_starts_to_move_makes_a_resting_block_slip() {
    let scene = led::Led::<f64>::default();
    let check = |run: Runs<'_, led::Led<f64>>, allowed: f64| {
        let found = run(&scene, 1.0);
        near(found.y[0], 0.0, 1e-13);
        let found = run(&scene, 1.5);
        let decay = (-2.5_f64).exp();
        near(found.y[1], 0.8 * (1.0 - decay), allowed);
        near(found.y[0], 0.8 * (0.5 - (1.0 - decay) / 5.0), allowed);
        // From 2 s it slows down to rest, and stays there.
        let v = 0.8 * (1.0 - (-5.0_f64).exp());
        let x = 0.8 * (1.0 - (1.0 - (-5.0_f64).exp()) / 5.0);
        let stop = ((v + 0.2) / 0.2).ln() / 5.0;
        let found = run(&scene, 2.0 + 2.0 * stop);
        assert_eq!((found.y[1], found.modes[0]), (0.0, 0.0));
        near(
            found.y[0],
            x + (v + 0.2) / 5.0 * (1.0 - (-5.0 * stop).exp()) - 0.2 * stop,
            allowed,
        );
    };
    by_every_kind!(check);
}

/// Steps stop at corners, and clocks show them.
#[test]
fn the_clock_shows_every_corner_that_a_step_meets() {
    let scene = belt::Belt::<f64>::default();
    assert_eq!(HybridSystem::<f64>::corners(&scene), [0.0, 1.0, 2.0]);
    let mut run = Run::new(&scene);
    let mut corners = Vec::new();
    for _ in 0..40 {
        run.advance_densely(0.3).expect("a step");
        if [1.0, 2.0].contains(&run.t()) {
            corners.push(run.t());
        }
    }
    assert_eq!(corners, [1.0, 2.0]);
}

/// The plants of studies, behind pointers, and the reference in double-double.
#[test]
fn a_study_resolves_stiction_at_the_start_and_at_corners() {
    use bgdyn_accuracy::{AsItIs, Grid, StepControl, TestCase};
    let grid = Grid {
        end: 3.6,
        samples: 12,
    };
    let words = ["belt", "", "slide", "m"];
    let mut case = TestCase::new(words, grid.end, "rk4", StepControl::Step(1e-3));
    case.methods(belt::Belt::<f64>::default(), AsItIs);
    case.reference(belt::Belt::<bgdyn_runtime::Dd>::default(), AsItIs);
    let expected = |k: usize| on_the_belt(grid.end * (k + 1) as f64 / grid.samples as f64).0;
    let reference = case.reference.expect("a reference");
    for (k, row) in reference(&grid, 1e-14).expect("a run").iter().enumerate() {
        near(row[0].to_f64(), expected(k), 1e-12);
    }
    assert!(case.configurations.len() > 5);
    for configuration in &case.configurations {
        let control = match configuration.controlled {
            true => StepControl::Tolerance(1e-10),
            false => StepControl::Step(1e-3),
        };
        let run = (configuration.run)(&grid, control).expect("a run");
        let allowed = if configuration.order < 4 { 5e-3 } else { 1e-8 };
        for (k, row) in run.values.iter().enumerate() {
            near(row[0], expected(k), allowed);
        }
    }
}

/// The scene begins held by 20 N. With 1 N, a run-time parameter, only the run can find that the weight falls.
#[test]
fn a_study_lets_go_what_a_parameter_no_longer_holds() {
    use bgdyn_accuracy::{AsItIs, Grid, StepControl, TestCase};
    let held = brake::Brake::<f64>::default();
    assert_eq!(HybridSystem::start(&held).1[0], 0.0);
    let grid = Grid {
        end: 1.0,
        samples: 4,
    };
    let words = ["brake", "", "fall", "m"];
    let mut case = TestCase::new(words, grid.end, "rk4", StepControl::Step(1e-3));
    let grip = super::FRICTION;
    case.formulation("cheapest", brake::Brake::<f64> { grip }, AsItIs);
    let run = (case.configurations[0].run)(&grid, StepControl::Step(1e-3)).expect("a run");
    near(run.values[3][0], -0.5 * (9.81 - super::FRICTION), 1e-9);
}
