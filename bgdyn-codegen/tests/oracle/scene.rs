//! A scene parsed by the oracle, and its motion: M(q) a = E − h.

use std::collections::BTreeMap;

use bgdyn_runtime::Dd;
use serde_yaml::Value;

use super::contact_law::{Reading, each};
use super::hydraulics;
use super::laws::{Effect, geared, law};
use super::mechanism::{Kind, Mechanism, Motion, Wrench, carried, efforts, motions};
use super::state::{At, Named, State, Sums};
use super::vector::{M3, V3, ZERO, add, apply, cross, dd, dot, scale};
use super::yaml::{direction, list, number, text, vector};

pub struct Scene {
    pub mechanism: Mechanism,
    pub effects: Vec<Effect>,
    gravity: V3,
    /// Whether links have tensors.
    extended: bool,
    /// Whether velocity products are included.
    products: bool,
    locked: Named,
}

/// A rotor: N² J on its joint, and, with a given carrier, N J about an axis on the carrier.
struct Rotor {
    joint: usize,
    ratio: Dd,
    inertia: Dd,
    /// The body, and the axis in the body's axes.
    on: Option<(usize, V3)>,
}

/// The results of a scene in a state.
pub struct Answer {
    /// Accelerations, by the coordinates' names.
    pub accelerations: Named,
    /// Rates of first-order states.
    pub rates: Named,
    pub energy: Dd,
}

impl Scene {
    pub fn read(scene: &str, mechanism: &str) -> Self {
        let file: Value = serde_yaml::from_str(scene).expect("YAML");
        let mechanism = Mechanism::read(mechanism);
        let mut read = Scene {
            mechanism,
            effects: vec![],
            gravity: ZERO,
            extended: false,
            products: false,
            locked: Named::new(),
        };
        let name = |v: &Value| v.as_str().expect("a name").to_owned();
        if let Some(Value::Mapping(locks)) = file.get("lock") {
            read.locked = locks.iter().map(|(k, v)| (name(k), number(v))).collect();
        }
        for entry in list(&file["effects"]) {
            match entry {
                Value::Mapping(one) => {
                    let (key, keys) = one.iter().next().expect("an effect");
                    read.take(name(key), keys.clone());
                }
                word => read.take(name(word), Value::Null),
            }
        }
        read
    }

    fn take(&mut self, name: String, keys: Value) {
        match name.as_str() {
            "gravity" if keys == Value::Null => self.gravity = self.mechanism.gravity,
            "gravity" => self.gravity = vector(Some(&keys)),
            "inertia" => self.extended = keys.as_str() != Some("lumped"),
            "velocity_products" => self.products = true,
            _ => {
                if text(&keys, "type") == Some("payload") {
                    let place = self.mechanism.places[text(&keys, "at").expect("a place")];
                    let body = place.body.expect("a link carries it");
                    self.mechanism.bodies[body]
                        .masses
                        .push(carried(&keys, place));
                }
                let effect = Effect { name, keys };
                match effect.kind() {
                    "compliant_contact" => {
                        let each = each(effect, &self.mechanism.contacts);
                        self.effects.extend(each);
                    }
                    _ => self.effects.push(effect),
                }
            }
        }
    }

    /// Bodies whose joints move, in order.
    fn moving(&self) -> Vec<usize> {
        let moves = |i: &usize| {
            let body = &self.mechanism.bodies[*i];
            body.kind != Kind::Fixed && !self.locked.contains_key(&body.joint)
        };
        (0..self.mechanism.bodies.len()).filter(moves).collect()
    }

    /// Returns the coordinate of a body's joint.
    fn coordinate(&self, state: &State, body: usize) -> Dd {
        let joint = &self.mechanism.bodies[body].joint;
        let found = self.locked.get(joint).or_else(|| state.q.get(joint));
        found.copied().unwrap_or(Dd::ZERO)
    }

