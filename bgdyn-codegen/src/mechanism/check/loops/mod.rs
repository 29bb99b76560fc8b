//! Loops: reads their places, assembles them, and chooses which velocities are dependent.
//!
//! 1. `read.rs`: the entries of the file, and the chain of joints between the places; `contacts.rs`, `planes.rs`:
//!    the same for wheels and knife edges.
//!    `branch.rs`: their branch. `parallel.rs`, `sides.rs`: parallelograms on the branch `parallel` are closed by joints
//!    that follow, before the tree is numbered; the steps below are those of other loops.
//! 2. `axes.rs`: the axes of a loop's rows. `structure.rs`: a row that holds at every position of the tree is dropped;
//!    one that holds at none is a fault, and so is a loop or a contact without other rows.
//! 3. `assembly.rs`: a closed position, from the given ones, on the branch of the file; `samples.rs`: closed positions
//!    at random from there.
//! 4. `rank.rs`: rows that follow from others are left out, or are a fault. `rounding.rs`: they would if lengths were
//!    not rounded. `single_positions.rs`: a loop or a contact that closes only where it cannot move is a fault.
//!    `combine.rs`: rows of contacts are combined so that fewer velocities appear in each.
//! 5. `independents.rs`: the independent velocities: those of the file, else those closest to the base for which
//!    the dependent columns are well conditioned.
//!    `meeting.rs`: a start at which branches meet is a fault.
//! 6. `blocks.rs`: the order in which blocks of rows are solved.
//! 7. `actuated.rs`: the joints with drives.

mod actuated;
mod allowed;
mod assembly;
mod axes;
mod blocks;
mod branch;
mod combine;
mod contacts;
mod independents;
mod meeting;
mod parallel;
mod placed;
mod planes;
mod rank;
mod read;
mod rounding;
mod samples;
mod sides;
mod single_positions;
mod structure;
mod tree;

pub(super) use parallel::parallel_loops;
pub(super) use placed::Context;
pub use planes::PLANE_KEYS;
pub(super) use planes::{Planes, plane, planes};
pub(super) use tree::{Tree, find_site, path};

use super::constraint::ContactEntry;
use super::direction::Directions;
use crate::fault::Faults;
use crate::format::Spec;
use crate::mechanism::closure::{ChainStep, Closure, KinematicLoop};
use crate::mechanism::{CoordinateId, LinkId, Mechanism, Motion, PositionId};

/// What the file says of loops, wheels and knife edges.
pub(super) struct ClosedEntries<'a> {
    /// The file.
    pub(super) spec: &'a Spec,
    /// Its wheels and knife edges.
    pub(super) contacts: &'a [ContactEntry],
    /// Its planes.
    pub(super) planes: &'a Planes<'a>,
    /// Where the search for a closed position begins; `None` where all joints are at zero.
    pub(super) start: Option<Vec<bgdyn_runtime::Dd>>,
}

/// Closes the loops of a numbered open tree. `None` if a rule is broken.
pub(super) fn close(
    entries: ClosedEntries<'_>,
    mechanism: &mut Mechanism,
    directions: &Directions,
    faults: &mut Faults,
) -> Option<()> {
    let ClosedEntries {
        spec,
        contacts: entries,
        planes,
        start,
    } = entries;
    let before = faults.count();
    let specs = spec.loops.value().map_or(&[][..], Vec::as_slice);
    let specs = specs.iter().filter(|one| !one.is_parallel());
    let context = (spec, Tree::of(mechanism), directions);
    let loops = specs.map(|one| read::read(one, context, faults));
    let mut read: Vec<Option<read::ReadLoop>> = loops.collect();
    read.extend(
        entries
            .iter()
            .map(|one| contacts::read(one, (context, planes), faults)),
    );
    let read: Vec<read::ReadLoop> = read.into_iter().collect::<Option<_>>()?;
    if faults.count() > before {
        return None;
    }
    if read.is_empty() {
        actuated::refuse_without_loops(spec, faults);
        return Some(());
    }
    let mut closure = unsolved(mechanism, &read);
    if let Some(start) = start {
        closure.start = start;
    }
    let positions = closure.open_positions();
    contacts::find_upward(&mut closure, &positions, faults);
    if faults.count() > before {
        return None;
    }
    for one in &mut closure.loops {
        axes::choose(one, &positions);
    }
    structure::drop_rows(&mut closure, &read, faults);
    if faults.count() > before {
        return None;
    }
    let kept = independents::named(spec, mechanism, faults)?;
    let given = assembly::given(&closure, &read);
    let gap = assembly::assemble(&mut closure, &read, &kept, faults)?;
    let held = (gap == 0.0).then(|| rounding::held_by(&closure, &given));
    let on_branch = |held: &rounding::Held| {
        let q = &held.without.start;
        assembly::on_other_branch(&held.without, &read, q).is_none()
    };
    match held.flatten().filter(on_branch) {
        Some(held) => rounding::leave_out(&mut closure, &read, held, faults)?,
        None => rank::leave_out(&mut closure, (&read, gap), faults)?,
    }
    single_positions::refuse(&closure, faults)?;
    combine::combine(&mut closure);
    independents::choose(&mut closure, (spec, mechanism, &kept), faults)?;
    meeting::refuse_at_start(&closure, &read, faults)?;
    blocks::arrange(&mut closure);
    closure.signs = closure.signs_at(&closure.start);
    closure.samples = samples::sample(&closure);
    closure.actuated = actuated::read(&closure, (spec, mechanism), faults);
    closure.along_planes = along_planes(&closure, (spec, mechanism)).map(Box::new);
    mechanism.close(closure);
    Some(())
}

