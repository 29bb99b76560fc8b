//! Hydraulic laws of the oracle: pressures of nodes, flows between them, their effects on volumes and
//! joints.

use bgdyn_runtime::Dd;

use super::laws::{Effect, act, stretch};
use super::state::{At, Named, Sums};
use super::vector::dd;
use super::yaml::text;

/// A volume of fluid: its current size, and its size without pressure.
struct Volume {
    node: String,
    size: Dd,
    unpressed: Dd,
}

/// Returns the bulk modulus: the oracle's scenes have only one fluid.
fn bulk_modulus(all: &[Effect]) -> Option<Dd> {
    let fluid = all.iter().find(|e| e.kind() == "fluid")?;
    Some(fluid.number("bulk_modulus"))
}

/// Sizes of the volumes: of lines, and of the sides of cylinders.
pub fn sizes(all: &[Effect], at: &At<'_>) -> Vec<(String, Dd)> {
    let mut found = Vec::new();
    for e in all {
        match e.kind() {
            "line" => found.push((e.name.clone(), e.number("volume"))),
            "cylinder" => {
                let out = stretch(e, at).0 - e.or("offset", 0.0);
                let a = e.or("dead_a", 0.0) + e.number("area_a") * out;
                found.push((format!("{}_a", e.name), a));
                if e.has("area_b") {
                    let left = e.or("stroke", 0.0) - out;
                    let b = e.or("dead_b", 0.0) + e.number("area_b") * left;
                    found.push((format!("{}_b", e.name), b));
                }
            }
            _ => {}
        }
    }
    found
}

/// Computes the pressures first, because flows depend on them.
pub fn pressures(all: &[Effect], at: &At<'_>, sums: &mut Sums) {
    for e in all.iter().filter(|e| matches!(e.kind(), "supply" | "tank")) {
        sums.pressures.insert(e.name.clone(), e.or("pressure", 0.0));
    }
    let Some(bulk) = bulk_modulus(all) else {
        return;
    };
    for (node, size) in sizes(all, at) {
        let pressure = bulk * (at.state.x[&node] / size).ln();
        sums.pressures.insert(node, pressure);
    }
}

/// Adds the laws of resistors and cylinders; the others have no law of their own.
pub fn law(e: &Effect, at: &At<'_>, sums: &mut Sums) {
    match e.kind() {
        "fluid" | "supply" | "tank" | "line" | "junction" => {}
        "cylinder" => {
            let side = |s: &str| sums.pressures[&format!("{}_{s}", e.name)];
            let mut force = side("a") * e.number("area_a");
            if e.has("area_b") {
                force -= side("b") * e.number("area_b");
            }
            act(e, at, sums, force);
        }
        "orifice" | "leakage" => {
            let ends = [e.text("from"), e.text("to")];
            // A resistor in series is handled with the whole scene.
            if ends.iter().all(|n| sums.pressures.contains_key(*n)) {
                let opening = text(&e.keys, "opening").map_or(Dd::ONE, |u| at.input(u));
                let opening = opening.max(Dd::ZERO).min(Dd::ONE);
                pass(sums, ends, opening, resistances(e));
            }
        }
        "four_way_valve" => {
            let spool = text(&e.keys, "spool").unwrap_or(&e.name);
            let x = at.input(spool).max(-Dd::ONE).min(Dd::ONE);
            let [supply, tank, a, b] = ["supply", "tank", "a", "b"].map(|k| e.text(k));
            let (fed, emptied) = if x > Dd::ZERO { (a, b) } else { (b, a) };
            pass(sums, [supply, fed], x.abs(), resistances(e));
            pass(sums, [emptied, tank], x.abs(), resistances(e));
        }
        other => panic!("the oracle does not know {other}"),
    }
}

/// R and S of Δp = R q + S q |q|.
fn resistances(e: &Effect) -> [Dd; 2] {
    if e.has("conductance") {
        return [Dd::ONE / e.number("conductance"), Dd::ZERO];
    }
    let flow = e.number("flow");
    [e.or("resistance", 0.0), Dd::ONE / (flow * flow)]
}

/// Solves for the flow of two resistors that meet in a junction.
pub fn in_series(all: &[Effect], sums: &mut Sums) {
    for junction in all.iter().filter(|e| e.kind() == "junction") {
        let meets = |e: &&Effect, key: &str| text(&e.keys, key) == Some(&junction.name);
        let into = all.iter().find(|e| meets(e, "to")).expect("a resistor");
        let out = all.iter().find(|e| meets(e, "from")).expect("another one");
        let [a, b] = [resistances(into), resistances(out)];
        pass(
            sums,
            [into.text("from"), out.text("to")],
            Dd::ONE,
            [a[0] + b[0], a[1] + b[1]],
        );
    }
}

/// A flow q with Δp = R q + S q |q|, times the opening.
fn pass(sums: &mut Sums, [from, to]: [&str; 2], opening: Dd, [r, s]: [Dd; 2]) {
    let drop = sums.pressures[from] - sums.pressures[to];
    let root = (r * r + dd(4.0) * s * drop.abs()).sqrt();
    let flow = opening * dd(2.0) * drop / (r + root);
    sums.flow(from, -flow);
    sums.flow(to, flow);
}

/// Adds the effect of the flows on the volumes: Ẇ = q W/V. They store β (W − V) − p V.
pub fn volumes(all: &[Effect], at: &At<'_>, sums: &mut Sums) {
    let Some(bulk) = bulk_modulus(all) else {
        return;
    };
    let of = |(node, size): (String, Dd)| {
        let unpressed = at.state.x[&node];
        Volume {
            node,
            size,
            unpressed,
        }
    };
    for Volume {
        node,
        size,
        unpressed,
    } in sizes(all, at).into_iter().map(of)
    {
        let flow = sums.flows.get(&node).copied().unwrap_or(Dd::ZERO);
        sums.stored += bulk * (unpressed - size) - sums.pressures[&node] * size;
        sums.rates.insert(node, flow * unpressed / size);
    }
}

/// Returns the states of the volumes at these pressures.
pub fn filled(all: &[Effect], at: &At<'_>, mut pressure: impl FnMut() -> Dd) -> Named {
    let Some(bulk) = bulk_modulus(all) else {
        return Named::new();
    };
    let fill = |(node, size): (String, Dd)| (node, size * (pressure() / bulk).exp());
    sizes(all, at).into_iter().map(fill).collect()
}
