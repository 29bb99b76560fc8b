//! Bodies with corners in the plane, from event to event: rocking, jamming, tumbling, impacts off centre.

use bgdyn_runtime::random::Random;
use bgdyn_sim::event_driven::{ContactMode, ContactModes, EventError, ImpactLaw};
use bgdyn_sim::{Dop853, EventDriven, HybridState, Reason, Run, Tolerance};

use crate::bodies::{self, Planar};
use crate::sphere::GRAVITY;

fn planar(body: Planar, y: bodies::Y) -> Run<EventDriven<Planar>, Dop853> {
    let start = HybridState {
        t: 0.0,
        y,
        modes: ContactModes::open(()),
    };
    let run = Run::by(Dop853, EventDriven::new(body), start);
    run.with_tolerance(Tolerance {
        absolute: 1e-13,
        relative: 1e-13,
    })
}

/// A block of half width 0.1 m and half height 0.4 m.
fn block() -> Planar {
    Planar {
        inertia: (0.1 * 0.1 + 0.4 * 0.4) / 3.0,
        corners: vec![[-0.1, -0.4], [0.1, -0.4]],
        friction: 2.0,
        restitution: 0.0,
    }
}

/// Returns a fifth of a number in code that is not optimised, which is thirty times as slow.
fn fewer_if_slow(number: usize) -> usize {
    if cfg!(debug_assertions) {
        number / 5
    } else {
        number
    }
}

/// The time in which a rocking block falls from rest at this angle, by quadrature of its energy with θ = θ₀ − u²:
/// θ̇²/2 = p² (cos(α − θ₀) − cos(α − θ)).
fn quarter(amplitude: f64, slope: f64, p2: f64) -> f64 {
    let n = 4000;
    let end = amplitude.sqrt();
    let f = |u: f64| {
        let d = 0.5 * u * u;
        let ratio = if u == 0.0 { 0.5 } else { d.sin() / (u * u) };
        // 2u du over θ̇
        1.0 / (p2 * (slope - amplitude + d).sin() * ratio).sqrt()
    };
    let h = end / f64::from(n);
    let weight = |k: i32| match k {
        0 => 1.0,
        k if k == n => 1.0,
        k if k % 2 == 1 => 4.0,
        _ => 2.0,
    };
    let sum: f64 = (0..=n).map(|k| weight(k) * f(f64::from(k) * h)).sum();
    sum * h / 3.0
}

/// A slender block rocks from corner to corner: θ̈ = −p² sin(α − θ), p² = 3 g/(4 R), and each impact leaves
/// 1 − (3/2) sin² α of the rate (Housner 1963).
#[test]
fn a_block_rocks_until_it_rests() {
    let (slope, radius) = (0.25_f64.atan(), 0.1_f64.hypot(0.4));
    let p2 = 3.0 * GRAVITY / (4.0 * radius);
    let left = 1.0 - 1.5 * slope.sin().powi(2);
    let mut amplitude = 0.1_f64;
    let mut y = bodies::Y::zeros();
    // It stands on its right corner, which is at x = 0.
    let (sin, cos) = (-amplitude).sin_cos();
    y.as_mut_slice()[..3].copy_from_slice(&[
        -cos * 0.1 - sin * 0.4,
        -sin * 0.1 + cos * 0.4,
        -amplitude,
    ]);
    let mut run = planar(block(), y);
    let mut exact = quarter(amplitude, slope, p2);
    let mut before = block().energy_of(&y);
    let mut found = vec![];
    while found.len() < 12 {
        let events = run.events;
        run.advance_densely(1e-1).expect("it rocks");
        if run.events > events {
            found.push(run.t());
            let now = block().energy_of(run.y());
            assert!(now < before, "{now} {before}");
            before = now;
        }
    }
    for (k, instant) in found.iter().enumerate() {
        assert!((instant - exact).abs() < 1e-9, "{k}: {instant} {exact}");
        let square = 2.0 * p2 * ((slope - amplitude).cos() - slope.cos()) * left * left;
        amplitude = slope - (slope.cos() + square / (2.0 * p2)).acos();
        exact += 2.0 * quarter(amplitude, slope, p2);
    }
    run.step(20.0).expect("it comes to rest");
    let y = *run.y();
    assert!(
        run.modes().contacts[..2]
            .iter()
            .all(|&mode| mode == ContactMode::Stick)
    );
    assert!(y[2].abs() < 1e-13 && (y[1] - 0.4).abs() < 1e-13, "{y}");
    assert!(y.as_slice()[3..].iter().all(|v| v.abs() < 1e-14), "{y}");
    for _ in 0..fewer_if_slow(10_000) {
        run.step(0.1).expect("it rests");
    }
    assert!((run.y() - y).norm() < 1e-12, "{}", run.y() - y);
    assert!(run.audit().drift().abs() < 1e-10, "{}", run.audit().drift());
}

