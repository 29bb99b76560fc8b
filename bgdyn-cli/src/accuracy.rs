//! Accuracy studies without a compiler: errors are measured, times are estimated from the number of calls.

use std::cell::Cell;
use std::rc::Rc;

use bgdyn_accuracy::generate::{ALL_BUT, ablations, kinked, measured, operations, own_way};
use bgdyn_accuracy::{
    AsItIs, ByEvents, Call, Configuration, CountSteps, Grid, Integrate, Measured, PlantAtStart,
    Priced, RunError, Runner, STEPS_METHOD, Samples, Scheme, StepControl, TestCase, has_law, order,
};
use bgdyn_codegen::engine::Engine;
use bgdyn_codegen::method::SceneFunction;
use bgdyn_codegen::system::SceneEquations;
use bgdyn_runtime::{ContactMap, Dd, ImpactLaw, QuasiJoint, RigidContact};
use bgdyn_sim::{INTEGRATORS, Integrator, Jacobian, Plant, Power, WithIntegrator, with_integrator};

use crate::simulate::{Evaluated, Evaluation, Form, Numbers, Undefined};
use crate::timing::estimate;

/// The integrator of references.
const REFERENCE: &str = "extrapolation12";
/// Tolerances of the reference and of the coarser one: functions are computed in `f64`.
const TOLERANCES: (f64, f64) = (1e-14, 1e-12);

/// The estimated time of one call of each function in compiled code, ns.
#[derive(Clone, Copy, Debug)]
struct Calls {
    /// Operations of `derivative`.
    operations: usize,
    derivative: f64,
    rates: f64,
    slopes: f64,
    events: f64,
    contact_states: f64,
    contact_maps: f64,
    contact_biases: f64,
}

impl Calls {
    fn of(system: &SceneEquations) -> Self {
        let roles = system.roles_with(true, false);
        let one = |role: SceneFunction| match roles.contains(&role) {
            true => estimate(system.function(role).operations()),
            false => 0.0,
        };
        let inputs = one(SceneFunction::Inputs);
        let derivative = one(SceneFunction::Derivative);
        Calls {
            operations: operations(system),
            derivative,
            rates: derivative + inputs,
            slopes: one(SceneFunction::Jacobian),
            events: one(SceneFunction::Events) + inputs,
            contact_states: one(SceneFunction::RigidContactStates) + inputs,
            contact_maps: one(SceneFunction::RigidContactMaps) + inputs,
            contact_biases: one(SceneFunction::RigidContactBiases) + inputs,
        }
    }
}

/// A scene that sums the estimated times of its calls.
#[derive(Clone, Debug)]
struct Counted {
    plant: Rc<Evaluated<'static>>,
    calls: Calls,
    /// Estimated time so far, ns.
    spent: Rc<Cell<f64>>,
}

impl Counted {
    /// Leaks the scene: a study is the last action of the program.
    fn new(engine: &dyn Engine, system: SceneEquations) -> Self {
        let calls = Calls::of(&system);
        let system = Box::leak(Box::new(system));
        Counted {
            plant: Rc::new(Evaluated::new(engine, system, Form::Natural, true)),
            calls,
            spent: Rc::default(),
        }
    }

    fn spend(&self, ns: f64) {
        self.spent.set(self.spent.get() + ns);
    }

    /// Returns the cost of a call and of a run.
    fn price(&self, effects: &str) -> Priced {
        let counted = self.clone();
        Priced {
            effects: effects.to_owned(),
            operations: self.calls.operations,
            call: Call::Estimated(self.calls.derivative),
            steps: Box::new(move |end| {
                let count = StepsOf {
                    counted: &counted,
                    end,
                };
                with_integrator(STEPS_METHOD, count).expect("a method of bgdyn-sim")
            }),
        }
    }

    /// Returns the runner with the integrator of this name.
    fn runner(&self, method: &str) -> Runner {
        let (counted, method) = (self.clone(), method.to_owned());
        Box::new(move |grid, step_control| {
            counted.spent.set(0.0);
            let run = RunOf {
                counted: &counted,
                grid,
                step_control,
            };
            let values = with_integrator(&method, run).expect("a method of bgdyn-sim")?;
            Samples::finite(values, Some(counted.spent.get()))
        })
    }

    /// Returns the scene and its start.
    fn at_start(&self) -> PlantAtStart<Self> {
        (self.clone(), self.plant.begin())
    }

    /// Returns whether an integrator takes the scene from event to event: it has rigid contacts, for whose impulses the
    /// integrator does not solve.
    fn goes_by_events(&self, method: &impl Integrator<Numbers>) -> bool {
        self.rigid_contacts() > 0 && !method.solves_contacts()
    }
}

