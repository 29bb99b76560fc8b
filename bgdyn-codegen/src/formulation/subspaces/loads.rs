//! Loads through the joints: each link is a body, also if it is welded to its parent.

use super::bodies::Bodies;
use super::dynamics::JointLoad;
use crate::bond_graph::Multibody;
use crate::expr::{Builder, Expr};
use crate::formulation::arguments::Arguments;
use crate::mechanism::LinkId;
use crate::mechanism::closure::ChainStep;

/// Returns force and moment on each link from its parent, about the link's origin in link axes, without hidden links.
pub(super) fn joint_loads<'g>(
    b: &'g Builder,
    graph: &Multibody,
    x: &Arguments<'g>,
) -> Vec<Expr<'g>> {
    let (_, loads) = Bodies::of_links(b, graph, &x.q).efforts_and_loads(x);
    let shown = graph.frames.iter().zip(loads).filter(|(f, _)| !f.hidden);
    let entries = |load: JointLoad<'g>| load.force.0.into_iter().chain(load.moment.0);
    shown.flat_map(|(_, load)| entries(load)).collect()
}

/// The load on place b of a loop.
pub(in crate::formulation) struct ChainLoad<'a, 'g> {
    /// Force and moment about the origin of the first link, in its axes; of the world if the chain begins there.
    pub(in crate::formulation) load: JointLoad<'g>,
    /// The joints from place a to place b.
    pub(in crate::formulation) steps: &'a [ChainStep],
    /// The links beyond the first one that carry place a, from it outward: those of a wheel on its axle.
    pub(in crate::formulation) beyond: Vec<LinkId>,
}

/// Adds the loads of loops to those through the joints, `entries` of [`joint_loads`]: the joints from place a inward
/// carry the opposite load of place a, and those outward to place b less the load on b.
pub(in crate::formulation) fn add_chain_loads<'g>(
    b: &'g Builder,
    (graph, q): (&Multibody, &[Expr<'g>]),
    loops: &[ChainLoad<'_, 'g>],
    entries: &mut [Expr<'g>],
) {
    let bodies = Bodies::of_links(b, graph, q).bodies;
    let shown = |link: LinkId| {
        let before = graph.frames[..link.0].iter();
        let place = before.filter(|frame| !frame.hidden).count();
        (!graph.frames[link.0].hidden).then_some(6 * place)
    };
    let mut add = |link: LinkId, load: JointLoad<'g>, opposite: bool| {
        let Some(at) = shown(link) else { return };
        let parts = load.force.0.into_iter().chain(load.moment.0);
        for (entry, part) in entries[at..at + 6].iter_mut().zip(parts) {
            *entry = if opposite {
                *entry - part
            } else {
                *entry + part
            };
        }
    };
    for one in loops {
        let mut load = one.load;
        for &link in &one.beyond {
            load = bodies[link.0].outboard(b, load);
            add(link, load, false);
        }
        let mut load = one.load;
        for step in one.steps {
            if step.outward {
                load = bodies[step.link.0].outboard(b, load);
                add(step.link, load, true);
            } else {
                add(step.link, load, false);
                load = bodies[step.link.0].inboard(b, load);
            }
        }
    }
}
