//! Checks that runs begin with modes that are consistent with their state, and remain consistent after
//! every change from outside: motions of a block with dry friction, against their closed form.

use bgdyn::nalgebra::SVector;
use bgdyn_sim::{
    Dop853, Dopri5, HybridState, Integrator, Rk4, Rodas4, Run, ScenePlant, SemiImplicitEuler,
};

mod corners;

bgdyn::bgdyn!("drop.scene.yaml");
bgdyn::bgdyn!("push.scene.yaml", jacobian = true);

/// Friction, N, and with it the deceleration of 1 kg.
const FRICTION: f64 = 1.0;

type State = SVector<f64, 2>;
type Modes = SVector<f64, 1>;

fn begin(position: f64, velocity: f64, mode: f64) -> HybridState<State, Modes> {
    HybridState {
        t: 0.0,
        y: State::new(position, velocity),
        modes: SVector::from([mode]),
    }
}

/// The error of the first-order integrator is of the size of its step.
fn near(found: f64, expected: f64, method: &str) {
    let allowed = if method == "semi_implicit_euler" {
        5e-3
    } else {
        1e-10
    };
    assert!(
        (found - expected).abs() < allowed,
        "{method}: {found}, not {expected}"
    );
}

fn falls<M: Integrator<State>>(method: M, name: &str) {
    let scene = drop::Drop::<f64>::default();
    let mut run = Run::by(method, ScenePlant::new(&scene), Run::begin(&scene));
    for _ in 0..1000 {
        run.step(1e-3).expect("a step");
    }
    near(run.y()[0], -0.5 * (9.81 - FRICTION), name);
    near(run.y()[1], -(9.81 - FRICTION), name);
    assert_eq!((run.modes()[0], run.events), (-1.0, 0), "{name}");
}

#[test]
fn a_weight_heavier_than_friction_falls_from_rest() {
    falls(Rk4, "rk4");
    falls(SemiImplicitEuler, "semi_implicit_euler");
    falls(Dopri5, "dopri5");
    falls(Dop853, "dop853");
}

fn stops<M: Integrator<State> + Copy>(method: M, name: &str, mode: f64) {
    let scene = push::Push::<f64>::default();
    for direction in [1.0, -1.0] {
        let start = begin(0.5, 2.0 * direction, mode);
        let mut run = Run::by(method, ScenePlant::with_slope(&scene), start);
        for _ in 0..3000 {
            run.step(1e-3).expect("a step");
        }
        // The displacement v²/2 of the deceleration, which lasts for the time v.
        near(run.y()[0], 0.5 + 2.0 * direction / FRICTION, name);
        assert_eq!(
            (run.y()[1], run.modes()[0], run.events),
            (0.0, 0.0, 1),
            "{name}"
        );
        near(run.last_event, 2.0, name);
        let audit = run.audit();
        let lost: f64 = audit.dissipated.iter().sum();
        near(lost, 2.0, name);
    }
}

#[test]
fn a_moving_block_slips_whatever_mode_it_begins_with() {
    for mode in [-1.0, 0.0, 1.0] {
        stops(Rk4, "rk4", mode);
        stops(Dopri5, "dopri5", mode);
        stops(Rodas4, "rodas4", mode);
    }
}

/// As with a sampled controller, an input is set between two steps.
#[test]
fn an_input_set_between_steps_makes_it_slip() {
    let scene = push::Push::<f64>::default();
    for pushed_from in [0, 1, 500] {
        let mut run = Run::new(&scene);
        for k in 0..1000 {
            if k == pushed_from {
                run.plant_mut().given[0] = 10.0;
            }
            run.step(1e-3).expect("a step");
        }
        let t = 1e-3 * f64::from(1000 - pushed_from);
        near(run.y()[0], 0.5 * (10.0 - FRICTION) * t * t, "rk4");
        // Released, it slides until it is at rest; pushed with less than the friction, it remains at rest.
        run.plant_mut().given[0] = 0.0;
        let v = run.y()[1];
        for _ in 0..(1000.0 * v / FRICTION) as usize + 2 {
            run.step(1e-3).expect("a step");
        }
        assert_eq!((run.y()[1], run.modes()[0]), (0.0, 0.0));
        let x = run.y()[0];
        run.plant_mut().given[0] = 0.99 * FRICTION;
        run.step(1e-3).expect("a step");
        assert_eq!((run.y()[0], run.modes()[0]), (x, 0.0));
        run.plant_mut().given[0] = -1.01 * FRICTION;
        run.step(1e-3).expect("a step");
        assert_eq!(run.modes()[0], -1.0);
        near(run.y()[1], -0.01e-3, "rk4");
    }
}

/// A push against the motion neither stops nor reverses a moving joint at once.
#[test]
fn a_push_against_the_motion_slows_it_down() {
    let scene = push::Push::<f64>::default();
    let mut run = Run::by(Rk4, ScenePlant::new(&scene), begin(0.0, 2.0, 0.0));
    run.plant_mut().given[0] = -3.0;
    for _ in 0..250 {
        run.step(1e-3).expect("a step");
    }
    near(run.y()[1], 2.0 - 4.0 * 0.25, "rk4");
    for _ in 0..750 {
        run.step(1e-3).expect("a step");
    }
    // At rest after 0.5 s, it moves back under 3 N minus friction.
    near(run.y()[1], -(3.0 - FRICTION) * 0.5, "rk4");
    assert_eq!(run.modes()[0], -1.0);
}
