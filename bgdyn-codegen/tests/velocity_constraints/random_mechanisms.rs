//! Random mechanisms with wheels, balls and knife edges on links in general position.

use bgdyn_codegen::random::Random;
use bgdyn_runtime::Dd;

use super::robot::dot;

/// What touches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Touch {
    Edge,
    Wheel,
    /// A wheel that may slip along its axle.
    Longitudinal,
    Lateral,
    Tyre,
    /// A tyre that may slip along its axle.
    LongitudinalTyre,
    /// A tyre that may slip across its axle.
    LateralTyre,
    Ball,
    Ellipsoid,
}

impl Touch {
    /// Whether the rows along the plane are along its axes.
    pub fn without_axle(self) -> bool {
        matches!(self, Touch::Ball | Touch::Ellipsoid)
    }
}

/// A constraint of a random mechanism.
pub struct Constraint {
    pub touch: Touch,
    /// Direction of a knife edge, axle of a wheel, in the axes of its frame.
    pub axis: [Dd; 3],
    pub radius: Dd,
    /// Radius of a tyre's sections; 0 of others.
    pub crown: Dd,
    /// Those of an ellipsoid.
    pub half_axes: [Dd; 3],
}

fn thousandths(random: &mut Random, size: i64) -> i64 {
    random.below((2 * size + 1) as u64) as i64 - size
}

fn decimal(thousandths: i64) -> String {
    let sign = if thousandths < 0 { "-" } else { "" };
    let size = thousandths.abs();
    format!("{sign}{}.{:03}", size / 1000, size % 1000)
}

fn vector(v: [i64; 3]) -> String {
    format!("[{}]", v.map(decimal).join(", "))
}

fn unit(v: [i64; 3]) -> [Dd; 3] {
    let v = v.map(|x| decimal(x).parse().expect("a number"));
    let length = dot(&v, &v).sqrt();
    v.map(|x: Dd| x / length)
}

/// Returns a direction, none of whose components is small.
fn noisy(random: &mut Random) -> [i64; 3] {
    [0; 3].map(|_| {
        let x = thousandths(random, 700);
        if x < 0 { x - 250 } else { x + 250 }
    })
}

/// A mechanism with its constraints.
pub struct Text {
    pub head: String,
    pub links: String,
    pub frames: String,
    pub constraints: String,
    pub all: Vec<Constraint>,
    /// The normal of the plane.
    pub normal: [Dd; 3],
}

impl Text {
    /// A body with a chain of `count` joints on it; the plane `slope` has any normal.
    pub fn new(random: &mut Random, root: &str, count: usize) -> Self {
        let normal = noisy(random);
        let head = format!(
            "format: 1\nname: rolling\ngravity: [0.3, -0.4, -9.7]\nplanes:\n  slope: {{ normal: {}, offset: 0.07 }}\n",
            vector(normal)
        );
        let mut text = Text {
            head,
            links: format!(
                "  - name: body_0\n    joint: {{ name: root, {root} }}\n    mass: 1.7\n    com: [0.02, 0.01, -0.03]\n    \
                 inertia: {{ xx: 0.03, yy: 0.04, zz: 0.05, xy: 0.001 }}\n"
            ),
            frames: String::new(),
            constraints: String::new(),
            all: Vec::new(),
            normal: unit(normal),
        };
        for i in 1..=count {
            let kind = if i == 2 { "prismatic" } else { "continuous" };
            let [step, com] =
                [300, 100].map(|size| vector([0; 3].map(|_| thousandths(random, size))));
            let axis = vector(noisy(random));
            text.links += &format!(
                "  - name: body_{i}\n    parent: body_{}\n    joint: {{ name: j{i}, type: {kind}, axis: {axis}, \
                 origin: {{ xyz: {step}, rpy: [0.3, -0.5, 0.{i}] }} }}\n    mass: 0.{}\n    com: {com}\n    \
                 inertia: {{ xx: 0.02, yy: 0.03, zz: 0.025, xz: 0.002 }}\n",
                i - 1,
                i + 3
            );
        }
        text
    }