/// A rod, half a metre from its centre to its end, that slides on this end away from the side to which it leans.
fn rod(friction: f64, angle: f64, speed: f64) -> (Planar, bodies::Y) {
    let body = Planar {
        inertia: 0.25 / 3.0,
        corners: vec![[0.5, 0.0]],
        friction,
        restitution: 0.0,
    };
    let y = bgdyn_runtime::vector([0.0, 0.5 * angle.sin(), -angle, speed, 0.0, 0.0]);
    (body, y)
}

/// 1 + 3 cos φ (cos φ − μ sin φ) < 0 where μ > 4/3 and tan φ is about 2: no force keeps the rod up.
#[test]
fn a_rod_meets_the_paradox() {
    let (body, y) = rod(1.5, 2.0_f64.atan(), 3.0);
    let failure = planar(body, y).step(1e-3).expect_err("no forces");
    let wanted = Reason::Singular(EventError::Paradox { contact: 0 });
    assert_eq!(failure.reason, wanted);
    for (friction, angle, speed) in [(1.3, 2.0_f64.atan(), 3.0), (1.5, 2.0_f64.atan(), -3.0)] {
        let (body, y) = rod(friction, angle, speed);
        planar(body, y).step(1e-3).expect("forces");
    }
    // From outside the angles of the paradox it slides towards them, until its forces have no bound.
    let (body, y) = rod(2.0, 0.55, 10.0);
    let mut run = planar(body, y);
    run.step(0.07).expect("it slides");
    // By rod.py, in 40 digits.
    let exact = [
        (0, 0.593_357_094_538_216),
        (2, -0.620_277_678_142_963_6),
        (3, 6.426_076_549_800_927),
        (5, -2.704_285_668_880_464),
    ];
    for (k, exact) in exact {
        let found = run.y()[k];
        assert!((found - exact).abs() < 1e-11, "{k}: {found} {exact}");
    }
    let failure = run.step(0.02).expect_err("it jams");
    assert_eq!(failure.reason, wanted);
    assert!((failure.t - 0.07923814).abs() < 1e-5, "{}", failure.t);
}

/// A box thrown at random: energy falls at each impact and at no other time rises, until it rests.
#[test]
fn boxes_tumble_and_rest() {
    let mut random = Random(7);
    let mut random = || random.signed();
    for k in 0..fewer_if_slow(60) {
        let body = || Planar {
            inertia: (0.1 * 0.1 + 0.15 * 0.15) / 3.0,
            corners: vec![[-0.1, -0.15], [0.1, -0.15], [0.1, 0.15], [-0.1, 0.15]],
            friction: 0.4,
            restitution: 0.3,
        };
        let y = bgdyn_runtime::vector([
            0.0,
            0.6,
            3.0 * random(),
            random(),
            random(),
            10.0 * random(),
        ]);
        let mut run = planar(body(), y);
        let mut energy = body().energy_of(&y);
        for _ in 0..400 {
            run.step(0.01).unwrap_or_else(|e| panic!("{k}: {e}"));
            let now = body().energy_of(run.y());
            assert!(now < energy + 1e-11, "{k}: {now} {energy}");
            energy = now;
            let gaps = (0..4).map(|c| body().gap(c, run.y()));
            assert!(gaps.fold(0.0, f64::min) > -1e-12, "{k}: {}", run.y());
        }
        assert!(
            run.y().as_slice()[3..].iter().all(|v| v.abs() < 1e-13),
            "{k}: {}",
            run.y()
        );
        assert!(
            run.audit().drift().abs() < 1e-9,
            "{k}: {}",
            run.audit().drift()
        );
    }
}

