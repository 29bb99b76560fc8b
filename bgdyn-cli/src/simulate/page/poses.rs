//! The poses of links at the rows of a page.

use bgdyn_codegen::bond_graph::SiteId;
use bgdyn_codegen::engine::{CallArguments, Engine};
use bgdyn_codegen::math::{Mat3, Vec3, rodrigues};
use bgdyn_codegen::mechanism::Motion;
use bgdyn_codegen::method::Method;
use bgdyn_codegen::options::Options;
use bgdyn_codegen::selection::function;
use bgdyn_codegen::system::SceneEquations;
use bgdyn_codegen::tape::Tape;
use bgdyn_runtime::Dd;
use bgdyn_runtime::manifold::quaternion_of;
use bgdyn_runtime::nalgebra::Matrix3;

use super::body::Placed;
use crate::simulate::run_table::Row;

/// Scale of a quaternion's components.
pub(super) const TURN: f64 = 1e5;

/// Returns the poses of a link at all rows: its axes row by row, its origin. An undefined pose is replaced
/// by the previous one.
pub(super) fn poses(system: &SceneEquations, link: usize, rows: &[&Row]) -> Vec<[f64; 12]> {
    let mechanism = &system.scene.mechanism;
    let links = mechanism.links();
    if links[link].hidden {
        return hidden_poses(system, link, rows);
    }
    // Hidden links are no sites.
    let before = links[..link].iter().filter(|l| !l.hidden).count();
    let pose = function(mechanism, Method::Pose(SiteId(before)), &Options::default());
    // Machine code does not pay for so few rows.
    let pose = Tape.prepare(&pose.expect("every formulation knows poses"));
    let mut last = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0];
    let at = |row: &&Row| {
        let parameters = parameters(system, row);
        let (values, _) = pose.value(&CallArguments {
            q: &row.y.as_slice()[..mechanism.nq()],
            parameters: &parameters,
            ..CallArguments::default()
        });
        if values.iter().all(|x| x.is_finite() && x.abs() < 1e9) {
            last.copy_from_slice(&values);
        }
        last
    };
    rows.iter().map(at).collect()
}

/// Returns the mechanism's run-time parameters at a row: the motions of prescribed joints are inputs.
fn parameters(system: &SceneEquations, row: &Row) -> Vec<f64> {
    let mechanism = &system.scene.mechanism;
    let all = mechanism.parameters().iter();
    let mut values: Vec<f64> = all.map(|p| p.default.to_f64()).collect();
    let inputs = &system.scene.layout.inputs;
    for prescribed in mechanism.prescribed() {
        let name = &mechanism.prescribed_joint(prescribed).name;
        if let Some(i) = inputs.iter().position(|part| part.name == *name) {
            values[prescribed.motion[0].0] = row.inputs[i];
        }
    }
    values
}

/// Returns the poses of the link between two joints that the file has as one, from its parent's.
fn hidden_poses(system: &SceneEquations, link: usize, rows: &[&Row]) -> Vec<[f64; 12]> {
    let joint = &system.scene.mechanism.links()[link].joint;
    let parent = system.scene.mechanism.links()[link].parent;
    let parents = parent.map(|parent| poses(system, parent.0, rows));
    let origin = Placed::of(&joint.origin);
    let position = joint.degrees.positions.first().map(|p| p.0);
    let axis = joint.axis.map(|x| x.to_f64());
    let slides = joint.kind.motion == Motion::Translation;
    let mut prescribed = system.scene.mechanism.prescribed().iter();
    let motion = prescribed.find(|p| p.link.0 == link).map(|p| p.motion);
    let at = |(k, row): (usize, &&Row)| {
        let q = match motion {
            Some([p, ..]) => parameters(system, row)[p.0],
            None => position.map_or(0.0, |p| row.y[p]),
        };
        let moved = match slides {
            true => Placed {
                o: axis.scale(q).0,
                ..Placed::HERE
            },
            false => Placed {
                r: turned(joint.axis, q),
                ..Placed::HERE
            },
        };
        let on = parents.as_ref().map_or(Placed::HERE, |all| placed(&all[k]));
        let Placed { r, o } = on.then(&origin).then(&moved);
        std::array::from_fn(|i| if i < 9 { r.0[i / 3][i % 3] } else { o[i - 9] })
    };
    rows.iter().enumerate().map(at).collect()
}

/// Returns the rotation about an axis by an angle, rad.
fn turned(axis: Vec3<Dd>, angle: f64) -> Mat3<f64> {
    let (sin, cos) = Dd::from_f64(angle).sin_cos();
    rodrigues(axis, (cos, sin), |x| x).map(|x| x.to_f64())
}

/// Returns a pose from its axes row by row and its origin.
fn placed(pose: &[f64; 12]) -> Placed {
    Placed {
        r: Mat3::from_fn(|i, j| pose[3 * i + j]),
        o: [pose[9], pose[10], pose[11]],
    }
}

/// Returns quaternions of rotation matrices, each with the sign nearest to the previous one.
pub(super) fn turns(poses: &[[f64; 12]]) -> Vec<i64> {
    let mut before = [1.0, 0.0, 0.0, 0.0];
    let mut counts = Vec::with_capacity(4 * poses.len());
    for pose in poses {
        let mut q = quaternion(pose);
        if q.iter().zip(before).map(|(a, b)| a * b).sum::<f64>() < 0.0 {
            q = q.map(|x| -x);
        }
        counts.extend(q.map(|x| (TURN * x).round() as i64));
        before = q;
    }
    counts
}

/// Returns the unit quaternion w, x, y, z of a pose's axes.
fn quaternion(pose: &[f64; 12]) -> [f64; 4] {
    let [x, y, z, w] = quaternion_of(&Matrix3::from_fn(|i, j| pose[3 * i + j]));
    [w, x, y, z]
}
