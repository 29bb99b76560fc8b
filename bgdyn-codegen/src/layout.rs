//! The layout of a scene's state vector: positions, coordinates, first-order states, modes, inputs.

mod dependents;
mod followers;
mod quasi_joints;
mod references;

use std::collections::BTreeSet;
use std::ops::Range;

use bgdyn_runtime::{Dd, QuasiJointKind};

use crate::mechanism::CoordinateId;
use crate::unit::Dimension;
pub use references::Level;

/// A coordinate: a joint's, or one that an effect adds.
#[derive(Clone, Debug, PartialEq)]
pub struct StateCoordinate {
    /// Its name.
    pub name: String,
    /// The store of its momentum.
    pub store: MomentumStore,
    /// The position whose rate is its velocity. `None` for a motor's current, whose charge is not part of
    /// the state, and for a quasi-velocity.
    pub position: Option<usize>,
    /// The dimensions of position, velocity and effort.
    pub dimensions: [Dimension; 3],
    /// Name of the velocity: `shoulder_rate`, `motor_current`; of a quasi-velocity `base_x_velocity`.
    pub rate_name: String,
    /// The coordinate whose initial position is its default.
    pub starts_with: Option<String>,
}

impl StateCoordinate {
    /// Returns whether it is the velocity of a motion, not a motor's current.
    pub fn moves(&self) -> bool {
        self.position.is_some() || self.is_quasi_velocity()
    }

    /// Returns what its velocity is, with its unit.
    pub fn about_velocity(&self) -> String {
        let axes = match self.is_quasi_velocity() {
            true => " in link axes",
            false => "",
        };
        let unit = self.dimensions[1].si();
        format!("velocity of `{}`{axes}, {unit}", self.name)
    }

    /// Returns whether it is a quasi-velocity: a velocity of a joint that is not the rate of a position.
    pub fn is_quasi_velocity(&self) -> bool {
        self.position.is_none() && matches!(self.store, MomentumStore::Links(_))
    }
}

impl StatePosition {
    /// Returns what it is, with its unit.
    pub fn about(&self) -> String {
        match self.dimension.si() {
            "" => format!("component `{}` of a unit quaternion", self.name),
            unit => format!("position of `{}`, {unit}", self.name),
        }
    }
}

/// A position of the state.
#[derive(Clone, Debug, PartialEq)]
pub struct StatePosition {
    /// Its name.
    pub name: String,
    /// Its dimension.
    pub dimension: Dimension,
    /// The coordinate whose velocity is its rate; `None` for a position of a [`QuasiJoint`], whose rates
    /// are q̇ = N(q) v, for that of a [`DependentJoint`], and for that of a joint whose velocity alone follows others.
    pub coordinate: Option<usize>,
    /// Its value in the neutral position.
    pub neutral: Dd,
}

/// A joint with quasi-velocities: planar, spherical, floating.
#[derive(Clone, Debug, PartialEq)]
pub struct QuasiJoint {
    /// Its name.
    pub name: String,
    /// Its type, for its integration.
    pub kind: QuasiJointKind,
    /// Its positions.
    pub positions: Range<usize>,
    /// Its coordinates.
    pub coordinates: Range<usize>,
    /// Index of the first position of its quaternion x, y, z, w, if it has one.
    pub quaternion: Option<usize>,
    /// Whether its quaternion may have any length in the file.
    pub any_length: bool,
}

/// A joint that follows others: its position is Σ ratio · q + offset, its velocity Σ ratio · v.
#[derive(Clone, Debug, PartialEq)]
pub struct StateFollower {
    /// Its name.
    pub name: String,
    /// The positions that its own follows, with ratios; its own position with ratio 1 if it has one.
    pub positions: Vec<(usize, Dd)>,
    /// Its position where the others' are 0, rad or m.
    pub offset: Dd,
    /// The coordinates whose velocities its own follows, with ratios.
    pub leaders: Vec<(usize, Dd)>,
    /// The dimensions of its position, velocity and effort.
    pub dimensions: [Dimension; 3],
}

/// A velocity of a joint that follows from the independent ones through a loop or a contact.
#[derive(Clone, Debug, PartialEq)]
pub struct DependentJoint {
    /// Its name.
    pub name: String,
    /// The position whose rate it is; `None` for a quasi-velocity.
    pub position: Option<usize>,
    /// Its index in the open tree.
    pub velocity: CoordinateId,
    /// The dimensions of its position, velocity and effort.
    pub dimensions: [Dimension; 3],
    /// Name of its velocity.
    pub rate_name: String,
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
    /// For inputs: the index of the dependent joint whose drive it is.
    pub drives_dependent: Option<usize>,
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
            drives_dependent: None,
            follows: None,
            entered: None,
        }
    }
}

