//! Overrides of a scene's start: state variables and run-time parameters, by name.

use bgdyn_runtime::Dd;

use super::Scene;
use super::closed_start::{self, motion_of};
use crate::fault::{Faults, Location, unknown_name, wording};

/// A value of a run that can be overridden.
#[derive(Clone, Debug, PartialEq)]
pub struct Override {
    /// Its name.
    pub name: String,
    /// Its SI unit; empty for a pure number.
    pub unit: &'static str,
    /// Its kind.
    pub kind: OverrideKind,
}

/// The kind of a value, with its index in the scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OverrideKind {
    /// A position at the start.
    Position(usize),
    /// A velocity at the start.
    Velocity(usize),
    /// An initial first-order state, in the quantity that the scene gives: for a fluid volume, its
    /// pressure.
    State(usize),
    /// A mode at the start: −1 and 1 slipping, 0 stuck.
    Mode(usize),
    /// A run-time parameter.
    Parameter(usize),
}

impl OverrideKind {
    /// Returns whether it is a run-time parameter, not a part of the state.
    pub fn is_parameter(self) -> bool {
        matches!(self, OverrideKind::Parameter(_))
    }
}

impl Scene {
    /// Returns all values that can be overridden: positions, velocities, first-order states, modes
    /// (`NAME_mode`), run-time parameters.
    pub fn overrides(&self) -> Vec<Override> {
        use OverrideKind::{Mode, Parameter, Position, State, Velocity};
        let layout = &self.layout;
        let one = |name: &str, unit, kind| Override {
            name: name.to_owned(),
            unit,
            kind,
        };
        let coordinates = layout.coordinates.iter().enumerate();
        let positions = layout.positions.iter().enumerate();
        let positions = positions.map(|(i, p)| one(&p.name, p.dimension.si(), Position(i)));
        let velocities =
            coordinates.map(|(j, c)| one(&c.rate_name, c.dimensions[1].si(), Velocity(j)));
        let states = layout.states.iter().enumerate().map(|(i, part)| {
            let dimension = part.entered.map_or(part.dimension, |e| e.dimension);
            one(&part.name, dimension.si(), State(i))
        });
        let modes = layout.modes.iter().enumerate();
        let modes = modes.map(|(i, part)| one(&format!("{}_mode", part.name), "", Mode(i)));
        let parameters = self.parameters.iter().enumerate();
        let parameters = parameters.map(|(i, p)| one(&p.name, p.unit, Parameter(i)));
        positions
            .chain(velocities)
            .chain(states)
            .chain(modes)
            .chain(parameters)
            .collect()
    }

    /// Returns the value with this name among those for which `wanted` is true.
    ///
    /// # Errors
    /// A message with all names, or the nearest one. `what` is the kind of value in the message.
    pub fn override_named(
        &self,
        what: &str,
        name: &str,
        wanted: impl Fn(OverrideKind) -> bool,
    ) -> Result<Override, String> {
        let mut all = self.overrides();
        all.retain(|s| wanted(s.kind));
        let found: Vec<&Override> = all.iter().filter(|s| s.name == name).collect();
        match found.as_slice() {
            [one] => Ok((*one).clone()),
            [] if all.is_empty() => Err(wording::no_such_override(what, name)),
            [] => {
                let names: Vec<&str> = all.iter().map(|s| s.name.as_str()).collect();
                Err(unknown_name(what, name, &names, &names.join(", ")))
            }
            _ => Err(wording::ambiguous_override(name)),
        }
    }

