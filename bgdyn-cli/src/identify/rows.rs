//! The rows of the regressor of a tree by the generated method `regressor`, and where the links are.

use bgdyn_codegen::bond_graph::{BondGraph, LinkFrame, PositionVariable};
use bgdyn_codegen::engine::{CallArguments, Callable};
use bgdyn_codegen::mechanism::{LinkId, Mechanism, Motion, Pose};
use bgdyn_codegen::method::{Method, Regressor};
use bgdyn_codegen::options::Options;
use bgdyn_codegen::selection;
use bgdyn_identification::Rows;
use bgdyn_identification::model::fill_by_rows;
use nalgebra::{DMatrix, Matrix3, Vector3};

use crate::engine::often_called;

/// The regressor of a tree of joints about and along axes.
pub(crate) struct GeneratedRows {
    joints: usize,
    bodies: usize,
    regressor: Box<dyn Callable>,
    /// Values of the run-time parameters.
    parameters: Vec<f64>,
}

/// Where a link is: its moving body and its pose there; `None` for one that is fixed to the world, or hidden.
pub(crate) type Places = Vec<Option<(usize, Matrix3<f64>, Vector3<f64>)>>;

impl GeneratedRows {
    /// Returns the rows of a mechanism and the places of its links.
    ///
    /// # Errors
    /// What the mechanism has that is no tree of joints about and along axes with q̇ = v.
    pub(crate) fn new(mechanism: &Mechanism, graph: &BondGraph) -> Result<(Self, Places), String> {
        refuse(graph)?;
        let method = Method::Regressor(Regressor::Full);
        let function = selection::function(mechanism, method, &Options::default());
        let function = function.ok_or("the mechanism has no regressor")?;
        let parameters = mechanism.parameters().iter();
        let rows = GeneratedRows {
            joints: graph.coordinates.len(),
            bodies: graph.moving_links().len(),
            regressor: often_called().prepare(&function),
            parameters: parameters.map(|p| p.default.to_f64()).collect(),
        };
        Ok((rows, places(graph)))
    }
}

/// Returns where each link is.
fn places(graph: &BondGraph) -> Places {
    let bodies = graph.moving_links();
    let mut places: Places = Vec::new();
    for (i, frame) in graph.frames.iter().enumerate() {
        let body = bodies.iter().position(|link| *link == LinkId(i));
        let fixed = || {
            let (body, outer, at) = places[frame.parent?.0]?;
            let (rotation, translation) = pose(&frame.origin);
            Some((body, outer * rotation, at + outer * translation))
        };
        let place = match frame.motion {
            Motion::None => fixed(),
            _ => body.map(|body| (body, Matrix3::identity(), Vector3::zeros())),
        };
        places.push(place);
    }
    places
}

fn refuse(graph: &BondGraph) -> Result<(), String> {
    let own = |(i, p): (usize, &PositionVariable)| {
        p.coordinate.is_some_and(|coordinate| coordinate.0 == i)
    };
    let what = if graph.closed.is_some() {
        "loops, wheels or knife edges"
    } else if graph.base.is_some() {
        "a base that moves"
    } else if graph.released.is_some() {
        "prescribed joints"
    } else if let Some(frame) = graph.frames.iter().find(|f| !along_axis(f)) {
        return Err(format!(
            "link `{}` has a joint of several degrees of freedom",
            frame.name
        ));
    } else if graph.positions.len() != graph.coordinates.len()
        || !graph.positions.iter().enumerate().all(own)
    {
        "positions whose rates are not velocities"
    } else {
        return Ok(());
    };
    Err(format!("the mechanism has {what}"))
}

fn along_axis(frame: &LinkFrame) -> bool {
    match frame.motion {
        Motion::None | Motion::Rotation | Motion::Translation => true,
        Motion::Compound(motion) => motion.axial && motion.positions.len() == 1,
    }
}

fn pose(pose: &Pose) -> (Matrix3<f64>, Vector3<f64>) {
    let (rotation, translation) = (&pose.rotation.0, &pose.translation.0);
    (
        Matrix3::from_fn(|i, j| rotation[i][j].to_f64()),
        Vector3::from_fn(|i, _| translation[i].to_f64()),
    )
}

impl Rows for GeneratedRows {
    fn joints(&self) -> usize {
        self.joints
    }

    fn bodies(&self) -> usize {
        self.bodies
    }

