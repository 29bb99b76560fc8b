//! Spheres from event to event: bouncing, sliding, sticking, rolling, against closed forms.

use bgdyn_sim::event_driven::{ContactMode, ContactModes, EventError, ImpactLaw};
use bgdyn_sim::{
    Dop853, EventDriven, Gauss2, HybridState, Integrator, Midpoint, Plant, Power, Reason, Rodas4,
    Run, Tolerance,
};

use crate::sphere::{GRAVITY, Sphere, Y};

type Rolling = Run<EventDriven<Sphere>, Dop853>;

fn run(sphere: Sphere, y: Y) -> Rolling {
    let start = HybridState {
        t: 0.0,
        y,
        modes: ContactModes::open(()),
    };
    let run = Run::by(Dop853, EventDriven::new(sphere), start);
    run.with_tolerance(Tolerance {
        absolute: 1e-12,
        relative: 1e-12,
    })
}

fn ran(sphere: Sphere, y: Y, end: f64) -> Rolling {
    let mut run = run(sphere, y);
    run.step(end).expect("it goes on");
    run
}

/// A ball that falls from a height h bounces at √(2h/g) (1 + 2e + 2e² + …), and rests at √(2h/g) (1 + e)/(1 − e).
#[test]
fn a_ball_bounces_and_comes_to_rest() {
    let (height, e) = (0.5, 0.8);
    let first = (2.0 * height / GRAVITY).sqrt();
    let ball = || Sphere {
        restitution: e,
        ..Sphere::default()
    };
    let mut instants = vec![];
    let mut run = run(ball(), ball().at(height, [0.0; 3]));
    let rests = first * (1.0 + e) / (1.0 - e);
    while run.t() < 1.1 * rests {
        let events = run.events;
        run.advance_densely(1e-2).expect("it bounces");
        if run.events > events {
            instants.push(run.t());
        }
    }
    let mut exact = first;
    for (k, instant) in instants.iter().enumerate() {
        assert!((instant - exact).abs() < 1e-9, "{k}: {instant} {exact}");
        exact += 2.0 * first * e.powi(k as i32 + 1);
    }
    let last = instants.last().expect("impacts");
    assert!((last - rests).abs() < 1e-9, "{last} {rests}");
    assert_eq!(run.modes().contacts[0], ContactMode::Stick);
    assert!(run.y()[8] == 0.0 && (run.y()[2] - 0.1).abs() < 1e-14);
    let audit = run.audit();
    assert!(
        audit.drift().abs() < 1e-12 * 2.0 * GRAVITY * height * 2.0,
        "{}",
        audit.drift()
    );
}

#[test]
fn an_elastic_ball_keeps_its_energy() {
    let ball = Sphere {
        restitution: 1.0,
        ..Sphere::default()
    };
    let y = ball.at(0.5, [0.3, 0.0, 0.0]);
    let run = ran(ball, y, 20.0);
    let energy = |y: &Y| 0.5 * (y[6] * y[6] + y[8] * y[8]) + GRAVITY * (y[2] - 0.1);
    assert!((energy(run.y()) - energy(&y)).abs() < 1e-10);
    assert!(run.events > 30);
}

/// A block comes to rest after v₀²/(2 g (μ cos α − sin α)), and stays.
#[test]
fn a_block_slides_to_rest_and_sticks() {
    let (friction, incline, speed) = (0.5, 0.3_f64, 2.0);
    let block = || Sphere {
        friction,
        incline,
        ..Sphere::default()
    };
    let slows = GRAVITY * (friction * incline.cos() - incline.sin());
    let mut run = run(block(), block().at(0.0, [speed, 0.0, 0.0]));
    run.step(3.0).expect("it slides");
    assert!(
        (run.last_event - speed / slows).abs() < 1e-9,
        "{}",
        run.last_event
    );
    assert!((run.y()[0] - speed * speed / (2.0 * slows)).abs() < 1e-11);
    let x = run.y()[0];
    run.step(1000.0).expect("it sticks");
    assert!((run.y()[0] - x).abs() < 1e-12, "{}", run.y()[0] - x);
    assert!(run.audit().drift().abs() < 1e-10, "{:?}", run.audit());
    // Sideways friction turns the slip, until it stops.
    let run = ran(
        block(),
        block().at(0.0, [speed * 0.6, speed * 0.8, 0.0]),
        5.0,
    );
    assert_eq!(run.modes().contacts[0], ContactMode::Stick);
    assert!(run.y().as_slice()[6..9].iter().all(|v| v.abs() < 1e-12));
    // Steeper than the friction it does not stick.
    let steep = Sphere {
        friction: 0.2,
        ..block()
    };
    let run = ran(steep, block().at(0.0, [0.0; 3]), 1.0);
    let falls = GRAVITY * (incline.sin() - 0.2 * incline.cos());
    assert!((run.y()[6] - falls).abs() < 1e-11, "{}", run.y()[6]);
}

