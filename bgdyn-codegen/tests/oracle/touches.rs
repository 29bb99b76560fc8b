//! Random contacts: spheres, points, capsules and boxes at random places, with planes and spheres placed so
//! that most of them overlap a little near a given state.

use std::fmt::Write;

use bgdyn_runtime::Dd;

use super::contact::shifted;
use super::contact_law::outputs;
use super::mechanism::{Motion, Place, seen};
use super::random::Draft;
use super::rng::Rng;
use super::scene::Scene;
use super::state::{Named, State};
use super::tree::{joint, mover, rounded};
use super::vector::{M3, V3, add, apply, dd, dot, norm, scale, sub, transposed};

/// Contacts, as text, and what a scene says of them.
#[derive(Clone, Debug, Default)]
pub struct Touches {
    /// The keys `contacts` and `planes` of the mechanism.
    pub keys: String,
    /// Lines of the scene's `effects`.
    pub lines: Vec<String>,
    /// The positions near which they touch, by joint.
    pub near: Named,
}

/// A name in `contacts`, and its shape.
struct Entry {
    name: String,
    kind: Shape,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Shape {
    Ball,
    Capsule,
    Box,
    Pair,
}

struct Placing<'a> {
    rng: &'a mut Rng,
    draft: &'a Draft,
    locked: &'a [String],
    scene: &'a Scene,
    moving: &'a [(String, String)],
    /// Motions at the state of contact, and at another one.
    poses: [Vec<Motion>; 2],
    entries: String,
    planes: String,
    made: Vec<Entry>,
}

/// Contacts of three scenes in five, from a separate sequence.
pub fn touching(
    rng: &Rng,
    draft: &Draft,
    locked: &[String],
    scene: &str,
    moving: &[(String, String)],
) -> Touches {
    let mut own = Rng::new(rng.clone().next());
    if !own.chance(0.6) {
        return Touches::default();
    }
    let scene = Scene::read(&format!("{scene}effects: []\n"), &draft.yaml());
    touches(&mut own, draft, locked, &scene, moving)
}

/// The key `outputs`: all of all contacts; nothing without contacts.
pub fn asked(scene: &str, mechanism: &str) -> String {
    let read = Scene::read(scene, mechanism);
    let of_each = read.effects.iter().flat_map(|e| outputs(e, &read));
    let asked: Vec<String> = of_each.collect();
    match asked.is_empty() {
        true => String::new(),
        false => format!("outputs: [{}]\n", asked.join(", ")),
    }
}

/// Draws contacts of a mechanism; `scene` is read from what is written so far, `moving` are places on links
/// that move, each with the link whose joint moves it.
fn touches(
    rng: &mut Rng,
    draft: &Draft,
    locked: &[String],
    scene: &Scene,
    moving: &[(String, String)],
) -> Touches {
    let mut state = || {
        let joints = draft.links.iter().map(joint);
        let q = joints.map(|j| (j, dd(rng.within(1.2)))).collect();
        State {
            q,
            ..State::default()
        }
    };
    let states = [state(), state()];
    let mut placing = Placing {
        rng,
        draft,
        locked,
        scene,
        moving,
        poses: states.each_ref().map(|s| scene.poses(s)),
        entries: String::new(),
        planes: String::new(),
        made: vec![],
    };
    for i in 0..2 + placing.rng.below(3) {
        let (place, by) = placing.rng.pick(moving).clone();
        if i % 3 == 1 {
            placing.pair(i, &place, &by);
        } else {
            placing.on_plane(i, &place, &by);
        }
    }
    let [near, _] = states.map(|s| s.q);
    placing.finish(near)
}

/// Returns where a place is.
fn point(place: Place, motions: &[Motion]) -> (V3, M3) {
    let (arm, axes, carrier) = seen(place, motions);
    (add(carrier.place, arm), axes)
}

fn text(v: V3) -> String {
    format!("{:?}", v.map(Dd::to_f64))
}

