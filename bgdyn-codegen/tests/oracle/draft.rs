//! Random scenes: trees of three to seven joints, with three to six effects at once.

use std::fmt::Write;

use super::random::Draft;
use super::rng::Rng;
use super::state::Named;
use super::touches::{asked, touching};
use super::tree::{hooks, joint, mover, rounded, solid};

/// A mechanism and a scene, as text.
#[derive(Clone, Debug)]
pub struct Written {
    pub mechanism: String,
    pub scene: String,
    /// Positions near which contacts touch, by joint.
    pub near: Named,
}

/// The parts from which effects are drawn.
struct Drawn<'a> {
    rng: &'a mut Rng,
    /// Coordinates on which effects can act: joints first, then those of elastic drives.
    coordinates: Vec<String>,
    joints: Vec<String>,
    /// Links and frames that move, each with the link whose joint moves it.
    moving: Vec<(String, String)>,
    links: Vec<String>,
    /// Coordinates with friction that can hold, or with a gear.
    held: Vec<String>,
    geared: Vec<String>,
    /// Lines of the scene's `effects`.
    lines: Vec<String>,
}

/// A random scene.
pub fn written(rng: &mut Rng) -> Written {
    let joints = 3 + rng.below(5);
    let mut draft = Draft::moving(rng, joints);
    draft.exact = true;
    // Half of them have structure, the others none.
    let generic = rng.chance(0.5);
    for link in &mut draft.links {
        link.body = if generic {
            solid(rng)
        } else {
            std::mem::take(&mut link.body)
        };
        if generic {
            link.joint.axis = [0; 3].map(|_| rng.within(1.0));
            link.joint.xyz = [0; 3].map(|_| rounded(rng, 0.5));
            link.joint.rpy = [0; 3].map(|_| rounded(rng, 3.0).to_string());
        }
    }
    let mut locked: Vec<String> = Vec::new();
    for link in draft.links.iter().filter(|l| l.joint.kind != "fixed") {
        if locked.len() + 3 < joints && rng.chance(0.1) {
            locked.push(joint(link));
        }
    }
    hooks(rng, &mut draft);
    let mut drawn = drawn(rng, &draft, &locked);
    let tensors = drawn.rng.chance(0.9);
    drawn.ground(tensors, generic && tensors);
    for i in 0..3 + drawn.rng.below(4) {
        let kind = drawn.rng.below(KINDS);
        drawn.effect(kind, i);
    }
    let Drawn {
        coordinates,
        moving,
        lines,
        ..
    } = drawn;
    let mut scene = String::from("scene: 1\nmechanism: random.yaml\n");
    if !locked.is_empty() {
        let held = locked.iter().map(|j| format!("{j}: {}", rounded(rng, 0.7)));
        writeln!(scene, "lock: {{ {} }}", held.collect::<Vec<_>>().join(", ")).unwrap();
    }
    let touch = touching(rng, &draft, &locked, &scene, &moving);
    let given = coordinates.iter().map(|c| format!("{c}: given"));
    scene += "effects:\n";
    scene.extend(
        lines
            .iter()
            .chain(&touch.lines)
            .map(|line| format!("  - {line}\n")),
    );
    writeln!(
        scene,
        "inputs: {{ {} }}",
        given.collect::<Vec<_>>().join(", ")
    )
    .unwrap();
    let mechanism = draft.yaml() + &touch.keys;
    scene += &asked(&scene, &mechanism);
    Written {
        mechanism,
        scene,
        near: touch.near,
    }
}

fn drawn<'a>(rng: &'a mut Rng, draft: &Draft, locked: &[String]) -> Drawn<'a> {
    let moves = draft.links.iter().filter(|l| l.joint.kind != "fixed");
    let joints: Vec<String> = moves.map(joint).filter(|j| !locked.contains(j)).collect();
    let mut moving = Vec::new();
    let hooks = draft.frames.iter().filter_map(|f| {
        let (_, rest) = f.split_once("name: hook_")?;
        let (number, rest) = rest.split_once(", link: ")?;
        let (link, _) = rest.split_once(',')?;
        Some((format!("hook_{number}"), link.to_owned()))
    });
    let links = draft.links.iter().map(|l| (l.name.clone(), l.name.clone()));
    for (place, link) in hooks.chain(links) {
        if let Some(by) = mover(draft, locked, link) {
            moving.push((place, by));
        }
    }
    Drawn {
        rng,
        coordinates: joints.clone(),
        joints,
        moving,
        links: draft.links.iter().map(|l| l.name.clone()).collect(),
        held: vec![],
        geared: vec![],
        lines: vec![],
    }
}

const KINDS: usize = 20;

