//! Reads the branch of a loop that is closed by dependent joints: a side of a planar loop, or an antiparallelogram.

use bgdyn_runtime::Dd;

use super::parallel;
use super::placed::PlacedLoop;
use super::tree::Tree;
use crate::fault::{Faults, wording};
use crate::format::{Located, LoopSpec};
use crate::math::Vec3;
use crate::mechanism::Leader;
use crate::mechanism::closure::Closure;
use crate::mechanism::joint::DoubleDouble;

/// The least sum of two opposite sides of an antiparallelogram, relative to their length. On the branch of the
/// parallelogram it is zero.
const CROSSED: f64 = 1e-3;

/// A branch.
#[derive(Clone, Debug)]
pub(super) enum Branch {
    /// The places lie left of the line between the outer joints.
    Left,
    /// They lie right of it.
    Right,
    /// An antiparallelogram, with the segments of two opposite sides.
    Crossed([Vec<usize>; 2]),
}

/// Reads the branch; `axis` is that of a planar loop.
pub(super) fn read(
    one: &LoopSpec,
    (placed, tree, axis): (&PlacedLoop<'_>, Tree<'_>, Option<Vec3<Dd>>),
    faults: &mut Faults,
) -> Option<Located<Branch>> {
    let word = one.branch.given()?;
    let side = match word.value.as_str() {
        "left" => Branch::Left,
        "right" => Branch::Right,
        "crossed" => {
            let value = crossed(one, (placed, tree), faults)?;
            let location = word.location.clone();
            return Some(Located { value, location });
        }
        _ => {
            faults.push(wording::unknown_branch(&word.location, &word.value));
            return None;
        }
    };
    if axis.is_none() || placed.links.contains(&None) || !placed.kind.coincident {
        faults.push(wording::branch_of_spatial_loop(&word.location));
        return None;
    }
    Some(Located {
        value: side,
        location: word.location.clone(),
    })
}

/// Returns the branch of an antiparallelogram: opposite sides are equal, others are not.
fn crossed(
    one: &LoopSpec,
    (placed, tree): (&PlacedLoop<'_>, Tree<'_>),
    faults: &mut Faults,
) -> Option<Branch> {
    let word = one.branch.given()?;
    let plain = |angle: &[Leader]| (angle.to_vec(), Dd::ZERO);
    let found = parallel::sides_of(word, (placed, tree), plain, faults)?;
    let pairs = found.opposite();
    let Some([[a, c], [b, _]]) = pairs.as_deref() else {
        faults.push(parallel::not_equal(word, placed.name, &found));
        return None;
    };
    let (first, second) = (a.length().to_f64(), b.length().to_f64());
    if (first - second).abs() <= CROSSED * first {
        let fault = wording::crossed_rhombus(&word.location, placed.name, [first, second]);
        faults.push(fault);
        return None;
    }
    Some(Branch::Crossed([a.segments.clone(), c.segments.clone()]))
}

/// Returns whether a loop without a branch is a parallelogram, or a rhombus.
pub(super) fn is_parallelogram(
    one: &LoopSpec,
    (placed, tree): (&PlacedLoop<'_>, Tree<'_>),
) -> bool {
    let word = Located {
        value: "parallel".to_owned(),
        location: one.location.clone(),
    };
    let plain = |angle: &[Leader]| (angle.to_vec(), Dd::ZERO);
    let sides = || parallel::sides_of(&word, (placed, tree), plain, &mut Faults::default());
    one.branch.given().is_none() && sides().is_some_and(|sides| sides.opposite().is_some())
}

impl Branch {
    /// Returns its word in a file, and that of the other branch.
    pub(super) fn words(&self) -> [&'static str; 2] {
        match self {
            Branch::Left => ["left", "right"],
            Branch::Right => ["right", "left"],
            Branch::Crossed(_) => ["crossed", "parallel"],
        }
    }

    /// Returns whether a loop is on this branch at a position.
    pub(super) fn contains(&self, closure: &Closure, closes: usize, q: &[Dd]) -> bool {
        let side = |left: bool| {
            let side = closure.side(closes, q);
            side.is_none_or(|side| (side > 0.0) == left)
        };
        match self {
            Branch::Left => side(true),
            Branch::Right => side(false),
            Branch::Crossed(opposite) => {
                let frames = closure.loops[closes].chain.frames(q, &DoubleDouble);
                let [a, c] = opposite.each_ref().map(|segments| {
                    let zero = Vec3([Dd::ZERO; 3]);
                    let segments = segments.iter().map(|&k| frames.segment(k));
                    segments.fold(zero, |sum, segment| sum + segment)
                });
                let size = |v: Vec3<Dd>| v.dot(v).to_f64();
                size(a + c) > CROSSED * CROSSED * size(a)
            }
        }
    }
}
