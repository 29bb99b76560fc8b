//! Builds the drawing of a bond graph, in tree order.

use bgdyn_codegen::bond_graph::{
    self, BondGraph, BondNetwork, Effort, EffortSource, JunctionId, LinkFrame, Modulus, NodePart,
    Store, StoreInertia,
};
use bgdyn_codegen::math::Vec3;
use bgdyn_codegen::mechanism::{CoordinateId, LinkId, Mechanism, Pose, Value};
use bgdyn_runtime::Dd;

use super::chart::{Chart, ChartLink, Component, Flow, Port, Transformer, Velocity};
use super::notation::{coordinates, number, subscript, superscript};
use super::unfold::Unfolding;

/// What a drawing says of a base whose motion is given.
const MOVING_BASE: &str = "The base moves: its motion is given and not drawn. Flows are relative to it; the efforts of its motion add to the weights, which are those of a base at rest.";

impl Chart {
    /// Returns the drawing of a mechanism's bond graph.
    pub(crate) fn new(mechanism: &Mechanism) -> Self {
        let title = mechanism.label().unwrap_or(mechanism.name());
        let built = bond_graph::build(mechanism);
        let actuated = mechanism.actuated_names();
        let driven = match actuated.as_slice() {
            [] => built.coordinates.iter().map(|c| c.name.clone()).collect(),
            _ => actuated.into_iter().collect(),
        };
        let (graph, prescribed) = (built.of_all_joints(), mechanism.prescribed_names());
        let mut network = BondNetwork::of_mechanism(graph, driven);
        prescribed.iter().for_each(|joint| network.prescribe(joint));
        if let Some(closed) = &built.closed {
            network.close(&closed.closure);
        }
        let drive = |part: &NodePart| drive(graph, &prescribed, part);
        let mut unfolding = Unfolding::new(&network, &drive);
        let mut chart = Chart::of_graph(graph, &mut unfolding, title, mechanism.description());
        chart.add_ports(graph, &network, &mut unfolding);
        let parallel = mechanism.parallel_loops().iter();
        chart.notes.extend(parallel.map(|one| {
            let followers = mechanism.followers_of(one).join(", ");
            let name = &one.name;
            format!("Loop {name} is closed by joints that follow, with constant moduli: {followers}. Its multipliers do not appear.")
        }));
        chart
    }

    /// Returns the drawing of a bond graph, without flows that have no ports.
    pub(super) fn of_graph(
        graph: &BondGraph,
        unfolding: &mut Unfolding<'_>,
        title: &str,
        description: Option<&str>,
    ) -> Self {
        let links = depth_first(&graph.frames);
        let own = |i: &LinkId| {
            let degrees = &graph.frames[i.0].degrees;
            match degrees.own_velocities() {
                true => degrees.velocities.clone(),
                false => Vec::new(),
            }
        };
        let order: Vec<CoordinateId> = links.iter().flat_map(own).collect();
        let begins = beginnings(graph, &links, &order);
        let moved = |i: &LinkId| {
            let junctions = [graph.translation(*i), graph.rotation(*i)];
            graph.transformers.iter().any(|t| junctions.contains(&t.to))
        };
        let (moving, still): (Vec<_>, Vec<_>) = links.into_iter().partition(moved);
        let base = |i: &LinkId| graph.frames[i.0].motion.is_given();
        let still = still.into_iter().filter(|i| !base(i));
        let name = |i: LinkId| graph.frames[i.0].name.clone();
        let moving = moving
            .into_iter()
            .map(|i| (i, link(graph, unfolding, (&order, &begins), i)));
        let (links, folded) = fold_massless(graph, moving.collect());
        Chart {
            title: title.to_owned(),
            description: description.map(str::to_owned),
            velocities: order
                .iter()
                .map(|&j| velocity(graph, unfolding, j))
                .collect(),
            links,
            lines: Vec::new(),
            loops: Vec::new(),
            contacts: Vec::new(),
            sites: Vec::new(),
            still: still.map(name).collect(),
            folded,
            notes: graph.base.iter().map(|_| MOVING_BASE.to_owned()).collect(),
        }
    }
}

/// Removes links without junctions whose children have some, and returns their names. The velocities of
/// their joints begin at the next link.
fn fold_massless(
    graph: &BondGraph,
    all: Vec<(LinkId, ChartLink)>,
) -> (Vec<ChartLink>, Vec<String>) {
    let acting = all.iter().filter(|(_, link)| !link.flows.is_empty());
    let mut carries_some = vec![false; graph.frames.len()];
    for (i, _) in acting {
        let mut carrier = graph.frames[i.0].parent;
        while let Some(c) = carrier {
            carries_some[c.0] = true;
            carrier = graph.frames[c.0].parent;
        }
    }
    let (mut links, mut names) = (Vec::new(), Vec::new());
    let mut waiting: Vec<usize> = Vec::new();
    for (i, mut link) in all {
        if link.flows.is_empty() && carries_some[i.0] {
            waiting.append(&mut link.velocities);
            names.push(link.name);
        } else {
            link.velocities.splice(0..0, waiting.drain(..));
            links.push(link);
        }
    }
    (links, names)
}

