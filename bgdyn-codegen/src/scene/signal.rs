//! Sources of inputs: a signal, a controller, or the caller.

use bgdyn_runtime::Dd;

use super::profile;
use super::waveform::{Waveform, unknown_key};
use crate::fault::wording::expected;
use crate::fault::{Faults, wording};
use crate::format::{Dimension, Raw};
use crate::layout::QuasiJoint;

/// What drives an input.
#[derive(Clone, Debug, PartialEq)]
pub enum InputSource {
    /// The caller, in Rust.
    Given,
    /// A course in time.
    Waveform(Waveform),
    /// The time derivative of another input's course: the rate of a reference.
    RateOf(usize),
    /// u = k (r − q) + d (ṙ − q̇)
    Pd {
        /// r
        target: Waveform,
        /// k
        stiffness: Dd,
        /// d
        damping: Dd,
    },
    /// u = P(q, q̇, a) at a = r̈ + d (ṙ − q̇) + k (r − q) (Luh, Walker, Paul 1980).
    ComputedTorque {
        /// r
        target: Waveform,
        /// k, 1/s²
        stiffness: Dd,
        /// d, 1/s
        damping: Dd,
    },
    /// u = k (r − q) + d (ṙ − q̇) + z, with the integral part z of this name among the first-order states.
    Pid {
        /// r
        target: Waveform,
        /// k
        stiffness: Dd,
        /// d
        damping: Dd,
        /// k_i: ż = k_i (r − q) + (limited u − u)/T_t
        integral: Dd,
        /// T_t, s: how fast the integral part follows a limit.
        tracking: Option<Dd>,
    },
    /// ż of the [`InputSource::Pid`] with this index.
    IntegralRate(usize),
    /// One effort of a controller that holds a joint's position or orientation, by its index.
    Hold(Box<PoseHold>, usize),
}

/// A controller that holds the position or the orientation of a joint with quasi-velocities, by efforts in
/// link axes: two forces of a planar joint, otherwise three forces or three moments.
#[derive(Clone, Debug, PartialEq)]
pub struct PoseHold {
    /// The joint.
    pub joint: QuasiJoint,
    /// What it is held at.
    pub target: PoseTarget,
    /// N/m along the axes of the joint's origin, or N·m/rad about link axes.
    pub stiffness: Vec<Dd>,
    /// N·s/m along the axes of the joint's origin, or N·m·s/rad about link axes.
    pub damping: Vec<Dd>,
}

/// The target of a [`PoseHold`].
#[derive(Clone, Debug, PartialEq)]
pub enum PoseTarget {
    /// Place of the link's origin in the joint's origin, m: x, y and, unless the joint is planar, z.
    Position(Vec<Waveform>),
    /// The unit quaternion x, y, z, w from link axes to origin axes.
    Quaternion([Dd; 4]),
    /// Turns about the fixed axes x, then y, then z, rad.
    Rpy([Waveform; 3]),
}

impl PoseTarget {
    /// Returns its courses in time.
    fn courses(&self) -> &[Waveform] {
        match self {
            PoseTarget::Position(courses) => courses,
            PoseTarget::Quaternion(_) => &[],
            PoseTarget::Rpy(courses) => courses,
        }
    }
}

impl InputSource {
    /// Returns whether it follows a coordinate or a pose.
    pub fn is_controller(&self) -> bool {
        matches!(
            self,
            InputSource::Pd { .. }
                | InputSource::Pid { .. }
                | InputSource::IntegralRate(_)
                | InputSource::ComputedTorque { .. }
                | InputSource::Hold(..)
        )
    }

    /// The instants, s, at which its course or its target bends.
    pub fn corners(&self) -> impl Iterator<Item = Dd> {
        let courses: &[Waveform] = match self {
            InputSource::Given | InputSource::RateOf(_) | InputSource::IntegralRate(_) => &[],
            InputSource::Waveform(course) => std::slice::from_ref(course),
            InputSource::Pd { target, .. }
            | InputSource::Pid { target, .. }
            | InputSource::ComputedTorque { target, .. } => std::slice::from_ref(target),
            InputSource::Hold(hold, _) => hold.target.courses(),
        };
        courses.iter().flat_map(Waveform::corners)
    }
}

/// The words that a drive may begin with.
pub(super) const BUILT_IN: &str = "constant, ramp, harmonic, sum, table, step, trapezoidal, quintic, pd, pid, computed_torque, or `given` for values from Rust code";

