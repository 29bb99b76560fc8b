//! Compliant contact against closed forms: impacts, creep and hold on an incline, a ball that slides until it rolls,
//! two balls that collide; methods of contacts, compiled.

mod balls;
mod block;
mod impact;
mod methods;

bgdyn::bgdyn!("damped.scene.yaml");
bgdyn::bgdyn!("linear.scene.yaml");
bgdyn::bgdyn!("restored.scene.yaml");
bgdyn::bgdyn!("creeps.scene.yaml");
bgdyn::bgdyn!("holds.scene.yaml");
bgdyn::bgdyn!("slides.scene.yaml");
bgdyn::bgdyn!("bowling.scene.yaml");
bgdyn::bgdyn!("collision.scene.yaml");
bgdyn::bgdyn!("frictionless.scene.yaml");

/// Weight per mass, m/s².
const G: f64 = 9.81;

/// A run of a scene by `Dop853` with this tolerance, from a changed start.
macro_rules! run {
    ($scene:expr, $tolerance:expr, $change:expr) => {{
        let mut start = bgdyn_sim::Run::begin($scene);
        let change = $change;
        change(&mut start.y);
        let plant = bgdyn_sim::ScenePlant::new($scene);
        let run = bgdyn_sim::Run::by(bgdyn_sim::Dop853, plant, start);
        run.with_tolerance(bgdyn_sim::Tolerance {
            absolute: $tolerance,
            relative: $tolerance,
        })
    }};
}
pub(crate) use run;