/// A body turned by an angle, whose lower corner touches and approaches at this velocity.
fn meets(restitution: f64, friction: f64, angle: f64, v: [f64; 3]) -> (Planar, bodies::Y) {
    let body = Planar {
        inertia: 0.02,
        corners: vec![[0.3, -0.1]],
        friction,
        restitution,
    };
    let height = -(angle.sin() * 0.3 - angle.cos() * 0.1);
    let y = bgdyn_runtime::vector([0.0, height, angle, v[0], v[1], v[2]]);
    (body, y)
}

/// At impacts off centre Newton's law would add energy in some states: then Poisson's is taken. By Poisson's law the normal
/// impulse is 1 + e times that of compression; no law adds energy, and friction keeps in its cone.
#[test]
fn impacts_off_centre_add_no_energy() {
    let mut random = Random(5);
    let (mut impacts, mut replaced) = (0, 0);
    for _ in 0..4000 {
        let [e, friction] = [0.5 + 0.5 * random.signed().abs(), random.signed().abs()];
        let angle = 1.5 * random.signed();
        let v = [(); 3].map(|()| 3.0 * random.signed());
        let jump = |law, e: f64| {
            let (body, y) = meets(e, friction, angle, v);
            let mut run = planar(body, y);
            run.plant_mut().law = law;
            run.resolve_stiction().ok()?;
            let ([x, _, normal], loss) = {
                let jump = &run.modes().jump;
                (jump.impulses[0], jump.losses[0])
            };
            assert!(x.abs() <= friction * normal * (1.0 + 1e-12) + 1e-14);
            (normal > 0.0).then_some((normal, loss, run.modes().jump.by_poisson, y, *run.y()))
        };
        let Some((normal, loss, by_poisson, before, after)) = jump(ImpactLaw::Newton, e) else {
            continue;
        };
        impacts += 1;
        replaced += usize::from(by_poisson);
        let (body, _) = meets(e, friction, angle, v);
        let lost = body.energy_of(&before) - body.energy_of(&after);
        assert!(lost > -1e-9 && (lost - loss).abs() < 1e-9, "{lost} {loss}");
        let compressed = jump(ImpactLaw::Newton, 0.0).map(|found| found.0);
        let Some((poisson, loss, ..)) = jump(ImpactLaw::Poisson, e) else {
            panic!("both laws meet");
        };
        let wanted = (1.0 + e) * compressed.expect("an impact");
        assert!(
            poisson > wanted * (1.0 - 1e-12) && loss > -1e-9,
            "{poisson} {wanted} {loss}"
        );
        assert!(!by_poisson || (normal - poisson).abs() < 1e-12 * poisson);
    }
    assert!(impacts > 1000 && replaced > 10, "{impacts} {replaced}");
}

/// A box that falls flat hits with both corners at once, and bounces with both.
#[test]
fn two_corners_bounce_at_once() {
    let body = || Planar {
        restitution: 0.6,
        ..block()
    };
    let y = bgdyn_runtime::vector([0.0, 0.5, 0.0, 0.2, 0.0, 0.0]);
    let mut run = planar(body(), y);
    while run.events == 0 {
        run.advance_densely(1.0).expect("it falls");
    }
    let speed = (2.0 * GRAVITY * 0.1_f64).sqrt();
    assert!((run.t() - speed / GRAVITY).abs() < 1e-12);
    let y = run.y();
    // Friction stops both corners; their arm turns the block.
    let impulses = &run.modes().jump.impulses;
    let pressed = impulses[0][2] + impulses[1][2];
    assert!((y[4] - (pressed - speed)).abs() < 1e-12);
    for corner in [-0.1, 0.1] {
        let leaves = y[4] + y[5] * corner;
        assert!(leaves > 0.6 * speed - 1e-12, "{y}");
    }
}
