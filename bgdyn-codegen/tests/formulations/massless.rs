//! Tests consecutive massless links: solved if the outboard body gives each joint inertia, refused in
//! every state if it cannot.

use std::fmt::Write;

use crate::common::rng::Rng;
use crate::common::{Robot, State};
use bgdyn_codegen::method::Method;
use bgdyn_runtime::Dd;

/// Joints on consecutive massless links, and a body.
struct Row {
    axes: &'static [&'static str],
    step: &'static str,
    body: &'static str,
    /// Number of joints to which the body gives inertia.
    rank: usize,
}

const HERE: &str = "[0, 0, 0]";
const STEP: &str = "[0.3, 0.1, 0.2]";
const POINT: &str = "mass: 1.3\n    com: [0.1, 0.2, 0.3]";
const RIGID: &str = "mass: 1.3\n    com: [0.1, 0.2, 0.3]\n    inertia: { xx: 1, yy: 1.1, zz: 1.2 }";
const SKEW: &str = "[0.6, 0.8, 0]";
const ODD: &str = "[0.708, -0.786, -0.694]";

impl Row {
    fn robot(&self) -> Robot {
        let mut links = String::new();
        for (i, axis) in self.axes.iter().enumerate() {
            let step = if i > 0 { self.step } else { HERE };
            writeln!(links, "  - name: link_{i}").unwrap();
            if i > 0 {
                writeln!(links, "    parent: link_{}", i - 1).unwrap();
            }
            writeln!(
                links,
                "    joint: {{ name: joint_{i}, type: revolute, axis: {axis}, origin: {{ xyz: {step} }} }}"
            )
            .unwrap();
        }
        let text = format!("format: 1\nname: row\nlinks:\n{links}    {}\n", self.body);
        Robot::read(&text, None)
    }

    /// Checks seeded states: refused with the name of a joint without inertia, or solved.
    fn check(&self, states: usize) {
        let robot = self.robot();
        let f = robot.chosen(Method::ForwardDynamics);
        let lost = self.axes.len().checked_sub(self.rank + 1);
        let lost = lost.map(|j| format!("joint_{j}"));
        let mut rng = Rng::new(11);
        for _ in 0..states {
            let mut s = State::random(&mut rng, &robot.motions());
            // At exact zeros a gimbal is locked.
            s.q.iter_mut().filter(|q| **q == 0.0).for_each(|q| *q = 0.1);
            let (_, refused) = f.evaluate(s.inputs::<f64>());
            let found = refused.map(|j| robot.joints()[j].clone());
            let place = || format!("{:?} {} {}\n{s:?}", self.axes, self.step, self.body);
            assert_eq!(found, lost, "{}", place());
        }
    }
}

#[test]
fn massless_links_in_a_row_that_can_be_moved() {
    let row = |axes, step, body| Row {
        axes,
        step,
        body,
        rank: usize::MAX - 1,
    };
    for row in [
        row(&["z", "y", "x"], HERE, RIGID),
        row(&["z", SKEW, ODD], HERE, RIGID),
        row(&["z", "y", "x"], STEP, POINT),
        row(&["z", "z"], STEP, POINT),
        row(&["z", "z", "z"], STEP, RIGID),
        row(&["z", "y", "x", "z"], STEP, RIGID),
        row(&["z", "y", "x", "z", "y"], STEP, RIGID),
        row(&["z", "y", "x", "z", "y", "x"], STEP, RIGID),
    ] {
        row.check(1250);
    }
}

#[test]
fn massless_links_in_a_row_that_cannot() {
    let row = |axes, step, body, rank| Row {
        axes,
        step,
        body,
        rank,
    };
    for row in [
        row(&["z", "y", "x", "z"], HERE, RIGID, 3),
        row(&["z", "y", "x", "z", "y"], HERE, RIGID, 3),
        row(&["z", SKEW, ODD, "z"], HERE, RIGID, 3),
        row(&["z", "y", "x", "z"], STEP, POINT, 3),
        row(&["z", SKEW, ODD, "z", "y"], STEP, POINT, 3),
        row(&["z", "y", "x", "z", "y", "x", "z"], STEP, RIGID, 6),
        row(&["z", "z", "z"], STEP, POINT, 2),
        row(&["z", "z", "z", "z"], STEP, RIGID, 3),
    ] {
        row.check(1250);
    }
}

/// ∂q̈/∂τ = M⁻¹ and ∂q̈/∂q if only articulated bodies are accurate: the derivatives are as accurate as the
/// accelerations.
#[test]
fn derivatives_beyond_a_massless_link() {
    let row = Row {
        axes: &["z", "y", "z"],
        step: HERE,
        body: RIGID,
        rank: 3,
    };
    let robot = row.robot();
    let f = robot.chosen(Method::ForwardDynamicsDerivatives);
    let mass = robot.chosen(Method::MassMatrix);
    for angle in [0.7, 1e-3, 1e-6] {
        let s = State {
            q: vec![0.3, angle, 0.4],
            v: vec![0.1, -0.2, 0.3],
            a: vec![0.0; 3],
            tau: vec![0.5, 0.4, -0.3],
            parameters: Vec::new(),
        };
        let exact: Vec<Dd> = s.value(&f);
        let rough: Vec<f64> = s.value(&f);
        let m = crate::common::full(&s.value::<Dd>(&mass), 3);
        let inverse = &exact[3 + 18..];
        for i in 0..3 {
            for j in 0..3 {
                let sum = (0..3).fold(Dd::ZERO, |sum, k| sum + m[i][k] * inverse[3 * k + j]);
                let off = (sum - Dd::from_f64(f64::from(i == j))).abs().to_f64();
                // A condition number of 1 / angle² in double-double.
                assert!(off < 1e-15, "{angle}: {off:e}");
            }
        }
        for block in [3..12, 12..21, 21..30] {
            let size = block
                .clone()
                .map(|k| exact[k].to_f64().abs())
                .fold(0.0, f64::max);
            for k in block {
                let off = (Dd::from_f64(rough[k]) - exact[k]).abs().to_f64();
                // The efforts almost cancel near the gimbal lock, which costs a factor 1 / angle.
                let bar = 64.0 * f64::EPSILON / angle * size;
                assert!(off <= bar, "{angle}, {k}: {off:e} of {size:e}");
            }
        }
    }
}
