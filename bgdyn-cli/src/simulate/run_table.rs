//! The record of a run: its points, and how they were computed.

use bgdyn_codegen::scene::{Integration, StepControl};
use bgdyn_codegen::system::SceneEquations;
use bgdyn_sim::Audit;

use super::plant::Numbers;

/// A quantity that is told of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// Its name.
    pub name: String,
    /// Its SI unit; nothing for a pure number.
    pub unit: &'static str,
}

impl Column {
    /// What stands above it in a table: `slide [m]`.
    pub(crate) fn head(&self) -> String {
        headed(&self.name, self.unit)
    }
}

/// A name with its unit, 1 for a pure number: `slide [m]`.
pub(crate) fn headed(name: &str, unit: &str) -> String {
    format!("{name} [{}]", if unit.is_empty() { "1" } else { unit })
}

/// The parts of a scene's state, in the order of y.
pub(crate) fn state_columns(system: &SceneEquations) -> Vec<Column> {
    let layout = &system.scene.layout;
    let column = |name: &str, unit| Column {
        name: name.to_owned(),
        unit,
    };
    let stored = layout.coordinates.iter().filter(|c| c.stored);
    let places = stored.map(|c| column(&c.name, c.dimensions[0].si()));
    let all = layout.coordinates.iter();
    let rates = all.map(|c| column(&c.rate_name, c.dimensions[1].si()));
    let states = layout.states.iter();
    let states = states.map(|s| column(&s.name, s.dimension.si()));
    places.chain(rates).chain(states).collect()
}

/// What is told of a scene: its outputs, or its whole state where it names none.
pub fn columns(system: &SceneEquations) -> Vec<Column> {
    if system.outputs.is_empty() {
        return state_columns(system);
    }
    let outputs = system.outputs.iter().map(|output| Column {
        name: output.name.clone(),
        unit: output.unit,
    });
    outputs.collect()
}

/// An instant of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// Time, s.
    pub t: f64,
    /// The columns' values.
    pub values: Vec<f64>,
    /// Positions, velocities, first-order states.
    pub y: Numbers,
    /// The modes.
    pub modes: Numbers,
    /// The inputs, driven ones and 0 for the others.
    pub inputs: Vec<f64>,
    /// Whether it stands here for an event or for the end, not for one of the points asked for.
    pub extra: bool,
}

/// The account of the energy at the end of a step, J, all entries together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EnergyAt {
    /// Time, s.
    pub t: f64,
    /// What came from outside.
    pub supplied: f64,
    /// What is stored more than at the start.
    pub stored: f64,
    /// What was lost.
    pub dissipated: f64,
    /// Stored + dissipated − supplied.
    pub drift: f64,
}

/// An instant at which a mode changed.
#[derive(Clone, Debug, PartialEq)]
pub struct Event {
    /// Time, s.
    pub t: f64,
    /// The modes before it.
    pub before: Numbers,
    /// The modes after it.
    pub after: Numbers,
}

/// What is kept of a run.
#[derive(Clone, Debug)]
pub struct Record {
    /// The points asked for, with rows at events between them.
    pub rows: Vec<Row>,
    /// The energy at ends of steps, one at most between two points; none of a run without account.
    pub energy: Vec<EnergyAt>,
    /// Steps that were taken, those up to events included.
    pub steps: usize,
    /// Events that changed a mode.
    pub events: Vec<Event>,
    /// Kinks of laws that were passed.
    pub kinks: usize,
    /// Where it ended, s.
    pub t: f64,
    /// The state there, in positions and velocities.
    pub y: Numbers,
    /// The modes there.
    pub modes: Numbers,
    /// Where the energy went, J.
    pub audit: Audit<Numbers>,
    /// The most energy that moved or could have at any of the points, J: supplied, stored more than at
    /// the start, dissipated, or held by the motion itself; no less than 1e-12 of what is stored.
    pub moved: f64,
    /// Why it ended early, if it did.
    pub failure: Option<String>,
}

/// How a run is made.
#[derive(Clone, Copy, Debug)]
pub struct Way {
    /// Method, steps, end.
    pub integration: Integration,
    /// At how many evenly spaced points from 0 to the end it is told of; at least 2.
    pub points: usize,
    /// Whether energy is accounted for.
    pub audited: bool,
}

impl Way {
    /// The same run, but for an error far below its own: half the step, a tenth of the tolerance.
    #[must_use]
    pub fn finer(mut self) -> Self {
        self.integration.step_control = match self.integration.step_control {
            StepControl::Step(h) => StepControl::Step(0.5 * h),
            StepControl::Tolerance(tolerance) => StepControl::Tolerance(0.1 * tolerance),
        };
        self.audited = false;
        self
    }
}
