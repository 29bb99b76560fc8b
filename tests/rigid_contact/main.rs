//! Rigid contact by time stepping and from event to event, against closed forms: bouncing, sliding, sticking, rolling,
//! rocking, collision, rest.

mod balls;
mod biases;
mod drops;
mod events;
mod laws;
mod planar;
mod rest;
mod sliding;
mod studies;

bgdyn::bgdyn!("bounces.scene.yaml");
bgdyn::bgdyn!("bowls.scene.yaml");
bgdyn::bgdyn!("across.scene.yaml");
bgdyn::bgdyn!("sticks.scene.yaml");
bgdyn::bgdyn!("rolls.scene.yaml");
bgdyn::bgdyn!("slips.scene.yaml");
bgdyn::bgdyn!("rocks.scene.yaml");
bgdyn::bgdyn!("collides.scene.yaml");
bgdyn::bgdyn!("tumbles.scene.yaml");
bgdyn::bgdyn!("falls.scene.yaml");
bgdyn::bgdyn!("jams.scene.yaml");
bgdyn::bgdyn!("lands.scene.yaml");
bgdyn::bgdyn!("../../specs/contact/quadruped_rigid.scene.yaml");

use bgdyn_sim::{Moreau, Run, ScenePlant};

/// Weight per mass, m/s².
const G: f64 = 9.81;

/// A run of a scene in steps for rigid contacts.
type Stepped<'a, S> = Run<ScenePlant<'a, S, f64>, Moreau<f64>>;

/// Returns a run of a scene, from a changed start.
macro_rules! start {
    ($scene:expr, $change:expr) => {{
        let mut start = bgdyn_sim::Run::begin($scene);
        let change = $change;
        change(&mut start.y);
        let plant = bgdyn_sim::ScenePlant::with_slope($scene);
        bgdyn_sim::Run::by(bgdyn_sim::Moreau::new(), plant, start)
    }};
}
pub(crate) use start;

/// Goes on for a time, in this many steps. Every step must be solved.
fn advance<S: bgdyn::runtime::HybridSystem<f64>>(
    run: &mut Stepped<'_, S>,
    time: f64,
    steps: usize,
) {
    for _ in 0..steps {
        run.step(time / steps as f64).expect("it goes on");
        let contacts = run.contact_step().expect("rigid contacts");
        assert!(
            contacts.solved,
            "at {} s: residual {}",
            run.t(),
            contacts.residual
        );
    }
}
