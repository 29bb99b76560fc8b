//! The layout of a scene's state vector: coordinates, first-order states, modes, inputs.

use std::collections::BTreeSet;

use bgdyn_runtime::Dd;

use crate::mechanism::CoordinateId;
use crate::unit::Dimension;

/// A coordinate: a joint's, or one that an effect adds.
#[derive(Clone, Debug, PartialEq)]
pub struct StateCoordinate {
    /// Its name.
    pub name: String,
    /// The store of its momentum.
    pub store: MomentumStore,
    /// Whether its position is part of the state; a motor's charge is not.
    pub stored: bool,
    /// The dimensions of position, velocity and effort.
    pub dimensions: [Dimension; 3],
    /// Name of the velocity: `shoulder_rate`, `motor_current`.
    pub rate_name: String,
    /// The coordinate whose initial position is its default.
    pub starts_with: Option<String>,
}

/// The store of a coordinate's momentum.
#[derive(Clone, Debug, PartialEq)]
pub enum MomentumStore {
    /// The mechanism's links and rotors.
    Links(CoordinateId),
    /// A store of its own, for which the effect's law gives the inertia.
    Own(String),
}

/// A part of the state, an input, an event.
#[derive(Clone, Debug, PartialEq)]
pub struct Variable {
    /// Its name.
    pub name: String,
    /// Its dimension.
    pub dimension: Dimension,
    /// One line of documentation.
    pub about: String,
    /// For inputs: the index of the coordinate whose drive it is.
    pub drives: Option<usize>,
    /// For inputs: the coordinate that a controller on it follows.
    pub follows: Option<String>,
    /// For first-order states: the quantity that a scene gives at the start, if it is not the state
    /// itself.
    pub entered: Option<InitialValueAs>,
}

/// The quantity by which a scene gives the start of a state indirectly: for a fluid volume, its pressure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InitialValueAs {
    /// Its dimension.
    pub dimension: Dimension,
    /// Its least value.
    pub least: Dd,
    /// Advice for smaller values.
    pub way_out: &'static str,
}

impl Variable {
    fn new(name: String, dimension: Dimension, about: String) -> Self {
        Variable {
            name,
            dimension,
            about,
            drives: None,
            follows: None,
            entered: None,
        }
    }
}

/// The layout of a scene's state.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StateLayout {
    /// Velocities: joints, then other coordinates with positions, then currents.
    pub coordinates: Vec<StateCoordinate>,
    /// First-order states.
    pub states: Vec<Variable>,
    /// Modes: −1 and 1 slipping, 0 stuck.
    pub modes: Vec<Variable>,
    /// Inputs.
    pub inputs: Vec<Variable>,
    /// Event functions; an event occurs where one falls through zero.
    pub events: Vec<Variable>,
}

/// Level of a reference's time derivative.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Level {
    /// Its position.
    Position,
    /// Its rate.
    Rate,
    /// Its acceleration.
    Acceleration,
}

impl Level {
    /// Returns the name of a reference's input.
    pub fn name(self, reference: &str) -> String {
        match self {
            Level::Position => reference.to_owned(),
            Level::Rate => format!("{reference}_rate"),
            Level::Acceleration => format!("{reference}_acceleration"),
        }
    }
}

impl StateLayout {
    /// Adds a coordinate with this name and a store of its own.
    pub fn coordinate(
        &mut self,
        name: &str,
        rate_name: String,
        stored: bool,
        dimensions: [Dimension; 3],
    ) {
        let coordinate = StateCoordinate {
            name: name.to_owned(),
            store: MomentumStore::Own(name.to_owned()),
            stored,
            dimensions,
            rate_name,
            starts_with: None,
        };
        // Positions belong to the first velocities.
        let stored_before = self.coordinates.iter().filter(|c| c.stored).count();
        let at = if stored {
            stored_before
        } else {
            self.coordinates.len()
        };
        for input in &mut self.inputs {
            input.drives = input.drives.map(|j| if j >= at { j + 1 } else { j });
        }
        self.coordinates.insert(at, coordinate);
    }

    /// Adds a coordinate at the scale of another one, whose initial position is its default: a joint's
    /// drive.
    pub fn coordinate_beside(&mut self, name: &str, other: &str) {
        let Some(k) = self.coordinate_named(other) else {
            return;
        };
        let dimensions = self.coordinates[k].dimensions;
        self.coordinate(name, format!("{name}_rate"), true, dimensions);
        if let Some(j) = self.coordinate_named(name) {
            self.coordinates[j].starts_with = Some(other.to_owned());
        }
    }

    /// Adds a first-order state.
    pub fn state(&mut self, name: String, dimension: Dimension, about: String) {
        self.states.push(Variable::new(name, dimension, about));
    }

