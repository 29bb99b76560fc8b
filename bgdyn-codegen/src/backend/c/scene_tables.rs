//! The sizes of a scene, and its tables.

use super::style::Style;
use super::table::{Size, Table};
use crate::interface::SceneInterface;
use crate::layout::Variable;

/// Returns the sizes that signatures and tables use.
pub(super) fn sizes(scene: &SceneInterface) -> Vec<Size> {
    let layout = &scene.layout;
    let (nq, nv, nx) = (layout.nq(), layout.nv(), layout.nx());
    let mut all = vec![
        ("NQ", "positions", nq),
        ("NV", "velocities", nv),
        ("NX", "first-order states", nx),
        (
            "N",
            "numbers of the state that change in time: positions, velocities, first-order states",
            nq + nv + nx,
        ),
        (
            "NM",
            "modes: the numbers of the state after these",
            layout.modes.len(),
        ),
        ("NU", "inputs", layout.inputs.len()),
        ("NY", "outputs", scene.outputs.len()),
        ("NE", "events", layout.events.len()),
        ("NB", "entries of the balance of power", scene.entries.len()),
        ("NR", "loops and contacts", layout.loops.len()),
    ];
    let rigid = layout.rigid_contacts.len();
    all.extend((rigid > 0).then_some(("NK", "rigid contacts", rigid)));
    all
}

/// Returns the tables, without empty ones: C has no empty arrays.
pub(super) fn tables(scene: &SceneInterface, style: &Style) -> Vec<Table> {
    let layout = &scene.layout;
    let owned = |all: &[Variable]| all.iter().map(|v| v.name.clone()).collect::<Vec<_>>();
    let positions = layout.positions.iter().map(|p| p.name.clone());
    let velocities = layout.coordinates.iter().map(|c| c.rate_name.clone());
    let moving = positions.chain(velocities).chain(owned(&layout.states));
    let coordinates: Vec<String> = layout.coordinates.iter().map(|c| c.name.clone()).collect();
    let pivots = coordinates.iter().cloned().chain(owned(&layout.states));
    let pivots: Vec<String> = pivots.chain(layout.loops.iter().cloned()).collect();
    let outputs = scene.outputs.iter().map(|n| n.name.clone()).collect();
    let entries = scene.entries.iter().map(|n| n.name.clone()).collect();
    let names = |about, name: &str, size: &str, all: Vec<String>| Table {
        about,
        declaration: format!(
            "const char *const {}[{}]",
            style.global(name),
            style.sized(size)
        ),
        elements: all.iter().map(|name| format!("\"{name}\"")).collect(),
    };
    let numbers = |about, kind: &str, name: &str, size: &str, all: Vec<String>| Table {
        about,
        declaration: format!("const {kind} {}[{}]", style.global(name), style.sized(size)),
        elements: all,
    };
    let event_modes = layout.events.iter().map(|e| match layout.mode_of(e) {
        Some(mode) => mode.to_string(),
        None => "-1".into(),
    });
    let held = scene.mode_coordinates.iter();
    let held = held.map(|&j| (layout.nq() + j).to_string());
    let initial = &scene.initial;
    let start = [&initial.q, &initial.v, &initial.x, &initial.modes];
    let start = start
        .into_iter()
        .flatten()
        .map(|x| style.number(x.to_f64()));
    let mut tables = vec![
        names(
            "Names of the numbers of the state that change in time.",
            "state_names",
            "N",
            moving.collect(),
        ),
        names(
            "Names of the modes.",
            "mode_names",
            "NM",
            owned(&layout.modes),
        ),
        names(
            "Names of the inputs.",
            "input_names",
            "NU",
            owned(&layout.inputs),
        ),
        names("Names of the outputs.", "output_names", "NY", outputs),
        names(
            "Names of the events.",
            "event_names",
            "NE",
            owned(&layout.events),
        ),
        names(
            "Names of the coordinates, in the order of the velocities.",
            "coordinate_names",
            "NV",
            coordinates,
        ),
        names(
            "Names of the entries of the balance of power.",
            "entry_names",
            "NB",
            entries,
        ),
        names(
            "Names of coordinates, first-order states, then of loops and contacts: the causes of missing results.",
            "pivot_names",
            "NV + NX + NR",
            pivots,
        ),
        names(
            "Names of the rigid contacts.",
            "rigid_contact_names",
            "NK",
            layout.rigid_contacts.clone(),
        ),
        numbers(
            "The mode that each event may change; -1 for none.",
            "int",
            "event_modes",
            "NE",
            event_modes.collect(),
        ),
        numbers(
            "The velocity, in the state, that each mode holds at 0.",
            "int",
            "mode_velocities",
            "NM",
            held.collect(),
        ),
        numbers(
            "The state in which the scene begins.",
            style.real(),
            "start",
            "N + NM",
            start.collect(),
        ),
    ];
    tables.retain(|table| !table.elements.is_empty());
    tables
}
