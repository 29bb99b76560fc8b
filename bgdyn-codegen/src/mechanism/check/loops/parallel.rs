//! Reads loops with `branch: parallel`: the joints of a parallelogram that follow each other.

use super::placed::{self, Context, PlacedLoop};
use super::sides::{AngleRelation, LoopSides, NotPlanar, relation, sides};
use super::tree::Tree;
use crate::fault::{Fault, Faults, Location, wording};
use crate::format::{Field, Located, LoopSpec};
use crate::mechanism::check::constraint::{Relations, Row};
use crate::mechanism::{Leader, LinkId, Motion, ParallelLoop};

/// Lengths that differ by less, relative to the length of the loop, seem to be rounded.
const ROUNDED: f64 = 1e-6;

/// The types of loops that are pins of a plane.
const PINS: [&str; 2] = ["hinge", "point"];

/// A loop on its parallel branch, and the rows that make its joints follow.
struct ReadParallel {
    closes: ParallelLoop,
    rows: Vec<Row>,
}

/// Reads the loops with `branch: parallel` of a tree without numbers, in which joints follow others by `mimic` only.
/// Returns the rows that make joints follow, and the loops. `None` if a rule is broken.
pub fn parallel_loops(
    context: Context<'_>,
    faults: &mut Faults,
) -> Option<(Vec<Row>, Vec<ParallelLoop>)> {
    let before = faults.count();
    let tree = context.1;
    let specs = context.0.loops.value().map_or(&[][..], Vec::as_slice);
    let mut waiting: Vec<(&LoopSpec, PlacedLoop<'_>)> = Vec::new();
    for one in specs.iter().filter(|one| one.is_parallel()) {
        report_keys(one, faults);
        let placed = placed::placed(one, context, faults);
        waiting.extend(placed.map(|placed| (one, placed)));
    }
    // A loop whose joints follow others by another loop may be a parallelogram with these only.
    let mut found: Vec<ReadParallel> = Vec::new();
    loop {
        let rows: Vec<Row> = found.iter().flat_map(|one| one.rows.clone()).collect();
        let relations = Relations::of(tree.links(), &rows);
        let closed = waiting.iter().enumerate().find_map(|(k, (one, placed))| {
            let closed = read_one((one, placed), tree, &relations, &mut Faults::default());
            Some((k, closed?))
        });
        if let Some((k, closed)) = closed {
            waiting.remove(k);
            found.push(closed);
            continue;
        }
        for (one, placed) in &waiting {
            read_one((one, placed), tree, &relations, faults);
        }
        break;
    }
    let place = |one: &ReadParallel| {
        specs
            .iter()
            .position(|s| s.name.value() == Some(&one.closes.name))
    };
    found.sort_by_key(place);
    let rows = found.iter().flat_map(|one| one.rows.clone()).collect();
    let loops = found.into_iter().map(|one| one.closes).collect();
    (faults.count() == before).then_some((rows, loops))
}

/// Returns the rows of a parallelogram. `None` if it is none, where joints follow others by these relations.
fn read_one(
    (one, placed): (&LoopSpec, &PlacedLoop<'_>),
    tree: Tree<'_>,
    relations: &Relations,
    faults: &mut Faults,
) -> Option<ReadParallel> {
    let word = one.branch.given()?;
    let reduced = |angle: &[Leader]| relations.reduced(angle);
    let sides = sides_of(word, (placed, tree), reduced, faults)?;
    let Some(pairs) = sides.opposite() else {
        faults.push(not_equal(word, placed.name, &sides));
        return None;
    };
    let row = |(terms, offset): AngleRelation| Row {
        name: placed.name.to_owned(),
        of: "loop",
        location: one.location.clone(),
        terms,
        offset: Some(offset),
    };
    let rows: Vec<Row> = pairs.into_iter().map(|pair| row(relation(pair))).collect();
    let moving = placed.chain.steps.iter();
    let moving = moving.filter(|step| step.motion != Motion::None);
    Some(ReadParallel {
        closes: ParallelLoop {
            name: placed.name.to_owned(),
            kind: placed.kind,
            links: placed.links,
            places: [placed.chain.start, placed.chain.end],
            joints: moving.map(|step| step.link).collect(),
            rows: rows.len(),
        },
        rows,
    })
}

/// Returns the sides of a loop whose branch is this word: one with a pin, of revolute joints with parallel axes.
pub(super) fn sides_of(
    word: &Located<String>,
    (placed, tree): (&PlacedLoop<'_>, Tree<'_>),
    reduced: impl Fn(&[Leader]) -> AngleRelation,
    faults: &mut Faults,
) -> Option<LoopSides> {
    let (name, kind) = (placed.name, placed.kind);
    let named = (name, word.value.as_str());
    if !PINS.contains(&kind.keyword) {
        faults.push(wording::parallelogram_without_pin(
            &word.location,
            named,
            kind.keyword,
        ));
        return None;
    }
    let fault = match sides(&placed.chain, kind.axial, reduced) {
        Ok(sides) if sides.level() => return Some(sides),
        Ok(sides) => {
            let height = (sides.height.to_f64(), "m");
            wording::loop_row_never_holds(&word.location, (name, "z"), height)
        }
        Err(NotPlanar::Axes) => wording::parallelogram_axes(&word.location, named),
        Err(NotPlanar::Joint(LinkId(link))) => {
            let joint = &tree.links()[link].joint;
            let joint = (joint.name.as_str(), joint.kind.keyword);
            wording::parallelogram_with_joint(&word.location, named, joint)
        }
    };
    faults.push(fault);
    None
}

/// Returns the fault of a loop whose opposite sides are not equal.
pub(super) fn not_equal(word: &Located<String>, name: &str, sides: &LoopSides) -> Fault {
    let named = (name, word.value.as_str());
    let lengths = sides.lengths();
    match sides.largest_difference() {
        Some(gap) if gap < ROUNDED => {
            wording::rounded_parallelogram(&word.location, named, (&lengths, &sides.differences()))
        }
        _ => wording::not_a_parallelogram(&word.location, named, &lengths),
    }
}

/// Reports keys that loops with `branch: parallel` do not have.
fn report_keys(one: &LoopSpec, faults: &mut Faults) {
    fn at<T>(field: &Field<T>) -> Option<&Location> {
        field.given().map(|given| &given.location)
    }
    let keys = [
        ("near", at(&one.near)),
        ("redundant", at(&one.redundant)),
        ("tolerance", at(&one.tolerance)),
    ];
    for (key, location) in keys {
        faults
            .0
            .extend(location.map(|at| wording::parallel_with_key(at, key)));
    }
}
