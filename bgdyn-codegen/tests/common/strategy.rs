//! Mechanisms and states for proptest: a failing one shrinks to fewer links and rounder numbers.

use proptest::prelude::*;
use proptest::sample::{Index, select};

use crate::common::random::{Draft, Joint, Link};
use crate::common::{Robot, State};

/// A mechanism whose first joint moves, and numbers for its state.
#[derive(Clone, Debug)]
pub struct Machine {
    pub draft: Draft,
    numbers: Vec<[f64; 4]>,
}

impl Machine {
    /// The state of a robot made from the draft.
    pub fn state(&self, robot: &Robot) -> State {
        let all = |k: usize| self.numbers[..robot.nv()].iter().map(|x| x[k]).collect();
        State {
            q: all(0),
            v: all(1),
            a: all(2),
            tau: all(3),
            parameters: Vec::new(),
        }
    }
}

/// A machine of up to `most` links.
pub fn machine(most: usize) -> impl Strategy<Value = Machine> {
    let links = prop::collection::vec((any::<Index>(), joint(), body()), 1..=most);
    let numbers = [3200, 2000, 3000, 20_000].map(thousandths);
    let numbers = prop::collection::vec(numbers, most);
    let gravity = prop::option::of([9810, 9810, 9810].map(thousandths));
    (links, numbers, gravity).prop_map(|(links, numbers, gravity)| Machine {
        draft: draft(links, gravity),
        numbers,
    })
}

fn draft(genes: Vec<(Index, Joint, String)>, gravity: Option<[f64; 3]>) -> Draft {
    let mut links: Vec<Link> = Vec::new();
    for (number, (parent, mut joint, body)) in genes.into_iter().enumerate() {
        if number == 0 && joint.kind == "fixed" {
            joint.kind = "revolute";
        }
        // The world, or an earlier link.
        let parent = parent.index(number + 1).checked_sub(1);
        links.push(Link {
            name: format!("link_{number}"),
            parent: parent.map(|p| links[p].name.clone()),
            joint,
            body,
        });
    }
    let on = links.last().map_or("world", |link| &link.name);
    let frames = vec![format!(
        "{{ name: tool, link: {on}, origin: {{ xyz: [0, 1, 2] }} }}"
    )];
    Draft {
        exact: false,
        gravity,
        links,
        frames,
    }
}

fn joint() -> impl Strategy<Value = Joint> {
    let kind = select(vec![
        "revolute",
        "revolute",
        "continuous",
        "prismatic",
        "fixed",
    ]);
    let exact = select(vec![[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]]);
    let skew = [-5..=5, -5..=5, 1..=5].map(|range| range.prop_map(f64::from));
    let axis = prop_oneof![2 => exact, 1 => skew];
    let place = prop_oneof![1 => Just([0.0; 3]), 2 => [800, 800, 800].map(thousandths)];
    let rpy = [angle(), angle(), angle()];
    (kind, axis, place, rpy).prop_map(|(kind, axis, xyz, rpy)| Joint {
        kind,
        axis,
        xyz,
        rpy,
    })
}

fn angle() -> impl Strategy<Value = String> {
    let exact = select(vec![
        "0", "90 deg", "-90 deg", "180 deg", "30 deg", "1.5708",
    ]);
    prop_oneof![
        3 => exact.prop_map(str::to_owned),
        1 => thousandths(3000).prop_map(|x| x.to_string()),
    ]
}

/// Returns mass, centre of mass, and the tensor of a possible body: tr(D)·1 − D with D = diag(a, b, c).
fn body() -> impl Strategy<Value = String> {
    let second = [0..200, 0..200, 0..200].map(|range| range.prop_map(|x| f64::from(x) / 1000.0));
    let massive = (1..5000, [300, 300, 300].map(thousandths), second, angle());
    let massive = massive.prop_map(|(mass, com, [a, b, c], turn)| {
        let (mass, xx, yy, zz) = (f64::from(mass) / 1000.0, b + c, c + a, a + b);
        format!(
            "    mass: {mass}\n    com: {com:?}\n    inertia: {{ xx: {xx}, yy: {yy}, zz: {zz}, \
             rpy: [{turn}, 0, {turn}] }}\n"
        )
    });
    prop_oneof![1 => Just(String::new()), 7 => massive]
}

fn thousandths(most: i32) -> impl Strategy<Value = f64> + Clone {
    (-most..=most).prop_map(|x| f64::from(x) / 1000.0)
}
