//! Time stepping of rigid contacts, compared with closed forms.

mod sphere;

use bgdyn_sim::{HybridState, Moreau, Reason, Rk4, Run};

use sphere::{GRAVITY, Sphere, Y};

fn run(sphere: Sphere, y: Y) -> Run<Sphere, Moreau<f64>> {
    let start = HybridState {
        t: 0.0,
        y,
        modes: (),
    };
    Run::by(Moreau::new(), sphere, start)
}

/// Runs to the time `end` in this many steps, and returns the run.
fn ran(sphere: Sphere, y: Y, end: f64, steps: usize) -> Run<Sphere, Moreau<f64>> {
    let mut run = run(sphere, y);
    for _ in 0..steps {
        run.step(end / steps as f64).expect("it goes on");
        assert!(run.contact_step().expect("steps of contacts").solved);
    }
    run
}

/// A ball that falls from a height h bounces at √(2h/g) (1 + 2e + 2e² + …), and rests at √(2h/g) (1 + e)/(1 − e).
#[test]
fn a_ball_bounces_and_comes_to_rest() {
    let (height, e) = (0.5, 0.6);
    let first = (2.0 * height / GRAVITY).sqrt();
    let speed = GRAVITY * first;
    // In the middle of the second flight.
    let time = first + 2.0 * speed / GRAVITY * (e + 0.5 * e * e);
    let exact = (e * e * speed) * (e * e * speed) / (2.0 * GRAVITY);
    let ball = || Sphere {
        restitution: e,
        ..Sphere::default()
    };
    let error = |steps| {
        let run = ran(ball(), ball().at(height, [0.0; 3]), time, steps);
        (run.y()[2] - 0.1 - exact).abs()
    };
    // The error of first order jumps with the place of an impact in its step: its largest values over many steps fall as h.
    let worst = |steps: usize| (steps..steps + 40).map(error).fold(0.0, f64::max);
    let (coarse, fine) = (worst(400), worst(6400));
    assert!(
        fine < 1.5e-3 && (8.0..32.0).contains(&(coarse / fine)),
        "{coarse} {fine}"
    );

    let rests = first * (1.0 + e) / (1.0 - e);
    let mut run = ran(ball(), ball().at(height, [0.0; 3]), 1.2 * rests, 20_000);
    let (y, depth) = (*run.y(), run.contact_step().expect("contacts").depth);
    assert!(y[8].abs() < 1e-12 && depth < 1e-13, "{y} {depth}");
    for _ in 0..100_000 {
        run.step(1e-3).expect("it rests");
    }
    let (moved, speed) = (run.y()[2] - y[2], run.y()[8]);
    assert!(
        moved.abs() < 1e-15 && speed.abs() < 1e-15,
        "{moved} {speed}"
    );
    // What it lost is in the account of the contact, to rounding and the overlap of its first impacts.
    let audit = run.audit();
    assert!(
        audit.drift().abs() < 1e-7 * 2.0 * GRAVITY * height,
        "{audit:?}"
    );
}

/// Without losses the energy is kept through many impacts.
#[test]
fn an_elastic_ball_keeps_its_energy() {
    let ball = Sphere {
        restitution: 1.0,
        ..Sphere::default()
    };
    let y = ball.at(0.5, [0.3, 0.0, 0.0]);
    let run = ran(ball, y, 20.0, 20_011);
    let energy = |y: &Y| 0.5 * (y[6] * y[6] + y[8] * y[8]) + GRAVITY * (y[2] - 0.1);
    let (before, after) = (energy(&y), energy(run.y()));
    assert!((after - before).abs() < 1e-12, "{before} {after}");
    assert!(run.audit().drift().abs() < 1e-11);
}

/// A block comes to rest after v₀²/(2 g (μ cos α − sin α)), and rests exactly: the cone sticks.
#[test]
fn a_block_slides_to_rest_and_sticks() {
    let (friction, incline, speed) = (0.5, 0.3_f64, 2.0);
    let block = || Sphere {
        friction,
        incline,
        ..Sphere::default()
    };
    let slows = GRAVITY * (friction * incline.cos() - incline.sin());
    let exact = speed * speed / (2.0 * slows);
    let ended = |steps| {
        let start = block().at(0.0, [speed * 0.6, speed * 0.8, 0.0]);
        // Sideways friction turns with the slip: only a slide along x has a closed form.
        let along = block().at(0.0, [speed, 0.0, 0.0]);
        let sideways = ran(block(), start, 3.0, steps);
        let speeds = &sideways.y().as_slice()[6..12];
        assert!(speeds.iter().all(|v| v.abs() < 1e-15), "{speeds:?}");
        ran(block(), along, 3.0, steps)
    };
    let errors = [500, 2000].map(|steps| (ended(steps).y()[0] - exact).abs());
    assert!(errors[0] < 2e-4 && errors[1] < 2e-5, "{errors:?}");
    let mut run = ended(2000);
    let x = run.y()[0];
    for _ in 0..100_000 {
        run.step(1e-3).expect("it sticks");
    }
    assert!((run.y()[0] - x).abs() < 1e-12, "{}", run.y()[0] - x);
    assert!(run.audit().drift().abs() < 1e-10, "{:?}", run.audit());
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
    let start = sphere.at(0.0, [speed, 0.0, 0.0]);
    let run = ran(sphere, start, 2.0 * rolls, 1000);
    let y = run.y();
    assert!((y[6] - 5.0 * speed / 7.0).abs() < 1e-12, "{}", y[6]);
    assert!((y[6] - 0.1 * y[10]).abs() < 1e-13);
    let way = 12.0 * speed * speed / (49.0 * friction * GRAVITY) + 5.0 * speed / 7.0 * rolls;
    assert!((y[0] - way).abs() < 1e-5 * way, "{} {way}", y[0]);
}

/// Damping that is far faster than the step needs the slopes of the rates; the mean of two steps is the motion.
#[test]
fn stiff_damping_is_stepped_over() {
    let sphere = Sphere {
        damping: 1e5,
        ..Sphere::default()
    };
    let y = sphere.at(0.5, [0.0; 3]);
    let run = ran(sphere, y, 1.0, 1000);
    let sinks = 2.0 * GRAVITY / 1e5;
    assert!((run.y()[2] - (0.6 - sinks)).abs() < 1e-6, "{}", run.y()[2]);
}

/// Integrators that do not know rigid contacts refuse them.
#[test]
fn other_integrators_refuse_contacts() {
    let sphere = Sphere::default();
    let start = HybridState {
        t: 0.0,
        y: sphere.at(0.5, [0.0; 3]),
        modes: (),
    };
    let mut run = Run::by(Rk4, sphere, start);
    let failure = run.step(1e-3).expect_err("rk4 knows no contacts");
    assert_eq!(failure.reason, Reason::RigidContacts);
    assert!(failure.to_string().contains("use `Moreau`"), "{failure}");
}
