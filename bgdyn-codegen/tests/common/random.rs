//! Random mechanisms, written as specs: trees with all structural features (exact, parallel, opposite,
//! coaxial, skew and noisy axes, quarter turns, massless and fixed links, several roots) and with none.

use std::fmt::Write;

use super::rng::Rng;

/// A link as text, so that its spec can be written in any order and position.
#[derive(Clone, Debug)]
pub struct Link {
    pub name: String,
    pub parent: Option<String>,
    pub joint: Joint,
    /// Lines for mass, com and inertia.
    pub body: String,
}

#[derive(Clone, Debug)]
pub struct Joint {
    pub kind: &'static str,
    /// In link axes.
    pub axis: [f64; 3],
    pub xyz: [f64; 3],
    pub rpy: [String; 3],
}

/// A mechanism as text.
#[derive(Clone, Debug)]
pub struct Draft {
    /// `snap: 0`: axes are not snapped.
    pub exact: bool,
    pub gravity: Option<[f64; 3]>,
    pub links: Vec<Link>,
    pub frames: Vec<String>,
}

impl Draft {
    /// A random mechanism with 1 to `most` moving joints.
    pub fn random(rng: &mut Rng, most: usize) -> Self {
        let moving = 1 + rng.below(most);
        Draft::moving(rng, moving)
    }

    /// A random mechanism with that many moving joints.
    pub fn moving(rng: &mut Rng, moving: usize) -> Self {
        let gravity = match rng.below(10) {
            0 => Some([0.0; 3]),
            1 | 2 => Some([rng.within(9.0), rng.within(9.0), rng.within(9.0)]),
            _ => None,
        };
        let mut links: Vec<Link> = Vec::new();
        let mut made = 0;
        while made < moving {
            let fixed = rng.chance(0.2);
            let parent = parent(rng, &links);
            let name = format!("link_{}", links.len());
            let joint = joint(rng, parent.map(|p| &links[p].joint), fixed);
            made += usize::from(!fixed);
            let parent = parent.map(|p| links[p].name.clone());
            let body = body(rng, made == moving);
            links.push(Link {
                name,
                parent,
                joint,
                body,
            });
        }
        let mut frames = Vec::new();
        if rng.chance(0.5) {
            let on = rng.pick(&links).name.clone();
            frames.push(format!(
                "{{ name: tool, link: {on}, origin: {{ xyz: [0, 1, 2] }} }}"
            ));
            frames.push("{ name: bench, link: world }".into());
        }
        let mut draft = Draft {
            exact: false,
            gravity,
            links,
            frames,
        };
        // From a separate sequence, so that the rest does not depend on it.
        let mut noise = Rng::new(rng.clone().next());
        if noise.chance(0.4) {
            draft.roughen(&mut noise);
        }
        draft
    }

    /// Adds rounding noise to axes: deviations from their exact directions by 1e-17 to 1e-7, mostly
    /// without snapping. Axes parallel or opposite to the parent's have its noise or another one.
    fn roughen(&mut self, noise: &mut Rng) {
        self.exact = noise.chance(0.75);
        let smooth: Vec<[f64; 3]> = self.links.iter().map(|l| l.joint.axis).collect();
        for i in 0..self.links.len() {
            let named = |l: &Link| Some(&l.name) == self.links[i].parent.as_ref();
            let parent = self.links.iter().position(named);
            let of_parent = parent.map(|p| (smooth[p], self.links[p].joint.axis));
            let axis = smooth[i];
            let size = 10f64.powi(-7 - noise.below(11) as i32);
            let off = [0; 3].map(|_| {
                if noise.chance(0.5) {
                    noise.within(size)
                } else {
                    0.0
                }
            });
            let keep = noise.chance(0.5);
            self.links[i].joint.axis = match of_parent {
                Some((was, is)) if keep && axis == was => is,
                Some((was, is)) if keep && axis == was.map(|x| -x) => is.map(|x| -x),
                _ => std::array::from_fn(|k| axis[k] + off[k]),
            };
        }
    }

    /// As a spec.
    pub fn yaml(&self) -> String {
        self.named("random")
    }