/// Returns the links in depth-first order.
fn depth_first(frames: &[LinkFrame]) -> Vec<LinkId> {
    let carried = |by: Option<LinkId>| {
        let ids = (0..frames.len()).rev().map(LinkId);
        ids.filter(move |i| frames[i.0].parent == by)
    };
    let mut waiting: Vec<LinkId> = carried(None).collect();
    let mut order = Vec::with_capacity(frames.len());
    while let Some(i) = waiting.pop() {
        order.push(i);
        waiting.extend(carried(Some(i)));
    }
    order
}

/// Returns the text beside the drive of a joint: its effort; for a prescribed one its flow, and the effort that it
/// supplies.
pub(super) fn drive(graph: &BondGraph, prescribed: &[String], part: &NodePart) -> Option<String> {
    let NodePart::Drive(Some(j)) = part else {
        return None;
    };
    let ([_, effort], n) = (units(graph, *j), subscript(j.0 + 1));
    Some(match prescribed.contains(&graph.coordinates[j.0].name) {
        true => format!("q̇{n}(t), supplies P{n}, {effort}"),
        false => format!("P{n}, {effort}"),
    })
}

/// Returns the units of the velocity of a joint and of its effort.
fn units(graph: &BondGraph, j: CoordinateId) -> [&'static str; 2] {
    match graph.coordinates[j.0].linear {
        false => ["rad/s", "N·m"],
        true => ["m/s", "N"],
    }
}

fn velocity(graph: &BondGraph, unfolding: &mut Unfolding<'_>, j: CoordinateId) -> Velocity {
    let [unit, effort] = units(graph, j);
    Velocity {
        symbol: format!("q̇{}", subscript(j.0 + 1)),
        name: graph.coordinates[j.0].name.clone(),
        unit,
        effort,
        ports: unfolding.ports_at(NodePart::Velocity(j)),
    }
}

/// Returns for each velocity the first link, in the order of the drawing, whose joint moves by it: its own, or one
/// that follows.
fn beginnings(graph: &BondGraph, links: &[LinkId], order: &[CoordinateId]) -> Vec<Option<LinkId>> {
    let moves = |i: LinkId, j: &CoordinateId| graph.frames[i.0].degrees.velocities.contains(j);
    let first = |j: &CoordinateId| links.iter().copied().find(|&i| moves(i, j));
    order.iter().map(first).collect()
}

fn link(
    graph: &BondGraph,
    unfolding: &Unfolding<'_>,
    (order, begins): (&[CoordinateId], &[Option<LinkId>]),
    i: LinkId,
) -> ChartLink {
    let frame = &graph.frames[i.0];
    let flows = [('ṙ', graph.translation(i)), ('ω', graph.rotation(i))];
    let flows = flows.map(|(letter, junction)| Flow {
        symbol: format!("{letter}{}", subscript(i.0 + 1)),
        transformers: transformers(graph, order, i, junction),
        ports: ports(graph, unfolding, i, junction),
    });
    let massless = massless(graph, i);
    let acts = |f: &Flow| !massless && !f.transformers.is_empty() && !f.ports.is_empty();
    let flows = flows.into_iter().filter(acts);
    ChartLink {
        name: frame.name.clone(),
        velocities: (0..order.len()).filter(|&k| begins[k] == Some(i)).collect(),
        flows: flows.collect(),
    }
}

/// Returns whether a link has neither mass nor inertia, so that its stores and its weight are zero.
fn massless(graph: &BondGraph, i: LinkId) -> bool {
    let own = [graph.translation(i), graph.rotation(i)];
    let nothing = |value: &Value| *value == Value::Fixed(Dd::ZERO);
    let mut stores = graph.stores.iter().filter(|s| own.contains(&s.junction));
    let sources = graph.sources.iter().filter(|s| own.contains(&s.junction));
    let mut weights = sources.flat_map(|s| &s.efforts);
    let empty = |store: &Store| match &store.inertia {
        StoreInertia::Mass(mass) => nothing(mass),
        StoreInertia::Tensor(entries) => entries.iter().all(nothing),
    };
    stores.all(empty) && weights.all(|Effort::Weight { mass, .. }| nothing(mass))
}

