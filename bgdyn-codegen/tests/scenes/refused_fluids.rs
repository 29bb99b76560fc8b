//! Tests the refusals of fluids that are missing or mixed, and of cylinders without volume.

use super::refused_bodies::{oil, plain, refused};

#[test]
fn fluids_that_are_missing_or_mixed() {
    refused(
        &plain("hose: { type: line, volume: 1 cm^3 }"),
        "no-fluid",
        "hose",
        &["calls for none"],
    );
    refused(&oil("water: { type: fluid, bulk_modulus: 2 GPa }\nwell: { type: line, volume: 1 l, fluid: wine }").named(), "no-fluid", "well", &["`wine`"]);
    let two = "
        oil: { type: fluid, bulk_modulus: 1 GPa }
        water: { type: fluid, bulk_modulus: 2 GPa }
        pump: { type: supply, pressure: 1 MPa, fluid: oil }";
    refused(
        &plain(&format!("{two}\nhose: {{ type: line, volume: 1 l }}")),
        "no-fluid",
        "hose",
        &["which of the fluids `oil`, `water`"],
    );
    refused(
        &plain(&format!(
            "{two}\nhose: {{ type: line, volume: 1 l, fluid: water }}\ncut: {{ type: leakage, from: pump, to: hose, conductance: 1e-12 }}"
        )),
        "two-fluids",
        "cut",
        &["`oil` and `water`"],
    );
}

#[test]
fn cylinders_that_run_out_of_volume() {
    // Side a closes at −0.15 m, the joint goes to −0.2 m.
    refused(
        &oil("ram: { type: cylinder, joint: slide, area_a: 10 cm^2, dead_a: 150 cm^3 }"),
        "effect-range",
        "ram",
        &["`ram_a`", "within its limits", "`slide` is -0.2", "-5"],
    );
    refused(
        &oil("ram: { type: cylinder, joint: slide, area_a: 10 cm^2, dead_a: 0 }"),
        "effect-range",
        "ram",
        &["at the start"],
    );
    // The lug swings to within 0.3 m of the anchor.
    refused(
        &oil("ram: { type: cylinder, between: [anchor, lug], area_a: 10 cm^2, offset: 0.25 m }"),
        "effect-range",
        "ram",
        &["`swing`"],
    );
}
