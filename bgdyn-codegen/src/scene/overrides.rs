//! Overrides of a scene's start: state variables and run-time parameters, by name.

use bgdyn_runtime::Dd;

use super::Scene;
use super::closed_start::{self, motion_of};
use crate::fault::{Faults, Location, unknown_name, wording};
use crate::mechanism::closure::{Closure, Unreached};

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
    /// The velocity at the start of a joint in a loop that follows others, by its index among these.
    DependentVelocity(usize),
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
        use OverrideKind::{DependentVelocity, Mode, Parameter, Position, State, Velocity};
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
        let dependents = layout.dependents.iter().enumerate();
        let dependents = dependents.map(|(d, joint)| {
            let unit = joint.dimensions[1].si();
            one(&joint.rate_name, unit, DependentVelocity(d))
        });
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
            .chain(dependents)
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
        let follower = self.layout.follower_of(name);
        if let (true, Some((joint, leaders))) = (found.is_empty(), follower) {
            return Err(wording::follows(name, (joint, &leaders)));
        }
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
                OverrideKind::DependentVelocity(_) => {}
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
            let given = self.positions_of_start(closure, values);
            let closed = closure.reach(&mut scene.initial.q[..in_tree], &given);
            if let Err(reason) = closed.and_then(|()| self.moved(closure, &mut scene, values)) {
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

    /// Returns the positions in the open tree that these values give, and those of independent joints that the file gives
    /// and the values leave free, in the order of the joints.
    fn positions_of_start(&self, closure: &Closure, values: &[(Override, Dd)]) -> Vec<usize> {
        let layout = &self.layout;
        let changed = |p: &usize| {
            let mut values = values.iter();
            values.any(|(one, _)| one.kind == OverrideKind::Position(*p))
        };
        let of_file = |p: &usize| {
            let position = &layout.positions[*p];
            let mut written = self.written.initial.iter();
            position.coordinate.is_some() && written.any(|raw| raw.name.value == position.name)
        };
        let all = 0..closure.start.len();
        let (mut given, others): (Vec<usize>, Vec<usize>) = all
            .filter(|p| changed(p) || of_file(p))
            .partition(|p| changed(p));
        let velocity = |p: usize| {
            let mut positions = closure.positions.iter();
            positions.position(|own| own.is_some_and(|own| own.0 == p))
        };
        let velocities = |of: &[usize]| {
            of.iter()
                .filter_map(|&p| velocity(p))
                .collect::<Vec<usize>>()
        };
        let map = closure.velocity_map(&closure.start);
        let left =
            map.map(|map| closure.left_free(&map, &velocities(&given), &velocities(&others)));
        let is_left = |p: &usize| match (velocity(*p), &left) {
            (Some(j), Some(left)) => left.contains(&j),
            _ => true,
        };
        given.extend(others.into_iter().filter(is_left));
        given.sort_unstable();
        given
    }

    /// Sets the independent velocities of a scene with loops, if velocities of dependent joints are among these values or
    /// in the file: those of the file hold as far as the values leave them free, in their order.
    fn moved(
        &self,
        closure: &Closure,
        scene: &mut Scene,
        values: &[(Override, Dd)],
    ) -> Result<(), Unreached> {
        let layout = &self.layout;
        let independent = |j: usize| Some(closure.independents.get(j)?.0);
        let dependent = |d: usize| layout.dependents[d].velocity.0;
        let of_values = values.iter().filter_map(|(one, value)| match one.kind {
            OverrideKind::Velocity(j) => Some((independent(j)?, *value)),
            OverrideKind::DependentVelocity(d) => Some((dependent(d), *value)),
            _ => None,
        });
        let of_values: Vec<(usize, Dd)> = of_values.collect();
        let start = (&self.initial.q[..], &self.initial.v[..]);
        let of_file = |name: &str| {
            let mut coordinates = layout.coordinates.iter();
            if let Some(j) = coordinates.position(|c| c.rate_name == name) {
                return Some((independent(j)?, self.initial.v[j]));
            }
            let mut dependents = layout.dependents.iter();
            let joint = dependents.find(|joint| joint.rate_name == name)?;
            let (_, velocity) = motion_of((&self.mechanism, layout), &joint.name, start)?;
            Some((joint.velocity.0, velocity))
        };
        let written = self.written.initial.iter();
        let of_file = written.filter_map(|raw| of_file(&raw.name.value));
        let of_file: Vec<(usize, Dd)> = of_file.collect();
        let mut all = of_values.iter().chain(&of_file);
        let own = |j: usize| closure.independents.iter().any(|i| i.0 == j);
        if values.is_empty() || all.all(|&(j, _)| own(j)) {
            return Ok(());
        }
        let q = &scene.initial.q[..closure.start.len()];
        let u = closure.independent_velocities(q, &of_values, &of_file)?;
        scene.initial.v[..u.len()].copy_from_slice(&u);
        Ok(())
    }
}
