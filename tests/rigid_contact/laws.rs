//! Newton's and Poisson's laws of restitution at an impact where they differ.

use bgdyn_sim::event_driven::{ContactModes, ImpactLaw};
use bgdyn_sim::{Dop853, EventDriven, HybridState, Run, ScenePlant, Tolerance};

use crate::G;
use crate::lands::Lands;
use crate::planar::Y;

/// The angle of the rod at its impact, rad.
const ANGLE: f64 = 1.1;
/// The place of the rod's lower end, from its centre.
const ARM: [f64; 2] = [-0.5, 0.0];
/// The inertia of the rod, of 1 kg and 1 m, about its centre, kg·m².
const INERTIA: f64 = 1.0 / 12.0;

/// Returns the lower end from the centre along fixed axes, and its velocity.
fn end_of(y: &Y) -> ([f64; 2], [f64; 2]) {
    let (sin, cos) = y[2].sin_cos();
    let turned = |[a, b]: [f64; 2]| [cos * a - sin * b, sin * a + cos * b];
    let (arm, v) = (turned(ARM), turned([y[3], y[4]]));
    (arm, [v[0] - y[5] * arm[1], v[1] + y[5] * arm[0]])
}

/// Returns the velocity of the lower end after its first impact: the rod falls from 100 mm with 1 m/s forward, without a spin.
fn landed(law: Option<ImpactLaw>) -> [f64; 2] {
    let scene = Lands::<f64>::default();
    let HybridState { t, mut y, modes } = Run::<ScenePlant<'_, _, f64>>::begin(&scene);
    y[1] = 0.1 + 0.5 * ANGLE.sin();
    y[2] = ANGLE;
    let (sin, cos) = ANGLE.sin_cos();
    (y[3], y[4]) = (cos, -sin);
    let mut plant = EventDriven::new(ScenePlant::new(&scene));
    if let Some(law) = law {
        plant.law = law;
    }
    let modes = ContactModes::open(modes);
    let tolerance = Tolerance {
        absolute: 1e-12,
        relative: 1e-12,
    };
    let run = Run::by(Dop853, plant, HybridState { t, y, modes });
    let mut run = run.with_tolerance(tolerance);
    while run.events == 0 {
        run.advance_densely(1.0).expect("it falls");
    }
    end_of(run.y()).1
}

/// The end sticks in compression and in expansion. With G of the contact, Poisson's law leaves −e (γ_n − (G_tn/G_tt) γ_t), and
/// Newton's −e γ_n.
#[test]
fn a_scene_names_the_law_of_its_impacts() {
    let arm = [-0.5 * ANGLE.cos(), -0.5 * ANGLE.sin()];
    let (along, across) = (1.0 + arm[1] * arm[1] / INERTIA, -arm[0] * arm[1] / INERTIA);
    let before = [1.0, -(2.0 * G * 0.1).sqrt()];
    let wanted = [
        (None, -0.6 * (before[1] - across / along * before[0])),
        (
            Some(ImpactLaw::Poisson),
            -0.6 * (before[1] - across / along * before[0]),
        ),
        (Some(ImpactLaw::Newton), -0.6 * before[1]),
    ];
    for (law, wanted) in wanted {
        let [sliding, rising] = landed(law);
        assert!(
            sliding.abs() < 1e-9 && (rising - wanted).abs() < 1e-9,
            "{law:?}: {sliding:e}, {rising}, {wanted}"
        );
    }
}
