//! Contacts of a mechanism: gaps, frames, velocities, their Jacobian and its rate, in fixed axes.
//!
//! | file | job |
//! |---|---|
//! | `frame.rs` | the gap, the axes and the contact point of a pair |
//! | `tangents.rs` | two directions across a unit normal |
//! | `motion.rs` | the velocities of both links at the contact point, without the joints that carry both |
//!
//! The contacts of scenes have the same frames (`effort_sums/contact_motion.rs`), rigid ones these methods.

mod frame;
mod motion;
mod tangents;

use super::arguments::Arguments;
use super::placement::Placement;
use super::site::rates;
use super::{Formulation, Prepared};
use crate::bond_graph::{BondGraph, LinkFrame, Multibody};
use crate::expr::{Builder, Expr};
use crate::function::Function;
use crate::method::{ContactMethod, Method};
pub(crate) use frame::PairFrame;
use motion::PairMotion;

/// Contacts from the poses of the links.
pub(super) struct PlacedContacts;

impl Formulation for PlacedContacts {
    fn name(&self) -> &'static str {
        "contacts"
    }

    fn summary(&self) -> &'static str {
        "contacts from the poses of the links, in fixed axes"
    }

    fn knows(&self, method: Method) -> bool {
        matches!(method, Method::Contact(of) if !of.is_dynamic())
    }

    fn unserved<'a>(&self, _: &'a Multibody) -> Option<&'a LinkFrame> {
        None
    }

    fn serves(&self, graph: &BondGraph) -> bool {
        graph.closed.is_none()
    }

    fn function(&self, prepared: &Prepared<'_>, method: Method) -> Option<Function> {
        let Method::Contact(of) = method else {
            return None;
        };
        let graph: &Multibody = prepared.graph;
        let b = Builder::new();
        let outputs = {
            let x = Arguments::new(&b, graph, method);
            let outputs = outputs(&b, graph, of, &x)?;
            outputs.into_iter().map(Expr::signed).collect()
        };
        let name = self.name().into();
        Some(Function::flat(graph, method, name, b.into_graph(), outputs))
    }
}

/// Returns the expressions of a method; `None` for one that contains the mass matrix.
fn outputs<'g>(
    b: &'g Builder,
    graph: &Multibody,
    of: ContactMethod,
    x: &Arguments<'g>,
) -> Option<Vec<Expr<'g>>> {
    let placement = Placement::new(b, graph, &x.q);
    let pairs = graph.contacts.iter();
    let pose = |link| placement.pose(b, link);
    let frames = pairs.map(|pair| (pair, PairFrame::new(b, pose, pair)));
    let motions = frames
        .clone()
        .map(|(pair, frame)| PairMotion::new(b, graph, &placement, (pair, frame)));
    Some(match of {
        ContactMethod::Gaps(_) => frames.map(|(_, frame)| frame.gap).collect(),
        ContactMethod::Frames(_) => frames.flat_map(|(_, frame)| frame.pose()).collect(),
        ContactMethod::Velocity(_) => motions.flat_map(|motion| motion.velocity(&x.v)).collect(),
        ContactMethod::Jacobian(_) => motions.flat_map(|motion| motion.jacobian()).collect(),
        ContactMethod::Bias(_) => {
            let velocities: Vec<_> = motions.flat_map(|motion| motion.velocity(&x.v)).collect();
            rates(b, graph, &velocities, &x.v)
        }
        ContactMethod::Delassus(_) | ContactMethod::Response(_) => return None,
    })
}