/// The key of the limits of an input.
pub(super) const LIMIT: &str = "limit";

/// The word of a controller that holds the pose of a joint with quasi-velocities.
pub(super) const HOLD: &str = "hold";

/// Reads what drives an input of this dimension; `follows` is the dimension of the coordinate that
/// a controller would follow, `effort` whether the input is that coordinate's own effort.
pub(super) fn drive(
    raw: &Raw,
    dimension: Dimension,
    follows: Option<Dimension>,
    effort: bool,
    faults: &mut Faults,
) -> Option<InputSource> {
    if raw.as_word() == Some("given") {
        return Some(InputSource::Given);
    }
    if !raw.is_mapping() {
        return signal(raw, dimension, faults).map(InputSource::Waveform);
    }
    let mut entries = raw.entries(expected::INPUT, faults);
    let all = entries.len();
    entries.retain(|entry| entry.name.value != LIMIT);
    let [only] = entries.as_slice() else {
        if entries.is_empty() && all > 0 {
            return Some(InputSource::Given);
        }
        faults.push(wording::not_one_source(&raw.location, BUILT_IN));
        return None;
    };
    let word = only.name.value.as_str();
    if word == HOLD {
        faults.push(wording::hold_of_one_degree(&only.name.location));
        return None;
    }
    if !matches!(word, "pd" | "pid" | "computed_torque") {
        return course(only, dimension, faults).map(InputSource::Waveform);
    }
    if word == "computed_torque" && follows.is_some() && !effort {
        faults.push(wording::computed_torque_without_effort(&only.name.location));
        return None;
    }
    let Some(position) = follows else {
        faults.push(wording::controller_without_joint(&only.name.location, word));
        return None;
    };
    controller(only, word, position, faults)
}

fn controller(
    raw: &Raw,
    word: &str,
    position: Dimension,
    faults: &mut Faults,
) -> Option<InputSource> {
    let entries = raw.entries(expected::CONTROLLER, faults);
    let mut target = None;
    let mut gains = [Dd::ZERO; 2];
    let (mut integral, mut tracking) = (None, None);
    let known: &[&str] = match word {
        "pid" => &["target", "stiffness", "damping", "integral", "anti_windup"],
        _ => &["target", "stiffness", "damping"],
    };
    for entry in &entries {
        let gain = |faults: &mut Faults| entry.number(&[Dimension::One], faults);
        match entry.name.value.as_str() {
            "target" => target = signal(entry, position, faults),
            "stiffness" => gains[0] = gain(faults)?.value.value,
            "damping" => gains[1] = gain(faults)?.value.value,
            "integral" if word == "pid" => integral = Some(gain(faults)?.value.value),
            "anti_windup" if word == "pid" => {
                let number = entry.number(&[Dimension::Time], faults)?;
                if number.value.value <= Dd::ZERO {
                    let text = &number.value.text;
                    faults.push(wording::anti_windup_not_positive(&number.location, text));
                }
                tracking = Some(number.value.value);
            }
            other => return unknown_key(&entry.name.location, other, known, faults),
        }
    }
    if word == "pid" && integral.is_none() {
        faults.push(wording::pid_without_integral(&raw.location));
    }
    if target.is_none() && !entries.iter().any(|e| e.name.value == "target") {
        faults.push(wording::controller_without_target(&raw.location));
    }
    let (target, [stiffness, damping]) = (target?, gains);
    Some(match word {
        "pd" => InputSource::Pd {
            target,
            stiffness,
            damping,
        },
        "pid" => InputSource::Pid {
            target,
            stiffness,
            damping,
            integral: integral?,
            // By default the time of the integral part, k/k_i.
            tracking: tracking.or_else(|| {
                let time = stiffness / integral.unwrap_or(Dd::ONE);
                (time > Dd::ZERO && time.is_finite()).then_some(time)
            }),
        },
        _ => InputSource::ComputedTorque {
            target,
            stiffness,
            damping,
        },
    })
}

/// Reads a course of this dimension.
pub(super) fn signal(raw: &Raw, dimension: Dimension, faults: &mut Faults) -> Option<Waveform> {
    let fit = [dimension];
    if !raw.is_mapping() {
        let value = raw.number(&fit, faults)?.value.value;
        return Some(Waveform::Constant(value));
    }
    let entries = raw.entries(expected::COURSE, faults);
    let [only] = entries.as_slice() else {
        faults.push(wording::not_one_source(&raw.location, BUILT_IN));
        return None;
    };
    course(only, dimension, faults)
}