    /// Returns the positions that a part of the pose of a spherical or floating joint sets: `xyz`, `rpy` or
    /// `quaternion`. `None` if there is no such joint or part.
    pub fn pose_overrides(&self, joint: &str, part: &str) -> Option<Vec<Override>> {
        let joint = self.layout.quasi_joints.iter().find(|j| j.name == joint)?;
        let quaternion = joint.quaternion?;
        let positions = match part {
            "xyz" if joint.positions.start < quaternion => joint.positions.start..quaternion,
            "rpy" | "quaternion" => quaternion..quaternion + 4,
            _ => return None,
        };
        let one = |i: usize| Override {
            name: self.layout.positions[i].name.clone(),
            unit: self.layout.positions[i].dimension.si(),
            kind: OverrideKind::Position(i),
        };
        Some(positions.map(one).collect())
    }

    /// Returns the scene with these values, SI units, in place of those in its file. A drive without a
    /// position in the file starts with its joint; modes that are not among the values are determined
    /// again.
    ///
    /// # Errors
    /// Invalid values of a state.
    pub fn with_overrides(&self, values: &[(Override, Dd)]) -> Result<Scene, Faults> {
        let mut scene = self.clone();
        let mut faults = Faults::default();
        // The modes in the file are valid only for the start in the file.
        let modes = values.iter().filter_map(|(s, _)| match s.kind {
            OverrideKind::Mode(i) => Some(i),
            _ => None,
        });
        if !values.is_empty() {
            scene.written.modes = Some(modes.collect());
        }
        for (overrides, value) in values {
            let value = *value;
            match overrides.kind {
                OverrideKind::Position(j) => scene.initial.q[j] = value,
                OverrideKind::Velocity(j) => scene.initial.v[j] = value,
                OverrideKind::Mode(i) => scene.initial.modes[i] = value,
                OverrideKind::Parameter(i) => scene.parameters[i].default = value,
                OverrideKind::State(i) => {
                    scene.initial.x[i] = value;
                    let entered = scene.layout.states[i].entered;
                    if let Some(entered) = entered.filter(|e| value < e.least) {
                        let with_unit = |x: Dd| format!("{} {}", x.to_f64(), overrides.unit);
                        faults.push(wording::initial_below_least(
                            &Location::file(),
                            &overrides.name,
                            (&with_unit(value), &with_unit(entered.least)),
                            entered.way_out,
                        ));
                    }
                }
            }
        }
        let wrong = scene.layout.unit_quaternions(&mut scene.initial.q);
        faults.0.extend(wrong.into_iter().map(|(joint, length)| {
            wording::quaternion_length(&Location::file(), &joint.name, joint.any_length, length)
        }));
        if faults.any_fault() {
            return Err(faults);
        }
        let given = |name: &str| {
            let written = self
                .written
                .initial
                .iter()
                .any(|raw| raw.name.value == name);
            written || values.iter().any(|(s, _)| s.name == name)
        };
        if let Some(closure) = self.mechanism.closure() {
            let in_tree = closure.start.len();
            let independent = |p: usize| self.layout.positions[p].coordinate.is_some();
            let chosen = |p: &usize| {
                let name = &self.layout.positions[*p].name;
                let changed = values.iter().any(|(s, _)| s.name == *name);
                changed || (independent(*p) && given(name))
            };
            let given: Vec<usize> = (0..in_tree).filter(chosen).collect();
            let q = &mut scene.initial.q[..in_tree];
            if let Err(reason) = closure.reach(q, &given) {
                faults.push(closed_start::fault(&self.layout, &reason, |_| {
                    Location::file()
                }));
                return Err(faults);
            }
        }
        let layout = &self.layout;
        for (j, c) in layout.coordinates.iter().enumerate() {
            let (with, start) = (c.starts_with.as_ref(), &mut scene.initial);
            let state = (&start.q[..], &start.v[..]);
            let joints = (&self.mechanism, layout);
            let motion = with.and_then(|name| motion_of(joints, name, state));
            let Some((position, velocity)) = motion else {
                continue;
            };
            if let (Some(own), Some(position)) = (c.position, position)
                && !given(&c.name)
            {
                start.q[own] = position;
            }
            if !given(&c.rate_name) {
                start.v[j] = velocity;
            }
        }
        Ok(scene)
    }
}
