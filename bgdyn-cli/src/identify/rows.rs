//! The rows of the regressor of a tree, by the Newton–Euler equations: each parameter's wrench on its body, projected
//! on the joints before it.

use bgdyn_codegen::bond_graph::{BondGraph, LinkFrame};
use bgdyn_codegen::mechanism::{Motion, Pose};
use bgdyn_identification::Rows;
use nalgebra::{DMatrix, Matrix3, Rotation3, Unit, Vector3};

/// A moving body: a moving link with all that is fixed to it.
struct MovingBody {
    parent: Option<usize>,
    /// Pose of the joint's origin in the parent's axes.
    rotation: Matrix3<f64>,
    translation: Vector3<f64>,
    axis: Unit<Vector3<f64>>,
    /// The positions that it follows with their factors, and its position where they are zero.
    positions: Vec<(usize, f64)>,
    offset: f64,
    /// Turn and shift along the axis per unit position.
    pitch: [f64; 2],
    /// Velocities with the motion per unit velocity, angular and linear, link axes.
    columns: Vec<(usize, Vector3<f64>, Vector3<f64>)>,
}

/// A tree of joints about and along axes.
pub(crate) struct TreeRows {
    joints: usize,
    bodies: Vec<MovingBody>,
    gravity: Vector3<f64>,
}

/// Where a link is: its moving body and its pose there; `None` for one that is fixed to the world.
pub(crate) type Places = Vec<Option<(usize, Matrix3<f64>, Vector3<f64>)>>;

impl TreeRows {
    /// Returns the rows of a mechanism and the places of its links.
    ///
    /// # Errors
    /// What the mechanism has that is no tree of joints about and along axes with q̇ = v.
    pub(crate) fn new(graph: &BondGraph) -> Result<(Self, Places), String> {
        refuse(graph)?;
        let (mut bodies, mut places): (Vec<MovingBody>, Places) = (Vec::new(), Vec::new());
        for frame in &graph.frames {
            let parent = frame.parent.map_or(Some(None), |p| places[p.0].map(Some));
            // A link on one that is fixed to the world has its pose there from the chain of origins.
            let (own_rotation, own_translation) = pose(&frame.origin);
            let base = match (frame.parent, parent) {
                (Some(p), None) => Some(world_pose(graph, p.0)),
                _ => None,
            };
            let (body, rotation, translation) = match (parent.flatten(), base) {
                (Some((body, r, p)), _) => (Some(body), r * own_rotation, p + r * own_translation),
                (None, Some((r, p))) => (None, r * own_rotation, p + r * own_translation),
                (None, None) => (None, own_rotation, own_translation),
            };
            if frame.motion == Motion::None {
                places.push(body.map(|body| (body, rotation, translation)));
                continue;
            }
            places.push(Some((bodies.len(), Matrix3::identity(), Vector3::zeros())));
            bodies.push(moving(frame, body, rotation, translation));
        }
        let gravity = vector(&graph.gravity.0);
        let joints = graph.coordinates.len();
        Ok((
            TreeRows {
                joints,
                bodies,
                gravity,
            },
            places,
        ))
    }
}