/// A run of a scene, from event to event if it has to.
struct RunOf<'a> {
    counted: &'a Counted,
    grid: &'a Grid,
    step_control: StepControl,
}

impl RunOf<'_> {
    fn by<C: Scheme, M: Integrator<Numbers>>(self, method: M) -> Result<Vec<Vec<f64>>, RunError> {
        let (plant, begin) = C::scene(self.counted.at_start());
        let run = Integrate {
            plant,
            begin,
            grid: self.grid,
            step_control: self.step_control,
        };
        run.with(method)
    }
}

impl WithIntegrator<Numbers> for RunOf<'_> {
    type Output = Result<Vec<Vec<f64>>, RunError>;

    fn with<M: Integrator<Numbers>>(self, method: M) -> Self::Output {
        match self.counted.goes_by_events(&method) {
            true => self.by::<ByEvents, M>(method),
            false => self.by::<AsItIs, M>(method),
        }
    }
}

/// The steps of a scene's run, from event to event if it has to.
struct StepsOf<'a> {
    counted: &'a Counted,
    end: f64,
}

impl StepsOf<'_> {
    fn by<C: Scheme, M: Integrator<Numbers>>(self, method: M) -> Result<usize, RunError> {
        let (plant, begin) = C::scene(self.counted.at_start());
        let end = self.end;
        CountSteps { plant, begin, end }.with(method)
    }
}

impl WithIntegrator<Numbers> for StepsOf<'_> {
    type Output = Result<usize, RunError>;

    fn with<M: Integrator<Numbers>>(self, method: M) -> Self::Output {
        match self.counted.goes_by_events(&method) {
            true => self.by::<ByEvents, M>(method),
            false => self.by::<AsItIs, M>(method),
        }
    }
}

impl Plant for Counted {
    type State = Numbers;
    type Modes = Numbers;
    type Values = Numbers;
    type Entries = Numbers;
    type Error = Undefined;

    fn rates(&self, t: f64, y: &Numbers, modes: &Numbers) -> Evaluation<Numbers> {
        self.spend(self.calls.rates);
        self.plant.rates(t, y, modes)
    }

    fn jacobian(
        &self,
        t: f64,
        y: &Numbers,
        modes: &Numbers,
    ) -> Option<Evaluation<Jacobian<Numbers>>> {
        self.spend(self.calls.slopes);
        self.plant.jacobian(t, y, modes)
    }

    fn positions(&self) -> usize {
        self.plant.positions()
    }

    fn position_rates(&self, t: f64, y: &Numbers, modes: &Numbers) -> Evaluation<Numbers> {
        self.plant.position_rates(t, y, modes)
    }

    fn position_change(&self, t: f64, y: &Numbers, modes: &Numbers, h: f64) -> Evaluation<Numbers> {
        self.plant.position_change(t, y, modes, h)
    }

    fn quasi_joints(&self) -> Option<&[QuasiJoint]> {
        self.plant.quasi_joints()
    }

    fn project(&self, t: f64, y: &mut Numbers, modes: &Numbers) -> Evaluation<bool> {
        self.plant.project(t, y, modes)
    }

    fn project_in_two(
        &self,
        t: f64,
        y: (&mut Numbers, &mut Numbers),
        modes: &Numbers,
    ) -> Evaluation<bool> {
        self.plant.project_in_two(t, y, modes)
    }

    fn strays(&self, y: &Numbers) -> bool {
        self.plant.strays(y)
    }

    fn rigid_contacts(&self) -> usize {
        self.plant.rigid_contacts()
    }

    fn impact_law(&self) -> ImpactLaw {
        self.plant.impact_law()
    }

    fn rigid_contact_entry(&self, contact: usize) -> usize {
        self.plant.rigid_contact_entry(contact)
    }

    fn rigid_contact_states(
        &self,
        t: f64,
        y: &Numbers,
        modes: &Numbers,
        contacts: &mut [RigidContact<f64>],
    ) -> Evaluation<()> {
        self.spend(self.calls.contact_states);
        self.plant.rigid_contact_states(t, y, modes, contacts)
    }

    fn rigid_contact_maps(
        &self,
        t: f64,
        y: &Numbers,
        modes: &Numbers,
        maps: &mut [Option<ContactMap<Numbers>>],
    ) -> Evaluation<()> {
        self.spend(self.calls.contact_maps);
        self.plant.rigid_contact_maps(t, y, modes, maps)
    }

