//! Courses in polynomials of time: a step, and point-to-point motions with a trapezoidal velocity or of fifth order.

use bgdyn_runtime::Dd;

use super::waveform::{Piece, Waveform, unknown_key};
use crate::fault::wording::expected;
use crate::fault::{Faults, wording};
use crate::format::{Dimension, Raw};

/// Keys of a motion from one value to another, as far as the file gives them.
#[derive(Default)]
struct PointToPoint {
    from: Dd,
    to: Dd,
    start: Dd,
    duration: Option<Dd>,
    velocity: Option<Dd>,
    acceleration: Option<Dd>,
}

/// Reads a step: `before` until `time`, then `after`.
pub(super) fn step(raw: &Raw, dimension: Dimension, faults: &mut Faults) -> Option<Waveform> {
    let (mut values, mut time) = ([Dd::ZERO; 2], Dd::ZERO);
    for entry in raw.entries(expected::STEP, faults) {
        match entry.name.value.as_str() {
            "before" => values[0] = entry.number(&[dimension], faults)?.value.value,
            "after" => values[1] = entry.number(&[dimension], faults)?.value.value,
            "time" => time = entry.number(&[Dimension::Time], faults)?.value.value,
            other => {
                let known = &["before", "after", "time"];
                return unknown_key(&entry.name.location, other, known, faults);
            }
        }
    }
    let [before, after] = values;
    let pieces = vec![Piece::new(time, &[after])];
    Some(Waveform::Pieces { before, pieces })
}

/// Reads a motion with a trapezoidal velocity: constant acceleration, constant velocity, constant deceleration. Two of
/// `duration` T, `velocity` v and `acceleration` a determine it, with the distance D and the time t_a of acceleration:
///
/// - v, a: t_a = v/a and T = D/v + t_a; if D < v²/a, v is not reached and t_a = √(D/a), T = 2 t_a.
/// - T, a: v is the smaller root of v² − a T v + a D = 0, which needs a T² ≥ 4 D.
/// - T, v: t_a = T − D/v, which needs D/v ≤ T ≤ 2 D/v; with T = D/v the velocity would jump.
pub(super) fn trapezoidal(
    raw: &Raw,
    dimension: Dimension,
    faults: &mut Faults,
) -> Option<Waveform> {
    let motion = motion(raw, dimension, expected::TRAPEZOIDAL, faults)?;
    let change = motion.to - motion.from;
    let distance = change.abs();
    let refuse = |faults: &mut Faults, message: String, way_out: &str| {
        faults.push(wording::profile(&raw.location, message, way_out));
        None
    };
    let two = Dd::from_f64(2.0);
    let (ramp, total) = match (motion.duration, motion.velocity, motion.acceleration) {
        (None, Some(v), Some(a)) if distance < v * v / a => {
            let ramp = (distance / a).sqrt();
            (ramp, ramp * two)
        }
        (None, Some(v), Some(a)) => (v / a, distance / v + v / a),
        (Some(total), None, Some(a)) => {
            let root = total * total - distance * Dd::from_f64(4.0) / a;
            if root < Dd::ZERO {
                let least = (distance * Dd::from_f64(4.0) / (total * total)).to_f64();
                let message = format!(
                    "an acceleration of {} does not go the distance {} in {} s",
                    a.to_f64(),
                    distance.to_f64(),
                    total.to_f64()
                );
                return refuse(faults, message, &format!("it takes {least} or more"));
            }
            ((total - root.sqrt()) / two, total)
        }
        (Some(total), Some(v), None) => {
            let (ramp, least) = (total - distance / v, (distance / v).to_f64());
            if ramp <= Dd::ZERO || total < ramp * two {
                let message = format!(
                    "with the velocity {} the distance {} does not take {} s",
                    v.to_f64(),
                    distance.to_f64(),
                    total.to_f64()
                );
                let way_out = format!(
                    "the duration is above {least} s, and at most {} s",
                    2.0 * least
                );
                return refuse(faults, message, &way_out);
            }
            (ramp, total)
        }
        _ => {
            return refuse(
                faults,
                expected::TRAPEZOIDAL_NUMBERS.into(),
                "write two of them, and leave the third out",
            );
        }
    };
    if distance == Dd::ZERO {
        return Some(Waveform::Constant(motion.from));
    }
    // The velocity between the ramps: the area of the trapezoid is the distance.
    let velocity = change / (total - ramp);
    let half = velocity / ramp / two;
    let [speeding, end] = [motion.start + ramp, motion.start + total];
    let slowing = end - ramp;
    let mut pieces = vec![Piece::new(motion.start, &[motion.from, Dd::ZERO, half])];
    if speeding < slowing {
        pieces.push(Piece::new(
            speeding,
            &[motion.from + half * ramp * ramp, velocity],
        ));
    }
    let from = motion.to - half * ramp * ramp;
    pieces.push(Piece::new(slowing, &[from, velocity, -half]));
    pieces.push(Piece::new(end, &[motion.to]));
    let before = motion.from;
    Some(Waveform::Pieces { before, pieces })
}

