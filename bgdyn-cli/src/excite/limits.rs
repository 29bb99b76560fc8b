//! The limits of a motion: those of the file, with margins, and the values that replace missing ones.

use std::f64::consts::PI;

use bgdyn_codegen::format::Dimension;
use bgdyn_identification::excite::JointLimits;
use bgdyn_identification::{JointPart, LogFault};

use crate::quantity::value;

/// Speed of a joint without a limit: rad/s, m/s.
const SPEED: [f64; 2] = [2.0, 0.5];
/// Acceleration without `--acceleration`: rad/s², m/s².
const ACCELERATION: [f64; 2] = [7.0, 2.0];

/// How sizes of both kinds are written.
const EXAMPLES: [&str; 2] = ["such as `2 rad/s,0.5 m/s`", "such as `7 rad/s^2,2 m/s^2`"];

/// What the options say of limits; pairs are of joints that turn, and that slide.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Asked {
    /// Share of the limits that stays free.
    pub(crate) margin: f64,
    /// Speeds that are not exceeded either.
    pub(crate) speed: [Option<f64>; 2],
    /// Accelerations.
    pub(crate) acceleration: [f64; 2],
}

impl Asked {
    /// Reads the options: `8%`, `2 rad/s,0.5 m/s`, `7 rad/s^2,2 m/s^2`. A number without a unit has the SI unit of each
    /// joint.
    ///
    /// # Errors
    /// The option and what is wrong with it.
    pub(crate) fn read(
        margin: &str,
        speed: Option<&str>,
        acceleration: Option<&str>,
    ) -> Result<Self, String> {
        let share = margin.trim().strip_suffix('%');
        let number = share.unwrap_or(margin).trim().parse::<f64>();
        let number = number.map(|x| if share.is_some() { x / 100.0 } else { x });
        let Some(margin) = number.ok().filter(|x| (0.0..1.0).contains(x)) else {
            return Err(format!(
                "`--margin {margin}`: write a share from 0 % to below 100 %, such as `8%`"
            ));
        };
        let speeds = [Dimension::AngularSpeed, Dimension::Speed];
        let speed = pair("speed", speed, &speeds)?;
        let found = pair(
            "acceleration",
            acceleration,
            &[Dimension::One, Dimension::Acceleration],
        )?;
        let or = |i: usize| found[i].unwrap_or(ACCELERATION[i]);
        Ok(Asked {
            margin,
            speed,
            acceleration: [or(0), or(1)],
        })
    }
}

/// Reads a size of joints that turn, one of joints that slide, or both, separated by a comma; a number without a unit is
/// that of all joints, and stands alone.
fn pair(
    option: &str,
    text: Option<&str>,
    dimensions: &[Dimension; 2],
) -> Result<[Option<f64>; 2], String> {
    let mut found = [None; 2];
    let whole = text.unwrap_or_default();
    for part in text.iter().flat_map(|text| text.split(',')).map(str::trim) {
        // The format of files has no unit of angular acceleration.
        let angular = part.strip_suffix("rad/s^2");
        let own = angular.map_or(part, str::trim);
        let plain = own.parse::<f64>().is_ok();
        let read = |d: Dimension| value(own, &[d]).map(|x| x.to_f64());
        let sizes = match (angular.is_some(), plain) {
            (true, _) => [read(dimensions[0]).map(Some), Ok(None)],
            (false, true) => [read(dimensions[0]).map(Some), read(dimensions[1]).map(Some)],
            (false, false) => match read(dimensions[0]) {
                Ok(x) => [Ok(Some(x)), Ok(None)],
                Err(_) => [Ok(None), read(dimensions[1]).map(Some)],
            },
        };
        for (kept, size) in found.iter_mut().zip(sizes) {
            let size = size.map_err(|why| format!("`--{option} {part}`: {why}"))?;
            if size.is_some_and(|x| x <= 0.0) {
                return Err(format!(
                    "`--{option} {part}`: write a number greater than 0"
                ));
            }
            if kept.is_some() && size.is_some() {
                return Err(format!(
                    "`--{option} {whole}`: write one number for joints that turn and one for joints that slide, with their units, {}",
                    EXAMPLES[usize::from(option != "speed")]
                ));
            }
            *kept = size.or(*kept);
        }
    }
    Ok(found)
}