    fn effort_rows(&self, q: &[f64], v: &[f64], a: &[f64], rows: &mut DMatrix<f64>) {
        let (values, _) = self.regressor.value(&CallArguments {
            q,
            v,
            a,
            parameters: &self.parameters,
            ..CallArguments::default()
        });
        fill_by_rows(rows, &values);
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use bgdyn_codegen::engine::Engine;
    use bgdyn_codegen::expr::Inputs;
    use bgdyn_codegen::read_machine;
    use bgdyn_codegen::tape::Tape;
    use bgdyn_identification::model::Unknown;

    use super::super::{IdentifiedMachine, Wanted};
    use super::*;

    /// A screw, a slide, a follower, and links that are fixed to others and to the world.
    const JOINTS: &str = "
format: 1
links:
  - { name: stand, mass: 9, joint: { type: fixed, origin: { xyz: [0.1, 0, 0.2], rpy: [0, 0, 30 deg] } } }
  - { name: nut, parent: stand, joint: { name: screw, type: helical, lead: 0.1, axis: [0.3, 0, 1], origin: { xyz: [0, 0.1, 0.2], rpy: [0.2, 0, 0] } }, mass: 2, com: [0.1, 0, 0.05], inertia: { xx: 0.03, yy: 0.04, zz: 0.05, xy: 0.001 } }
  - { name: plate, parent: nut, joint: { type: fixed, origin: { xyz: [0, 0.2, 0], rpy: [0, 1, 0] } }, mass: 1, com: [0, 0, 0.1] }
  - { name: sled, parent: plate, joint: { name: slide, type: prismatic, axis: [1, 1, 0] }, mass: 1.5, com: [0.1, 0.2, 0] }
  - { name: arm, parent: sled, joint: { name: bend, type: revolute, axis: y, origin: { xyz: [0.3, 0, 0] } }, mass: 1, com: [0.2, 0, 0], inertia: { xx: 0.01, yy: 0.02, zz: 0.02 } }
  - { name: hand, parent: arm, joint: { name: wrist, type: revolute, axis: x, mimic: { joint: bend, ratio: -2, offset: 0.3 }, origin: { xyz: [0.3, 0, 0.1] } }, mass: 1, com: [0, 0.1, 0], inertia: { xx: 0.01, yy: 0.02, zz: 0.02 } }
";

    fn compare(name: &str, text: &str) {
        let (machine, faults) = read_machine(text, Some(name));
        let machine = machine.unwrap_or_else(|| panic!("{}", faults.render(name, text)));
        let identified = IdentifiedMachine::new(&machine, &Wanted::default()).expect("a tree");
        let model = identified.model();
        let graph = bgdyn_codegen::bond_graph::build(&machine.mechanism);
        let method = Method::named(&graph, "inverse_dynamics").expect("the method");
        let function =
            bgdyn_codegen::selection::function(&machine.mechanism, method, &Options::default());
        let prepared = Tape.prepare(&function.expect("a function"));
        let n = model.joints.len();
        let parameters: Vec<f64> = machine
            .mechanism
            .parameters()
            .iter()
            .map(|p| p.default.to_f64())
            .collect();
        for s in 0..5 {
            let of = |k: usize| {
                (0..n)
                    .map(|j| ((s * 7 + j * 3 + k) as f64).sin() * 1.3)
                    .collect::<Vec<f64>>()
            };
            let (q, v, a) = (of(0), of(11), of(29));
            let mut rows = DMatrix::zeros(n, 10 * model.rows.bodies());
            model.rows.effort_rows(&q, &v, &a, &mut rows);
            let file = model
                .unknowns()
                .into_iter()
                .filter(|u| matches!(u, Unknown::Link(..)));
            let file: Vec<f64> = file.map(|u| model.file(u)).collect();
            let found = model.rows_of_links(&rows) * nalgebra::DVector::from_vec(file);
            let inputs = Inputs {
                q,
                v,
                a,
                parameters: parameters.clone(),
                ..Inputs::default()
            };
            let (expected, _) = prepared.value(&(&inputs).into());
            for (j, (x, y)) in found.iter().zip(&expected).enumerate() {
                assert!(
                    (x - y).abs() < 1e-11 * (1.0 + y.abs()),
                    "{name}, joint {j}: {x} for {y}"
                );
            }
        }
    }

    #[test]
    fn rows_times_the_files_numbers_are_inverse_dynamics() {
        compare("joints", JOINTS);
        for name in ["panda", "puma560", "scara", "ur5", "stanford", "torso"] {
            let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../specs/{name}.yaml"));
            compare(name, &std::fs::read_to_string(path).expect("a spec"));
        }
    }

    #[test]
    fn other_mechanisms_are_refused_by_name() {
        let text = "format: 1\nlinks:\n  - { name: ball, joint: { name: free, type: floating }, mass: 1, inertia: { solid: sphere, radius: 1 } }\n";
        let (machine, _) = read_machine(text, Some("ball"));
        let faults = IdentifiedMachine::new(&machine.expect("a machine"), &Wanted::default()).err();
        assert!(faults.expect("refused")[0].contains("link `ball` has a joint of several degrees"));
    }
}
