//! From event to event: instants, velocities and rest, to what rounding and the tolerance leave.

use bgdyn::nalgebra::{SVector, Vector3};
use bgdyn::runtime::HybridSystem;
use bgdyn::runtime::random::Random;
use bgdyn_sim::event_driven::{ContactMode, ContactModes, EventError};
use bgdyn_sim::{
    Dop853, EventDriven, HybridState, Integrator, Real, Reason, Rk4, Run, ScenePlant, StateVector,
    Tolerance,
};

use crate::G;
use crate::balls::{COLLISIONS, assert_collided, spin_first};
use crate::bounces::Bounces;
use crate::bowls::Bowls;
use crate::collides::Collides;
use crate::jams::Jams;
use crate::planar::{Y, downhill, quarter, rocker};
use crate::rocks::Rocks;
use crate::rolls::Rolls;
use crate::slips::Slips;
use crate::tumbles::Tumbles;

/// A run from event to event.
type Driven<'a, S, M> = Run<EventDriven<ScenePlant<'a, S, f64>>, M>;

/// Returns a run of a scene from a changed start, with the tolerance 1e-12.
macro_rules! driven {
    ($scene:expr, $change:expr) => {{
        let mut start = Run::<ScenePlant<'_, _, f64>>::begin($scene);
        let change = $change;
        change(&mut start.y);
        let plant = EventDriven::new(ScenePlant::new($scene));
        let start = HybridState {
            t: start.t,
            y: start.y,
            modes: ContactModes::open(start.modes),
        };
        Run::by(Dop853, plant, start).with_tolerance(Tolerance {
            absolute: 1e-12,
            relative: 1e-12,
        })
    }};
}

/// Returns the instants of the events up to a time.
fn instants<S: HybridSystem<f64>, M: Integrator<S::State>>(
    run: &mut Driven<'_, S, M>,
    end: f64,
) -> Vec<f64> {
    let mut found = vec![];
    while run.t() < end {
        let events = run.events;
        run.advance_densely(end - run.t()).expect("it goes on");
        if run.events > events {
            found.push(run.t());
        }
    }
    found
}

#[test]
fn a_ball_bounces_until_it_rests() {
    let scene = Bounces::<f64>::default();
    let e = 0.8;
    let first = (2.0_f64 * 0.5 / G).sqrt();
    let over = first * (1.0 + e) / (1.0 - e);
    let mut run = driven!(&scene, |_: &mut SVector<f64, 13>| {});
    let found = instants(&mut run, 1.05 * over);
    let mut exact = first;
    for (k, instant) in found.iter().enumerate() {
        assert!((instant - exact).abs() < 1e-9, "{k}: {instant} {exact}");
        exact += 2.0 * first * e.powi(k as i32 + 1);
    }
    let last = found.last().expect("impacts");
    assert!((last - over).abs() < 1e-9, "{last} {over}");
    assert!(run.modes().contacts[0].is_closed());
    let audit = run.audit();
    assert!(audit.drift().abs() < 1e-11, "{}", audit.drift());
}

#[test]
fn discs_roll_and_slip() {
    let (sin, cos) = (0.6, 0.8);
    let scene = Rolls::<f64>::default();
    let mut run = driven!(&scene, |_: &mut Y| {});
    run.step(2.0).expect("it rolls");
    let speed = downhill(run.y());
    assert!((speed - 2.0 / 3.0 * G * sin * 2.0).abs() < 1e-11, "{speed}");
    assert!((speed - 0.2 * run.y()[5]).abs() < 1e-13);

    let scene = Slips::<f64>::default();
    let mut run = driven!(&scene, |_: &mut Y| {});
    run.step(2.0).expect("it slips");
    let errors = [
        downhill(run.y()) - G * (sin - 0.1 * cos) * 2.0,
        run.y()[5] - 2.0 * 0.1 * G * cos / 0.2 * 2.0,
    ];
    assert!(errors.iter().all(|e| e.abs() < 1e-11), "{errors:?}");
}

