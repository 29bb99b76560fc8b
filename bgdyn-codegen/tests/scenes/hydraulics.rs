//! Tests hydraulic elements: their laws against equations written in this file.

use bgdyn_codegen::random::Random;
use bgdyn_runtime::{Dd, Scalar};

use super::bench::{Bench, agree, dd};
use super::common::scene;

const EXACT: f64 = 1e-24;

/// A block on a rail, and whatever hydraulics a test calls for.
const BLOCK: &str = "
format: 1
links:
  - { name: block, mass: 2 kg, joint: { name: slide, type: prismatic, axis: x } }
";

fn bench(effects: &str, rest: &str) -> Bench {
    let text = format!("scene: 1\nmechanism: block.yaml\neffects:\n{effects}\n{rest}\n");
    Bench::new(scene(&text, BLOCK))
}

/// p = β ln(W/V)
fn pressure(bulk: &str, reference: Dd, volume: Dd) -> Dd {
    dd(bulk) * (reference / volume).ln()
}

/// Given pressures become volumes at reference density, wherever the piston stands.
#[test]
fn a_given_pressure_becomes_a_volume() {
    let mut bench = bench(
        "  - oil: { type: fluid, bulk_modulus: 1.2 GPa }
  - ram: { type: cylinder, joint: slide, area_a: 8 cm^2, dead_a: 20 cm^3, offset: -50 mm }
  - hose: { type: line, volume: 3 cm^3 }",
        "initial: { slide: 100 mm, ram_a: 5 MPa }\noutputs: [ram_a_pressure, hose_pressure, ram_force]",
    );
    let volume = dd("20e-6") + dd("8e-4") * dd("0.15");
    let stored = bench.at.x[bench.state("ram_a")];
    agree(
        "W",
        stored,
        volume * (dd("5e6") / dd("1.2e9")).exp(),
        0.0,
        EXACT,
    );
    agree("W", bench.at.x[bench.state("hose")], dd("3e-6"), 0.0, EXACT);
    agree("p", bench.output("ram_a_pressure"), dd("5e6"), 0.0, EXACT);
    agree("p", bench.output("hose_pressure"), Dd::ZERO, 1.0, EXACT);
    agree("f", bench.output("ram_force"), dd("4e3"), 0.0, EXACT);
    agree("a", bench.acceleration("slide"), dd("2e3"), 0.0, EXACT);
}

/// A vane actuator: volume per angle, torque instead of force.
#[test]
fn a_cylinder_turns_a_joint() {
    let mechanism = "
format: 1
links:
  - { name: arm, inertia: { yy: 2, xx: 1, zz: 2 }, joint: { name: swing, type: revolute, axis: y, limits: { lower: -60 deg, upper: 60 deg } } }
";
    let text = "
scene: 1
mechanism: arm.yaml
effects:
  - inertia
  - oil: { type: fluid, bulk_modulus: 1 GPa }
  - vane: { type: cylinder, joint: swing, area_a: 30 cm^3, area_b: 30 cm^3, offset: -1.2 rad, stroke: 2.4 rad, dead_a: 5 cm^3, dead_b: 5 cm^3 }
initial: { swing: 30 deg, vane_a: 4 MPa, vane_b: 1 MPa }
";
    let mut bench = Bench::new(scene(text, mechanism));
    // 3 MPa on 30 cm³ per radian are 90 N·m.
    agree("a", bench.acceleration("swing"), dd("45"), 0.0, EXACT);
    let turned = Dd::PI / dd("6") + dd("1.2");
    let volume = dd("5e-6") + dd("30e-6") * turned;
    let p = pressure("1e9", bench.at.x[bench.state("vane_a")], volume);
    agree("p", p, dd("4e6"), 0.0, EXACT);
}

/// Two volumes, one element between them.
fn between(element: &str) -> Bench {
    let effects = format!(
        "  - oil: {{ type: fluid, bulk_modulus: 1 GPa }}
  - left: {{ type: line, volume: 2 cm^3 }}
  - right: {{ type: line, volume: 5 cm^3 }}
  - {element}"
    );
    bench(&effects, "")
}

/// Sets the pressures of two volumes; the flow from left to right, from the two rates.
fn flow(bench: &mut Bench, left: Dd, right: Dd) -> Dd {
    let bulk = dd("1e9");
    for (name, volume, p) in [("left", "2e-6", left), ("right", "5e-6", right)] {
        let i = bench.state(name);
        bench.at.x[i] = dd(volume) * (p / bulk).exp();
    }
    let (out, into) = (bench.rate("left"), bench.rate("right"));
    // Ẇ = q e^{p/β} on both sides
    let (out, into) = (out / (left / bulk).exp(), into / (right / bulk).exp());
    agree("both ends", into, -out, 1e-12, EXACT);
    into
}

/// Pairs of pressures of both signs of the drop.
fn pressures() -> impl Iterator<Item = [Dd; 2]> {
    let mut random = Random(7);
    (0..20).map(move |_| std::array::from_fn(|_| Dd::from_f64(8e6 + 7e6 * random.signed())))
}

