//! A crate that falls and rests.

use bgdyn::nalgebra::SVector;

use crate::tumbles::Tumbles;
use crate::{G, start};

type Y = SVector<f64, 13>;

fn energy(y: &Y) -> f64 {
    let square = |i: usize| y[i] * y[i];
    let inertia = [[0.16, 0.1], [0.2, 0.1], [0.2, 0.16]].map(|[a, b]| 2.0 / 12.0 * (a * a + b * b));
    let spin: f64 = (0..3).map(|i| inertia[i] * square(10 + i)).sum();
    let slide: f64 = (7..10).map(square).sum();
    0.5 * (2.0 * slide + spin) + 2.0 * G * y[2]
}

/// A crate that tumbles comes to rest flat on the ground, and then does not move: no drift, no energy.
#[test]
fn a_crate_tumbles_and_rests() {
    // Fewer in code that is not optimised.
    rests(if cfg!(debug_assertions) {
        5_000
    } else {
        20_000
    });
}

/// The same for a million steps.
#[test]
#[ignore = "a minute: .ci/long contact"]
fn a_crate_rests_for_a_million_steps() {
    rests(1_000_000);
}

fn rests(steps: usize) {
    let scene = Tumbles::<f64>::default();
    let mut run = start!(&scene, |_: &mut Y| {});
    let start = energy(run.y());
    let mut most = start;
    for _ in 0..3000 {
        run.step(1e-3).expect("it falls");
        let now = energy(run.y());
        // Free flight keeps the energy to rounding, positions that are put right add what they had lost.
        assert!(
            now < most + 2e-3,
            "at {} s: {now} J after {most} J",
            run.t()
        );
        most = most.min(now);
        let depth = run.contact_step().expect("contacts").depth;
        assert!(depth < 3e-3, "at {} s: {depth} m", run.t());
    }
    let rested = *run.y();
    assert!(
        rested.as_slice()[7..].iter().all(|v| v.abs() < 1e-13),
        "{rested}"
    );
    assert!(rested[2] < 0.1001, "it lies flat: {rested}");
    for _ in 0..steps {
        run.step(1e-3).expect("it rests");
    }
    let moved = (run.y() - rested).amax();
    assert!(moved < 1e-12, "it moved by {moved:e}");
    assert!((energy(run.y()) - energy(&rested)).abs() < 1e-12);
    assert!(run.audit().drift().abs() < 1e-3, "{:?}", run.audit());
}