/// After 2 |γ_t|/(7 μ g) it rolls with (5 v₀ + 2 R ω₀ × n)/7.
#[test]
fn a_ball_slides_on_a_parabola_until_it_rolls() {
    let scene = Bowls::<f64>::default();
    let radius = 0.11;
    let (v, w) = (Vector3::new(3.0, 0.0, 0.0), Vector3::new(9.0, -20.0, 7.0));
    let slip = v - radius * w.cross(&Vector3::<f64>::z());
    let ends = (5.0 * v + 2.0 * radius * w.cross(&Vector3::<f64>::z())) / 7.0;
    let time = 2.0 * slip.norm() / (7.0 * 0.12 * G);
    let force = slip.normalize() * (-0.12 * G);
    let place = v * time + 0.5 * force * time * time + ends * 0.5 * time;
    let mut run = driven!(&scene, |_: &mut SVector<f64, 13>| {});
    let found = instants(&mut run, 1.5 * time);
    assert!(
        found.len() == 1 && (found[0] - time).abs() < 1e-9,
        "{found:?} {time}"
    );
    assert_eq!(run.modes().contacts[0], ContactMode::Stick);
    let off = Vector3::new(run.y()[0], run.y()[1], 0.0) - place;
    assert!(off.norm() < 1e-10, "{off}");
}

#[test]
fn a_block_rocks_from_corner_to_corner() {
    let scene = Rocks::<f64>::default();
    let (alpha, size, square) = rocker();
    let left = 1.0 - 1.5 * alpha.sin().powi(2);
    let mut tilt = 0.2;
    let mut run = driven!(&scene, |y: &mut Y| {
        y[0] = 0.1 - size * (alpha - tilt).sin();
        y[1] = size * (alpha - tilt).cos();
        y[2] = -tilt;
    });
    let mut exact = quarter(tilt);
    let found = instants(&mut run, 3.0);
    for (k, instant) in found.iter().take(8).enumerate() {
        assert!((instant - exact).abs() < 1e-9, "{k}: {instant} {exact}");
        let rest = 2.0 * square * ((alpha - tilt).cos() - alpha.cos()) * left * left;
        tilt = alpha - (alpha.cos() + rest / (2.0 * square)).acos();
        exact += 2.0 * quarter(tilt);
    }
    run.step(20.0).expect("it comes to rest");
    let y = run.y();
    assert!(
        y.as_slice()[2..].iter().all(|x| x.abs() < 1e-13) && (y[1] - 0.4).abs() < 1e-13,
        "{y}"
    );
}

#[test]
fn balls_collide_off_centre_with_spin() {
    let mut scene = Collides::<f64>::default();
    for (friction, sticks) in COLLISIONS {
        scene.friction = friction;
        let mut run = driven!(&scene, spin_first);
        run.step(0.06).expect("they collide");
        assert_collided(run.y(), (friction, sticks), 1e-11);
    }
}

/// The paradox is an error with the contact.
#[test]
fn a_rod_meets_the_paradox() {
    let scene = Jams::<f64>::default();
    let angle = 1.0_f64;
    let mut run = driven!(&scene, |y: &mut Y| {
        y[1] = 0.5 * angle.sin();
        y[2] = angle;
        let (sin, cos) = angle.sin_cos();
        (y[3], y[4]) = (-cos * 3.0, sin * 3.0);
    });
    let failure = run.step(0.1).expect_err("no forces");
    let Reason::Singular(EventError::Paradox { contact }) = failure.reason else {
        panic!("{failure}");
    };
    let names = HybridSystem::<f64>::rigid_contact_names(&scene);
    assert!(names[contact].starts_with("ends_"), "{names:?} {contact}");
}

/// Throws a crate at random, and returns the largest rise of its energy, its largest speed at the end and its energy in no
/// account. Its pose comes first in the state.
///
/// Without a tolerance steps are fixed.
fn thrown<T: Real, S: HybridSystem<T>>(scene: &S, seed: u64, tolerance: Option<f64>) -> [f64; 3] {
    let mut random = Random(seed);
    let mut start = Run::<ScenePlant<'_, S, T>>::begin(scene);
    let y = start.y.entries_mut();
    let unit = SVector::<f64, 4>::from_fn(|_, _| random.signed()).normalize();
    y[2] = T::from_f64(0.6);
    for (q, &x) in y[3..7].iter_mut().zip(unit.iter()) {
        *q = T::from_f64(x);
    }
    for v in &mut y[7..] {
        *v = T::from_f64(3.0 * random.signed());
    }
    let start = HybridState {
        t: start.t,
        y: start.y,
        modes: ContactModes::open(start.modes),
    };
    let plant = EventDriven::new(ScenePlant::new(scene));
    let mut run = Run::by(Dop853, plant, start);
    if let Some(tolerance) = tolerance.map(T::from_f64) {
        run = run.with_tolerance(Tolerance {
            absolute: tolerance,
            relative: tolerance,
        });
    }
    let energy = |run: &Run<EventDriven<ScenePlant<'_, S, T>>, Dop853>| {
        let none = bgdyn::runtime::FixedVector::zero_vector();
        let all = scene.energy(run.y(), &run.modes().plant, &none, run.t());
        all.as_ref().iter().map(|x| x.to_f64()).sum::<f64>()
    };
    let (mut before, mut gain) = (energy(&run), 0.0_f64);
    for _ in 0..2500 {
        let step = T::from_f64(2e-3);
        run.step(step).unwrap_or_else(|e| panic!("{seed}: {e}"));
        let now = energy(&run);
        gain = gain.max(now - before);
        before = now;
    }
    let speeds = run.y().entries()[7..].iter();
    let speed = speeds.fold(0.0_f64, |most, v| most.max(v.abs().to_f64()));
    [gain, speed, run.audit().drift().abs().to_f64()]
}