    /// Adds a first-order state that a scene initialises by another quantity, which
    /// [`crate::effect::Effect::initial_state`] converts.
    pub fn state_entered(
        &mut self,
        name: String,
        dimension: Dimension,
        about: String,
        entered: InitialValueAs,
    ) {
        self.states.push(Variable {
            entered: Some(entered),
            ..Variable::new(name, dimension, about)
        });
    }

    /// Adds a mode.
    pub fn mode(&mut self, name: String, about: String) {
        self.modes.push(Variable::new(name, Dimension::One, about));
    }

    /// Adds an input.
    pub fn input(&mut self, name: String, dimension: Dimension, about: String) {
        self.inputs.push(Variable::new(name, dimension, about));
    }

    /// Adds an input that several effects may share: the opening of two valves on one spool.
    pub fn shared_input(&mut self, name: &str, dimension: Dimension, about: String) {
        let same = |i: &Variable| i.name == name && i.dimension == dimension;
        if !self.inputs.iter().any(same) {
            self.input(name.to_owned(), dimension, about);
        }
    }

    /// Adds the input that is the drive of a coordinate: a torque, a voltage. A controller on it follows
    /// the coordinate `follows`.
    pub fn drive(&mut self, name: String, coordinate: &str, follows: &str, about: String) {
        let j = self.coordinates.iter().position(|c| c.name == coordinate);
        let dimension = j.map_or(Dimension::One, |j| self.coordinates[j].dimensions[2]);
        self.inputs.push(Variable {
            drives: j,
            follows: Some(follows.to_owned()),
            ..Variable::new(name, dimension, about)
        });
    }

    /// Adds an input with which a controller can follow a coordinate.
    pub fn control(&mut self, name: String, dimension: Dimension, follows: &str, about: String) {
        self.input(name, dimension, about);
        if let Some(input) = self.inputs.last_mut() {
            input.follows = Some(follows.to_owned());
        }
    }

    /// Adds an event.
    pub fn event(&mut self, name: String, about: String) {
        self.events.push(Variable::new(name, Dimension::One, about));
    }

    /// Adds a moving reference up to a level of its derivatives; several effects may share it.
    pub fn reference(&mut self, name: &str, from: Level, to: Level, dimension: Dimension) {
        for level in [Level::Position, Level::Rate, Level::Acceleration] {
            let own = level.name(name);
            if level < from || level > to || self.inputs.iter().any(|i| i.name == own) {
                continue;
            }
            let about = match level {
                Level::Position => format!("place of the reference `{name}`"),
                Level::Rate => format!("speed of the reference `{name}`"),
                Level::Acceleration => format!("acceleration of the reference `{name}`"),
            };
            let dimension = match (level, dimension) {
                (Level::Position, d) => d,
                (Level::Rate, Dimension::Angle) => Dimension::AngularSpeed,
                (Level::Rate, _) => Dimension::Speed,
                (Level::Acceleration, Dimension::Angle) => Dimension::One,
                (Level::Acceleration, _) => Dimension::Acceleration,
            };
            self.input(own, dimension, about);
        }
    }

    /// Returns the mode that an event may change; `None` if the law only has a kink.
    pub fn mode_of(&self, event: &Variable) -> Option<usize> {
        self.modes.iter().position(|m| m.name == event.name)
    }

    /// Returns the coordinate with this name.
    pub fn coordinate_named(&self, name: &str) -> Option<usize> {
        self.coordinates.iter().position(|c| c.name == name)
    }

    /// Returns the dimension of a coordinate's position; an angle if no coordinate has this name.
    pub fn position_of(&self, name: &str) -> Dimension {
        self.coordinate_named(name)
            .map_or(Dimension::Angle, |j| self.coordinates[j].dimensions[0])
    }

    /// Returns a name that two parts of the state, or two inputs, have.
    pub fn repeated(&self) -> Option<&str> {
        let stored = self.coordinates.iter().filter(|c| c.stored);
        let rates = self.coordinates.iter().map(|c| c.rate_name.as_str());
        let states = self.states.iter().map(|p| p.name.as_str());
        let mut state = stored.map(|c| c.name.as_str()).chain(rates).chain(states);
        let mut inputs = self.inputs.iter().map(|p| p.name.as_str());
        let (mut in_state, mut in_inputs) = (BTreeSet::new(), BTreeSet::new());
        let twice = state.find(|name| !in_state.insert(*name));
        twice.or_else(|| inputs.find(|name| !in_inputs.insert(*name)))
    }

    /// Returns the number of positions.
    pub fn nq(&self) -> usize {
        self.coordinates.iter().filter(|c| c.stored).count()
    }

    /// Returns the number of velocities.
    pub fn nv(&self) -> usize {
        self.coordinates.len()
    }

    /// Returns the number of first-order states.
    pub fn nx(&self) -> usize {
        self.states.len()
    }
}