    /// As a spec of that name.
    pub fn named(&self, name: &str) -> String {
        let mut text = format!("format: 1\nname: {name}\n");
        if self.exact {
            text += "snap: 0\n";
        }
        if let Some(g) = self.gravity {
            writeln!(text, "gravity: {g:?}").unwrap();
        }
        text += "links:\n";
        for link in &self.links {
            writeln!(text, "  - name: {}", link.name).unwrap();
            if let Some(parent) = &link.parent {
                writeln!(text, "    parent: {parent}").unwrap();
            }
            let Joint {
                kind,
                axis,
                xyz,
                rpy,
            } = &link.joint;
            let number = link.name.trim_start_matches("link_");
            write!(text, "    joint: {{ name: joint_{number}, type: {kind}, ").unwrap();
            if *kind != "fixed" {
                write!(text, "axis: {}, ", axis_text(axis)).unwrap();
            }
            let rpy = rpy.join(", ");
            writeln!(text, "origin: {{ xyz: {xyz:?}, rpy: [{rpy}] }} }}").unwrap();
            text += &link.body;
        }
        if !self.frames.is_empty() {
            text += "frames:\n";
            for frame in &self.frames {
                writeln!(text, "  - {frame}").unwrap();
            }
        }
        text
    }

    /// Returns the same mechanism with its base elsewhere.
    pub fn moved(&self, by: [f64; 3]) -> Self {
        let mut moved = self.clone();
        for link in moved.links.iter_mut().filter(|l| l.parent.is_none()) {
            for (x, d) in link.joint.xyz.iter_mut().zip(by) {
                *x += d;
            }
        }
        moved
    }

    /// Returns the same mechanism with its links in another order.
    pub fn shuffled(&self, rng: &mut Rng) -> Self {
        let mut shuffled = self.clone();
        for i in (1..shuffled.links.len()).rev() {
            shuffled.links.swap(i, rng.below(i + 1));
        }
        shuffled
    }
}

/// Returns letters for the exact axes, so that both notations are tested.
fn axis_text(axis: &[f64; 3]) -> String {
    let place = |k: usize| axis[k].abs() == 1.0 && (0..3).all(|i| i == k || axis[i] == 0.0);
    match (0..3).find(|&k| place(k)) {
        Some(k) => format!(
            "{}{}",
            if axis[k] < 0.0 { "-" } else { "" },
            ["x", "y", "z"][k]
        ),
        None => format!("{axis:?}"),
    }
}

/// Mostly the newest link; sometimes an older one or the world.
fn parent(rng: &mut Rng, links: &[Link]) -> Option<usize> {
    if links.is_empty() || rng.chance(0.08) {
        None
    } else if rng.chance(0.75) {
        Some(links.len() - 1)
    } else {
        Some(rng.below(links.len()))
    }
}

fn joint(rng: &mut Rng, parent: Option<&Joint>, fixed: bool) -> Joint {
    let kind = match rng.below(8) {
        _ if fixed => "fixed",
        0 | 1 => "prismatic",
        2 => "continuous",
        _ => "revolute",
    };
    let mut joint = Joint {
        kind,
        axis: axis(rng),
        xyz: place(rng),
        rpy: [angle(rng), angle(rng), angle(rng)],
    };
    let level = || [(); 3].map(|()| "0".to_owned());
    match (rng.below(8), parent) {
        // Parallel, opposite, collinear.
        (0 | 1, Some(parent)) => (joint.axis, joint.rpy) = (parent.axis, level()),
        (2, Some(parent)) => (joint.axis, joint.rpy) = (parent.axis.map(|x| -x), level()),
        (3, Some(parent)) => {
            let along = *rng.pick(&[0.0, 0.25, -0.5]);
            (joint.axis, joint.rpy) = (parent.axis, level());
            joint.xyz = parent.axis.map(|x| x * along);
        }
        _ => {}
    }
    joint
}