/// Reads a motion of fifth order, from + D (10 s³ − 15 s⁴ + 6 s⁵) with s = (t − start)/T: velocity and acceleration are
/// 0 at both ends. Limits give the shortest T: the largest velocity is 15/8 D/T, the largest acceleration 10/√3 D/T².
pub(super) fn quintic(raw: &Raw, dimension: Dimension, faults: &mut Faults) -> Option<Waveform> {
    let motion = motion(raw, dimension, expected::QUINTIC, faults)?;
    let (change, before) = (motion.to - motion.from, motion.from);
    let distance = change.abs();
    let fastest = motion.velocity.map(|v| distance * Dd::from_f64(1.875) / v);
    let strongest = motion
        .acceleration
        .map(|a| (distance * Dd::from_f64(10.0) / (Dd::from_f64(3.0).sqrt() * a)).sqrt());
    let total = match (motion.duration, fastest, strongest) {
        (Some(total), None, None) => total,
        (None, Some(one), Some(other)) if one < other => other,
        (None, Some(one), _) => one,
        (None, None, Some(one)) => one,
        _ => {
            let message = expected::QUINTIC_NUMBERS;
            let way_out = "write `duration`, or one or both limits";
            faults.push(wording::profile(&raw.location, message.into(), way_out));
            return None;
        }
    };
    if distance == Dd::ZERO {
        return Some(Waveform::Constant(before));
    }
    let cubic = change / (total * total * total);
    let coefficients = [
        before,
        Dd::ZERO,
        Dd::ZERO,
        cubic * Dd::from_f64(10.0),
        -(cubic / total * Dd::from_f64(15.0)),
        cubic / (total * total) * Dd::from_f64(6.0),
    ];
    let pieces = vec![
        Piece::new(motion.start, &coefficients),
        Piece::new(motion.start + total, &[motion.to]),
    ];
    Some(Waveform::Pieces { before, pieces })
}

/// Reads the keys of a motion; duration and limits are positive.
fn motion(
    raw: &Raw,
    dimension: Dimension,
    wanted: wording::Wanted<'_>,
    faults: &mut Faults,
) -> Option<PointToPoint> {
    let [speed, acceleration] = match dimension {
        Dimension::Angle => [Dimension::AngularSpeed, Dimension::One],
        Dimension::Length => [Dimension::Speed, Dimension::Acceleration],
        _ => [Dimension::One; 2],
    };
    let mut motion = PointToPoint::default();
    let mut sound = true;
    for entry in raw.entries(wanted, faults) {
        let key = entry.name.value.as_str();
        let fit = match key {
            "from" | "to" => dimension,
            "start" | "duration" => Dimension::Time,
            "velocity" => speed,
            "acceleration" => acceleration,
            other => {
                let known = &[
                    "from",
                    "to",
                    "start",
                    "duration",
                    "velocity",
                    "acceleration",
                ];
                return unknown_key(&entry.name.location, other, known, faults);
            }
        };
        let number = entry.number(&[fit], faults)?.value;
        let value = number.value;
        if matches!(key, "duration" | "velocity" | "acceleration") && value <= Dd::ZERO {
            faults.push(wording::profile_not_positive(
                &entry.location,
                key,
                &number.text,
            ));
            sound = false;
        }
        match key {
            "from" => motion.from = value,
            "to" => motion.to = value,
            "start" => motion.start = value,
            "duration" => motion.duration = Some(value),
            "velocity" => motion.velocity = Some(value),
            _ => motion.acceleration = Some(value),
        }
    }
    sound.then_some(motion)
}