    /// Adds a wheel with its own link: the joint is about the axle.
    pub fn wheel(&mut self, random: &mut Random, on: usize, touch: Touch) {
        let axle = noisy(random);
        let (axis, step) = (
            vector(axle),
            vector([0; 3].map(|_| thousandths(random, 300))),
        );
        let k = self.all.len();
        self.links += &format!(
            "  - name: wheel_{k}\n    parent: body_{on}\n    joint: {{ name: spin_{k}, type: continuous, axis: {axis}, \
             origin: {{ xyz: {step}, rpy: [0.1, 0.2, 0.3] }} }}\n    mass: 0.4\n    com: [0.01, 0.02, 0]\n    \
             inertia: {{ xx: 0.02, yy: 0.03, zz: 0.025 }}\n"
        );
        self.constrain(touch, axle, (&format!("wheel_{k}"), [0; 3]));
    }

    /// Adds a constraint at a place of a body.
    pub fn touch(&mut self, random: &mut Random, on: usize, touch: Touch) {
        let axis = noisy(random);
        let at = [0; 3].map(|_| thousandths(random, 200));
        self.constrain(touch, axis, (&format!("body_{on}"), at));
    }

    fn constrain(&mut self, touch: Touch, axis: [i64; 3], (link, at): (&str, [i64; 3])) {
        let k = self.all.len();
        // A wheel with a joint about its axle has the axes of its link.
        let turned = match touch {
            Touch::Ellipsoid => ", rpy: [0.4, -0.3, 0.7]",
            _ => "",
        };
        self.frames += &format!(
            "  - {{ name: f{k}, link: {link}, origin: {{ xyz: {}{turned} }} }}\n",
            vector(at)
        );
        let direction = vector(axis);
        let keys = match touch {
            Touch::Edge => format!("type: knife_edge, at: f{k}, direction: {direction}"),
            Touch::Ball => format!("type: rolling, link: f{k}, radius: 0.4, on: slope"),
            Touch::Ellipsoid => {
                format!("type: rolling, link: f{k}, radii: [0.4, 0.25, 0.3], on: slope")
            }
            Touch::Tyre | Touch::LongitudinalTyre | Touch::LateralTyre => format!(
                "type: rolling, link: f{k}, axis: {direction}, radius: 0.4, crown_radius: 0.13, on: slope"
            ),
            _ => format!("type: rolling, link: f{k}, axis: {direction}, radius: 0.4, on: slope"),
        };
        let rows = match touch {
            Touch::Longitudinal | Touch::LongitudinalTyre => ", rows: [longitudinal]",
            Touch::Lateral | Touch::LateralTyre => ", rows: [lateral]",
            _ => "",
        };
        self.constraints += &format!("  c{k}: {{ {keys}{rows} }}\n");
        let number = |text: &str| -> Dd { text.parse().expect("a number") };
        let crown = match touch {
            Touch::Tyre | Touch::LongitudinalTyre | Touch::LateralTyre => number("0.13"),
            _ => Dd::ZERO,
        };
        self.all.push(Constraint {
            touch,
            axis: unit(axis),
            radius: number("0.4"),
            crown,
            half_axes: ["0.4", "0.25", "0.3"].map(number),
        });
    }

    /// Carries the first body by links without mass, `base_0` and so on, with these joints.
    pub fn on_chain(mut self, joints: &[&str]) -> Self {
        let mut chain = String::new();
        for (k, joint) in joints.iter().enumerate() {
            let parent = match k {
                0 => String::new(),
                _ => format!("    parent: link_{}\n", k - 1),
            };
            chain +=
                &format!("  - name: link_{k}\n{parent}    joint: {{ name: base_{k}, {joint} }}\n");
        }
        let last = format!("    parent: link_{}\n", joints.len() - 1);
        let body = "  - name: body_0\n";
        self.links = chain + &self.links.replacen(body, &format!("{body}{last}"), 1);
        self
    }

    pub fn open(&self) -> String {
        format!(
            "{}links:\n{}frames:\n{}",
            self.head, self.links, self.frames
        )
    }

    pub fn constrained(&self) -> String {
        format!("{}constraints:\n{}", self.open(), self.constraints)
    }
}