/// A sphere without spin rolls from t = 2 v₀/(7 μ g) on at 5 v₀/7, after 12 v₀²/(49 μ g).
#[test]
fn a_sphere_slides_until_it_rolls() {
    let (friction, speed) = (0.2, 3.0);
    let sphere = Sphere {
        friction,
        rolls: true,
        ..Sphere::default()
    };
    let rolls = 2.0 * speed / (7.0 * friction * GRAVITY);
    let y = sphere.at(0.0, [speed, 0.0, 0.0]);
    let run = ran(sphere, y, 2.0 * rolls);
    assert!((run.last_event - rolls).abs() < 1e-9, "{}", run.last_event);
    let way = 12.0 * speed * speed / (49.0 * friction * GRAVITY) + 5.0 * speed / 7.0 * rolls;
    let y = run.y();
    assert!(
        (y[6] - 5.0 * speed / 7.0).abs() < 1e-12 && (y[0] - way).abs() < 1e-11,
        "{}",
        y[0] - way
    );
    assert!(run.audit().drift().abs() < 1e-11);
}

/// An oblique impact: the tangential impulse is the lesser of μ times the normal one and m v_t/3.5, by both laws.
#[test]
fn both_laws_agree_on_a_sphere() {
    let (mass, e, v) = (2.0, 0.5, [1.0, 2.0, -3.0]);
    for law in [ImpactLaw::Newton, ImpactLaw::Poisson] {
        for friction in [0.05, 0.3] {
            let sphere = Sphere {
                friction,
                restitution: e,
                rolls: true,
                ..Sphere::default()
            };
            let y = sphere.at(0.0, v);
            let mut run = run(sphere, y);
            run.plant_mut().law = law;
            run.resolve_stiction().expect("it bounces");
            let pressed = mass * (1.0 + e) * 3.0;
            let along = v[0].hypot(v[1]);
            let rubbed = (friction * pressed).min(mass * along / 3.5);
            let left = 1.0 - rubbed / mass / along;
            let wanted = [v[0] * left, v[1] * left, -e * v[2]];
            for (found, wanted) in run.y().as_slice()[6..9].iter().zip(wanted) {
                assert!(
                    (found - wanted).abs() < 1e-13,
                    "{law:?} {friction}: {found} {wanted}"
                );
            }
        }
    }
}

/// Implicit methods take their slopes from differences where contacts are closed.
#[test]
fn implicit_methods_run_from_event_to_event() {
    fn error<M: Integrator<Y>>(method: M, steps: u32) -> f64 {
        let (friction, speed) = (0.2, 3.0);
        let sphere = Sphere {
            friction,
            rolls: true,
            ..Sphere::default()
        };
        let start = HybridState {
            t: 0.0,
            y: sphere.at(0.0, [speed, 0.0, 0.0]),
            modes: ContactModes::open(()),
        };
        let rolls = 2.0 * speed / (7.0 * friction * GRAVITY);
        let mut run = Run::by(method, EventDriven::new(sphere), start);
        for _ in 0..steps {
            run.step(2.0 * rolls / f64::from(steps)).expect("it rolls");
        }
        let way = 12.0 * speed * speed / (49.0 * friction * GRAVITY) + 5.0 * speed / 7.0 * rolls;
        (run.y()[0] - way).abs()
    }
    // Motions of constant acceleration are exact for these orders, up to the instant of the event.
    for error in [
        error(Gauss2::new(), 7),
        error(Rodas4, 7),
        error(Midpoint::new(), 7),
    ] {
        assert!(error < 1e-9, "{error}");
    }
}

/// A plant that does not say how its contacts act is refused.
#[test]
fn contacts_without_maps_are_refused() {
    struct Silent(Sphere);
    impl Plant for Silent {
        type State = Y;
        type Modes = ();
        type Values = nalgebra::SVector<f64, 0>;
        type Entries = nalgebra::SVector<f64, 3>;
        type Error = ();
        fn rates(&self, t: f64, y: &Y, modes: &()) -> Result<Y, ()> {
            self.0.rates(t, y, modes)
        }
        fn rigid_contacts(&self) -> usize {
            1
        }
        fn events(&self, t: f64, y: &Y, modes: &()) -> Result<Self::Values, ()> {
            self.0.events(t, y, modes)
        }
        fn changes_mode(&self, _: usize) -> bool {
            false
        }
        fn change(&self, _: f64, y: &Y, (): &(), _: impl Fn(usize) -> bool) -> Result<(Y, ()), ()> {
            Ok((*y, ()))
        }
        fn nothing(&self) -> Self::Entries {
            self.0.nothing()
        }
        fn energy(&self, t: f64, y: &Y, modes: &()) -> Result<Self::Entries, ()> {
            self.0.energy(t, y, modes)
        }
        fn power(&self, t: f64, y: &Y, modes: &()) -> Result<Power<Self::Entries>, ()> {
            self.0.power(t, y, modes)
        }
    }
    let sphere = Sphere::default();
    let start = HybridState {
        t: 0.0,
        y: sphere.at(0.5, [0.0; 3]),
        modes: ContactModes::open(()),
    };
    let failure = Run::by(Dop853, EventDriven::new(Silent(sphere)), start).step(1e-3);
    let wanted = Reason::Singular(EventError::NoMap { contact: 0 });
    assert_eq!(failure.expect_err("no maps").reason, wanted);
}
