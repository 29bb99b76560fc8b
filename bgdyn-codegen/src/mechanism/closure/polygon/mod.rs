//! Planar loops whose dependent joints follow in closed form from the independent ones: polygons of three unknown
//! joints.
//!
//! The chain of a loop and its closing pin are a polygon. Two of its joints are dependent, the closing pin is the third
//! unknown one; they divide the polygon into three arcs. One arc contains the link that carries the loop, and all
//! independent joints: its vector D, from its first unknown joint S to its last one E, is known. The other two are
//! rigid:
//!
//! | unknown joints | form | equations |
//! |---|---|---|
//! | three pins | triangle | D, and two lengths a and b |
//! | two pins and a slide beside D | slider | a length, and a line on which its end moves |
//! | two pins and a slide opposite D | cylinder | the direction of D, and the length of D |
//!
//! Vectors are in the plane of the loop, with all joints at zero: joint angles turn them.

mod plane_chain;
mod shape;
mod unknown_joints;
mod vectors;

use super::{ClosingRow, Closure, RowKind};
use crate::mechanism::CoordinateId;
use plane_chain::PlaneChain;
pub use shape::{AngleTerm, PlaneJoint, Polygon, PolygonForm, PolygonSide, TurnedVector};
use shape::{LEAST, merged, opposite};
use unknown_joints::{FoundForm, form};
pub use vectors::{PlaneVector, snapped};

/// Returns the loops of a mechanism as polygons, each after those that it depends on; `None` if a dependent velocity
/// does not follow from one.
pub fn polygons(closure: &Closure) -> Option<Vec<Polygon>> {
    let (found, unsolved) = closing_polygons(closure);
    (unsolved.is_empty() && !found.is_empty()).then_some(found)
}

/// Returns the loops of a mechanism that are polygons, each after those that it depends on, and the dependent
/// velocities that do not follow from them.
pub fn closing_polygons(closure: &Closure) -> (Vec<Polygon>, Vec<CoordinateId>) {
    let mut unsolved: Vec<CoordinateId> = closure.dependents().collect();
    let mut found: Vec<Polygon> = Vec::new();
    if !closure.combined.is_empty() || !closure.compounds.is_empty() || closure.nonholonomic() {
        return (found, unsolved);
    }
    loop {
        let open = (0..closure.loops.len()).filter(|l| found.iter().all(|one| one.closes != *l));
        let next = open
            .filter_map(|closes| polygon(closure, closes, &unsolved))
            .next();
        let Some(next) = next else {
            return (found, unsolved);
        };
        let solved = next.dependents().map(|joint| joint.velocity);
        unsolved.retain(|j| !solved.contains(j));
        found.push(next);
    }
}

/// Returns a loop as a polygon if two of the `unsolved` velocities are its unknown joints.
fn polygon(closure: &Closure, closes: usize, unsolved: &[CoordinateId]) -> Option<Polygon> {
    let one = &closure.loops[closes];
    let rows = closure.rows.iter().filter(|row| row.closes == closes);
    let places = rows
        .clone()
        .all(|row| matches!(row.kind, RowKind::Closing(ClosingRow::Place(_))));
    // Rows that follow from others may be open by a tolerance.
    let mut following = closure.following.iter();
    let follows = following.any(|one| one.row.closes == closes);
    if rows.count() != 2 || !places || follows || one.contact.is_some() {
        return None;
    }
    let chain = PlaneChain::new(one, closure.start.len())?;
    let is_unsolved = |k: &usize| {
        chain.steps[*k]
            .joint()
            .is_some_and(|j| unsolved.contains(&j.velocity))
    };
    let unknown: Vec<usize> = (0..chain.steps.len()).filter(is_unsolved).collect();
    let &[i, j] = &unknown[..] else { return None };
    let arcs = chain.arcs([i, j]);
    let arc_of = |link: usize| usize::from(link > i) + usize::from(link > j);
    let known = arc_of(chain.root);
    let moves = |k: usize| chain.steps[k].joint().is_some() && k != i && k != j;
    if (0..chain.steps.len()).any(|k| moves(k) && arc_of(k) != known) {
        return None;
    }
    let sides = merged(&arcs[known].sides);
    let form = form(&chain, [i, j], (&arcs, known))?;
    let (known, form) = match form {
        FoundForm::Whole(form) => (sides, form),
        FoundForm::Slide { before, form, last } => {
            let mut sides = sides;
            sides.push(last);
            let sides = merged(&sides);
            (if before { opposite(&sides) } else { sides }, form)
        }
    };
    let polygon = Polygon {
        closes,
        known,
        form,
        positive: true,
    };
    let mut signs = closure
        .samples
        .iter()
        .chain([&closure.start])
        .map(|q| polygon.root_at(q));
    let first = polygon.root_at(&closure.start);
    let same = first.abs() > LEAST && signs.all(|x| x.abs() > LEAST && (x > 0.0) == (first > 0.0));
    let one_branch = same && !polygon.changes_branch();
    one_branch.then_some(Polygon {
        positive: first > 0.0,
        ..polygon
    })
}
