//! Drawing of a scene's effects: friction, springs, stops, rotors, gears, motors, hydraulics.
//!
//! What acts neither on one joint nor along one line (wrenches, drag) is not drawn but named.

use bgdyn_codegen::declaration::Element;
use bgdyn_codegen::system::System;

use super::between;
use super::chart::{Chart, Port};
use super::fluid::Fluid;
use super::notation::{subscript, value};

impl Chart {
    /// The drawing of a scene.
    pub(crate) fn of_scene(system: &System) -> Self {
        let (scene, graph) = (&system.scene, &system.graph);
        let mut chart = Chart::of_graph(graph, &scene.name, scene.description.as_deref());
        let mut fluid = Fluid::new(&scene.elements);
        for velocity in &mut chart.velocities {
            let number = graph
                .coordinate_named(&velocity.name)
                .map_or(0, |j| j.0 + 1);
            let drive = Port::drive(format!("P{}, {}", subscript(number), velocity.effort));
            velocity.ports = ports(system, &velocity.name, drive, &mut fluid);
        }
        chart.lines = between::lines(&chart, system, &mut fluid);
        if !graph.velocity_products && chart.varies() {
            let note = "The rates of the transformers are left out: no velocity products.";
            chart.notes.push(note.into());
        }
        let payload = |e: &Element| graph.frames.iter().any(|frame| frame.name == e.name);
        let is_drawn = |e: &Element| is_drawn(e) || between::is_drawn(e) || fluid.has_drawn(e);
        let elements = scene.elements.iter();
        let beside = elements.filter(|e| !e.effect.built_in() && !payload(e) && !is_drawn(e));
        let beside: Vec<&str> = beside.map(|e| e.name.as_str()).collect();
        if !beside.is_empty() {
            let names = beside.join(", ");
            chart.notes.push(format!("Not drawn: {names}."));
        }
        chart
    }
}

/// Whether an element acts on one coordinate, and on nothing else: no fluid either.
fn is_drawn(element: &Element) -> bool {
    let known = ["R", "C", "I", "GY", "TF"].contains(&element.effect.symbol());
    known && element.name("joint").is_some() && element.nodes().is_empty()
}

/// What stands on the junction of a coordinate, its drive first where an effort from outside acts.
fn ports(system: &System, coordinate: &str, drive: Port, fluid: &mut Fluid<'_>) -> Vec<Port> {
    let elements = system.scene.elements.iter();
    let own = elements.filter(|e| e.name("joint") == Some(coordinate) && is_drawn(e));
    let (gears, others): (Vec<_>, Vec<_>) = own.partition(|e| e.effect.symbol() == "TF");
    let drive = driven(system, coordinate).then_some(drive);
    let drive = drive.map(|drive| gears.into_iter().fold(drive, geared));
    let mut all: Vec<Port> = drive.into_iter().collect();
    all.extend(others.into_iter().filter_map(|e| port(e, system, fluid)));
    all.extend(fluid.at(coordinate));
    settle(&mut all);
    all
}

/// A drive behind a gear.
fn geared(drive: Port, gear: &Element) -> Port {
    let text = format!("{}, {}", gear.name, number(gear, "η", "efficiency"));
    Port {
        symbol: "TF",
        ports: vec![drive],
        ..Port::drive(text)
    }
}

/// Whether an effort from outside acts on a coordinate.
fn driven(system: &System, name: &str) -> bool {
    let layout = &system.scene.layout;
    let own = layout.coordinate_named(name);
    own.is_some() && layout.inputs.iter().any(|input| input.drives == own)
}

/// Where a store gives the junction its flow, the drive's effort acts on the junction.
fn settle(ports: &mut [Port]) {
    if ports.iter().any(|p| p.on_junction == Some(false)) {
        ports.iter_mut().for_each(give);
    }
}

fn give(port: &mut Port) {
    if port.on_junction.is_none() {
        port.on_junction = Some(true);
        port.ports.iter_mut().for_each(give);
    }
}

