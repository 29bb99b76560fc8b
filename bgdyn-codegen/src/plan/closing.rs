//! Which positions change where loops close, and which tell a closed position.

use bgdyn_runtime::closure::Dependent;

use crate::bond_graph::{ClosedTree, Multibody};
use crate::mechanism::CoordinateId;
use crate::method::TASK_DIRECTIONS;

/// Returns the joint of a dependent velocity.
pub fn dependent_joint(closed: &ClosedTree, j: CoordinateId) -> Dependent {
    let closure = &closed.closure;
    let mut compounds = closure.compounds.iter();
    let own = compounds.find(|joint| joint.degrees.velocities.contains(&j));
    let first = own.and_then(|joint| joint.degrees.positions.first());
    let position = closure.positions[j.0].as_ref().or(first);
    Dependent {
        velocity: j.0,
        position: position.map_or(0, |p| p.0),
        closes: closure.loop_of(j),
    }
}

/// Returns the positions of the independent joints in loops.
pub fn independent_positions(closed: &ClosedTree) -> Vec<usize> {
    let closure = &closed.closure;
    let positions = closure.independents.iter();
    let positions = positions.filter_map(|j| closure.positions[j.0]);
    positions.map(|p| p.0).collect()
}

/// Returns the names of the velocities of a mechanism, and of its loops and contacts after them: the causes of missing
/// accelerations.
pub fn pivot_names<'a>(closed: &'a ClosedTree, graph: &'a Multibody) -> Vec<&'a str> {
    let joints = graph.coordinates.iter().map(|c| c.name.as_str());
    joints.chain(loop_names(closed)).collect()
}

/// Returns the names of the velocities, of loops and contacts after them, and of the directions of a frame after these:
/// the causes of missing operational inertias.
pub fn operational_pivot_names<'a>(
    closed: Option<&'a ClosedTree>,
    graph: &'a Multibody,
) -> Vec<&'a str> {
    let joints = graph.coordinates.iter().map(|c| c.name.as_str());
    let loops = closed.into_iter().flat_map(loop_names);
    joints.chain(loops).chain(TASK_DIRECTIONS).collect()
}

/// Returns the same for functions of the open tree.
pub fn tree_pivot_names(closed: &ClosedTree) -> Vec<&str> {
    pivot_names(closed, &closed.tree)
}

/// Returns the names of the actuated joints, of the loops after them, and of the independent joints after these: the
/// causes of missing efforts of the actuated joints; none without actuated joints.
pub fn actuated_pivot_names<'a>(closed: &'a ClosedTree, graph: &'a Multibody) -> Vec<&'a str> {
    let Some(actuated) = &closed.closure.actuated else {
        return Vec::new();
    };
    let joints = graph.coordinates.iter().map(|c| c.name.as_str());
    let drives = closed.joint_names(actuated).into_iter();
    drives.chain(loop_names(closed)).chain(joints).collect()
}

/// Returns the names of the positions, and of the loops and contacts after them: the causes of positions that do not
/// close.
pub fn closing_names<'a>(closed: &'a ClosedTree, graph: &'a Multibody) -> Vec<&'a str> {
    let positions = graph.positions.iter().map(|p| p.name.as_str());
    positions.chain(loop_names(closed)).collect()
}

/// Returns the names of the loops and contacts.
pub fn loop_names(closed: &ClosedTree) -> impl Iterator<Item = &str> {
    closed.closure.loops.iter().map(|one| one.name.as_str())
}