fn refuse(graph: &BondGraph) -> Result<(), String> {
    let own = |(i, p): (usize, &bgdyn_codegen::bond_graph::PositionVariable)| {
        p.coordinate.is_some_and(|c| c.0 == i)
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

fn world_pose(graph: &BondGraph, link: usize) -> (Matrix3<f64>, Vector3<f64>) {
    let frame = &graph.frames[link];
    let (r, p) = pose(&frame.origin);
    match frame.parent {
        None => (r, p),
        Some(parent) => {
            let (outer, at) = world_pose(graph, parent.0);
            (outer * r, at + outer * p)
        }
    }
}

fn moving(
    frame: &LinkFrame,
    parent: Option<usize>,
    rotation: Matrix3<f64>,
    translation: Vector3<f64>,
) -> MovingBody {
    let degrees = &frame.degrees;
    let ratios = degrees.position_ratios();
    let columns = frame.columns().into_iter();
    let pitch = match frame.motion {
        Motion::Translation => [0.0, 1.0],
        Motion::Compound(_) => [1.0, degrees.advance.to_f64()],
        _ => [1.0, 0.0],
    };
    MovingBody {
        parent,
        rotation,
        translation,
        axis: Unit::new_normalize(vector(&frame.axis.0)),
        positions: degrees
            .positions
            .iter()
            .zip(ratios)
            .map(|(p, r)| (p.0, r.to_f64()))
            .collect(),
        offset: degrees.offset().to_f64(),
        pitch,
        columns: columns
            .map(|(j, c)| (j.0, vector(&c.angular.0), vector(&c.linear.0)))
            .collect(),
    }
}

fn vector(x: &[bgdyn_runtime::Dd; 3]) -> Vector3<f64> {
    Vector3::from(x.map(|x| x.to_f64()))
}

fn pose(pose: &Pose) -> (Matrix3<f64>, Vector3<f64>) {
    let r = &pose.rotation.0;
    (
        Matrix3::from_fn(|i, j| r[i][j].to_f64()),
        vector(&pose.translation.0),
    )
}

/// A body's motion in its own axes; `a` is the acceleration of its origin less gravity.
struct BodyMotion {
    w: Vector3<f64>,
    dw: Vector3<f64>,
    a: Vector3<f64>,
    /// Angular and linear velocity per unit velocity of the joints before it.
    twists: Vec<(usize, Vector3<f64>, Vector3<f64>)>,
}

impl MovingBody {
    fn motion(
        &self,
        before: Option<&BodyMotion>,
        gravity: &Vector3<f64>,
        (q, v, a): (&[f64], &[f64], &[f64]),
    ) -> BodyMotion {
        let x = self
            .positions
            .iter()
            .fold(self.offset, |x, (p, ratio)| x + ratio * q[*p]);
        let turn =
            self.rotation * Rotation3::from_axis_angle(&self.axis, self.pitch[0] * x).into_inner();
        let at = self.translation + turn * (self.axis.into_inner() * (self.pitch[1] * x));
        let back = turn.transpose();
        let rest = BodyMotion {
            w: Vector3::zeros(),
            dw: Vector3::zeros(),
            a: -gravity,
            twists: Vec::new(),
        };
        let before = before.unwrap_or(&rest);
        let (w0, dw0) = (back * before.w, back * before.dw);
        let sum = |of: &[f64], angular: bool| {
            let own = self.columns.iter().map(|(j, turn, shift)| {
                if angular {
                    turn * of[*j]
                } else {
                    shift * of[*j]
                }
            });
            own.fold(Vector3::zeros(), |s, x| s + x)
        };
        let (w_own, v_own) = (sum(v, true), sum(v, false));
        // Of the origin: carried, Coriolis, and along the joint.
        let carried = before.a + before.dw.cross(&at) + before.w.cross(&before.w.cross(&at));
        let twists = before
            .twists
            .iter()
            .map(|(j, w, u)| (*j, back * w, back * (u + w.cross(&at))));
        BodyMotion {
            w: w0 + w_own,
            dw: dw0 + sum(a, true) + w0.cross(&w_own),
            a: back * carried + 2.0 * w0.cross(&v_own) + sum(a, false),
            twists: twists.chain(self.columns.iter().copied()).collect(),
        }
    }
}

/// Returns force and moment about the origin for each parameter of a body: m a; U h with U = [ω̇]× + [ω]×[ω]×, h × a;
/// E ω̇ + ω × E ω for an entry E of the tensor.
fn wrenches(body: &BodyMotion) -> [(Vector3<f64>, Vector3<f64>); 10] {
    let BodyMotion { w, dw, a, .. } = body;
    let zero = Vector3::zeros();
    let moment = |k: usize| {
        let e = Vector3::ith(k, 1.0);
        (dw.cross(&e) + w.cross(&w.cross(&e)), e.cross(a))
    };
    let tensor = |i: usize, k: usize| {
        let times = |x: &Vector3<f64>| {
            let mut y = Vector3::zeros();
            y[i] += x[k];
            if i != k {
                y[k] += x[i];
            }
            y
        };
        (zero, times(dw) + w.cross(&times(w)))
    };
    [
        (*a, zero),
        moment(0),
        moment(1),
        moment(2),
        tensor(0, 0),
        tensor(0, 1),
        tensor(1, 1),
        tensor(0, 2),
        tensor(1, 2),
        tensor(2, 2),
    ]
}

impl Rows for TreeRows {
    fn joints(&self) -> usize {
        self.joints
    }

    fn bodies(&self) -> usize {
        self.bodies.len()
    }

    fn effort_rows(&self, q: &[f64], v: &[f64], a: &[f64], rows: &mut DMatrix<f64>) {
        rows.fill(0.0);
        let mut motions: Vec<BodyMotion> = Vec::with_capacity(self.bodies.len());
        for (b, body) in self.bodies.iter().enumerate() {
            let own = body.motion(body.parent.map(|p| &motions[p]), &self.gravity, (q, v, a));
            for (k, (force, moment)) in wrenches(&own).iter().enumerate() {
                for (j, w, u) in &own.twists {
                    rows[(*j, 10 * b + k)] += w.dot(moment) + u.dot(force);
                }
            }
            motions.push(own);
        }
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use bgdyn_codegen::engine::Engine;
    use bgdyn_codegen::expr::Inputs;
    use bgdyn_codegen::method::Method;
    use bgdyn_codegen::options::Options;
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