/// Throws crates on two threads: energy does not rise, and all come to rest, on up to eight corners.
fn assert_crates_rest<T: Real, S: HybridSystem<T> + Sync>(
    scene: &S,
    number: u64,
    tolerance: Option<f64>,
    bars: [f64; 3],
) {
    let some = |odd: u64| {
        let seeds = (0..number).filter(move |seed| seed % 2 == odd);
        let drops = seeds.map(|seed| thrown(scene, seed, tolerance));
        drops.fold([0.0_f64; 3], |worst, drop| {
            std::array::from_fn(|k| worst[k].max(drop[k]))
        })
    };
    let both = std::thread::scope(|scope| {
        let threads = [0, 1].map(|odd| scope.spawn(move || some(odd)));
        threads.map(|thread| thread.join().expect("no drop fails"))
    });
    let worst: [f64; 3] = std::array::from_fn(|k| both[0][k].max(both[1][k]));
    println!("{number} crates from event to event: J, m/s or rad/s, J: {worst:?}");
    for (found, bar) in worst.into_iter().zip(bars) {
        assert!(found < bar, "{worst:?} {bars:?}");
    }
}

/// Crates; fewer in code that is not optimised.
const CRATES: u64 = if cfg!(debug_assertions) { 1 } else { 12 };

#[test]
fn crates_fall_and_rest() {
    let double = Tumbles::<f64>::default();
    assert_crates_rest(&double, CRATES, Some(1e-10), [5e-11, 1e-13, 1e-7]);
    let single = Tumbles::<f32>::default();
    assert_crates_rest(&single, CRATES, None, [2e-5, 5e-6, 5e-2]);
}

#[test]
#[ignore = "a quarter of an hour: .ci/long contact"]
fn ten_thousand_crates_from_event_to_event() {
    let double = Tumbles::<f64>::default();
    assert_crates_rest(&double, 10_000, Some(1e-10), [5e-11, 1e-13, 1e-5]);
}

/// With the usual steps of the usual method, on the rocking block: of order 4 between impacts that are located.
#[test]
fn runs_have_the_order_of_the_method() {
    let scene = Rocks::<f64>::default();
    let (alpha, size, square) = rocker();
    let (left, tilt) = (1.0 - 1.5 * alpha.sin().powi(2), 0.2);
    let rest = 2.0 * square * ((alpha - tilt).cos() - alpha.cos()) * left * left;
    let other = alpha - (alpha.cos() + rest / (2.0 * square)).acos();
    let time = quarter(tilt) + quarter(other);
    let error = |steps: i32| {
        let mut start = Run::<ScenePlant<'_, _, f64>>::begin(&scene);
        let y = start.y.as_mut_slice();
        y[0] = 0.1 - size * (alpha - tilt).sin();
        y[1] = size * (alpha - tilt).cos();
        y[2] = -tilt;
        let start = HybridState {
            t: start.t,
            y: start.y,
            modes: ContactModes::open(start.modes),
        };
        let mut run = Run::by(Rk4, EventDriven::new(ScenePlant::new(&scene)), start);
        for _ in 0..steps {
            run.step(time / f64::from(steps)).expect("it rocks");
        }
        (run.y()[2] - other).abs()
    };
    let errors = [20, 40, 80].map(error);
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!(order > 3.5, "{errors:?}");
    }
}