    fn rotors(&self) -> Vec<Rotor> {
        let rotors = self.effects.iter().filter(|e| e.kind() == "rotor");
        let read = |e: &Effect| Rotor {
            joint: self.mechanism.body_of_joint(e.text("joint")),
            ratio: e.or("ratio", 1.0),
            inertia: e.number("inertia"),
            on: text(&e.keys, "on").and_then(|on| {
                let place = self.mechanism.places[on];
                let axes: M3 = place.origin.rotation;
                Some((place.body?, apply(axes, direction(e.keys.get("axis")))))
            }),
        };
        rotors.map(read).collect()
    }

    /// Returns the efforts at the joints for rates and accelerations by body, under wrenches.
    fn inverse(
        &self,
        state: &State,
        rate: &[Dd],
        acceleration: &[Dd],
        gravity: V3,
        wrenches: &[Wrench],
    ) -> Vec<Dd> {
        let moved = motions(&self.mechanism, |i| {
            [self.coordinate(state, i), rate[i], acceleration[i]]
        });
        let mut wrenches = wrenches.to_vec();
        let mut own = vec![Dd::ZERO; moved.len()];
        for Rotor {
            joint,
            ratio,
            inertia,
            on,
        } in self.rotors()
        {
            let (spin, change) = (ratio * rate[joint], ratio * acceleration[joint]);
            own[joint] += ratio * inertia * change;
            let Some((body, axis)) = on else { continue };
            let carrier = moved[body];
            let axis = apply(carrier.rotation, axis);
            // The rotor's momentum J N q̇ e rotates with the body, which receives the reaction to its
            // change; the joint's drive also accelerates the rotor with its carrier.
            let turned = scale(cross(carrier.turning, axis), spin);
            let moment = scale(add(scale(axis, change), turned), -inertia);
            wrenches.push(Wrench {
                body,
                at: ZERO,
                force: ZERO,
                moment,
            });
            own[joint] += ratio * inertia * dot(axis, carrier.turning_rate);
        }
        let links = efforts(&self.mechanism, &moved, gravity, self.extended, &wrenches);
        links.iter().zip(own).map(|(&l, r)| l + r).collect()
    }