/// Reads a course by its word.
fn course(only: &Raw, dimension: Dimension, faults: &mut Faults) -> Option<Waveform> {
    let fit = [dimension];
    match only.name.value.as_str() {
        "constant" => only
            .number(&fit, faults)
            .map(|n| Waveform::Constant(n.value.value)),
        "ramp" => ramp(only, dimension, faults),
        "harmonic" => harmonic(only, dimension, faults),
        "sum" => sum(only, dimension, faults),
        "table" => table(only, dimension, faults),
        "step" => profile::step(only, dimension, faults),
        "trapezoidal" => profile::trapezoidal(only, dimension, faults),
        "quintic" => profile::quintic(only, dimension, faults),
        other => {
            faults.push(wording::unknown_source(
                &only.name.location,
                other,
                BUILT_IN,
            ));
            None
        }
    }
}

/// A ramp; its numbers are of the input's dimension.
fn ramp(raw: &Raw, dimension: Dimension, faults: &mut Faults) -> Option<Waveform> {
    let mut found = [Dd::ZERO; 2];
    for entry in raw.entries(expected::RAMP, faults) {
        match entry.name.value.as_str() {
            "from" => found[0] = entry.number(&[dimension], faults)?.value.value,
            "rate" => {
                let fit = match dimension {
                    Dimension::Angle => Dimension::AngularSpeed,
                    Dimension::Length => Dimension::Speed,
                    _ => Dimension::One,
                };
                found[1] = entry.number(&[fit], faults)?.value.value;
            }
            other => return unknown_key(&entry.name.location, other, &["from", "rate"], faults),
        }
    }
    let [from, rate] = found;
    Some(Waveform::Ramp { from, rate })
}

fn harmonic(raw: &Raw, dimension: Dimension, faults: &mut Faults) -> Option<Waveform> {
    let mut own = [Dd::ZERO; 2];
    let mut time = [Dd::ZERO; 2];
    for entry in raw.entries(expected::HARMONIC, faults) {
        let mut read = |fit: Dimension| Some(entry.number(&[fit], faults)?.value.value);
        match entry.name.value.as_str() {
            "amplitude" => own[0] = read(dimension)?,
            "offset" => own[1] = read(dimension)?,
            "frequency" => time[0] = read(Dimension::Frequency)?,
            "phase" => time[1] = read(Dimension::Angle)?,
            other => {
                let known = &["amplitude", "frequency", "phase", "offset"];
                return unknown_key(&entry.name.location, other, known, faults);
            }
        }
    }
    let ([amplitude, offset], [frequency, phase]) = (own, time);
    Some(Waveform::Harmonic {
        amplitude,
        frequency,
        phase,
        offset,
    })
}

/// The sum of numbers and courses.
fn sum(raw: &Raw, dimension: Dimension, faults: &mut Faults) -> Option<Waveform> {
    let items = raw.items(expected::TERMS, faults)?;
    // Faults of all terms.
    let terms = items.iter().map(|term| signal(term, dimension, faults));
    let terms: Vec<Option<Waveform>> = terms.collect();
    let terms: Vec<Waveform> = terms.into_iter().collect::<Option<_>>()?;
    if terms.is_empty() {
        faults.push(wording::empty_sum(&raw.location));
        return None;
    }
    Some(Waveform::Sum(terms))
}

fn table(raw: &Raw, dimension: Dimension, faults: &mut Faults) -> Option<Waveform> {
    let example = expected::POINTS;
    let mut points: Vec<[Dd; 2]> = Vec::new();
    for row in raw.items(example, faults)? {
        let pair = row.items(expected::POINT, faults)?;
        let [t, value] = pair.as_slice() else {
            faults.push(wording::not_a_point(&row.location));
            return None;
        };
        let time = t.number(&[Dimension::Time], faults)?.value;
        let value = value.number(&[dimension], faults)?.value.value;
        if points.last().is_some_and(|last| last[0] >= time.value) {
            faults.push(wording::times_not_increasing(&t.location, &time.text));
            return None;
        }
        points.push([time.value, value]);
    }
    if points.is_empty() {
        faults.push(wording::empty_table(&raw.location));
        return None;
    }
    Some(Waveform::Table(points))
}
