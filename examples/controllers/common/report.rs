//! Prints the results of the run.

use super::cycle::Gripper;
use super::machine::Machine;
use super::simulate::{PERIOD, Sample};
use super::stopwatch::{PASSES, STATES, Times};
use super::{Cell, Joints};

/// Largest and root-mean-square magnitude.
fn peak_and_rms(values: impl Iterator<Item = f64>) -> (f64, f64) {
    let (mut peak, mut squares, mut count) = (0f64, 0.0, 0usize);
    for x in values {
        peak = peak.max(x.abs());
        squares += x * x;
        count += 1;
    }
    (peak, (squares / count.max(1) as f64).sqrt())
}

/// Returns the distance of the tool from its desired position, mm.
pub fn tool_error<const N: usize>(machine: &Machine<N>, sample: &Sample<N>) -> f64 {
    let at = |q: &Joints<N>| (machine.tool)(q);
    (at(&sample.q) - at(&sample.wanted.q)).norm() * 1e3
}

/// Prints tracking errors, efforts, and the positions where the part was gripped and released.
pub fn tracking<G, C, E, L, const N: usize>(
    cell: &Cell<G, C, E, L, N>,
    computed: &[Sample<N>],
    baseline: &[Sample<N>],
) {
    let (taken, released) = cell.cycle.carried();
    println!("{}", cell.title);
    let legs = cell.cycle.legs.iter();
    let legs: Vec<String> = legs
        .map(|leg| format!("{} {:.2}", leg.name, leg.seconds))
        .collect();
    println!(
        "{:.2} s in {} legs: {}",
        cell.cycle.seconds(),
        legs.len(),
        legs.join(", ")
    );
    println!(
        "Controller at {:.0} Hz; part carried from {taken:.2} s to {released:.2} s",
        1.0 / PERIOD
    );
    println!(
        "Kp = {:.0} 1/s², Kd = {:.1} 1/s, for computed torque (CT) and for PD with gravity alike",
        cell.gains.stiffness, cell.gains.damping
    );
    println!("{}\n", cell.plant);

    println!("Tracking error    up to the pick, peak  carrying, peak        whole cycle, rms");
    println!("                         CT   PD+grav          CT   PD+grav          CT   PD+grav");
    for i in 0..N {
        let joint = cell.machine.joint(i);
        let (scale, unit) = joint.error_unit();
        print!("  {:<11} {unit:<4}", joint.name);
        let (until, from) = (taken + 0.5 * PERIOD, taken - 0.5 * PERIOD);
        let parts = [
            (0.0, until),
            (from, released + 0.5 * PERIOD),
            (0.0, f64::INFINITY),
        ];
        for (part, (from, until)) in parts.into_iter().enumerate() {
            for samples in [computed, baseline] {
                let chosen = samples.iter().filter(|s| from <= s.t && s.t < until);
                let (peak, rms) = peak_and_rms(chosen.map(|s| s.error(i) * scale));
                print!(" {:9.3}", if part == 2 { rms } else { peak });
            }
            print!("{}", if part < 2 { "  " } else { "\n" });
        }
    }

    println!("\nSpeed and effort        top speed  of limit    peak effort      limit  of limit");
    for i in 0..N {
        let joint = cell.machine.joint(i);
        let (scale, unit) = joint.position_unit();
        let (speed, _) = peak_and_rms(computed.iter().map(|s| s.wanted.v[i]));
        let (effort, _) = peak_and_rms(computed.iter().map(|s| s.tau[i]));
        println!(
            "  {:<16} {:8.1} {:<4} {:5.0} %  {effort:9.2} {:<4} {:6.1} {:<4} {:5.0} %",
            joint.name,
            speed * scale,
            format!("{unit}/s"),
            100.0 * speed / joint.limits.velocity,
            joint.effort_unit(),
            joint.limits.effort,
            joint.effort_unit(),
            100.0 * effort / joint.limits.effort,
        );
    }
    for (law, samples) in [("CT", computed), ("PD+grav", baseline)] {
        let saturated = samples.iter().filter(|s| s.saturated).count();
        let ms = saturated as f64 * PERIOD * 1e3;
        println!("  {law}: some drive at its limit for {ms:.0} ms");
    }

    println!("\nTool's distance from its target           CT   PD+grav");
    for (place, gripper) in [("pick", Gripper::Takes), ("place", Gripper::Releases)] {
        let time = cell.cycle.time_of(gripper).unwrap_or(0.0);
        let call = (time / PERIOD).round() as usize;
        println!(
            "  at the {place:<5} point, {time:5.2} s       {:8.3} {:9.3}  mm",
            tool_error(&cell.machine, &computed[call]),
            tool_error(&cell.machine, &baseline[call]),
        );
    }
    println!(
        "  What is left at the place point is the part's weight against the gains: a model that\n  \
         knows the part, or an integral term, would take it away."
    );
}

/// Operations and time of the generated methods.
pub fn calls<const N: usize>(machine: &Machine<N>, times: &Times) {
    println!("\nGenerated method      mul   add   div  sqrt  sincos    ns/call  of the period");
    for (method, nanoseconds) in times {
        let o = machine.operations(method).copied().unwrap_or_default();
        println!(
            "  {method:<18} {:5} {:5} {:5} {:5} {:7} {nanoseconds:10.1} {:13.4} %",
            o.mul,
            o.add,
            o.div,
            o.sqrt,
            o.sincos,
            100.0 * nanoseconds * 1e-9 / PERIOD,
        );
    }
    println!(
        "  f64, this machine, this build; median of {PASSES} passes over {STATES} random states"
    );
    if cfg!(debug_assertions) {
        println!("  a debug build: pass --release for times worth reading");
    }
}