    fn at<'a>(&'a self, state: &'a State, motions: &'a [Motion]) -> At<'a> {
        At {
            mechanism: &self.mechanism,
            motions,
            state,
        }
    }

    /// Returns the sums of the laws of all effects.
    fn sums(&self, state: &State, rate: &[Dd]) -> Sums {
        let moved = motions(&self.mechanism, |i| {
            [self.coordinate(state, i), rate[i], Dd::ZERO]
        });
        let at = self.at(state, &moved);
        let mut sums = Sums::default();
        hydraulics::pressures(&self.effects, &at, &mut sums);
        for e in &self.effects {
            law(e, &at, &mut sums);
        }
        hydraulics::in_series(&self.effects, &mut sums);
        hydraulics::volumes(&self.effects, &at, &mut sums);
        for name in state.v.keys() {
            let Some(&effort) = state.u.get(name) else {
                continue;
            };
            if self
                .effects
                .iter()
                .any(|e| e.name == *name && e.kind() == "dc_motor")
            {
                continue; // a voltage
            }
            let at_it = |e: &&Effect| e.kind() == "gear" && e.text("joint") == name;
            let gear = self.effects.iter().find(at_it);
            let arrives = gear.map_or(effort, |g| geared(g, effort, &at, &mut sums));
            sums.push(name, arrives);
        }
        for e in self.effects.iter().filter(|e| e.kind() == "gear") {
            geared(e, Dd::ZERO, &at, &mut sums);
        }
        sums
    }

    /// The poses of the bodies, at rest.
    pub fn poses(&self, state: &State) -> Vec<Motion> {
        motions(&self.mechanism, |i| {
            [self.coordinate(state, i), Dd::ZERO, Dd::ZERO]
        })
    }

    /// Sets the volumes of a state from consecutive pressures.
    pub fn fill(&self, state: &mut State, pressure: impl FnMut() -> Dd) {
        let moved = self.poses(state);
        let filled = hydraulics::filled(&self.effects, &self.at(state, &moved), pressure);
        state.x.extend(filled);
    }

    /// The rate of each body's joint.
    fn rates(&self, state: &State) -> Vec<Dd> {
        let mut rate = vec![Dd::ZERO; self.mechanism.bodies.len()];
        for i in self.moving() {
            rate[i] = state.v[&self.mechanism.bodies[i].joint];
        }
        rate
    }

    /// What contacts do, by the effects' names.
    pub fn contacts(&self, state: &State) -> BTreeMap<String, Reading> {
        self.sums(state, &self.rates(state)).contacts
    }

    /// Accelerations, rates and energy.
    pub fn answer(&self, state: &State) -> Answer {
        let (moving, rate) = (self.moving(), self.rates(state));
        let still = vec![Dd::ZERO; rate.len()];
        let sums = self.sums(state, &rate);
        let bias_rate = if self.products { &rate } else { &still };
        let bias = self.inverse(state, bias_rate, &still, self.gravity, &sums.wrenches);
        let names: Vec<String> = moving
            .iter()
            .map(|&i| self.mechanism.bodies[i].joint.clone())
            .collect();
        let mut mass: Vec<Vec<Dd>> = Vec::new();
        for &j in &moving {
            let mut unit = still.clone();
            unit[j] = Dd::ONE;
            let column = self.inverse(state, &still, &unit, ZERO, &[]);
            mass.push(moving.iter().map(|&i| column[i]).collect());
        }
        let effort = |name: &String| sums.efforts.get(name).copied().unwrap_or(Dd::ZERO);
        let mut right: Vec<Dd> = names
            .iter()
            .zip(&moving)
            .map(|(n, &i)| effort(n) - bias[i])
            .collect();
        let speeds: Vec<Dd> = moving.iter().map(|&i| rate[i]).collect();
        let mut energy = sums.stored + self.potential(state) + dd(0.5) * form(&mass, &speeds);
        let mut accelerations = Named::new();
        for (name, &inertia) in &sums.inertia {
            let free = effort(name) / inertia;
            accelerations.insert(name.clone(), sums.held.get(name).copied().unwrap_or(free));
            energy += dd(0.5) * inertia * state.v[name] * state.v[name];
        }
        for (j, name) in names.iter().enumerate() {
            if let Some(&held) = sums.held.get(name) {
                mass.iter_mut().for_each(|column| column[j] = Dd::ZERO);
                (mass[j][j], right[j]) = (Dd::ONE, held);
            }
        }
        accelerations.extend(names.into_iter().zip(solved(mass, right)));
        Answer {
            accelerations,
            rates: sums.rates,
            energy,
        }
    }

    /// Returns −Σ m g·r, including payloads.
    fn potential(&self, state: &State) -> Dd {
        let moved = self.poses(state);
        let mut sum = Dd::ZERO;
        for (body, m) in self.mechanism.bodies.iter().zip(&moved) {
            for mass in &body.masses {
                let at = add(m.place, apply(m.rotation, mass.com));
                sum -= mass.mass * dot(self.gravity, at);
            }
        }
        sum
    }
}

/// vᵀ M v
fn form(mass: &[Vec<Dd>], v: &[Dd]) -> Dd {
    let mut sum = Dd::ZERO;
    for (column, &a) in mass.iter().zip(v) {
        for (&m, &b) in column.iter().zip(v) {
            sum += a * m * b;
        }
    }
    sum
}

/// Gaussian elimination with the largest pivot of each column. `columns` of the matrix.
fn solved(columns: Vec<Vec<Dd>>, right: Vec<Dd>) -> Vec<Dd> {
    let n = right.len();
    let row = |i: usize| {
        let entries = columns.iter().map(move |c| c[i]);
        entries.chain([right[i]]).collect::<Vec<Dd>>()
    };
    let mut rows: Vec<Vec<Dd>> = (0..n).map(row).collect();
    for k in 0..n {
        let size = |i: &usize| rows[*i][k].to_f64().abs();
        let best = (k..n)
            .max_by(|a, b| size(a).total_cmp(&size(b)))
            .expect("a row");
        rows.swap(k, best);
        let pivot = rows[k].clone();
        for (i, row) in rows.iter_mut().enumerate() {
            if i != k {
                let factor = row[k] / pivot[k];
                row.iter_mut()
                    .zip(&pivot)
                    .for_each(|(x, &p)| *x -= factor * p);
            }
        }
    }
    (0..n).map(|k| rows[k][n] / rows[k][k]).collect()
}
