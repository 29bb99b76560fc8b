//! The checked scene: a mechanism with the effects of a run, its inputs, start and integration.
//!
//! Only [`check`] can construct a [`Scene`]; nothing later checks again or fails on what a user
//! wrote.

mod ablate;
mod causality;
mod check;
mod closed_start;
mod control;
mod integration;
mod overrides;
mod profile;
mod signal;
mod waveform;

use bgdyn_runtime::Dd;

pub use crate::declaration::Chain;
use crate::declaration::Element;
use crate::fault::Location;
use crate::fault::wording;
use crate::format::{Located, Raw};
pub use crate::layout::{
    DependentJoint, InitialValueAs, Level, MomentumStore, QuasiJoint, StateCoordinate,
    StateFollower, StateLayout, StatePosition, Variable,
};
use crate::math::Ring;
use crate::mechanism::{Mechanism, Parameter};
pub use causality::Solved;
pub(crate) use check::sketch;
pub use check::{Verdict, check, check_alone, integral_name, limit_events, with_controller_model};
pub use control::Control;
pub use integration::{Integration, IntegratorName, StepControl};
pub use overrides::{Override, OverrideKind};
pub use signal::{InputSource, PoseHold, PoseTarget};
pub use waveform::{Piece, Waveform};

/// A scene that passed every check.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// Its name: a snake_case identifier, the module's name.
    pub name: String,
    /// What the file says of it.
    pub description: Option<String>,
    /// The mechanism, locked joints welded.
    pub mechanism: Mechanism,
    /// The effects called for, those whose laws run first in front.
    pub elements: Vec<Element>,
    /// Elements in series, with one flow through all.
    pub chains: Vec<Chain>,
    /// What the state is made of.
    pub layout: StateLayout,
    /// Run-time parameters: the mechanism's, then the effects'.
    pub parameters: Vec<Parameter>,
    /// What drives each input.
    pub drives: Vec<InputSource>,
    /// The least and the largest value of each input, where it has limits.
    pub limits: Vec<Option<[Dd; 2]>>,
    /// How controllers are sampled; `None` if they are continuous.
    pub control: Option<Control>,
    /// The scene of which computed torques are the efforts; `None` if it is this one.
    pub controller_model: Option<Box<Scene>>,
    /// Initial positions, velocities and first-order states.
    pub initial: Initial,
    /// What is wanted of it, by name.
    pub outputs: Vec<Located<String>>,
    /// How it is run.
    pub integration: Integration,
    /// What the file says of inputs and initial values, for scenes with fewer effects.
    written: FileEntries,
}

/// Entries as they stand in the file.
#[derive(Clone, Debug, PartialEq)]
struct FileEntries {
    inputs: Vec<Raw>,
    effort_limits: Option<Raw>,
    control: Option<Raw>,
    initial: Vec<Raw>,
    /// The mechanism before effects change its links.
    unloaded: Mechanism,
    /// The modes that a start in place of the file's states; nothing where the file's is the start.
    modes: Option<Vec<usize>>,
}

impl Scene {
    /// The instants, s, at which an input bends, in increasing order.
    pub fn corners(&self) -> Vec<f64> {
        let all = self.drives.iter().flat_map(InputSource::corners);
        let mut corners: Vec<f64> = all.map(Dd::to_f64).collect();
        corners.sort_by(f64::total_cmp);
        corners.dedup();
        corners
    }

    /// Where the mode with this number is stated: in the file, or for a start in place of the file's.
    /// Nothing where it is left to the run.
    pub fn stated_mode(&self, mode: usize) -> Option<Location> {
        if let Some(modes) = &self.written.modes {
            return modes.contains(&mode).then(Location::file);
        }
        let name = mode_name(&self.layout.modes[mode]);
        let mut all = self.written.initial.iter();
        all.find(|raw| raw.name.value == name)
            .map(|raw| raw.name.location.clone())
    }
}

/// The name of a mode as a part of the state.
pub fn mode_name(part: &Variable) -> String {
    format!("{}_mode", part.name)
}

/// Where a run begins.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Initial {
    /// Positions.
    pub q: Vec<Dd>,
    /// Velocities.
    pub v: Vec<Dd>,
    /// First-order states as the scene gives them: of a fluid volume, its pressure.
    pub x: Vec<Dd>,
    /// Modes.
    pub modes: Vec<Dd>,
}

impl QuasiJoint {
    /// Returns what is wrong with a quaternion of this length.
    pub fn wrong_length(&self, length: f64) -> String {
        wording::length_of_quaternion(&self.name, self.any_length, length)
    }
}

/// Returns the unit quaternion x, y, z, w of turns about the fixed axes x, then y, then z, rad.
pub fn quaternion_of_rpy(rpy: [Dd; 3]) -> [Dd; 4] {
    quaternion_of_half_turns(rpy.map(|angle| (angle * Dd::from_f64(0.5)).sin_cos()))
}

/// Returns the same for the sines and cosines of half of each angle.
pub(crate) fn quaternion_of_half_turns<E: Ring>(halves: [(E, E); 3]) -> [E; 4] {
    let [(sx, cx), (sy, cy), (sz, cz)] = halves;
    [
        cz * cy * sx - sz * sy * cx,
        cz * sy * cx + sz * cy * sx,
        sz * cy * cx - cz * sy * sx,
        cz * cy * cx + sz * sy * sx,
    ]
}