impl Placing<'_> {
    fn place(&self, name: &str) -> Place {
        self.scene.mechanism.places[name]
    }

    /// The gap that an entry shall have near the state: two of three overlap.
    fn gap(&mut self) -> f64 {
        if self.rng.chance(0.7) {
            -0.03 * self.rng.unit()
        } else {
            0.04 * self.rng.unit()
        }
    }

    fn vector(&mut self, size: f64) -> V3 {
        [0; 3].map(|_| dd(rounded(self.rng, size)))
    }

    /// A place for a sphere that another joint moves, or that does not move.
    fn other(&mut self, by: &str) -> Option<String> {
        match self.rng.below(4) {
            0 => Some("pole".into()),
            1 => {
                let (place, moved) = self.rng.pick(self.moving).clone();
                (moved != by).then_some(place)
            }
            _ => self.partner(by),
        }
    }

    /// A link that another joint moves, or that does not move.
    fn partner(&mut self, by: &str) -> Option<String> {
        let names = self.draft.links.iter().map(|l| l.name.clone());
        let apart = |name: &String| {
            let moved = mover(self.draft, self.locked, name.clone());
            moved.as_deref() != Some(by)
        };
        let others: Vec<String> = names.filter(apart).collect();
        (!others.is_empty()).then(|| self.rng.pick(&others).clone())
    }

    /// A direction: exact, exact but for rounding noise, any.
    fn normal(&mut self) -> (String, V3) {
        let mut n = [0.0; 3];
        match self.rng.below(4) {
            0 => n[self.rng.below(3)] = *self.rng.pick(&[1.0, -1.0]),
            1 => {
                n = [0; 3].map(|_| self.rng.within(1e-9));
                n[self.rng.below(3)] = *self.rng.pick(&[1.0, -1.0]);
            }
            _ => n = [0; 3].map(|_| self.rng.within(1.0)),
        }
        let exact = (0..3).find(|&k| n[k].abs() == 1.0 && norm(n.map(dd)) == Dd::ONE);
        let text = match exact {
            Some(k) if n[k] > 0.0 => ["x", "y", "z"][k].into(),
            Some(k) => ["-x", "-y", "-z"][k].into(),
            None => format!("{n:?}"),
        };
        let n = n.map(dd);
        (text, scale(n, Dd::ONE / norm(n)))
    }

    /// The further keys of a capsule, a box or a sphere.
    fn shape(&mut self, at: V3) -> (Shape, String) {
        match self.rng.below(4) {
            0 => {
                let end = add(at, self.vector(0.05));
                (Shape::Capsule, format!(", to: {}", text(end)))
            }
            1 => {
                let edges = [0; 3].map(|_| 0.02 + rounded(self.rng, 0.01).abs());
                (Shape::Box, format!(", size: {edges:?}"))
            }
            _ => (Shape::Ball, String::new()),
        }
    }

    /// Something round or with corners against a plane of the world or of a link.
    fn on_plane(&mut self, i: usize, place: &str, by: &str) {
        let at = self.vector(0.3);
        let radius = *self.rng.pick(&[0.0, 0.04, 0.125]);
        if self.rng.chance(0.15) {
            return self.on_ground(i, place, at, radius);
        }
        let (kind, shape) = self.shape(at);
        let link = match self.rng.chance(0.4) {
            true => None,
            false => self.partner(by),
        };
        let (normal, n) = self.normal();
        if !self.changes(place, at, link.as_deref(), n) {
            return;
        }
        let least = dd(self.gap() + radius);
        let offset = (self.height(place, at, link.as_deref(), n, 0) - least).to_f64();
        let on = link.map_or(String::new(), |link| format!(", link: {link}"));
        let plane = format!("  plane_{i}: {{ normal: {normal}, offset: {offset:?}{on} }}");
        writeln!(self.planes, "{plane}").unwrap();
        let at = text(at);
        let keys = format!("link: {place}, at: {at}, radius: {radius}{shape}, on: plane_{i}");
        self.entry(i, kind, &keys);
    }

    /// A sphere or a point against the world's x–y plane: its centre is moved there.
    fn on_ground(&mut self, i: usize, place: &str, at: V3, radius: f64) {
        let up = [0.0, 0.0, 1.0].map(dd);
        if !self.changes(place, at, None, up) {
            return;
        }
        let (p, axes) = point(shifted(self.place(place), at), &self.poses[0]);
        let by = dd(self.gap() + radius) - p[2];
        let at = text(add(at, apply(transposed(axes), scale(up, by))));
        let keys = format!("link: {place}, at: {at}, radius: {radius}");
        self.entry(i, Shape::Ball, &keys);
    }

    /// The height of a point above the plane through a link's origin, in a state.
    fn height(&self, place: &str, at: V3, link: Option<&str>, n: V3, state: usize) -> Dd {
        let poses = &self.poses[state];
        let (p, _) = point(shifted(self.place(place), at), poses);
        let (o, axes) = point(self.place(link.unwrap_or("world")), poses);
        dot(apply(axes, n), sub(p, o))
    }

    /// Whether the joints change that height.
    fn changes(&self, place: &str, at: V3, link: Option<&str>, n: V3) -> bool {
        let [a, b] = [0, 1].map(|state| self.height(place, at, link, n, state));
        (a - b).to_f64().abs() > 1e-3
    }

    /// A sphere or a point against a sphere.
    fn pair(&mut self, i: usize, place: &str, by: &str) {
        let Some(other) = self.other(by) else {
            return;
        };
        let (at, with) = (self.vector(0.3), self.vector(0.3));
        let apart = |poses: &[Motion]| {
            let (a, _) = point(shifted(self.place(place), at), poses);
            let (b, _) = point(shifted(self.place(&other), with), poses);
            norm(sub(a, b))
        };
        let [distance, later] = self.poses.each_ref().map(|p| apart(p));
        if (distance - later).to_f64().abs() < 1e-3 || distance.to_f64() < 0.1 {
            return;
        }
        let sum = distance.to_f64() - self.gap();
        let share = *self.rng.pick(&[0.0, 0.3, 0.8]);
        let keys = format!(
            "link: {place}, at: {}, radius: {:?}, with: {other}, with_at: {}, with_radius: {:?}",
            text(at),
            share * sum,
            text(with),
            (1.0 - share) * sum
        );
        self.entry(i, Shape::Pair, &keys);
    }

    fn entry(&mut self, i: usize, kind: Shape, keys: &str) {
        let name = format!("touch_{i}");
        writeln!(self.entries, "  {name}: {{ {keys} }}").unwrap();
        self.made.push(Entry { name, kind });
    }

    /// Gives the contacts laws: one for all of them, one for several, or each its own.
    fn finish(mut self, near: Named) -> Touches {
        let made = std::mem::take(&mut self.made);
        if made.is_empty() {
            return Touches::default();
        }
        let names: Vec<String> = made.iter().map(|e| self.named(e)).collect();
        let pair = |e: &Entry| e.kind == Shape::Pair;
        let mut lines = Vec::new();
        match self.rng.below(3) {
            0 => {
                let law = self.law(!made.iter().any(pair));
                lines.push(format!("press: {{ {law}, contacts: all }}"));
            }
            1 => {
                let law = self.law(!made.iter().any(pair));
                lines.push(format!(
                    "press: {{ {law}, contacts: [{}] }}",
                    names.join(", ")
                ));
            }
            _ => {
                for (i, (e, name)) in made.iter().zip(&names).enumerate() {
                    let law = self.law(!pair(e));
                    let which = match name.contains(',') {
                        true => format!("contacts: [{name}]"),
                        false => format!("contact: {name}"),
                    };
                    lines.push(format!("press_{i}: {{ {law}, {which} }}"));
                }
            }
        }
        let mut keys = format!("contacts:\n{}", self.entries);
        if !self.planes.is_empty() {
            write!(keys, "planes:\n{}", self.planes).unwrap();
        }
        Touches { keys, lines, near }
    }

    /// The contacts of an entry: all of them, or a few corners.
    fn named(&mut self, e: &Entry) -> String {
        if e.kind != Shape::Box || self.rng.chance(0.2) {
            return e.name.clone();
        }
        let first = 1 + self.rng.below(7);
        let second = first + 1 + self.rng.below(8 - first);
        format!("{0}_{first}, {0}_{second}", e.name)
    }

    fn law(&mut self, bristles: bool) -> String {
        let number = |rng: &mut Rng, least: f64, most: f64| {
            ((least + (most - least) * rng.unit()) * 1e3).round() / 1e3
        };
        let rng = &mut *self.rng;
        let stiffness = 10f64.powf(number(rng, 3.0, 5.0)).round();
        let mut law = format!("type: compliant_contact, stiffness: {stiffness}");
        if rng.chance(0.2) {
            law = format!(
                "type: compliant_contact, stiffness: {{ parameter: hardness_{stiffness}, value: {stiffness} }}"
            );
        }
        match rng.below(5) {
            0 => {}
            1 | 2 => write!(law, ", damping: {}", number(rng, 0.0, 0.8)).unwrap(),
            _ => {
                let (e, speed) = (number(rng, 0.1, 1.0), number(rng, 0.2, 2.0));
                write!(law, ", restitution: {e}, impact_speed: {speed}").unwrap();
            }
        }
        if rng.chance(0.15) {
            return law;
        }
        let kinetic = number(rng, 0.1, 0.9);
        write!(law, ", kinetic: {kinetic}").unwrap();
        if rng.chance(0.5) {
            let (more, speed) = (number(rng, 0.0, 0.3), number(rng, 0.2, 2.0));
            write!(law, ", static: {}, stribeck_speed: {speed}", kinetic + more).unwrap();
        }
        if bristles && rng.chance(0.6) {
            let (sigma, release) = (number(rng, 100.0, 600.0), number(rng, 0.01, 0.5));
            write!(law, ", bristles: {sigma}, release: {release}").unwrap();
            if rng.chance(0.6) {
                write!(law, ", bristle_damping: {}", number(rng, 0.01, 0.5)).unwrap();
            }
        } else {
            write!(law, ", width: {}", number(rng, 0.01, 0.5)).unwrap();
        }
        law
    }
}
