//! Tests events: at their times, in their order, and without loss of order.

use std::f64::consts::PI;

use bgdyn_runtime::vector;
use bgdyn_sim::{
    Dop853, Dopri5, Gauss3, INTEGRATORS, Integrator, IntegratorInfo, Reason, Rk4, Rodas4, Run,
    Tolerance, WithIntegrator, with_integrator,
};
use nalgebra::SVector;

use crate::plants::{Law, Oscillator};
use crate::problems::{distance, slope};

type Y = SVector<f64, 2>;

/// The wall at ½ is reached from q = 1 at t = π/3, with q̇ = −sin(π/3); reflected at the same speed, q
/// returns to 1 and the wall after another 2π/3.
struct Met {
    h: f64,
    tolerance: Option<f64>,
}

impl WithIntegrator<Y> for Met {
    type Output = (IntegratorInfo, [f64; 2]);

    fn with<M: Integrator<Y>>(self, method: M) -> Self::Output {
        let info = method.info();
        let law = Law::Walls {
            at: [0.5, -9.0],
            returns: 1.0,
        };
        let wall = Oscillator { law };
        let start = wall.start();
        let mut run = Run::by(method, wall, start);
        if let Some(tolerance) = self.tolerance {
            run = run.with_tolerance(Tolerance {
                absolute: tolerance,
                relative: tolerance,
            });
        }
        let mut times = Vec::new();
        while run.t() < 3.5 {
            run.step(self.h).expect("it swings");
            if run.events > times.len() {
                times.push(run.last_event);
            }
        }
        let [first, second] = times[..] else {
            panic!("{}: events at {times:?}", info.name)
        };
        (info, [first - PI / 3.0, second - PI])
    }
}

/// To 1e-10 s by every integrator of that accuracy, by the others to their own error.
#[test]
fn every_method_meets_the_wall_in_time() {
    for name in INTEGRATORS {
        let met = Met {
            h: 1e-3,
            tolerance: None,
        };
        let (info, off) = with_integrator(name, met).expect("a name of the list");
        let bar = match info.order {
            1 => 2e-3,
            2 => 1e-6,
            _ => 1e-12,
        };
        assert!(
            off[0].abs() < bar && off[1].abs() < 3.0 * bar,
            "{name}: {off:?}"
        );
    }
    for (name, bar) in [("dopri5", 1e-10), ("dop853", 1e-11), ("rodas4", 1e-10)] {
        let met = Met {
            h: 0.5,
            tolerance: Some(1e-12),
        };
        let (_, off) = with_integrator(name, met).expect("a name of the list");
        assert!(off[0].abs() < bar && off[1].abs() < bar, "{name}: {off:?}");
    }
}

/// A mode changes as early as the resolution of time permits: a delay is an error of first order, which is
/// visible in `f32`.
#[test]
fn modes_change_at_once() {
    let law = Law::Walls {
        at: [0.5, -9.0],
        returns: 1.0,
    };
    let wall = Oscillator { law };
    let start = wall.start();
    let mut run = Run::by(Dop853, wall, start);
    while run.events == 0 {
        run.step(0.01).expect("it swings");
    }
    let late = (run.last_event - PI / 3.0) / f64::EPSILON;
    println!("{late} roundings late");
    assert!((0.0..8.0).contains(&late), "{late} roundings late");
}

/// Long steps during which a wall is crossed and recrossed: the end states do not show it.
#[test]
fn events_inside_a_long_step_are_seen() {
    let law = Law::Walls {
        at: [-0.9, -9.0],
        returns: 0.0,
    };
    let wall = Oscillator { law };
    let start = wall.start();
    let mut run = Run::by(Dop853, wall, start);
    // q is back above −0.9 at the end of the step.
    run.step(3.8).expect("it swings");
    assert_eq!(run.events, 1);
    let met = (-0.9_f64).acos();
    assert!((run.last_event - met).abs() < 3e-3, "{}", run.last_event);
    assert!((run.t() - 3.8).abs() < 1e-14);
}

/// Of two events in one step the earlier one comes first, for any order of their indices, and each of them
/// once.
#[test]
fn the_first_of_several_events_comes_first() {
    for at in [[0.5, 0.4], [0.4, 0.5]] {
        let law = Law::Walls { at, returns: -1.0 };
        let wall = Oscillator { law };
        let start = wall.start();
        let mut run = Run::by(Dop853, wall, start);
        let mut met = Vec::new();
        while run.t() < 1.5 {
            run.advance_densely(1.5 - run.t()).expect("it swings");
            if run.events > met.len() {
                met.push(run.last_event);
            }
        }
        // Walls without effect: the velocity is multiplied by 1.
        assert_eq!(met.len(), 2, "{met:?}");
        assert!((met[0] - 0.5_f64.acos()).abs() < 1e-7, "{met:?}");
        assert!((met[1] - 0.4_f64.acos()).abs() < 1e-7, "{met:?}");
    }
}

