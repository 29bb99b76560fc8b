//! Accuracy studies of compiled scenes with rigid contacts: every integrator of the list, and the reference, against the
//! closed form of a bouncing ball.

use bgdyn_accuracy::{ByEvents, Configuration, Dd, Grid, StepControl, TestCase};

use crate::G;
use crate::bounces::Bounces;

const GRID: Grid = Grid {
    end: 1.5,
    samples: 10,
};

/// Returns the height of the ball's centre at a time, m: it falls 0.5 m, and each impact leaves 0.8 of the speed.
fn height(t: f64) -> f64 {
    let mut speed = (2.0 * G * 0.5_f64).sqrt();
    let mut since = t - speed / G;
    if since < 0.0 {
        return 0.61 - 0.5 * G * t * t;
    }
    loop {
        speed *= 0.8;
        let flight = 2.0 * speed / G;
        if since < flight {
            return 0.11 + (speed - 0.5 * G * since) * since;
        }
        since -= flight;
    }
}

/// Returns the largest distance of samples from the closed form, m.
fn error(samples: impl IntoIterator<Item = f64>) -> f64 {
    let times = (1..=GRID.samples).map(|k| GRID.interval() * k as f64);
    let errors = times.zip(samples).map(|(t, z)| (z - height(t)).abs());
    errors.fold(0.0, f64::max)
}

/// Returns the error of a configuration's run.
fn error_of(configuration: &Configuration, step_control: StepControl) -> f64 {
    let run = (configuration.run)(&GRID, step_control).expect("a run");
    error(run.values.into_iter().map(|row| row[0]))
}

#[test]
fn integrators_of_studies_go_from_event_to_event() {
    let words = ["bounces", "", "base_z", "m"];
    let mut case = TestCase::new(words, GRID.end, "moreau", StepControl::Step(1e-3));
    case.methods(Bounces::<f64>::default(), ByEvents);
    case.single(Bounces::<f32>::default(), ByEvents);
    case.reference(Bounces::<Dd>::default(), ByEvents);
    let reference = case.reference.as_ref().expect("a reference");
    let samples = reference(&GRID, 1e-20).expect("a run");
    assert_eq!(samples.len(), GRID.samples);
    let of_reference = error(samples.iter().map(|row| row[0].to_f64()));
    assert!(of_reference < 1e-14, "{of_reference}");
    assert!(case.configurations.len() > 10);
    for configuration in &case.configurations {
        let (step, name) = (StepControl::Step(1.5e-3), configuration.method.as_str());
        // The ball flies on a parabola, which methods from order 2 on follow exactly.
        match (name, configuration.scalar) {
            // Of order 1 by the impacts.
            ("moreau" | "semi_implicit_euler", _) => {
                let coarse = error_of(configuration, StepControl::Step(1.5e-2));
                let fine = error_of(configuration, step);
                assert!(coarse > 3.0 * fine, "{name}: {coarse} {fine}");
                assert!((1e-5..2e-2).contains(&fine), "{name}: {fine}");
            }
            (_, "f32") => {
                let found = error_of(configuration, step);
                assert!(found < 1e-3, "{name} in f32: {found}");
            }
            _ => {
                let control = match configuration.controlled {
                    true => StepControl::Tolerance(1e-9),
                    false => step,
                };
                let found = error_of(configuration, control);
                assert!(found < 1e-11, "{name}: {found}");
            }
        }
    }
}

/// Where contacts are closed the rates are those with their forces: the ball that rests keeps its height.
#[test]
fn formulations_and_effects_of_studies_do_the_same() {
    let words = ["bounces", "", "base_z", "m"];
    let mut case = TestCase::new(words, GRID.end, "rk4", StepControl::Step(1e-3));
    case.formulation("recursion", Bounces::<f64>::default(), ByEvents);
    case.ablation("all", Bounces::<f64>::default(), ByEvents, || {
        bgdyn_sim::Rk4
    });
    case.price("all", 1, Bounces::<f64>::default(), ByEvents);
    let runs = case.configurations.iter().chain(&case.ablations);
    for configuration in runs {
        let late = Grid {
            end: 6.0,
            samples: 2,
        };
        let run = (configuration.run)(&late, StepControl::Step(0.1)).expect("a run");
        let rests = run.values[1][0];
        assert!((rests - 0.11).abs() < 1e-10, "{rests}");
        let found = error_of(configuration, StepControl::Step(1e-2));
        assert!(found < 1e-11, "{found}");
    }
    let steps = (case.prices[0].steps)(GRID.end).expect("a run");
    assert!((3..2000).contains(&steps), "{steps}");
}