/// Returns the transformers into a link's flow, in the order of the velocities.
fn transformers(
    graph: &BondGraph,
    order: &[CoordinateId],
    i: LinkId,
    junction: JunctionId,
) -> Vec<Transformer> {
    let mut found = Vec::new();
    for (place, &j) in order.iter().enumerate() {
        let own = |t: &&bond_graph::Transformer| t.from == graph.velocity(j);
        for t in graph.into(junction).filter(own) {
            let (n, m) = (subscript(j.0 + 1), i.0 + 1);
            let name = match junction == graph.translation(i) {
                true => format!("∂r{}/∂q{n}", subscript(m)),
                false => format!("ρ{n}{}", superscript(m)),
            };
            let all = (0..order.len()).filter(|&k| t.modulus.0.iter().any(|m| varies(m, k)));
            let numbers: Vec<usize> = all.map(|k| k + 1).collect();
            found.push(Transformer {
                velocity: place,
                name,
                modulus: t.modulus.0.map(|m| component(m, order.len())).to_vec(),
                varies: coordinates(&numbers),
            });
        }
    }
    found
}

fn varies(modulus: &Modulus, k: usize) -> bool {
    matches!(modulus, Modulus::Varying(with) if with.contains(CoordinateId(k)))
}

fn component(modulus: Modulus, nv: usize) -> Component {
    match modulus {
        Modulus::Zero => Component::Zero,
        Modulus::Constant(x) => Component::Constant(number(x.to_f64())),
        Modulus::Varying(_) if (0..nv).any(|k| varies(&modulus, k)) => Component::Varying,
        Modulus::Varying(_) => Component::Parameter,
    }
}

/// Returns the store and the source on a link's junction, without a source of zero effort.
fn ports(
    graph: &BondGraph,
    unfolding: &Unfolding<'_>,
    i: LinkId,
    junction: JunctionId,
) -> Vec<Port> {
    let stores = graph.stores.iter().enumerate();
    let stores = stores.filter(|(_, s)| s.junction == junction);
    let stores = stores.filter_map(|(k, s)| {
        let (text, more) = store(graph, i, s);
        unfolding.part(NodePart::Store(k), text, more)
    });
    let sources = graph.sources.iter().enumerate();
    let sources = sources.filter(|(_, s)| s.junction == junction);
    let sources =
        sources.filter_map(|(k, s)| unfolding.part(NodePart::Source(k), source(graph, i, s), None));
    stores.chain(sources).collect()
}

fn store(graph: &BondGraph, i: LinkId, store: &Store) -> (String, Option<String>) {
    let n = subscript(i.0 + 1);
    match store.inertia {
        StoreInertia::Mass(mass) => (format!("m{n} = {} kg", value(graph, mass)), None),
        StoreInertia::Tensor(entries) => tensor(graph, i, entries),
    }
}

/// Returns the diagonal, and the nonzero off-diagonal entries.
fn tensor(graph: &BondGraph, i: LinkId, entries: [Value; 6]) -> (String, Option<String>) {
    let n = subscript(i.0 + 1);
    if entries == [Value::Fixed(Dd::ZERO); 6] {
        return (format!("J{n} = 0"), None);
    }
    let named = ["xx", "yy", "zz", "xy", "xz", "yz"]
        .into_iter()
        .zip(entries);
    let shown = named.map(|(axes, entry)| (entry, format!("{axes} {}", value(graph, entry))));
    let (diagonal, others): (Vec<_>, Vec<_>) = shown.enumerate().partition(|(place, _)| *place < 3);
    let diagonal: Vec<String> = diagonal.into_iter().map(|(_, (_, text))| text).collect();
    let others = others.into_iter().map(|(_, entry)| entry);
    let there = others.filter(|(entry, _)| *entry != Value::Fixed(Dd::ZERO));
    let mut more: Vec<String> = there.map(|(_, text)| text).collect();
    if graph.frames[i.0].tensor_axes != Pose::IDENTITY.rotation {
        more.push("in axes of its own".into());
    }
    let diagonal = diagonal.join(", ");
    let more = (!more.is_empty()).then(|| more.join(", "));
    (format!("J{n} = {diagonal} kg·m²"), more)
}

fn source(graph: &BondGraph, i: LinkId, source: &EffortSource) -> String {
    let efforts = source
        .efforts
        .iter()
        .map(|Effort::Weight { mass, gravity }| match mass {
            Value::Fixed(mass) => vector(gravity.scale(*mass)),
            Value::Parameter(_) => format!("{}·{}", value(graph, *mass), vector(*gravity)),
        });
    let sum = efforts.collect::<Vec<_>>().join(" + ");
    format!("R{} = {sum} N", subscript(i.0 + 1))
}

fn vector(v: Vec3<Dd>) -> String {
    let [x, y, z] = v.0.map(|x| number(x.to_f64()));
    format!("({x}, {y}, {z})")
}

/// Returns a number, or the name of the run-time parameter.
fn value(graph: &BondGraph, value: Value) -> String {
    match value {
        Value::Fixed(x) => number(x.to_f64()),
        Value::Parameter(p) => graph.parameters[p.0].name.clone(),
    }
}
