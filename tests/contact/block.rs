//! A block on an incline of the slope 1/3 with a coefficient of friction of 1/2 or 1/5.

use bgdyn::nalgebra::SVector;

use crate::creeps::Creeps;
use crate::holds::Holds;
use crate::slides::Slides;
use crate::{G, run};

/// The block's mass, kg, and the stiffness of its contact, N/m^1.5.
const MASS: f64 = 3.0;
const STIFFNESS: f64 = 4e6;
/// The stiffness of its bristles, 1/m.
const BRISTLES: f64 = 2e4;

/// Weight along the incline and across it, N.
fn weights() -> (f64, f64) {
    let along = 1.0 / 10.0_f64.sqrt();
    (MASS * G * along, 3.0 * MASS * G * along)
}

/// Displacement up the incline and the distance from it, m.
fn along_and_above(y: &[f64]) -> (f64, f64) {
    let size = 10.0_f64.sqrt();
    ((3.0 * y[0] + y[2]) / size, (3.0 * y[2] - y[0]) / size)
}

/// Smooth friction creeps at w f/√((μ λ)² − f²).
#[test]
fn smooth_friction_creeps_as_fast_as_its_page_says() {
    let scene = Creeps::<f64>::default();
    let mut run = run!(&scene, 1e-12, |y: &mut SVector<f64, 6>| y[3] = 0.3);
    run.step(3.0).expect("it moves");
    let (along, across) = weights();
    let wanted = 2e-3 * along / ((0.5 * across).powi(2) - along * along).sqrt();
    let (speed, sinking) = along_and_above(&run.y().as_slice()[3..]);
    assert!((speed + wanted).abs() < 1e-9, "{speed} for −{wanted}");
    assert!(sinking.abs() < 1e-9, "{sinking}");
}

/// Bristles hold a block on an incline below the angle of friction: it does not creep, and their force is its weight.
#[test]
fn bristles_hold_without_creep() {
    let scene = Holds::<f64>::default();
    let mut run = run!(&scene, 1e-12, |_: &mut SVector<f64, 8>| {});
    run.step(2.0).expect("it moves");
    let before = *run.y();
    run.step(2.0).expect("it holds");
    let y = run.y().as_slice();
    let (along, across) = weights();
    let (moved, depth) = along_and_above(y);
    let (was, _) = along_and_above(before.as_slice());
    assert!((moved - was).abs() < 1e-12, "{} in 2 s", moved - was);
    let (deflection, depth) = (y[6].hypot(y[7]), -depth);
    let elastic = STIFFNESS * depth.powf(1.5);
    let held = elastic * BRISTLES * deflection;
    assert!((held - along).abs() < 1e-8, "{held} N for {along} N");
    let pushed = elastic + 0.75 * BRISTLES * deflection.powi(2) * elastic / depth;
    assert!((pushed - across).abs() < 1e-8, "{pushed} N for {across} N");
    assert!(deflection < 0.5 / BRISTLES, "within the limit of friction");
    // It slipped by as much as the bristles deflect while it sank.
    assert!(moved < 0.0 && moved > -0.1, "{moved}");
}

/// Above the angle of friction the block slides, as Coulomb's law says with the elastic part of the normal force.
#[test]
fn bristles_slide_above_the_angle_of_friction() {
    let scene = Slides::<f64>::default();
    let mut run = run!(&scene, 1e-12, |_: &mut SVector<f64, 8>| {});
    run.step(1.0).expect("it moves");
    let (first, _) = along_and_above(&run.y().as_slice()[3..]);
    run.step(1.0).expect("it slides");
    let y = run.y().as_slice();
    let (second, _) = along_and_above(&y[3..]);
    let (_, height) = along_and_above(y);
    let (along, _) = weights();
    let elastic = STIFFNESS * (-height).powf(1.5);
    let wanted = -(along - 0.2 * elastic) / MASS;
    assert!(
        (second - first - wanted).abs() < 1e-8,
        "{} for {wanted}",
        second - first
    );
    // Bristles push with ¾ μ²/(σ₀ δ) of the elastic force: 2 % here.
    let coulomb = -G * (1.0 - 0.2 * 3.0) / 10.0_f64.sqrt();
    assert!(
        (wanted / coulomb - 1.0).abs() < 0.02,
        "{wanted} for {coulomb}"
    );
}
