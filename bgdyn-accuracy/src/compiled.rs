//! Compiled scenes as contenders of a study.

use std::hint::black_box;
use std::rc::Rc;

use bgdyn_runtime::{Canonical, Dd, FixedVector, HybridSystem, Slope};
use bgdyn_sim::{
    CanonicalPlant, Dopri5, Extrapolation12, HybridState, INTEGRATORS, Integrator, Of, Real, Rk4,
    Run, ScenePlant, StateVector, WithIntegrator, with_integrator,
};

use crate::contender::{Contender, Grid, Ran, Runner, StepControl, Stop};
use crate::erased::{Callable, Erased};
use crate::integrate::{Integrate, Measured, numbers};
use crate::subject::{Subject, order};

/// What equations are called that are written as they are by default.
const CHEAPEST: &str = "cheapest";

/// A contender of this method's order and way to go.
fn contender(
    method: &str,
    scalar: (&'static str, f64),
    formulation: &str,
    run: Runner,
) -> Contender {
    let (order, controlled) = order(method).expect("a method of bgdyn-sim");
    Contender {
        effects: "all".into(),
        method: method.into(),
        order,
        controlled,
        scalar: scalar.0,
        epsilon: scalar.1,
        formulation: formulation.into(),
        run,
    }
}

const F64: (&str, f64) = ("f64", f64::EPSILON);
const F32: (&str, f64) = ("f32", f32::EPSILON as f64);

impl<S: HybridSystem<T>, T: Real> Measured for ScenePlant<'_, S, T> {
    fn measured(&self, t: T, y: &S::State, modes: &S::Modes) -> Vec<T> {
        self.output(t, y, modes).entries().to_vec()
    }
}

impl<S: Canonical<T>, T: Real> Measured for CanonicalPlant<'_, S, T> {
    fn measured(&self, t: T, z: &S::State, modes: &S::Modes) -> Vec<T> {
        match self.to_natural(t, z, modes) {
            Ok(y) => Measured::measured(&self.natural, t, &y, modes),
            Err(_) => vec![T::from_f64(f64::NAN); S::Outputs::LEN],
        }
    }
}

/// A plant as it is run: where it begins, and how.
struct Started<Y: StateVector, M, E> {
    plant: Erased<Y, M, E>,
    begin: HybridState<Y, M>,
}

impl<Y, M, E> Started<Y, M, E>
where
    Y: FixedVector<Scalar: Real> + 'static,
    M: FixedVector + 'static,
    E: FixedVector<Scalar = Of<Y>> + 'static,
{
    fn new(plant: impl Callable<Y, M, E> + 'static, begin: HybridState<Y, M>) -> Rc<Self> {
        let plant = Erased(Rc::new(plant));
        Rc::new(Started { plant, begin })
    }

    /// A run that any integrator can make.
    fn integrate<'g>(
        &self,
        grid: &'g Grid,
        step_control: StepControl,
    ) -> Integrate<'g, Erased<Y, M, E>> {
        Integrate {
            plant: self.plant.clone(),
            begin: black_box(self.begin),
            grid,
            step_control: black_box(step_control),
        }
    }

    /// Runs by an integrator, for a contender.
    fn runner<I: Integrator<Y>>(self: &Rc<Self>, integrator: impl Fn() -> I + 'static) -> Runner {
        let started = self.clone();
        Box::new(move |grid, step_control| {
            let run = started.integrate(grid, step_control);
            Ran::finite(numbers(run.with(integrator())?), None)
        })
    }

    /// Runs by the integrator of this name, for a contender.
    fn runner_by_name(self: &Rc<Self>, name: &'static str) -> Runner {
        let started = self.clone();
        Box::new(move |grid, step_control| {
            let run = started.integrate(grid, step_control);
            let values = with_integrator(name, run).expect("a name of the list");
            Ran::finite(numbers(values?), None)
        })
    }
}

/// A scene that stays: studies are few and their scenes small.
fn kept<S: 'static>(scene: S) -> &'static S {
    Box::leak(Box::new(scene))
}

