//! The record of a run: its points, and how they were computed.

use bgdyn_codegen::scene::{Integration, StepControl};
use bgdyn_codegen::system::SceneEquations;
use bgdyn_sim::Audit;

use super::plant::Numbers;

/// The usual number of output points.
pub const POINTS: usize = 1001;

/// A recorded quantity of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// Its name.
    pub name: String,
    /// Its SI unit; empty for a pure number.
    pub unit: &'static str,
}

impl Column {
    /// Returns its header in a table: `slide [m]`.
    pub(crate) fn head(&self) -> String {
        headed(&self.name, self.unit)
    }
}

/// Returns a name with its unit, 1 for a pure number: `slide [m]`.
pub(crate) fn headed(name: &str, unit: &str) -> String {
    format!("{name} [{}]", if unit.is_empty() { "1" } else { unit })
}

/// Returns the parts of a scene's state, in the order of y.
pub(crate) fn state_columns(system: &SceneEquations) -> Vec<Column> {
    let layout = &system.scene.layout;
    let column = |name: &str, unit| Column {
        name: name.to_owned(),
        unit,
    };
    let positions = layout.positions.iter();
    let places = positions.map(|p| column(&p.name, p.dimension.si()));
    let all = layout.coordinates.iter();
    let rates = all.map(|c| column(&c.rate_name, c.dimensions[1].si()));
    let states = layout.states.iter();
    let states = states.map(|s| column(&s.name, s.dimension.si()));
    places.chain(rates).chain(states).collect()
}

/// Returns the recorded quantities of a scene: its outputs, or its whole state if it names none.
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
    /// The forces of the rigid contacts, N along (x, y, normal): the mean ones in the step up to this instant, or, from
    /// event to event, those at this instant.
    pub contacts: Vec<[f64; 3]>,
    /// Whether it is a row for an event or for the end, and no output point.
    pub extra: bool,
}

/// The energy account at the end of a step, J, all entries together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EnergyAt {
    /// Time, s.
    pub t: f64,
    /// Energy supplied from outside.
    pub supplied: f64,
    /// Increase of stored energy since the start.
    pub stored: f64,
    /// Dissipated energy.
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
    /// What rigid contacts did, if they are solved from event to event.
    pub contacts: Vec<ContactEvent>,
}

/// What a rigid contact did at an event.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactEvent {
    /// The contact, in the order of the scene's.
    pub contact: usize,
    /// What it did: "bounces", "opens", "sticks".
    pub text: &'static str,
    /// Its normal impulse, N·s; 0 without an impact.
    pub impulse: f64,
}

/// How well the rigid contacts of a run were solved.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ContactQuality {
    /// The deepest overlap at the end of a step, m.
    pub depth: f64,
    /// The largest residual of the impulses of a step or an impact, N·s.
    pub residual: f64,
    /// The number of steps whose residual does not meet the tolerance.
    pub unsolved: usize,
    /// The number of impacts at which Newton's law would have added energy, so that Poisson's was taken.
    pub by_poisson: usize,
}

/// The record of a run.
#[derive(Clone, Debug)]
pub struct Record {
    /// The output points, with rows at events between them.
    pub rows: Vec<Row>,
    /// The energy account at ends of steps, at most one between two points; empty without an account.
    pub energy: Vec<EnergyAt>,
    /// Number of steps, including steps up to events.
    pub steps: usize,
    /// Events that changed a mode.
    pub events: Vec<Event>,
    /// Number of kinks of laws that were passed.
    pub kinks: usize,
    /// Time at the end, s.
    pub t: f64,
    /// State at the end, in positions and velocities.
    pub y: Numbers,
    /// Modes at the end.
    pub modes: Numbers,
    /// The energy account, J.
    pub audit: Audit<Numbers>,
    /// The largest energy that moved or could have moved at any of the points, J: supplied, increase of
    /// stored energy, dissipated, or energy of the motion; at least 1e-12 of the stored energy.
    pub moved: f64,
    /// How well the rigid contacts were solved, in a scene with some.
    pub contacts: Option<ContactQuality>,
    /// The reason for an early end.
    pub failure: Option<String>,
}

/// The settings of a run.
#[derive(Clone, Copy, Debug)]
pub struct Way {
    /// Integrator, steps, end.
    pub integration: Integration,
    /// Number of equally spaced output points from 0 to the end; at least 2.
    pub points: usize,
    /// Whether the run has an energy account.
    pub audited: bool,
}

impl Way {
    /// Returns settings for an error far below that of this run: half the step, a tenth of the tolerance.
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