/// Returns the loops and contacts with the rows of contacts along their planes, and the same independent velocities;
/// `None` where no wheel leans.
fn along_planes(closure: &Closure, (spec, mechanism): (&Spec, &Mechanism)) -> Option<Closure> {
    let mut other = closure.clone();
    other.of_plane = true;
    combine::combine(&mut other);
    let q = closure.samples.first()?;
    if !closure.nonholonomic() || other.solved_rates(q) == closure.solved_rates(q) {
        return None;
    }
    let kept = closure.independents.clone();
    let context = (spec, mechanism, &kept[..]);
    independents::choose(&mut other, context, &mut Faults::default())?;
    blocks::arrange(&mut other);
    other.signs = other.signs_at(&other.start);
    Some(other)
}

/// Returns the loops with all their rows, without a solution.
fn unsolved(mechanism: &Mechanism, read: &[read::ReadLoop]) -> Closure {
    let loops: Vec<_> = read.iter().map(|one| one.closes.clone()).collect();
    let rows = loops.iter().enumerate().flat_map(|(closes, one)| {
        let row = move |(name, kind)| crate::mechanism::closure::LoopRow { closes, name, kind };
        one.rows().into_iter().map(row)
    });
    let rows = rows.collect();
    let mut positions: Vec<Option<PositionId>> = vec![None; mechanism.nv()];
    let mut compounds: Vec<ChainStep> = Vec::new();
    for CoordinateId(j) in loops.iter().flat_map(KinematicLoop::velocities) {
        let joint = mechanism.joint(CoordinateId(j));
        if joint.kind.motion.nv() == 1 {
            positions[j] = joint.degrees.positions.first().copied();
        } else if compounds.iter().all(|known| known.degrees != joint.degrees) {
            let LinkId(link) = mechanism.coordinates()[j];
            compounds.push(tree::step(Tree::of(mechanism), LinkId(link), true));
        }
    }
    Closure {
        rows,
        dropped: Vec::new(),
        following: Vec::new(),
        independents: Vec::new(),
        blocks: Vec::new(),
        positions,
        compounds,
        closers: Vec::new(),
        combined: Vec::new(),
        constants: Vec::new(),
        of_plane: false,
        along_planes: None,
        actuated: None,
        start: neutral(mechanism),
        samples: Vec::new(),
        signs: Vec::new(),
        loops,
    }
}

/// Returns the position of the tree with all joints at zero.
fn neutral(mechanism: &Mechanism) -> Vec<bgdyn_runtime::Dd> {
    let part = |(p, link): (usize, &crate::mechanism::LinkId)| {
        let joint = &mechanism.links()[link.0].joint;
        let own = joint.degrees.positions.iter().position(|x| x.0 == p);
        let neutral = match (joint.kind.motion, own) {
            (Motion::Compound(motion), Some(k)) => f64::from(motion.positions[k].neutral),
            _ => 0.0,
        };
        bgdyn_runtime::Dd::from_f64(neutral)
    };
    mechanism.positions().iter().enumerate().map(part).collect()
}