/// Returns the limits of each joint, and what the command chose for those that the file does not have.
///
/// # Errors
/// Joints that cannot move, or whose range nothing limits.
pub(crate) fn joint_limits(
    joints: &[JointPart],
    asked: &Asked,
) -> Result<(Vec<JointLimits>, Vec<String>), Vec<LogFault>> {
    let (mut limits, mut chosen, mut faults) = (Vec::new(), Vec::new(), Vec::new());
    for joint in joints {
        match of_joint(joint, asked, &mut chosen) {
            Ok(own) => limits.push(own),
            Err(fault) => faults.push(fault),
        }
    }
    match faults.is_empty() {
        true => Ok((limits, chosen)),
        false => Err(faults),
    }
}

fn of_joint(
    joint: &JointPart,
    asked: &Asked,
    chosen: &mut Vec<String>,
) -> Result<JointLimits, LogFault> {
    let name = &joint.name;
    let kind = usize::from(joint.linear);
    let unit = ["rad", "m"][kind];
    let free = 1.0 - asked.margin;
    let [low, high] = range(joint, chosen)?;
    if high <= low {
        let message = format!("joint `{name}` has the range {low} … {high} {unit}");
        return Err(LogFault::whole("no-range", message).with_help(
            "a joint that does not move shows nothing: widen its limits, or make it `fixed`",
        ));
    }
    let (middle, half) = (0.5 * (low + high), 0.5 * free * (high - low));
    let speed = match (joint.speed.map(|s| s * free), asked.speed[kind]) {
        (Some(file), Some(asked)) => file.min(asked),
        (Some(speed), None) | (None, Some(speed)) => speed,
        (None, None) => {
            chosen.push(format!(
                "joint `{name}` has no limit of velocity: {} {unit}/s (--speed)",
                SPEED[kind]
            ));
            SPEED[kind]
        }
    };
    if speed <= 0.0 {
        let message = format!("joint `{name}` has the limit of velocity 0");
        return Err(LogFault::whole("no-speed", message).with_help(
            "a joint that does not move shows nothing: raise its limit, or make it `fixed`",
        ));
    }
    if let Some(effort) = joint.effort.filter(|effort| *effort <= 0.0) {
        let message = format!("joint `{name}` has the limit of effort {effort}");
        return Err(LogFault::whole("no-effort", message)
            .with_help("such a joint cannot move: raise its limit, or leave it out"));
    }
    Ok(JointLimits {
        position: [middle - half, middle + half],
        speed,
        acceleration: asked.acceleration[kind],
        effort: joint.effort.map(|e| e * free),
    })
}

/// Returns the range of a joint without margin.
fn range(joint: &JointPart, chosen: &mut Vec<String>) -> Result<[f64; 2], LogFault> {
    let name = &joint.name;
    match joint.range {
        [Some(low), Some(high)] => Ok([low, high]),
        [low, high] if !joint.linear => {
            // Without one of both, a turn from the other.
            let low = low.unwrap_or_else(|| high.map_or(-PI, |high| high - 2.0 * PI));
            let high = high.unwrap_or(low + 2.0 * PI);
            let missing = match joint.range {
                [Some(_), None] => "no upper limit",
                [None, Some(_)] => "no lower limit",
                _ => "no limits",
            };
            chosen.push(format!(
                "joint `{name}` has {missing} of position: {low:.4} … {high:.4} rad"
            ));
            Ok([low, high])
        }
        _ => {
            let message = format!("joint `{name}` slides, and the file does not say how far");
            Err(LogFault::whole("no-range", message)
                .with_help("add `limits: { lower: …, upper: … }` to the joint"))
        }
    }
}
