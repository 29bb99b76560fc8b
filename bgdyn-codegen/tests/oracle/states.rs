//! Random states of a scene, and directions in them.

use bgdyn_runtime::Dd;

use super::compare::Pair;
use super::laws::{Effect, sign};
use super::rng::Rng;
use super::state::State;
use super::vector::dd;

impl Pair {
    /// Returns a random state with consistent modes.
    pub fn state(&self, rng: &mut Rng) -> State {
        let layout = &self.system.scene.layout;
        let mut state = State::default();
        for c in &layout.coordinates {
            if c.position.is_some() {
                let near = self.written.near.get(&c.name);
                let q = near.map_or(dd(rng.within(1.2)), |&q| q + dd(rng.within(4e-3)));
                state.q.insert(c.name.clone(), q);
            }
            state.v.insert(c.name.clone(), dd(rng.within(2.0)));
        }
        for input in &layout.inputs {
            let size = if input.name.starts_with("joint") {
                9.0
            } else {
                2.0
            };
            state.u.insert(input.name.clone(), dd(rng.within(size)));
        }
        for part in &layout.states {
            state.x.insert(part.name.clone(), dd(rng.within(2e-3)));
        }
        for e in self.oracle.effects.iter().filter(|e| e.kind() == "coulomb") {
            let mode = f64::from(rng.below(3) as u32) - 1.0;
            state.modes.insert(e.name.clone(), dd(mode));
            let reference = e
                .has("reference")
                .then(|| format!("{}_rate", e.text("reference")));
            let belt = reference.map_or(Dd::ZERO, |r| state.u[&r]);
            let slip = dd(mode) * dd(0.1 + rng.unit());
            state.v.insert(e.text("joint").into(), belt + slip);
        }
        self.gears(&mut state, rng);
        for e in self.oracle.effects.iter().filter(|e| limits_a_winding(e)) {
            // Free, held at either limit, beyond either.
            let (current, upper, lower) = match rng.below(5) {
                0 => (0.9 * rng.within(1.0), -1.0, 1.0),
                1 => (1.0, 0.0, 1.0),
                2 => (-1.0, -1.0, 0.0),
                3 => (1.0 + rng.unit(), 1.0, 1.0),
                _ => (-1.0 - rng.unit(), -1.0, -1.0),
            };
            let current = e.number("current_limit") * dd(current);
            state.v.insert(e.name.clone(), current);
            for (side, mode) in [("upper_limit", upper), ("lower_limit", lower)] {
                state.modes.insert(format!("{}_{side}", e.name), dd(mode));
            }
        }
        let mut pressure = || dd(1e6 + 1e7 * rng.unit());
        self.oracle.fill(&mut state, &mut pressure);
        state
    }

    /// Sets joints with gears to move or rest, with consistent modes of the gears.
    fn gears(&self, state: &mut State, rng: &mut Rng) {
        let mut chosen: Vec<&str> = Vec::new();
        for e in &self.oracle.effects {
            let Some(name) = e.gear_mode() else { continue };
            let joint = e.text("joint");
            let rubs = |e: &Effect| e.kind() == "coulomb" && e.text("joint") == joint;
            if !chosen.contains(&joint) && !self.oracle.effects.iter().any(rubs) {
                let direction = f64::from(rng.below(3) as u32) - 1.0;
                let rate = dd(direction) * dd(0.1 + rng.unit());
                state.v.insert(joint.into(), rate);
                chosen.push(joint);
            }
            state.modes.insert(name, sign(state.v[joint]));
        }
    }

    /// Returns a direction in the state, along which held joints do not slip.
    pub fn direction(&self, rng: &mut Rng) -> State {
        let layout = &self.system.scene.layout;
        let held = |name: &str| {
            let on = |e: &&Effect| {
                let friction = e.kind() == "coulomb" && e.text("joint") == name;
                let geared = e.gear_mode().is_some() && e.text("joint") == name;
                friction || geared || limits_a_winding(e) && e.name == name
            };
            self.oracle.effects.iter().find(on).is_some()
        };
        let mut along = State::default();
        for c in &layout.coordinates {
            if c.position.is_some() {
                along.q.insert(c.name.clone(), dd(rng.within(1.0)));
            }
            let rate = if held(&c.name) { 0.0 } else { rng.within(1.0) };
            along.v.insert(c.name.clone(), dd(rate));
        }
        for part in &layout.states {
            along.x.insert(part.name.clone(), dd(rng.within(1e-3)));
        }
        along
    }
}

/// Returns whether it is a motor with a limited current that is part of the state.
fn limits_a_winding(e: &Effect) -> bool {
    e.kind() == "dc_motor" && e.has("inductance") && e.has("current_limit")
}