/// The layout of a scene's state.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StateLayout {
    /// Positions: those of the joints, then those of other coordinates.
    pub positions: Vec<StatePosition>,
    /// The joints with quasi-velocities, in the order of their positions.
    pub quasi_joints: Vec<QuasiJoint>,
    /// The joints that follow others: they have no velocity in the state.
    pub followers: Vec<StateFollower>,
    /// The joints whose velocities follow from others through loops: they have no velocity in the state.
    pub dependents: Vec<DependentJoint>,
    /// Names of the loops and contacts.
    pub loops: Vec<String>,
    /// The positions that change where loops close and wheels touch, each with its loop or contact.
    pub closing: Vec<(usize, usize)>,
    /// Velocities: joints, then other coordinates with positions, then currents.
    pub coordinates: Vec<StateCoordinate>,
    /// First-order states.
    pub states: Vec<Variable>,
    /// Modes: −1 and 1 slipping, 0 stuck.
    pub modes: Vec<Variable>,
    /// Inputs.
    pub inputs: Vec<Variable>,
    /// Names of the prescribed joints, whose position, rate and acceleration are inputs.
    pub prescribed: Vec<String>,
    /// Event functions; an event occurs where one falls through zero.
    pub events: Vec<Variable>,
    /// Names of the elements that are rigid contacts.
    pub rigid_contacts: Vec<String>,
}

impl StateLayout {
    /// Returns the joint that follows others and has this name, or this name of its velocity, with the names of those that
    /// it follows; `None` if there is none.
    pub fn follower_of(&self, name: &str) -> Option<(&str, Vec<&str>)> {
        let joint = name.strip_suffix("_rate").unwrap_or(name);
        let named = |one: &&StateFollower| one.name == name || one.name == joint;
        let one = self.followers.iter().find(named)?;
        let leaders = one.leaders.iter();
        let leaders = leaders.map(|(j, _)| self.coordinates[*j].name.as_str());
        Some((&one.name, leaders.collect()))
    }

    /// Adds a coordinate with this name and a store of its own.
    pub fn coordinate(
        &mut self,
        name: &str,
        rate_name: String,
        stored: bool,
        dimensions: [Dimension; 3],
    ) {
        // Currents follow the velocities of motions.
        let at = match stored {
            true => self.motions(),
            false => self.coordinates.len(),
        };
        let coordinate = StateCoordinate {
            name: name.to_owned(),
            store: MomentumStore::Own(name.to_owned()),
            position: stored.then_some(self.positions.len()),
            dimensions,
            rate_name,
            starts_with: None,
        };
        if stored {
            self.positions.push(StatePosition {
                name: name.to_owned(),
                dimension: dimensions[0],
                coordinate: Some(at),
                neutral: Dd::ZERO,
            });
        }
        for input in &mut self.inputs {
            input.drives = input.drives.map(|j| if j >= at { j + 1 } else { j });
        }
        self.coordinates.insert(at, coordinate);
    }

    /// Adds a coordinate at the scale of another one, whose initial position is its default: a joint's
    /// drive.
    pub fn coordinate_beside(&mut self, name: &str, other: &str) {
        let Some(dimensions) = self.dimensions_of(other) else {
            return;
        };
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

    /// Adds the input that is the drive of a dependent joint in a loop, by its index.
    pub fn drive_dependent(&mut self, joint: usize, about: String) {
        let DependentJoint {
            name, dimensions, ..
        } = self.dependents[joint].clone();
        self.inputs.push(Variable {
            drives_dependent: Some(joint),
            follows: Some(name.clone()),
            ..Variable::new(name, dimensions[2], about)
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

    /// Returns the mode that an event may change; `None` if the law only has a kink.
    pub fn mode_of(&self, event: &Variable) -> Option<usize> {
        self.modes.iter().position(|m| m.name == event.name)
    }

    /// Returns the coordinate with this name.
    pub fn coordinate_named(&self, name: &str) -> Option<usize> {
        self.coordinates.iter().position(|c| c.name == name)
    }

    /// Returns a name that two parts of the state, or two inputs, have.
    pub fn repeated(&self) -> Option<&str> {
        let mut state = self.state_names();
        let mut inputs = self.inputs.iter().map(|p| p.name.as_str());
        let (mut in_state, mut in_inputs) = (BTreeSet::new(), BTreeSet::new());
        let twice = state.find(|name| !in_state.insert(*name));
        twice.or_else(|| inputs.find(|name| !in_inputs.insert(*name)))
    }

    /// Returns the names of positions, velocities and first-order states, in the order of the state.
    pub fn state_names(&self) -> impl Iterator<Item = &str> {
        let positions = self.positions.iter().map(|p| p.name.as_str());
        let rates = self.coordinates.iter().map(|c| c.rate_name.as_str());
        let states = self.states.iter().map(|p| p.name.as_str());
        positions.chain(rates).chain(states)
    }

    /// Returns the number of positions.
    pub fn nq(&self) -> usize {
        self.positions.len()
    }

    /// Returns the number of coordinates that are motions: all but currents, which are the last ones.
    pub fn motions(&self) -> usize {
        self.coordinates.iter().filter(|c| c.moves()).count()
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
