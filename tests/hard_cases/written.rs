//! The mechanisms of the single states, as specs, for the build script in this folder and for the tests of
//! the generator.

use std::fmt::Write;

use serde_json::Value;

/// The cases of a file's text.
pub fn cases(text: &str) -> Vec<Value> {
    let file: Value = serde_json::from_str(text).expect("hard cases are JSON");
    file["cases"].as_array().expect("a list of cases").clone()
}

/// Returns a list of numbers, each the intended `f64`.
pub fn list(value: &Value) -> Vec<f64> {
    let numbers = value.as_array().expect("a list");
    numbers
        .iter()
        .map(|x| x.as_f64().expect("a number"))
        .collect()
}

/// Returns all digits of the exact number.
fn digits(x: f64) -> String {
    format!("{x:.120}")
}

/// A chain of links of unit length along x.
pub struct Chain {
    /// All axes along y; otherwise alternating z and y.
    pub planar: bool,
    /// Moments of inertia about the centre of mass of a link of mass 1, kg·m².
    pub moments: [f64; 3],
    /// Mass and inertia of each link relative to those of a link of mass 1.
    pub scales: Vec<f64>,
}

impl Chain {
    /// Returns links that are equal except the last one, which is `last` times as heavy.
    pub fn new(links: usize, planar: bool, moments: [f64; 3], last: f64) -> Chain {
        let mut scales = vec![1.0; links];
        scales[links - 1] = last;
        Chain {
            planar,
            moments,
            scales,
        }
    }

    /// Rods of `static_chain_conditioning`.
    pub fn rods(links: usize, planar: bool) -> Chain {
        let across = if planar { 0.0 } else { 1.0 / 600.0 };
        Chain::new(links, planar, [across, 1.0 / 12.0, 1.0 / 12.0], 1.0)
    }

    /// The chain of `static_mass_ratio`.
    pub fn of_ratio(links: usize, last: f64) -> Chain {
        Chain::new(links, false, [1.0 / 512.0, 1.0 / 16.0, 1.0 / 16.0], last)
    }

    /// The spec.
    pub fn text(&self) -> String {
        let g = digits(-9.81);
        let mut text = format!("format: 1\nname: chain\ngravity: [0, 0, {g}]\nlinks:\n");
        for (i, &scale) in self.scales.iter().enumerate() {
            let axis = if self.planar || i % 2 == 1 { 'y' } else { 'z' };
            let from = usize::from(i > 0);
            writeln!(text, "  - name: link_{i}").unwrap();
            if i > 0 {
                writeln!(text, "    parent: link_{}", i - 1).unwrap();
            }
            writeln!(
                text,
                "    joint: {{ name: joint_{i}, type: revolute, axis: {axis}, origin: {{ xyz: [{from}, 0, 0] }} }}"
            )
            .unwrap();
            let [xx, yy, zz] = self.moments.map(|x| digits(x * scale));
            let mass = digits(scale);
            writeln!(text, "    mass: {mass}\n    com: [0.5, 0, 0]").unwrap();
            writeln!(text, "    inertia: {{ xx: {xx}, yy: {yy}, zz: {zz} }}").unwrap();
        }
        text
    }
}

/// The links of a case of `singular_mass_matrix`; joints have the names of their links.
pub fn links_of(bodies: &[Value]) -> String {
    let mut text = String::new();
    for body in bodies {
        let word = |key: &str| body[key].as_str().expect("a word").to_owned();
        let numbers = |key: &str| list(&body[key]);
        writeln!(text, "  - name: {}", word("name")).unwrap();
        if word("parent") != "world" {
            writeln!(text, "    parent: {}", word("parent")).unwrap();
        }
        let (name, joint) = (word("name"), word("joint"));
        let (axis, origin) = (numbers("axis"), numbers("origin_in_parent"));
        writeln!(
            text,
            "    joint: {{ name: {name}, type: {joint}, axis: {axis:?}, origin: {{ xyz: {origin:?} }} }}"
        )
        .unwrap();
        let (mass, com) = (&body["mass"], numbers("com"));
        writeln!(text, "    mass: {mass}\n    com: {com:?}").unwrap();
        let moments = numbers("inertia_com");
        let names = ["xx", "yy", "zz", "xy", "xz", "yz"].iter().zip(moments);
        // A moment about one axis alone is not that of a body.
        let terms: Vec<String> = names.map(|(name, x)| format!("{name}: {x:.110}")).collect();
        writeln!(text, "    nonphysical: allow").unwrap();
        writeln!(text, "    inertia: {{ {} }}", terms.join(", ")).unwrap();
    }
    text
}

/// The links of an item of `singular_mass_matrix`: two masses that slide along one line.
pub fn sliders_of(item: &Value) -> String {
    [("a", "mA"), ("b", "mB")]
        .map(|(name, mass)| {
            let parent = if name == "b" { "    parent: a\n" } else { "" };
            let mass = item[mass].as_f64().expect("a mass");
            format!(
                "  - name: {name}\n{parent}    joint: {{ name: {name}, type: prismatic, axis: x }}\n    mass: {mass:.110}\n"
            )
        })
        .concat()
}
