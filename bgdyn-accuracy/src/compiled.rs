//! Compiled scenes as configurations of a study.

use std::hint::black_box;
use std::rc::Rc;

use bgdyn_runtime::{Canonical, Dd, FixedVector, HybridSystem, Slope};
use bgdyn_sim::{
    CanonicalPlant, Dopri5, Extrapolation12, HybridState, INTEGRATORS, Integrator, Moreau, Of,
    Plant, Real, Rk4, Run, ScenePlant, StateVector, WithIntegrator, with_integrator,
};

use crate::configuration::{Configuration, Grid, RunError, Runner, Samples, StepControl};
use crate::dyn_plant::{DynPlant, PlantObject};
use crate::integrate::{Integrate, Measured, numbers};
use crate::scheme::Scheme;
use crate::test_case::{References, TestCase, has_law, order};

/// Name of the equations with the default formulations.
const CHEAPEST: &str = "cheapest";

/// Returns a configuration with this integrator's order and step control.
fn configuration(
    method: &str,
    scalar: (&'static str, f64),
    formulation: &str,
    run: Runner,
) -> Configuration {
    let (order, controlled) = order(method).expect("a method of bgdyn-sim");
    Configuration {
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

/// A plant behind a pointer, with its start.
type Started<Y, M, E> = Contender<DynPlant<Y, M, E>>;

/// The same as the integrators of a scheme meet it.
type StartedBy<C, Y, M, E> = Contender<<C as Scheme>::Scene<DynPlant<Y, M, E>>>;

/// A plant with its start.
struct Contender<P: Plant> {
    plant: P,
    begin: HybridState<P::State, P::Modes>,
}

impl<Y, M, E> Started<Y, M, E>
where
    Y: FixedVector<Scalar: Real> + 'static,
    M: FixedVector + 'static,
    E: FixedVector<Scalar = Of<Y>> + 'static,
{
    fn new(plant: impl PlantObject<Y, M, E> + 'static, begin: HybridState<Y, M>) -> Rc<Self> {
        let plant = DynPlant(Rc::new(plant));
        Rc::new(Contender { plant, begin })
    }

    /// Returns the same as the integrators of a scheme meet it.
    fn by<C: Scheme>(&self, _: C) -> Rc<StartedBy<C, Y, M, E>> {
        let (plant, begin) = C::scene((self.plant.clone(), self.begin));
        Rc::new(Contender { plant, begin })
    }
}

impl<P> Contender<P>
where
    P: Measured + Clone + 'static,
    Of<P::State>: Real,
{
    /// Runs the plant with any integrator.
    fn integrate<'g>(&self, grid: &'g Grid, step_control: StepControl) -> Integrate<'g, P> {
        Integrate {
            plant: self.plant.clone(),
            begin: black_box(self.begin.clone()),
            grid,
            step_control: black_box(step_control),
        }
    }

    /// Returns the runner of a contender with an integrator.
    fn runner<I: Integrator<P::State>>(
        self: &Rc<Self>,
        integrator: impl Fn() -> I + 'static,
    ) -> Runner {
        let started = self.clone();
        Box::new(move |grid, step_control| {
            let run = started.integrate(grid, step_control);
            Samples::finite(numbers(run.with(integrator())?), None)
        })
    }

    /// Returns the runner of a configuration with the integrator of this name.
    fn runner_by_name(self: &Rc<Self>, name: &'static str) -> Runner {
        let started = self.clone();
        Box::new(move |grid, step_control| {
            let run = started.integrate(grid, step_control);
            let values = with_integrator(name, run).expect("a name of the list");
            Samples::finite(numbers(values?), None)
        })
    }
}

impl<P> Contender<P>
where
    P: Measured + Clone + 'static,
    P::State: StateVector<Scalar = Dd>,
{
    /// Returns the reference: order 12 with controlled steps.
    fn reference(self: Rc<Self>) -> References {
        Box::new(move |grid, tolerance| {
            let run = self.integrate(grid, StepControl::Tolerance(tolerance));
            run.with(Extrapolation12::default())
        })
    }
}

/// Leaks a scene: studies are few and their scenes small.
fn leak<S: 'static>(scene: S) -> &'static S {
    Box::leak(Box::new(scene))
}

/// The integrator of the reference, which is no contender.
const REFERENCE: &str = "extrapolation12";

impl TestCase {
    /// Sets the reference: order 12 in double-double with controlled steps.
    pub fn reference<S: HybridSystem<Dd> + 'static>(&mut self, scene: S, scheme: impl Scheme) {
        let scene = leak(scene);
        let started = Started::new(ScenePlant::new(scene), Run::begin(scene));
        self.reference = Some(started.by(scheme).reference());
    }

    /// Adds every integrator of bgdyn-sim except that of the reference; `moreau` takes the scene as it is, and only with Newton's law
    /// of impacts.
    pub fn methods<S: Slope<f64> + 'static>(&mut self, scene: S, scheme: impl Scheme) {
        let scene = leak(scene);
        let started = Started::new(ScenePlant::with_slope(scene), Run::begin(scene));
        let others = started.by(scheme);
        let law = HybridSystem::impact_law(scene);
        let all = INTEGRATORS.iter().filter(|name| **name != REFERENCE);
        for name in all.filter(|name| has_law(name, law)) {
            let run = match *name {
                "moreau" => started.runner(Moreau::new),
                name => others.runner_by_name(name),
            };
            self.configurations
                .push(configuration(name, F64, CHEAPEST, run));
        }
    }

    /// Adds Gauss–Legendre integrators of the canonical form.
    pub fn momenta<S: Canonical<f64> + 'static>(&mut self, scene: S) {
        let scene = leak(scene);
        let plant = CanonicalPlant::new(scene);
        let mut begin = Run::begin(scene);
        begin.y = plant.to_canonical(begin.t, &begin.y, &begin.modes);
        let started = Started::new(plant, begin);
        for name in ["midpoint", "gauss2", "gauss3"] {
            let run = started.runner_by_name(name);
            let method = format!("canonical_{name}");
            self.configurations
                .push(configuration(&method, F64, "canonical", run));
        }
    }

    /// Adds two integrators in `f32`: an explicit one, and one with step control; from event to event `moreau` in its place,
    /// as the instants of events in `f32` have errors that estimates of steps take for theirs.
    pub fn single<S: HybridSystem<f32> + 'static, C: Scheme>(&mut self, scene: S, scheme: C) {
        let scene = leak(scene);
        let started = Started::new(ScenePlant::new(scene), Run::begin(scene));
        let second: (&str, Runner) = match C::BY_EVENTS {
            true => ("moreau", started.runner(Moreau::new)),
            false => ("dopri5", started.runner(|| Dopri5)),
        };
        let both = [("rk4", started.by(scheme).runner(|| Rk4)), second];
        let law = HybridSystem::impact_law(scene);
        for (method, run) in both.into_iter().filter(|both| has_law(both.0, law)) {
            self.configurations
                .push(configuration(method, F32, CHEAPEST, run));
        }
    }

    /// Adds the scene's rates by another formulation, with the classical Runge–Kutta method.
    pub fn formulation<S: HybridSystem<f64> + 'static>(
        &mut self,
        name: &str,
        scene: S,
        scheme: impl Scheme,
    ) {
        let scene = leak(scene);
        let started = Started::new(ScenePlant::new(scene), Run::begin(scene));
        let run = started.by(scheme).runner(|| Rk4);
        self.configurations
            .push(configuration("rk4", F64, name, run));
    }

    /// Adds the scene with these effects, with the scene's own explicit integrator.
    pub fn ablation<S: HybridSystem<f64> + 'static, I: Integrator<S::State>>(
        &mut self,
        effects: &str,
        scene: S,
        scheme: impl Scheme,
        integrator: impl Fn() -> I + 'static,
    ) {
        let scene = leak(scene);
        let started = Started::new(ScenePlant::new(scene), Run::begin(scene));
        self.add_ablation(effects, started.by(scheme).runner(integrator));
    }

    /// Adds the same with an integrator that needs slopes.
    pub fn ablation_with_slope<S: Slope<f64> + 'static, I: Integrator<S::State>>(
        &mut self,
        effects: &str,
        scene: S,
        scheme: impl Scheme,
        integrator: impl Fn() -> I + 'static,
    ) {
        let scene = leak(scene);
        let started = Started::new(ScenePlant::with_slope(scene), Run::begin(scene));
        self.add_ablation(effects, started.by(scheme).runner(integrator));
    }

    /// Adds a set of effects without which the measured output does not exist.
    pub fn missing_ablation(&mut self, effects: &str) {
        let run: Runner = Box::new(|_, _| {
            let why = "the measured output is not there".into();
            Err(RunError { t: 0.0, why })
        });
        self.add_ablation(effects, run);
    }

    /// Adds a set of effects, run by the scene's own integrator.
    pub fn add_ablation(&mut self, effects: &str, run: Runner) {
        let ablation = configuration(&self.own.0, F64, CHEAPEST, run);
        self.ablations.push(Configuration {
            effects: effects.into(),
            ..ablation
        });
    }
}
