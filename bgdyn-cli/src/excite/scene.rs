//! The scene that runs a motion under computed torque.

use std::fmt::Write;

use bgdyn_codegen::machine::Machine;
use bgdyn_identification::Model;
use bgdyn_identification::excite::{Excitation, FourierSeries};

/// Gains of computed torque: poles at −10/s.
const GAINS: [f64; 2] = [100.0, 20.0];

/// Returns the scene; `spec` is the file of the mechanism beside it.
pub(crate) fn scene(
    spec: &str,
    machine: &Machine,
    model: &Model<'_>,
    found: &Excitation,
) -> String {
    let effects = effects(machine);
    let mut text = format!(
        "# The motion of `bgdyn excite` under computed torque, one period, without friction.\nscene: 1\nmechanism: {spec}\n\neffects: [{}]\n\ninputs:\n",
        effects.join(", ")
    );
    let [stiffness, damping] = GAINS;
    for (joint, series) in model.joints.iter().zip(&found.motion.joints) {
        let _ = writeln!(
            text,
            "  {}:\n    computed_torque:\n      stiffness: {stiffness}\n      damping: {damping}\n      target:\n        sum:\n          - {}",
            joint.name,
            exact(series.centre)
        );
        for k in 0..series.sine.len() {
            let _ = writeln!(text, "          - {}", harmonic(series, k, found));
        }
    }
    let start = found.motion.at(0.0);
    let _ = writeln!(text, "\ninitial:");
    for (joint, q) in model.joints.iter().zip(&start.q) {
        let _ = writeln!(text, "  {}: {}", joint.name, exact(*q));
    }
    let end = exact(found.motion.period());
    let _ = writeln!(
        text,
        "\nintegration: {{ method: rk4, step: 1 ms, end: {end} }}"
    );
    text
}

/// (a sin x − b cos x)/(kω) = |(a, b)|/(kω) · sin(x − atan2(b, a)).
fn harmonic(series: &FourierSeries, k: usize, found: &Excitation) -> String {
    let (a, b) = (series.sine[k], series.cosine[k]);
    let order = (k + 1) as f64;
    format!(
        "harmonic: {{ amplitude: {}, frequency: {}, phase: {} }}",
        exact(a.hypot(b) / (order * found.motion.frequency)),
        exact(order / found.motion.period()),
        exact(-b.atan2(a))
    )
}

/// Returns the effects: bodies under gravity, with rotors where the file has them. Friction is left out: a light joint
/// under computed torque sticks, and the motion would not be seen.
fn effects(machine: &Machine) -> Vec<String> {
    let mut all: Vec<String> = ["gravity", "inertia", "velocity_products"]
        .map(String::from)
        .into();
    if machine
        .effects
        .iter()
        .any(|e| e.effect.family() == "rotors")
    {
        all.push("rotors".into());
    }
    all
}

/// Returns a number with all its digits.
fn exact(x: f64) -> String {
    format!("{:?}", x + 0.0)
}
