//! YAML text → checked mechanism: reading, then checking, all findings together.

use crate::bond_graph;
use crate::fault::wording::no_inertia;
use crate::fault::{Fault, Faults};
use crate::mechanism::{Mechanism, check};
use crate::method;
use crate::spec::{Joint, Spec, parse};

/// Reads and checks a spec. `stem` is the file's name without its ending, if there is a file; only
/// what stands before its first dot counts.
///
/// The mechanism is there exactly if nothing refuses the spec; warnings may come with it. The
/// findings are in the order of the file.
pub fn read(text: &str, stem: Option<&str>) -> (Option<Mechanism>, Faults) {
    let (spec, mut faults) = parse(text);
    let Some(spec) = spec else {
        return (None, faults);
    };
    let (mechanism, more) = check(&spec, stem, &method::names());
    faults.0.extend(more.0);
    if let Some(mechanism) = &mechanism {
        faults.0.extend(without_inertia(mechanism, &spec));
    }
    faults.sort();
    (mechanism, faults)
}

/// Warns of joints that carry no inertia, which forward dynamics could only refuse.
fn without_inertia(mechanism: &Mechanism, spec: &Spec) -> Vec<Fault> {
    let graph = bond_graph::build(mechanism);
    let links = spec.links.value().into_iter().flatten();
    let joints: Vec<&Joint> = links.filter_map(|link| link.joint.value()).collect();
    let found = graph.without_inertia().into_iter().filter_map(|j| {
        let name = &graph.coordinates[j.0].name;
        let joint = joints
            .iter()
            .find(|joint| joint.name.value() == Some(name))?;
        Some(no_inertia(&joint.place, name))
    });
    found.collect()
}
