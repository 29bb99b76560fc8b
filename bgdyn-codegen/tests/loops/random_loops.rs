//! Random mechanisms with loops: at zero the axes of all links are parallel, so that places with the sum of the
//! origins coincide.

use bgdyn_codegen::random::Random;
use bgdyn_runtime::Dd;

use super::robot::dot;

/// A loop of a random mechanism.
pub struct Loop {
    pub kind: &'static str,
    /// The axis, for types with one.
    pub axis: [Dd; 3],
}

pub fn number(text: &str) -> Dd {
    text.parse().expect("a number")
}

/// A random decimal with three digits, in thousandths.
pub fn thousandths(random: &mut Random, size: i64) -> i64 {
    random.below((2 * size + 1) as u64) as i64 - size
}

pub fn decimal(thousandths: i64) -> String {
    let sign = if thousandths < 0 { "-" } else { "" };
    let size = thousandths.abs();
    format!("{sign}{}.{:03}", size / 1000, size % 1000)
}

pub fn vector(v: [i64; 3]) -> String {
    format!("[{}]", v.map(decimal).join(", "))
}

/// Returns an axis in any direction.
pub fn noisy(random: &mut Random) -> [i64; 3] {
    let axis = [0; 3].map(|_| thousandths(random, 999));
    if axis.iter().all(|x| x.abs() < 50) {
        [0, 0, 1000]
    } else {
        axis
    }
}

/// A mechanism whose links' axes are parallel at zero, so that places with the sum of the origins coincide there.
pub struct Text {
    pub links: String,
    pub frames: String,
    pub loops: String,
    /// Origins of the links in the axes of the world, thousandths of a metre.
    pub origins: Vec<[i64; 3]>,
    pub all: Vec<Loop>,
}

impl Text {
    /// Two branches of `count` joints each on a body that floats, is fixed or turns about a ball.
    pub fn new(
        random: &mut Random,
        root: &str,
        count: usize,
        axes: impl Fn(&mut Random) -> [i64; 3],
    ) -> Self {
        let mut text = Text {
            links: format!(
                "  - name: body_0\n    joint: {{ name: root, type: {root} }}\n    mass: 1.7\n    com: [0.02, 0.01, -0.03]\n    \
                 inertia: {{ xx: 0.03, yy: 0.04, zz: 0.05, xy: 0.001 }}\n"
            ),
            frames: String::new(),
            loops: String::new(),
            origins: vec![[0; 3]],
            all: Vec::new(),
        };
        for branch in 0..2 {
            for i in 0..count {
                let n = text.origins.len();
                let parent = if i == 0 { 0 } else { n - 1 };
                let kind = if i == 2 && branch == 0 {
                    "prismatic"
                } else {
                    "continuous"
                };
                let step = [0; 3].map(|_| thousandths(random, 400));
                let com = vector([0; 3].map(|_| thousandths(random, 100)));
                let axis = vector(axes(random));
                text.links += &format!(
                    "  - name: body_{n}\n    parent: body_{parent}\n    joint: {{ name: j{n}, type: {kind}, axis: {axis}, \
                     origin: {{ xyz: {} }} }}\n    mass: 0.{}\n    com: {com}\n    inertia: {{ xx: 0.02, yy: 0.03, zz: 0.025, xz: 0.002 }}\n",
                    vector(step),
                    n + 3
                );
                let from = text.origins[parent];
                text.origins
                    .push(std::array::from_fn(|k| from[k] + step[k]));
            }
        }
        text
    }

    /// Two branches in one plane, with a slide in it.
    pub fn planar(random: &mut Random, root: &str, count: usize) -> Self {
        let mut text = Text::new(random, root, count, |_| [0, 0, 1000]);
        text.links = text.links.replacen(
            "type: prismatic, axis: [0.000, 0.000, 1.000]",
            "type: prismatic, axis: [0.600, 0.800, 0.000]",
            1,
        );
        text
    }

    /// A point and a rod between links of a tree with this root.
    pub fn point_and_rod(random: &mut Random, root: &str) -> Self {
        let mut text = Text::new(random, root, 4, noisy);
        text.connect(random, "point", [4, 8], ([0, 0, 1000], [0; 3]));
        let apart = ([0, 0, 1000], [30, 40, 120]);
        text.connect(random, "distance", [3, 6], apart);
        text
    }

    /// Two branches of four joints with noisy axes whose ends a loop of this type connects; a slider's are apart along
    /// its axis, to a millimetre.
    pub fn of_type(random: &mut Random, root: &str, kind: &'static str) -> Self {
        let mut text = Text::new(random, root, 4, noisy);
        let axis = noisy(random);
        let apart = match kind {
            "slider" => axis.map(|x| x / 10),
            _ => [0; 3],
        };
        text.connect(random, kind, [4, 8], (axis, apart));
        text
    }

    /// Gives a joint, by its number, another type.
    pub fn with_joint(mut self, number: usize, kind: &str) -> Self {
        let from = self
            .links
            .find(&format!("name: j{number}, type: "))
            .expect("a joint");
        let to = from + self.links[from..].find(", origin").expect("an origin");
        self.links
            .replace_range(from..to, &format!("name: j{number}, type: {kind}"));
        self
    }

    /// Connects places of two links that are apart by `apart` in the axes of the world at zero.
    pub fn connect(
        &mut self,
        random: &mut Random,
        kind: &'static str,
        links: [usize; 2],
        (axis, apart): ([i64; 3], [i64; 3]),
    ) {
        let k = self.all.len();
        let a = [0; 3].map(|_| thousandths(random, 200));
        let [from, to] = links.map(|i| self.origins[i]);
        let b: [i64; 3] = std::array::from_fn(|k| from[k] + a[k] + apart[k] - to[k]);
        let [a, b] = [a, b].map(vector);
        for (end, link, at) in [("a", links[0], &a), ("b", links[1], &b)] {
            self.frames +=
                &format!("  - {{ name: {end}{k}, link: body_{link}, origin: {{ xyz: {at} }} }}\n");
        }
        let more = match kind {
            "hinge" | "slider" => format!("    axis: {}\n", vector(axis)),
            // 3, 4, 12: 13
            "distance" => "    length: 0.13\n".to_owned(),
            _ => String::new(),
        };
        self.loops += &format!(
            "  - name: loop_{k}\n    type: {kind}\n    a: {{ frame: a{k} }}\n    b: {{ frame: b{k} }}\n{more}"
        );
        let axis = axis.map(|x| number(&decimal(x)));
        let length = dot(&axis, &axis).sqrt();
        self.all.push(Loop {
            kind,
            axis: axis.map(|x| x / length),
        });
    }

    pub fn open(&self) -> String {
        format!(
            "format: 1\nname: looped\ngravity: [0.3, -0.4, -9.7]\nlinks:\n{}frames:\n{}",
            self.links, self.frames
        )
    }

    pub fn closed(&self) -> String {
        format!("{}loops:\n{}", self.open(), self.loops)
    }
}
