//! Runs scenes: known motions, and their energy accounts.

use bgdyn_sim::Run;
use scenes::{scara_everything, scara_lumped, stick_slip};

/// Times at which the block breaks away and sticks again. Closed form: it slips for 3π/(2ω) and
/// sticks for 0.2 s with k = 100 N/m, m = 1 kg, 4 N and 3 N of friction, a belt at 0.1 m/s.
#[test]
fn the_block_on_the_belt_sticks_and_slips_when_it_should() {
    let scene = stick_slip::StickSlip::<f64>::default();
    let mut run = Run::new(&scene);
    let slip = 3.0 * std::f64::consts::PI / 20.0;
    let mut wanted = 0.4;
    let mut seen = 0;
    for _ in 0..5000 {
        run.step(1e-3).expect("it goes on");
        if run.events > seen {
            assert_eq!(run.events, seen + 1, "one event at a time");
            seen = run.events;
            let off = (run.last_event - wanted).abs();
            assert!(
                off < 1e-9,
                "event {seen} at {}, not {wanted}",
                run.last_event
            );
            wanted += if seen % 2 == 1 { slip } else { 0.2 };
        }
    }
    assert_eq!(seen, 14);
    let audit = run.audit();
    assert!(audit.drift().abs() < 1e-9, "{}", audit.drift());
    // While it is held, it moves exactly with the belt.
    assert!(audit.dissipated[1] > 0.0);
}

#[test]
fn energy_is_accounted_for() {
    let lumped = scara_lumped::ScaraLumped::<f64>::default();
    let mut run = Run::new(&lumped);
    // The turning axis is light: 1e-4 kg·m².
    for _ in 0..10_000 {
        run.step(1e-4).expect("it goes on");
    }
    let drift = run.audit().drift();
    assert!(drift.abs() < 1e-8, "{drift}");

    let everything = scara_everything::ScaraEverything::<f64>::default();
    let mut run = Run::new(&everything);
    for _ in 0..10_000 {
        run.step(2e-5).expect("it goes on");
    }
    let audit = run.audit();
    assert!(audit.drift().abs() < 1e-5, "{}", audit.drift());
    assert!(audit.dissipated.iter().sum::<f64>() > 0.1);
}
