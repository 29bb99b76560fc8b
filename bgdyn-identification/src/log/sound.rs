//! Faults of channels: gaps, constants, numbers that must be in other units.

use super::{Log, Quality};
use crate::fault::{LogFault, LogFaults, short};
use crate::model::JointPart;

/// The longest gap that is interpolated: the longer of this time, s, and of so many steps.
const GAP: (f64, f64) = (0.05, 4.0);
/// Rates that a log in seconds may have, 1/s.
const RATES: std::ops::RangeInclusive<f64> = 5.0..=100_000.0;

/// Returns the faults of a log's channels.
pub fn unsound(log: &Log, quality: &Quality, joints: &[JointPart]) -> Vec<LogFault> {
    let mut faults = LogFaults::default();
    let step = log.median_step();
    if !RATES.contains(&quality.rate) {
        let message = format!(
            "{} rows per second: the time is in other units",
            short(quality.rate)
        );
        let help = "write a second row with units: ms, us or s below `time`";
        faults.push(LogFault::whole("wrong-unit", message).with_help(help));
    }
    for (i, t) in log.time.windows(2).enumerate() {
        if t[1] - t[0] > GAP.0.max(GAP.1 * step) {
            let message = format!(
                "a gap of {} s: {} rows are missing",
                short(t[1] - t[0]),
                ((t[1] - t[0]) / step).round() - 1.0
            );
            let fault = LogFault::at(log.lines[i + 1], 1, "gap", message);
            faults.push(fault.with_help("cut the log there, and identify from the longer part"));
        }
    }
    for (j, joint) in joints.iter().enumerate() {
        let [low, high] = quality.joints[j].range;
        if high - low < 1e-9 {
            let message = format!("joint `{}` stays at {}", joint.name, short(low));
            let help = "move it, or make it `fixed` in the spec at this position";
            faults.push(LogFault::whole("constant-channel", message).with_help(help));
        }
        let tau = &log.tau[j];
        if tau.iter().all(|t| *t == tau[0]) {
            let message = format!(
                "the effort of joint `{}` is {} throughout",
                joint.name,
                short(tau[0])
            );
            let help = "record the measured effort, or the motor's current with --gains";
            faults.push(LogFault::whole("constant-channel", message).with_help(help));
        }
        if let Some(fault) = far_outside(joint, [low, high]) {
            faults.push(fault);
        }
    }
    faults.into_vec()
}

/// Returns a fault for positions that exceed the limits by more than their range: degrees, or millimetres.
fn far_outside(joint: &JointPart, [low, high]: [f64; 2]) -> Option<LogFault> {
    let [Some(lower), Some(upper)] = joint.range else {
        return None;
    };
    let room = upper - lower;
    (low < lower - room || high > upper + room).then(|| {
        let message = format!(
            "joint `{}` goes from {} to {}, its limits are {} and {}",
            joint.name,
            short(low),
            short(high),
            short(lower),
            short(upper)
        );
        let unit = if joint.linear { "mm" } else { "deg" };
        let help =
            format!("write the unit into a second row, such as `{unit}`, or correct the limits");
        LogFault::whole("wrong-unit", message).with_help(help)
    })
}