fn axis(rng: &mut Rng) -> [f64; 3] {
    let mut axis = [0.0; 3];
    match rng.below(4) {
        0 => axis = [0; 3].map(|_| thousandths(rng, 1.0)),
        1 => {
            // In a coordinate plane.
            let k = rng.below(3);
            (axis[k], axis[(k + 1) % 3]) = (0.6, *rng.pick(&[0.8, -0.8, 0.3]));
        }
        _ => axis[rng.below(3)] = *rng.pick(&[1.0, -1.0]),
    }
    if axis == [0.0; 3] {
        [0.0, 0.0, 1.0]
    } else {
        axis
    }
}

fn place(rng: &mut Rng) -> [f64; 3] {
    let mut place = [0.0; 3];
    match rng.below(4) {
        0 => {}
        1 | 2 => place[rng.below(3)] = *rng.pick(&[0.5, -0.4, 1.0, 0.333]),
        _ => place = [0; 3].map(|_| thousandths(rng, 0.8)),
    }
    place
}

fn angle(rng: &mut Rng) -> String {
    match rng.below(9) {
        0..=3 => "0".into(),
        4 => (*rng.pick(&["90 deg", "-90 deg", "180 deg", "270 deg"])).into(),
        5 => (*rng.pick(&["1.5707963267948966", "3.141592653589793"])).into(),
        6 => (*rng.pick(&["30 deg", "45 deg", "-60 deg"])).into(),
        // Quarter turns rounded as in files: axes that are nearly parallel.
        7 => (*rng.pick(&["1.5708", "-1.5708", "3.1416", "1e-9", "-0.00001"])).into(),
        _ => format!("{}", thousandths(rng, 3.0)),
    }
}

fn thousandths(rng: &mut Rng, size: f64) -> f64 {
    (rng.within(size) * 1000.0).round() / 1000.0
}

/// Mass, centre of mass, inertia; the last link is never massless.
fn body(rng: &mut Rng, last: bool) -> String {
    let mut text = String::new();
    if rng.chance(0.12) && !last {
        return text; // massless
    }
    let mass = match rng.below(12) {
        0 => 1000.0,
        1 => 0.001,
        _ => 0.1 + (rng.unit() * 5000.0).round() / 1000.0,
    };
    writeln!(text, "    mass: {mass}").unwrap();
    match rng.below(4) {
        0 => {}
        1 => {
            let mut com = [0.0; 3];
            com[rng.below(3)] = 0.125;
            writeln!(text, "    com: {com:?}").unwrap();
        }
        _ => {
            let com = [0; 3].map(|_| thousandths(rng, 0.3));
            writeln!(text, "    com: {com:?}").unwrap();
        }
    }
    text + &tensor(rng)
}

/// Returns the tensor of a possible body: tr(D)·1 − D with D = Σ s sᵀ over a few points s.
fn tensor(rng: &mut Rng) -> String {
    let mut d = [[0.0; 3]; 3];
    let kind = rng.below(6);
    match kind {
        0 => return String::new(), // a point mass
        1 => (d[0][0], d[1][1], d[2][2]) = (0.02, 0.02, 0.07),
        2 => (d[0][0], d[1][1], d[2][2]) = (rng.unit(), rng.unit(), rng.unit()),
        _ => {
            for _ in 0..if kind == 3 { 1 } else { 4 } {
                let s = [0; 3].map(|_| thousandths(rng, 0.4));
                for i in 0..3 {
                    for j in 0..3 {
                        d[i][j] += s[i] * s[j];
                    }
                }
            }
        }
    }
    let (xx, yy, zz) = (d[1][1] + d[2][2], d[2][2] + d[0][0], d[0][0] + d[1][1]);
    let mut text = format!("    inertia: {{ xx: {xx:?}, yy: {yy:?}, zz: {zz:?}");
    if kind > 2 {
        let (xy, xz, yz) = (-d[0][1], -d[0][2], -d[1][2]);
        write!(text, ", xy: {xy:?}, xz: {xz:?}, yz: {yz:?}").unwrap();
    }
    if rng.chance(0.3) {
        let rpy = [angle(rng), angle(rng), angle(rng)].join(", ");
        write!(text, ", rpy: [{rpy}]").unwrap();
    }
    text + " }\n"
}