/// What an effect is on the junction of its joint.
fn port(element: &Element, system: &System, fluid: &mut Fluid<'_>) -> Option<Port> {
    let named = format!("{} ({})", element.name, element.effect.keyword());
    match element.effect.symbol() {
        "C" if element.effect.adds_coordinate() => Some(elastic(element, system, fluid)),
        symbol @ ("R" | "C") => {
            let port = Port::taking(symbol, named);
            Some(match element.name("reference") {
                Some(reference) => relative(port, reference),
                None => port,
            })
        }
        "I" => Some(rotor(element)),
        "GY" => Some(motor(element)),
        _ => None,
    }
}

/// What acts between a joint and a reference that moves by itself: of the joint's flow the
/// reference takes its own, the rest is the element's.
fn relative(port: Port, reference: &str) -> Port {
    let difference = Port {
        ports: vec![port],
        ..Port::junction("1", format!("q̇ − {reference}"), false)
    };
    let moving = Port {
        symbol: "Sf",
        ..Port::store(format!("rate of {reference}"))
    };
    Port {
        ports: vec![difference, moving],
        ..Port::junction("0", String::new(), false)
    }
}

/// The store of a rotor behind its gear: N² J.
fn rotor(element: &Element) -> Port {
    let inertia = number(element, "J", "inertia");
    let text = match value(element, "ratio") {
        Some(ratio) => format!("N²J of {}, {inertia}, N = {ratio}", element.name),
        None => format!("{}, {inertia}", element.name),
    };
    let on = element.name("on");
    Port {
        more: on.map(|link| format!("its spin also acts on {link}, which is not drawn")),
        ..Port::store(text)
    }
}

/// L di/dt + R i + k N q̇ = u, τ = k N i; N is 1 without a ratio.
fn motor(element: &Element) -> Port {
    let of_gear = [("N", "ratio"), ("η", "efficiency")];
    let of_gear = of_gear.iter().filter(|(_, key)| element.get(key).is_some());
    let mut gyrator = number(element, "k", "torque_constant");
    for (symbol, key) in of_gear {
        gyrator += &format!(", {}", number(element, symbol, key));
    }
    let resistor = Port::taking("R", number(element, "R", "resistance"));
    let mut winding = vec![Port::source(format!("u, {}", element.name))];
    // Without inductance the current follows from the voltage: the resistor gives the flow.
    match value(element, "inductance") {
        Some(_) => winding.extend([resistor, Port::store(number(element, "L", "inductance"))]),
        None => winding.push(Port {
            on_junction: Some(false),
            ..resistor
        }),
    }
    let current = Port {
        on_junction: Some(false),
        ports: winding,
        ..Port::junction("1", "i, A".into(), true)
    };
    Port {
        symbol: "GY",
        ports: vec![current],
        ..Port::source(format!("k N, {gyrator}"))
    }
}

/// τ = K (θ − q) + D (θ̇ − q̇) between the joint and its drive, which has the rotor's store.
fn elastic(element: &Element, system: &System, fluid: &mut Fluid<'_>) -> Port {
    let mut stretch = vec![Port::taking("C", number(element, "K", "stiffness"))];
    if value(element, "damping").is_some() {
        stretch.push(Port::taking("R", number(element, "D", "damping")));
    }
    let stretch = Port {
        ports: stretch,
        ..Port::junction("1", "θ̇ − q̇".into(), false)
    };
    let outside = Port::drive(format!("P of {}", element.name));
    let mut behind = ports(system, &element.name, outside, fluid);
    behind.push(rotor(element));
    settle(&mut behind);
    let drive = Port {
        on_junction: Some(false),
        ports: behind,
        ..Port::junction("1", format!("θ̇ {}", element.name), true)
    };
    Port {
        ports: vec![drive, stretch],
        ..Port::junction("0", "τ".into(), true)
    }
}

/// `R = 0.6 ohm`, as it stands in the file.
fn number(element: &Element, symbol: &str, key: &str) -> String {
    format!("{symbol} = {}", value(element, key).unwrap_or_default())
}
