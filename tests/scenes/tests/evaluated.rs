//! Checks that runs by the engines, tapes and machine code, equal those of the compiled scenes, digit by digit.

use std::fs;
use std::path::{Path, PathBuf};

use bgdyn_cli::simulate::{Evaluated, Form, Numbers};
use bgdyn_codegen::engine::Engine;
use bgdyn_codegen::files::{beside, stem};
use bgdyn_codegen::read_scene;
use bgdyn_codegen::system::SceneEquations;
use bgdyn_codegen::tape::Tape;
use bgdyn_jit::Jit;
use bgdyn_sim::{
    CanonicalPlant, Gauss2, HybridState, Integrator, Rk4, Rodas4, Run, ScenePlant, StateVector,
};
use scenes::{hydraulic_cylinder, scara_everything, stick_slip, stiff_spring_pendulum};

/// A scene of the repository, by its name.
fn read(name: &str) -> SceneEquations {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../specs/scenes");
    let path: PathBuf = folder.join(format!("{name}.scene.yaml"));
    let text = fs::read_to_string(&path).expect("a scene's file");
    let load = |file: &str| fs::read_to_string(beside(&path, file)).map_err(|e| e.to_string());
    let (system, _) = read_scene(&text, &stem(&path), load).expect("a sound scene");
    system
}

/// Runs both with steps of `h` and compares state, modes, events and the energy account.
macro_rules! alike {
    ($compiled:expr, $evaluated:expr, $h:expr, $steps:expr) => {
        let (mut compiled, mut evaluated) = ($compiled, $evaluated);
        for step in 0..$steps {
            compiled.step($h).expect("the compiled scene goes on");
            evaluated.step($h).expect("the evaluated scene goes on");
            let states = (compiled.y().entries(), evaluated.y().entries());
            assert_eq!(states.0, states.1, "state after step {step}");
            let modes = (compiled.modes().entries(), evaluated.modes().entries());
            assert_eq!(modes.0, modes.1, "modes after step {step}");
        }
        assert_eq!(compiled.events, evaluated.events);
        assert_eq!(compiled.last_event, evaluated.last_event);
        assert_eq!(compiled.kinks, evaluated.kinks);
        let (one, other) = (compiled.audit(), evaluated.audit());
        assert_eq!(one.supplied.entries(), other.supplied.entries());
        assert_eq!(one.stored.entries(), other.stored.entries());
        assert_eq!(one.dissipated.entries(), other.dissipated.entries());
    };
}

/// Returns the engines of this machine.
fn engines() -> Vec<Box<dyn Engine>> {
    let mut all: Vec<Box<dyn Engine>> = vec![Box::new(Tape)];
    match Jit::new() {
        Ok(jit) => all.push(Box::new(jit)),
        Err(why) => println!("no machine code: {why}"),
    }
    all
}

fn evaluated<'a, M: Integrator<Numbers>>(
    engine: &dyn Engine,
    method: M,
    system: &'a SceneEquations,
    (form, slopes): (Form, bool),
) -> Run<Evaluated<'a>, M> {
    let plant = Evaluated::new(engine, system, form, slopes);
    assert_eq!(plant.engine(), engine.name());
    let begin = plant.begin();
    Run::by(method, plant, begin)
}

#[test]
fn with_events() {
    for engine in engines() {
        let scene = stick_slip::StickSlip::<f64>::default();
        let system = read("stick_slip");
        let other = evaluated(&*engine, Rk4, &system, (Form::Natural, false));
        alike!(Run::new(&scene), other, 1e-3, 2000);

        let scene = scara_everything::ScaraEverything::<f64>::default();
        let system = read("scara_everything");
        let other = evaluated(&*engine, Rk4, &system, (Form::Natural, false));
        alike!(Run::new(&scene), other, 2e-4, 2000);
    }
}

#[test]
fn with_slopes() {
    for engine in engines() {
        let scene = hydraulic_cylinder::HydraulicCylinder::<f64>::default();
        let compiled = Run::by(Rodas4, ScenePlant::with_slope(&scene), Run::begin(&scene));
        let system = read("hydraulic_cylinder");
        let other = evaluated(&*engine, Rodas4, &system, (Form::Natural, true));
        alike!(compiled, other, 1e-5, 500);
    }
}

#[test]
fn in_momenta() {
    for engine in engines() {
        let scene = stiff_spring_pendulum::StiffSpringPendulum::<f64>::default();
        let plant = CanonicalPlant::new(&scene);
        let HybridState { t, y, modes } = Run::begin(&scene);
        let y = plant.to_canonical(t, &y, &modes);
        let compiled = Run::by(Gauss2::new(), plant, HybridState { t, y, modes });
        let system = read("stiff_spring_pendulum");
        let other = evaluated(&*engine, Gauss2::new(), &system, (Form::Canonical, false));
        alike!(compiled, other, 5e-5, 500);
    }
}
