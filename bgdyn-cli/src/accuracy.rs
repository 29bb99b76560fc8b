//! Accuracy studies by the evaluator: errors are measured, times are estimated from the number of calls.

use std::cell::Cell;
use std::rc::Rc;

use bgdyn_accuracy::generate::{ALL_BUT, kinked, levels, measured, operations, own_way};
use bgdyn_accuracy::{
    Call, Contender, CountSteps, Integrate, Measured, Priced, Ran, Runner, STEPS_METHOD,
    StepControl, Subject, order,
};
use bgdyn_codegen::method::Role;
use bgdyn_codegen::system::System;
use bgdyn_runtime::Dd;
use bgdyn_sim::{INTEGRATORS, Jacobian, Plant, Power, with_integrator};

use crate::simulate::{Evaluated, Form, Numbers, Undefined};
use crate::timing::estimate;

/// The method of references.
const REFERENCE: &str = "extrapolation12";
/// Tolerances of the reference and of the coarser one: the evaluator's plant is in `f64`.
const TOLERANCES: (f64, f64) = (1e-14, 1e-12);

/// What one call of each function takes in compiled code, ns: an estimate.
#[derive(Clone, Copy, Debug)]
struct Calls {
    /// Operations of `derivative`.
    operations: usize,
    derivative: f64,
    rates: f64,
    slopes: f64,
    events: f64,
}

impl Calls {
    fn of(system: &System) -> Self {
        let roles = system.roles_with(true, false);
        let one = |role: Role| match roles.contains(&role) {
            true => estimate(system.function(role).operations()),
            false => 0.0,
        };
        let inputs = one(Role::Inputs);
        let derivative = one(Role::Derivative);
        Calls {
            operations: operations(system),
            derivative,
            rates: derivative + inputs,
            slopes: one(Role::Jacobian),
            events: one(Role::Events) + inputs,
        }
    }
}

/// A scene through the evaluator that adds up what its calls would take.
#[derive(Clone, Debug)]
struct Counted {
    plant: Rc<Evaluated<'static>>,
    calls: Calls,
    /// ns so far.
    spent: Rc<Cell<f64>>,
}

impl Counted {
    /// The scene: it stays, since a study is the program's last act.
    fn new(system: System) -> Self {
        let calls = Calls::of(&system);
        let system = Box::leak(Box::new(system));
        Counted {
            plant: Rc::new(Evaluated::new(system, Form::Natural, true)),
            calls,
            spent: Rc::default(),
        }
    }

    fn spend(&self, ns: f64) {
        self.spent.set(self.spent.get() + ns);
    }

    /// What a call and a run cost.
    fn price(&self, effects: &str) -> Priced {
        let counted = self.clone();
        Priced {
            effects: effects.to_owned(),
            operations: self.calls.operations,
            call: Call::Estimated(self.calls.derivative),
            steps: Box::new(move |end| {
                let run = CountSteps {
                    plant: counted.clone(),
                    begin: counted.plant.begin(),
                    end,
                };
                with_integrator(STEPS_METHOD, run).expect("a method of bgdyn-sim")
            }),
        }
    }

    /// Runs it by a method of this name.
    fn runner(&self, method: &str) -> Runner {
        let (counted, method) = (self.clone(), method.to_owned());
        Box::new(move |grid, step_control| {
            counted.spent.set(0.0);
            let run = Integrate {
                plant: counted.clone(),
                begin: counted.plant.begin(),
                grid,
                step_control,
            };
            let values = with_integrator(&method, run).expect("a method of bgdyn-sim")?;
            Ran::finite(values, Some(counted.spent.get()))
        })
    }
}

type Tried<T> = Result<T, Undefined>;

impl Plant for Counted {
    type State = Numbers;
    type Modes = Numbers;
    type Values = Numbers;
    type Entries = Numbers;
    type Error = Undefined;

    fn rates(&self, t: f64, y: &Numbers, modes: &Numbers) -> Tried<Numbers> {
        self.spend(self.calls.rates);
        self.plant.rates(t, y, modes)
    }

    fn jacobian(&self, t: f64, y: &Numbers, modes: &Numbers) -> Option<Tried<Jacobian<Numbers>>> {
        self.spend(self.calls.slopes);
        self.plant.jacobian(t, y, modes)
    }

    fn positions(&self) -> usize {
        self.plant.positions()
    }

    fn position_rates(&self, t: f64, y: &Numbers, modes: &Numbers) -> Tried<Numbers> {
        self.plant.position_rates(t, y, modes)
    }

    fn events(&self, t: f64, y: &Numbers, modes: &Numbers) -> Tried<Numbers> {
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
    ) -> Tried<(Numbers, Numbers)> {
        self.plant.change(t, y, modes, fell)
    }

    fn nothing(&self) -> Numbers {
        self.plant.nothing()
    }

    fn energy(&self, t: f64, y: &Numbers, modes: &Numbers) -> Tried<Numbers> {
        self.plant.energy(t, y, modes)
    }

    fn power(&self, t: f64, y: &Numbers, modes: &Numbers) -> Tried<Power<Numbers>> {
        self.plant.power(t, y, modes)
    }
}

impl Measured for Counted {
    fn measured(&self, t: f64, y: &Numbers, modes: &Numbers) -> Vec<f64> {
        self.plant.output(t, y, modes)
    }
}

/// The scene as a subject; `None` where it has nothing to measure.
pub(crate) fn subject(system: &System, end: Option<f64>) -> Option<Subject> {
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
    let mut subject = Subject::new(words, end, method, step_control);
    subject.kinked = kinked(&full);
    subject.tolerances = TOLERANCES;
    let levels = levels(&full);
    let counted = Counted::new(full);
    let reference = counted.runner(REFERENCE);
    subject.reference = Some(Box::new(move |grid, tolerance| {
        let ran = reference(grid, StepControl::Tolerance(tolerance))?;
        let row = |row: Vec<f64>| row.into_iter().map(Dd::from_f64).collect();
        Ok(ran.values.into_iter().map(row).collect())
    }));
    for method in INTEGRATORS.iter().filter(|m| **m != REFERENCE) {
        let (order, controlled) = order(method)?;
        subject.contenders.push(Contender {
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
    subject.add_level("all", counted.runner(method));
    subject.prices.push(counted.price("all"));
    for level in levels {
        match level.system {
            Some(system) => {
                let counted = Counted::new(system);
                subject.add_level(&level.effects, counted.runner(method));
                if level.effects.starts_with(ALL_BUT) {
                    subject.prices.push(counted.price(&level.effects));
                }
            }
            None => subject.missing_level(&level.effects),
        }
    }
    Some(subject)
}