#[test]
fn an_orifice_obeys_its_law() {
    let mut plain = between("valve: { type: orifice, from: left, to: right, flow: 2e-7 }");
    let mut opened =
        between("valve: { type: orifice, from: left, to: right, flow: 2e-7, opening: lever }");
    let mut smooth =
        between("valve: { type: orifice, from: left, to: right, flow: 2e-7, resistance: 3e8 }");
    for [left, right] in pressures() {
        let drop = left - right;
        let turbulent = dd("2e-7") * drop.abs().sqrt() * drop.sign();
        agree("q", flow(&mut plain, left, right), turbulent, 1e-6, EXACT);
        for (lever, opening) in [(0.3, 0.3), (1.0, 1.0), (1.7, 1.0), (-0.4, 0.0), (0.0, 0.0)] {
            opened.give("lever", lever);
            let q = flow(&mut opened, left, right);
            agree("u q", q, turbulent * Dd::from_f64(opening), 1e-6, EXACT);
        }
        let q = flow(&mut smooth, left, right);
        let again = dd("3e8") * q + q * q.abs() / (dd("2e-7") * dd("2e-7"));
        agree("Δp", again, drop, 1e3, EXACT);
    }
    // At rest the flow is zero, and the smooth law has the slope 1/R.
    let p = dd("5e6");
    for bench in [&mut plain, &mut opened, &mut smooth] {
        agree("at rest", flow(bench, p, p), Dd::ZERO, 1e-7, 1e-10);
    }
    let slope = flow(&mut smooth, p + dd("1e-6"), p) / dd("1e-6");
    agree("slope", slope, dd("1") / dd("3e8"), 0.0, 1e-6);
}

#[test]
fn a_leakage_obeys_its_law() {
    let mut bench = between("gap: { type: leakage, from: right, to: left, conductance: 4e-12 }");
    for [left, right] in pressures() {
        let wanted = dd("4e-12") * (left - right);
        agree("q", flow(&mut bench, left, right), wanted, 1e-6, EXACT);
    }
}

/// The four paths of a valve, both ways, beyond its ends, against the sums written out.
#[test]
fn a_four_way_valve_obeys_its_law() {
    let text = "  - oil: { type: fluid, bulk_modulus: 1 GPa }
  - pump: { type: supply, pressure: 16 MPa }
  - sump: { type: tank, pressure: 0.2 MPa }
  - left: { type: line, volume: 2 cm^3 }
  - right: { type: line, volume: 5 cm^3 }
  - valve: { type: four_way_valve, supply: pump, tank: sump, a: left, b: right, flow: 2e-7, resistance: 1e8 }";
    let mut bench = bench(text, "");
    let (supply, tank, bulk) = (dd("16e6"), dd("0.2e6"), dd("1e9"));
    let through = |drop: Dd| {
        let (r, k) = (dd("1e8"), dd("2e-7"));
        let root = (r * r + dd("4") * drop.abs() / (k * k)).sqrt();
        dd("2") * drop / (r + root)
    };
    for [left, right] in pressures() {
        for spool in [0.4, 1.0, 1.5, -0.25, -1.0, -3.0, 0.0] {
            bench.give("valve", spool);
            for (name, volume, p) in [("left", "2e-6", left), ("right", "5e-6", right)] {
                let i = bench.state(name);
                bench.at.x[i] = dd(volume) * (p / bulk).exp();
            }
            let open = Dd::from_f64(spool.clamp(-1.0, 1.0));
            let (into_left, into_right) = if spool > 0.0 {
                (through(supply - left), -through(right - tank))
            } else {
                (-through(left - tank), through(supply - right))
            };
            let open = open.abs();
            let rates = [("left", left, into_left), ("right", right, into_right)];
            for (name, p, into) in rates {
                let q = bench.rate(name) / (p / bulk).exp();
                agree(name, q, open * into, 1e-6, EXACT);
            }
            // The pump supplies its flow times its enthalpy, and no element creates power.
            let given = bench.power("pump")[0];
            let enthalpy = bulk * ((supply / bulk).exp() - dd("1"));
            let pumped = open * if spool > 0.0 { into_left } else { into_right };
            agree("supplied", given, enthalpy * pumped, 1.0, EXACT);
            assert!(bench.power("valve")[2].to_f64() >= 0.0);
        }
    }
}

/// Restrictions supply no energy: their dissipation is never negative, and the power of a supply is that
/// of its flow.
#[test]
fn restrictions_dissipate() {
    let elements = [
        "valve: { type: orifice, from: left, to: right, flow: 2e-7, opening: valve_lift }",
        "valve: { type: orifice, from: left, to: right, flow: 2e-7, resistance: 1e9 }",
        "valve: { type: leakage, from: left, to: right, conductance: 3e-12 }",
    ];
    for element in elements {
        let mut bench = between(element);
        for [left, right] in pressures() {
            for u in [-1.0, 0.2, 1.0, 2.0] {
                bench.at.u.iter_mut().for_each(|x| *x = Dd::from_f64(u));
                let q = flow(&mut bench, left, right);
                let [_, _, lost] = bench.power("valve");
                let bulk = dd("1e9");
                let expected = bulk * ((left / bulk).exp() - (right / bulk).exp()) * q;
                agree("lost", lost, expected, 1e-3, EXACT);
                assert!(lost.to_f64() >= 0.0, "{element} makes {lost:?} W");
            }
        }
    }
}
