//! Random planar mechanisms with loops of three unknown joints: four-bars, five-bars, six-bars, slider-cranks, slides on
//! cranks, cylinders between pins. At zero the axes of all links are parallel, and all axes have one direction, which is
//! along no axis of a frame.

use bgdyn_codegen::random::Random;

use super::random_loops::{Text, noisy, thousandths, vector};

/// What is drawn besides the loops.
pub struct Surroundings {
    /// The type of the joint that carries the mechanism.
    pub root: &'static str,
    pub gravity: bool,
    /// Whether the masses of the first links are run-time parameters.
    pub parameters: bool,
    /// Whether a loop's places are exchanged.
    pub exchanged: bool,
}

pub const KINDS: [&str; 8] = [
    "four_bar",
    "four_bar_cut_at_the_crank",
    "slider_crank",
    "slide_on_crank",
    "cylinder",
    "five_bar",
    "six_bar",
    "four_bar_on_arm",
];

/// A mechanism in the making.
struct Maker<'a> {
    random: &'a mut Random,
    axis: [i64; 3],
    text: Text,
    parameters: bool,
    exchanged: bool,
}

impl Maker<'_> {
    /// Adds a link and returns its number.
    fn link(&mut self, parent: usize, slides: bool) -> usize {
        let n = self.text.origins.len();
        let [x, y, z] = self.axis;
        let (kind, axis) = match slides {
            false => ("continuous", [x, y, z]),
            // Perpendicular to the axis, to the last digit.
            true if x == 0 && y == 0 => ("prismatic", [600, 800, 0]),
            true => ("prismatic", [y, -x, 0]),
        };
        let step = [0; 3].map(|_| thousandths(self.random, 400));
        let com = vector([0; 3].map(|_| thousandths(self.random, 150)));
        let mass = match self.parameters && n < 3 {
            true => format!("{{ parameter: m{n}, value: 0.{} }}", n + 3),
            false => format!("0.{}", n + 3),
        };
        self.text.links += &format!(
            "  - name: body_{n}\n    parent: body_{parent}\n    joint: {{ name: j{n}, type: {kind}, axis: {}, \
             origin: {{ xyz: {} }} }}\n    mass: {mass}\n    com: {com}\n    inertia: {{ xx: 0.02, yy: 0.03, zz: 0.025, xz: 0.002 }}\n",
            vector(axis),
            vector(step),
        );
        let from = self.text.origins[parent];
        self.text
            .origins
            .push(std::array::from_fn(|k| from[k] + step[k]));
        n
    }

    fn pin(&mut self, a: usize, b: usize) {
        let links = if self.exchanged { [b, a] } else { [a, b] };
        let axis = self.axis;
        self.text
            .connect(self.random, "hinge", links, (axis, [0; 3]));
    }
}

/// Returns the spec of a random mechanism.
pub fn draw(kind: &str, seed: u64, around: &Surroundings) -> String {
    let mut random = Random(seed);
    let axis = if seed.is_multiple_of(4) {
        [0, 0, 1000]
    } else {
        noisy(&mut random)
    };
    let text = Text::new(&mut random, around.root, 0, noisy);
    let mut maker = Maker {
        random: &mut random,
        axis,
        text,
        parameters: around.parameters,
        exchanged: around.exchanged,
    };
    let free: Vec<usize> = match kind {
        "four_bar" | "four_bar_on_arm" => {
            let ground = match kind {
                "four_bar" => 0,
                _ => maker.link(0, false),
            };
            let crank = maker.link(ground, false);
            let coupler = maker.link(crank, false);
            let rocker = maker.link(ground, false);
            maker.pin(coupler, rocker);
            if ground == 0 {
                vec![crank]
            } else {
                vec![ground, crank]
            }
        }
        "four_bar_cut_at_the_crank" => {
            let crank = maker.link(0, false);
            let rocker = maker.link(0, false);
            let coupler = maker.link(rocker, false);
            maker.pin(coupler, crank);
            vec![crank]
        }
        "slider_crank" => {
            let crank = maker.link(0, false);
            let rod = maker.link(crank, false);
            let slider = maker.link(0, true);
            maker.pin(rod, slider);
            vec![crank]
        }
        "slide_on_crank" => {
            let crank = maker.link(0, false);
            let slider = maker.link(crank, true);
            let arm = maker.link(0, false);
            maker.pin(slider, arm);
            vec![crank]
        }
        "cylinder" => {
            let barrel = maker.link(0, false);
            let rod = maker.link(barrel, true);
            let arm = maker.link(0, false);
            maker.pin(rod, arm);
            vec![arm]
        }
        "five_bar" => {
            let first = maker.link(0, false);
            let left = maker.link(first, false);
            let second = maker.link(0, false);
            let right = maker.link(second, false);
            maker.pin(left, right);
            vec![first, second]
        }
        _ => {
            let crank = maker.link(0, false);
            let coupler = maker.link(crank, false);
            let rocker = maker.link(0, false);
            let rod = maker.link(coupler, false);
            let output = maker.link(0, false);
            maker.pin(coupler, rocker);
            maker.pin(rod, output);
            vec![crank]
        }
    };
    let mut names: Vec<String> = free.iter().map(|n| format!("j{n}")).collect();
    if around.root != "fixed" && around.root != "floating" {
        names.push("root".into());
    }
    let text = maker.text.closed();
    let text = match around.gravity {
        true => text,
        false => text.replacen("gravity: [0.3, -0.4, -9.7]", "gravity: [0, 0, 0]", 1),
    };
    format!("{text}independent: [{}]\n", names.join(", "))
}
