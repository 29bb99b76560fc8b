//! Mechanisms with loops whose links are compared with free bodies, and the loads of their loops.

use bgdyn_codegen::random::Random;
use bgdyn_runtime::Dd;

use super::drawn::{NORMAL, at, connect, four_bar, spherical, xyz};
use super::free_bodies::{Load, Placed};
use super::random_loops::Text;
use super::robot::{Robot, State};

/// A mechanism, and for each of its loops the links of places a and b.
pub struct FreeBodyCase {
    pub text: Text,
    pub links: Vec<[usize; 2]>,
    pub what: String,
}

impl FreeBodyCase {
    fn new(text: Text, links: &[[usize; 2]], what: impl Into<String>) -> Self {
        FreeBodyCase {
            text,
            links: links.to_vec(),
            what: what.into(),
        }
    }

    /// Returns the loads on the links at the places of loops, from those on places b, in the axes of places a.
    pub fn loads(&self, tree: &Robot, motion: &State<Dd>, reactions: &[Dd]) -> Vec<(usize, Load)> {
        let mut loads = Vec::new();
        for ((l, [a, b]), load) in self.links.iter().enumerate().zip(reactions.chunks(6)) {
            let at = |end: &str| Placed::frame(tree, &format!("{end}{l}"), motion);
            let place = Placed {
                origin: at("b").origin,
                ..at("a")
            };
            let load = place.load(load);
            loads.push((*b, load));
            loads.push((*a, load.opposite()));
        }
        loads
    }
}

/// A point and a rod between branches with noisy axes.
pub fn spatial() -> Vec<FreeBodyCase> {
    let roots = ["fixed", "prismatic, axis: [0.6, 0.8, 0]"];
    let of = |(seed, root): (u64, &str)| {
        let text = Text::point_and_rod(&mut Random(1100 + seed), root);
        FreeBodyCase::new(text, &[[4, 8], [3, 6]], format!("point and rod, {root}"))
    };
    (0..).zip(roots).map(of).collect()
}

/// Loops of the other types.
pub fn of_other_types() -> Vec<FreeBodyCase> {
    let of = |(seed, kind): (u64, &'static str)| {
        let mut random = Random(1200 + seed);
        let text = Text::of_type(&mut random, "continuous, axis: [1, -2, 3]", kind);
        FreeBodyCase::new(text, &[[4, 8]], kind)
    };
    let kinds = ["hinge", "slider", "weld", "universal"];
    (0..).zip(kinds).map(of).collect()
}

/// Rows are left out: in a plane along no axis of a link; with the pin written twice, of which only one carries; about
/// one point; of a hinge in the plane of its branches, whose links are in balance without their loads.
pub fn with_rows_left_out() -> Vec<FreeBodyCase> {
    let root = "continuous, axis: [1, -2, 3]";
    let ends = [at(0.4, 0.0), at(0.3, 0.0)].map(xyz);
    let pins = [("coupler", ends[0].as_str()), ("rocker", ends[1].as_str())];
    let pinned = |times: usize| {
        let mut text = four_bar(root, [0.12, 0.35]);
        for more in ["", "    redundant: allow\n"].into_iter().take(times) {
            connect(&mut text, "hinge", pins, (NORMAL, more));
        }
        text
    };
    let mut random = Random(1300);
    let mut planar = Text::planar(&mut random, "fixed", 3);
    planar.connect(&mut random, "hinge", [3, 6], ([0, 0, 1000], [0; 3]));
    vec![
        FreeBodyCase::new(pinned(1), &[[2, 3]], "four-bar"),
        FreeBodyCase::new(pinned(2), &[[2, 3], [2, 3]], "the same pin twice"),
        FreeBodyCase::new(spherical(root, 0.25), &[[2, 3]], "spherical"),
        FreeBodyCase::new(planar, &[[3, 6]], "planar"),
    ]
}