impl Drawn<'_> {
    /// Adds gravity, tensors, velocity products; and rotors if M might be singular without them.
    fn ground(&mut self, tensors: bool, regular: bool) {
        if self.rng.chance(0.85) {
            let other = self.rng.chance(0.2);
            self.lines.push(
                if other {
                    "gravity: [1.5, -2.25, -1.62]"
                } else {
                    "gravity"
                }
                .into(),
            );
        }
        if tensors {
            self.lines.push("inertia".into());
        }
        if self.rng.chance(0.9) {
            self.lines.push("velocity_products".into());
        }
        if !regular {
            for joint in self.joints.clone() {
                self.lines.push(format!(
                    "kept_{joint}: {{ type: rotor, joint: {joint}, inertia: 2e-3, ratio: 40 }}"
                ));
            }
        }
    }

    fn number(&mut self, least: f64, most: f64) -> f64 {
        let x = least + (most - least) * self.rng.unit();
        (x * 1e3).round() / 1e3
    }

    fn coordinate(&mut self) -> String {
        self.rng.pick(&self.coordinates).clone()
    }

    fn joint(&mut self) -> String {
        self.rng.pick(&self.joints).clone()
    }

    fn place(&mut self) -> String {
        self.rng.pick(&self.moving).0.clone()
    }

    /// `, reference: …`, or nothing.
    fn reference(&mut self, i: usize) -> String {
        if self.rng.chance(0.4) {
            format!(", reference: belt_{i}")
        } else {
            String::new()
        }
    }

    /// Returns a joint, or two sites whose distance changes.
    fn along(&mut self) -> String {
        if self.rng.chance(0.4) {
            return format!("joint: {}", self.joint());
        }
        let of_hooks = |m: &&(String, String)| m.0.starts_with("hook");
        let hooks: Vec<_> = self.moving.iter().filter(of_hooks).cloned().collect();
        let Some((a, by)) = hooks.first() else {
            return format!("joint: {}", self.joint());
        };
        let other = hooks.iter().find(|(_, other)| other != by);
        let b = match other {
            Some((b, _)) if self.rng.chance(0.6) => b,
            _ => "pole",
        };
        let [a, b] = if self.rng.chance(0.5) { [a, b] } else { [b, a] };
        format!("between: [{a}, {b}]")
    }

    /// A motor's keys after its resistance.
    fn limits(&mut self) -> String {
        let mut keys = String::new();
        for (key, least, most) in [
            ("efficiency", 0.5, 1.0),
            ("voltage_limit", 2.0, 20.0),
            ("current_limit", 0.5, 5.0),
        ] {
            if self.rng.chance(0.4) {
                write!(keys, ", {key}: {}", self.number(least, most)).unwrap();
            }
        }
        keys
    }

    fn add(&mut self, line: String) {
        self.lines.push(line);
    }

    fn effect(&mut self, kind: usize, i: usize) {
        match kind {
            0..=4 => self.friction(kind, i),
            5 | 6 => {
                let (along, reference) = (self.along(), self.reference(i));
                let (k, s0, f0) = (
                    self.number(1.0, 90.0),
                    self.number(0.0, 2.0),
                    self.number(-3.0, 3.0),
                );
                self.add(format!("spring_{i}: {{ type: spring, {along}, stiffness: {k}, rest: {s0}, preload: {f0}{reference} }}"));
            }
            7 => {
                let (along, reference, b) =
                    (self.along(), self.reference(i), self.number(0.1, 9.0));
                self.add(format!(
                    "damper_{i}: {{ type: damper, {along}, damping: {b}{reference} }}"
                ));
            }
            8 => {
                let joint = self.coordinate();
                let (low, high, k) = (
                    self.number(-1.0, 0.0),
                    self.number(0.0, 1.0),
                    self.number(10.0, 900.0),
                );
                let (e, speed) = (self.number(0.1, 0.95), self.number(0.2, 2.0));
                self.add(format!("stop_{i}: {{ type: stop, joint: {joint}, lower: {low}, upper: {high}, stiffness: {k}, restitution: {e}, impact_speed: {speed} }}"));
            }
            9 | 10 => self.elastic(i),
            11 => {
                let (joint, efficiency) = (self.coordinate(), self.number(0.4, 1.0));
                if !self.geared.contains(&joint) {
                    self.geared.push(joint.clone());
                    self.add(format!(
                        "gear_{i}: {{ type: gear, joint: {joint}, efficiency: {efficiency} }}"
                    ));
                }
            }
            12..=14 => self.rotor(i),
            15 => {
                let coordinate = self.coordinate();
                self.motor(i, &coordinate);
            }
            16 | 17 => self.on_a_link(kind, i),
            18 => {
                let (at, mass) = (self.place(), self.number(0.1, 3.0));
                let com = [0; 3].map(|_| self.number(-0.2, 0.2));
                self.add(format!("load_{i}: {{ type: payload, at: {at}, mass: {mass}, com: {com:?}, inertia: {{ xx: 0.02, yy: 0.03, zz: 0.025, xy: 0.002, xz: -0.001, yz: 0.003 }} }}"));
            }
            _ => self.hydraulics(i),
        }
    }

    fn friction(&mut self, kind: usize, i: usize) {
        let (joint, reference) = (self.coordinate(), self.reference(i));
        let (kinetic, more, b) = (
            self.number(0.2, 3.0),
            self.number(0.0, 2.0),
            self.number(0.1, 2.0),
        );
        let fixed = kinetic + more;
        let common = format!("joint: {joint}{reference}");
        let keys = match kind {
            0 => format!("viscous, damping: {b}"),
            1 if self.held.contains(&joint) => return,
            1 => {
                self.held.push(joint.clone());
                format!("coulomb, kinetic: {kinetic}, static: {fixed:?}")
            }
            2 => format!("coulomb_smooth, kinetic: {kinetic}, width: {b}"),
            3 => format!(
                "stribeck, kinetic: {kinetic}, static: {fixed:?}, stribeck_speed: {b}, width: 0.05, damping: {b}"
            ),
            _ => format!(
                "lugre, stiffness: 900, damping: 3, viscous: 40, kinetic: {kinetic}, static: {fixed:?}, stribeck_speed: {b}"
            ),
        };
        self.add(format!("rub_{i}: {{ type: {keys}, {common} }}"));
    }

    /// An elastic drive; effects drawn later may act on its coordinate.
    fn elastic(&mut self, i: usize) {
        let (joint, k, d) = (
            self.joint(),
            self.number(10.0, 300.0),
            self.number(0.0, 2.0),
        );
        let n = self.number(1.0, 100.0);
        let name = format!("drive_{i}");
        self.add(format!("{name}: {{ type: series_elastic, joint: {joint}, stiffness: {k}, damping: {d}, inertia: 4e-5, ratio: {n} }}"));
        self.coordinates.push(name.clone());
        if self.rng.chance(0.6) {
            self.motor(i, &name);
        }
    }

    /// Adds a rotor on any link: inboard of its joint, at it, outboard or on another branch.
    fn rotor(&mut self, i: usize) {
        let (joint, on) = (self.joint(), self.rng.pick(&self.links).clone());
        let (ratio, axis) = (
            self.number(-90.0, 90.0).abs() + 1.0,
            [0; 3].map(|_| self.rng.within(1.0)),
        );
        self.add(format!("rotor_{i}: {{ type: rotor, joint: {joint}, inertia: 2e-3, ratio: {ratio:?}, on: {on}, axis: {axis:?} }}"));
    }

    fn motor(&mut self, i: usize, joint: &str) {
        let (r, n, limits) = (self.number(0.3, 3.0), self.number(1.0, 60.0), self.limits());
        let inductance = if self.rng.chance(0.5) {
            ", inductance: 0.002"
        } else {
            ""
        };
        self.add(format!("motor_{i}: {{ type: dc_motor, joint: {joint}, resistance: {r}, torque_constant: 0.06, ratio: {n}{inductance}{limits} }}"));
    }

    fn on_a_link(&mut self, kind: usize, i: usize) {
        let at = self.place();
        if kind == 16 {
            let axes = *self.rng.pick(&[
                "",
                ", axes: link",
                ", axes: link, components: [fx, mz]",
                ", components: [my, fy, fz]",
            ]);
            self.add(format!("push_{i}: {{ type: wrench, at: {at}{axes} }}"));
        } else {
            let [c1, c2, c3] = [3.0, 5.0, 1.0].map(|most| self.number(0.0, most));
            self.add(format!(
                "wind_{i}: {{ type: drag, at: {at}, linear: {c1}, quadratic: {c2}, angular: {c3} }}"
            ));
        }
    }

    /// Adds a cylinder with its supply; once in a scene.
    fn hydraulics(&mut self, i: usize) {
        if self.lines.iter().any(|l| l.starts_with("oil:")) {
            return;
        }
        let along = self.along();
        for part in [
            "oil: { type: fluid, bulk_modulus: 1.2e9 }",
            "pump: { type: supply, pressure: 16e6 }",
            "sump: { type: tank, pressure: 1e5 }",
        ] {
            self.add(part.into());
        }
        self.add(format!("ram: {{ type: cylinder, {along}, area_a: 8e-4, area_b: 5e-4, dead_a: 7e-3, dead_b: 7e-3, stroke: 0.4, offset: 0.2 }}"));
        self.add("gap: { type: leakage, from: ram_a, to: ram_b, conductance: 4e-12 }".into());
        match self.rng.below(3) {
            0 => self.add("valve: { type: four_way_valve, supply: pump, tank: sump, a: ram_a, b: ram_b, flow: 2e-7 }".into()),
            1 => {
                self.add("valve: { type: four_way_valve, supply: hose, tank: sump, a: ram_a, b: ram_b, flow: 2e-7, resistance: 2e9, spool: lever }".into());
                for part in ["hose: { type: line, volume: 2e-4 }", "knee: { type: junction }", "first: { type: orifice, from: pump, to: knee, flow: 3e-7, resistance: 1e9 }", "second: { type: leakage, from: knee, to: hose, conductance: 4e-11 }"] {
                    self.add(part.into());
                }
            }
            _ => {
                self.add("inlet: { type: orifice, from: pump, to: ram_a, flow: 1e-7, opening: tap }".into());
                self.add(format!("outlet: {{ type: orifice, from: ram_b, to: sump, flow: {}e-8, resistance: 1e9 }}", 5 + i));
            }
        }
    }
}