/// The integrator of the reference, which is no contender.
const REFERENCE: &str = "extrapolation12";

impl Subject {
    /// The reference: order 12 in double-double by controlled steps.
    pub fn reference<S: HybridSystem<Dd> + 'static>(&mut self, scene: S) {
        let scene = kept(scene);
        let started = Started::new(ScenePlant::new(scene), Run::begin(scene));
        self.reference = Some(Box::new(move |grid, tolerance| {
            let run = started.integrate(grid, StepControl::Tolerance(tolerance));
            run.with(Extrapolation12::default())
        }));
    }

    /// Every integrator of bgdyn-sim but the reference's.
    pub fn methods<S: Slope<f64> + 'static>(&mut self, scene: S) {
        let scene = kept(scene);
        let started = Started::new(ScenePlant::with_slope(scene), Run::begin(scene));
        for name in INTEGRATORS.iter().filter(|name| **name != REFERENCE) {
            let run = started.runner_by_name(name);
            self.contenders.push(contender(name, F64, CHEAPEST, run));
        }
    }

    /// Gauss–Legendre methods on the canonical form.
    pub fn momenta<S: Canonical<f64> + 'static>(&mut self, scene: S) {
        let scene = kept(scene);
        let plant = CanonicalPlant::new(scene);
        let mut begin = Run::begin(scene);
        begin.y = plant.to_canonical(begin.t, &begin.y, &begin.modes);
        let started = Started::new(plant, begin);
        for name in ["midpoint", "gauss2", "gauss3"] {
            let run = started.runner_by_name(name);
            let method = format!("canonical_{name}");
            self.contenders
                .push(contender(&method, F64, "canonical", run));
        }
    }

    /// An explicit and a controlled method in `f32`.
    pub fn single<S: HybridSystem<f32> + 'static>(&mut self, scene: S) {
        let scene = kept(scene);
        let started = Started::new(ScenePlant::new(scene), Run::begin(scene));
        let runs: [(&str, Runner); 2] = [
            ("rk4", started.runner(|| Rk4)),
            ("dopri5", started.runner(|| Dopri5)),
        ];
        for (method, run) in runs {
            self.contenders.push(contender(method, F32, CHEAPEST, run));
        }
    }

    /// The scene's rates by another formulation, by the classical Runge–Kutta method.
    pub fn formulation<S: HybridSystem<f64> + 'static>(&mut self, name: &str, scene: S) {
        let scene = kept(scene);
        let started = Started::new(ScenePlant::new(scene), Run::begin(scene));
        let run = started.runner(|| Rk4);
        self.contenders.push(contender("rk4", F64, name, run));
    }

    /// The scene with these effects, by an explicit method: the scene's own.
    pub fn level<S: HybridSystem<f64> + 'static, I: Integrator<S::State>>(
        &mut self,
        effects: &str,
        scene: S,
        integrator: impl Fn() -> I + 'static,
    ) {
        let scene = kept(scene);
        let started = Started::new(ScenePlant::new(scene), Run::begin(scene));
        self.add_level(effects, started.runner(integrator));
    }

    /// The same by a method that takes slopes.
    pub fn level_with_slope<S: Slope<f64> + 'static, I: Integrator<S::State>>(
        &mut self,
        effects: &str,
        scene: S,
        integrator: impl Fn() -> I + 'static,
    ) {
        let scene = kept(scene);
        let started = Started::new(ScenePlant::with_slope(scene), Run::begin(scene));
        self.add_level(effects, started.runner(integrator));
    }

    /// A level of effects at which the measured output is not there.
    pub fn missing_level(&mut self, effects: &str) {
        let run: Runner = Box::new(|_, _| {
            let why = "the measured output is not there".into();
            Err(Stop { t: 0.0, why })
        });
        self.add_level(effects, run);
    }

    /// A level of effects by the scene's own method.
    pub fn add_level(&mut self, effects: &str, run: Runner) {
        let level = contender(&self.own.0, F64, CHEAPEST, run);
        self.levels.push(Contender {
            effects: effects.into(),
            ..level
        });
    }
}