/// A spring of 8 N/m begins at q = ½: below it q oscillates at 3 rad/s about 4/9.
fn sprung(t: f64) -> Y {
    let met = PI / 3.0;
    let speed = met.sin();
    let (offset, turn) = (0.5 - 4.0 / 9.0, 3.0 * (t - met));
    vector([
        4.0 / 9.0 + offset * turn.cos() - speed / 3.0 * turn.sin(),
        -3.0 * offset * turn.sin() - speed * turn.cos(),
    ])
}

/// A step ends at a kink, so that the order is preserved; and the energy balances.
#[test]
fn kinks_do_not_cost_order() {
    fn errors<M: Integrator<Y> + Clone>(method: &M) -> [f64; 4] {
        [10, 20, 40, 80].map(|n| {
            let law = Law::Spring {
                below: 0.5,
                stiffness: 8.0,
            };
            let sprung_mass = Oscillator { law };
            let start = sprung_mass.start();
            let mut run = Run::by(method.clone(), sprung_mass, start);
            for _ in 0..n {
                run.step(1.7 / f64::from(n)).expect("it swings");
            }
            assert_eq!((run.kinks, run.events), (1, 0));
            distance(run.y(), &sprung(1.7))
        })
    }
    for (found, stated) in [
        (errors(&Rk4), 4.0),
        (errors(&Gauss3::<f64>::new()), 6.0),
        (errors(&Dopri5), 5.0),
        (errors(&Rodas4), 4.0),
    ] {
        println!("{stated}: {:.2} {found:?}", slope(&found));
        assert!(slope(&found) >= stated - 0.2, "{stated}: {found:?}");
    }
    // Without events: the same law, with its kink unknown to the run.
    let unaware = [10, 20, 40, 80].map(|n| distance(&blind(n), &sprung(1.7)));
    assert!(slope(&unaware) < 3.0, "{unaware:?}");
}

/// [`sprung`] with steps that do not end at the kink.
fn blind(n: u32) -> Y {
    let law = Law::Spring {
        below: 0.5,
        stiffness: 8.0,
    };
    let plant = Oscillator { law };
    let start = plant.start();
    let held = bgdyn_sim::FixedModes {
        plant: &plant,
        modes: &start.modes,
    };
    let mut solver = bgdyn_sim::Solver::new(Rk4, 0.0, start.y);
    for _ in 0..n {
        solver
            .advance(&held, 1.7 / f64::from(n))
            .expect("it swings");
    }
    *solver.y()
}

/// A relay in a sliding mode: the events do not end, but the run does, with the time in its error.
#[test]
fn chattering_is_an_error() {
    let relay = Oscillator { law: Law::Relay };
    let start = relay.start();
    let mut run = Run::by(Rk4, relay, start);
    run.step(0.2).expect("not there yet");
    let failure = run.step(0.2).expect_err("it slides");
    assert!(matches!(
        failure.reason,
        Reason::TooManyEvents { events: 64 }
    ));
    assert!((failure.t - 0.25).abs() < 1e-10, "{}", failure.t);
    assert_eq!((failure.t, failure.y), (run.t(), *run.y()));
    assert!(failure.to_string().contains("64 events"), "{failure}");
}

/// The energy account: the wall dissipates the loss of kinetic energy.
#[test]
fn energy_and_modes_after_events() {
    let law = Law::Walls {
        at: [0.0, -9.0],
        returns: 0.5,
    };
    let wall = Oscillator { law };
    let start = wall.start();
    let mut run = Run::by(Gauss3::new(), wall, start).compensated();
    for _ in 0..200 {
        run.step(1e-2).expect("it swings");
    }
    assert_eq!(run.events, 1);
    let audit = run.audit();
    assert!((audit.stored[0] + 0.375).abs() < 1e-13, "{}", audit.stored);
    assert!(
        run.low()
            .is_some_and(|low| low.amax() > 0.0 && low.amax() < 1e-15)
    );
    let unaudited = Run::by(Rk4, Oscillator { law: Law::Relay }, start).unaudited();
    assert_eq!(unaudited.audit().drift(), 0.0);
}