    fn rigid_contact_biases(
        &self,
        t: f64,
        y: &Numbers,
        modes: &Numbers,
        biases: &mut [[f64; 3]],
    ) -> Evaluation<()> {
        self.spend(self.calls.contact_biases);
        self.plant.rigid_contact_biases(t, y, modes, biases)
    }

    fn events(&self, t: f64, y: &Numbers, modes: &Numbers) -> Evaluation<Numbers> {
        self.spend(self.calls.events);
        self.plant.events(t, y, modes)
    }

    fn changes_mode(&self, event: usize) -> bool {
        self.plant.changes_mode(event)
    }

    fn change(
        &self,
        t: f64,
        y: &Numbers,
        modes: &Numbers,
        fell: impl Fn(usize) -> bool,
    ) -> Evaluation<(Numbers, Numbers)> {
        self.plant.change(t, y, modes, fell)
    }

    fn jump_losses(&self, modes: &Numbers) -> impl Iterator<Item = (usize, f64)> {
        self.plant.jump_losses(modes)
    }

    fn most_events(&self) -> usize {
        self.plant.most_events()
    }

    fn resolve_stiction(
        &self,
        t: f64,
        y: &Numbers,
        modes: &Numbers,
        rest: f64,
    ) -> Evaluation<Option<(Numbers, Numbers)>> {
        self.plant.resolve_stiction(t, y, modes, rest)
    }

    fn next_corner(&self, t: f64) -> Option<f64> {
        self.plant.next_corner(t)
    }

    fn reached(&mut self, t: f64, y: &Numbers, modes: &Numbers) {
        Rc::make_mut(&mut self.plant).reached(t, y, modes);
    }

    fn nothing(&self) -> Numbers {
        self.plant.nothing()
    }

    fn energy(&self, t: f64, y: &Numbers, modes: &Numbers) -> Evaluation<Numbers> {
        self.plant.energy(t, y, modes)
    }

    fn power(&self, t: f64, y: &Numbers, modes: &Numbers) -> Evaluation<Power<Numbers>> {
        self.plant.power(t, y, modes)
    }
}

impl Measured for Counted {
    fn measured(&self, t: f64, y: &Numbers, modes: &Numbers) -> Vec<f64> {
        self.plant.output(t, y, modes)
    }

    fn in_words(error: &Undefined) -> String {
        format!("{error:?}")
    }
}

/// Returns the scene as a test case, computed by an engine; `None` if it has nothing to measure.
pub(crate) fn test_case(
    engine: &dyn Engine,
    system: &SceneEquations,
    end: Option<f64>,
) -> Option<TestCase> {
    let full = measured(system)?;
    let scene = &full.scene;
    let (method, step_control) = own_way(&full);
    let words = [
        scene.name.as_str(),
        scene.description.as_deref().unwrap_or_default(),
        scene.outputs[0].value.as_str(),
        full.outputs[0].unit,
    ];
    let end = end.unwrap_or(scene.integration.end);
    let law = scene.integration.impacts;
    let mut test_case = TestCase::new(words, end, method, step_control);
    test_case.kinked = kinked(&full);
    test_case.tolerances = TOLERANCES;
    let ablations = ablations(&full);
    let counted = Counted::new(engine, full);
    let reference = counted.runner(REFERENCE);
    test_case.reference = Some(Box::new(move |grid, tolerance| {
        let ran = reference(grid, StepControl::Tolerance(tolerance))?;
        let row = |row: Vec<f64>| row.into_iter().map(Dd::from_f64).collect();
        Ok(ran.values.into_iter().map(row).collect())
    }));
    let all = INTEGRATORS.iter().filter(|m| **m != REFERENCE);
    for method in all.filter(|m| has_law(m, law)) {
        let (order, controlled) = order(method)?;
        test_case.configurations.push(Configuration {
            effects: "all".into(),
            method: (*method).to_owned(),
            order,
            controlled,
            scalar: "f64",
            epsilon: f64::EPSILON,
            formulation: "cheapest".into(),
            run: counted.runner(method),
        });
    }
    test_case.add_ablation("all", counted.runner(method));
    test_case.prices.push(counted.price("all"));
    for ablation in ablations {
        match ablation.system {
            Some(system) => {
                let counted = Counted::new(engine, system);
                test_case.add_ablation(&ablation.effects, counted.runner(method));
                if ablation.effects.starts_with(ALL_BUT) {
                    test_case.prices.push(counted.price(&ablation.effects));
                }
            }
            None => test_case.missing_ablation(&ablation.effects),
        }
    }
    Some(test_case)
}
