//! Units that may stand behind a number, and what they measure.

use std::fmt;

/// What a number measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dimension {
    /// A pure number.
    One,
    /// Length, m.
    Length,
    /// Angle, rad.
    Angle,
    /// Mass, kg.
    Mass,
    /// Moment of inertia, kg·m².
    Inertia,
    /// Acceleration, m/s².
    Acceleration,
    /// Speed, m/s.
    Speed,
    /// Angular speed, rad/s.
    AngularSpeed,
    /// Force, N.
    Force,
    /// Torque, N·m.
    Torque,
}

/// A unit: `text` is 10^`exponent` of the SI unit, or a degree (per second).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Unit {
    /// As written in the spec.
    pub text: &'static str,
    /// What it measures.
    pub dimension: Dimension,
    /// Power of ten that leads to the SI unit.
    pub exponent: i32,
    /// Whether π/180 leads to the SI unit.
    pub degrees: bool,
}

const fn unit(text: &'static str, dimension: Dimension, exponent: i32) -> Unit {
    Unit {
        text,
        dimension,
        exponent,
        degrees: false,
    }
}

const fn degrees(text: &'static str, dimension: Dimension) -> Unit {
    Unit {
        text,
        dimension,
        exponent: 0,
        degrees: true,
    }
}

/// Every unit there is; a dimension's SI unit stands first.
static UNITS: [Unit; 20] = [
    unit("m", Dimension::Length, 0),
    unit("cm", Dimension::Length, -2),
    unit("mm", Dimension::Length, -3),
    unit("rad", Dimension::Angle, 0),
    degrees("deg", Dimension::Angle),
    unit("kg", Dimension::Mass, 0),
    unit("g", Dimension::Mass, -3),
    unit("kg*m^2", Dimension::Inertia, 0),
    unit("kg*cm^2", Dimension::Inertia, -4),
    unit("kg*mm^2", Dimension::Inertia, -6),
    unit("g*cm^2", Dimension::Inertia, -7),
    unit("g*mm^2", Dimension::Inertia, -9),
    unit("m/s^2", Dimension::Acceleration, 0),
    unit("m/s", Dimension::Speed, 0),
    unit("mm/s", Dimension::Speed, -3),
    unit("rad/s", Dimension::AngularSpeed, 0),
    degrees("deg/s", Dimension::AngularSpeed),
    unit("N", Dimension::Force, 0),
    unit("kN", Dimension::Force, 3),
    unit("N*m", Dimension::Torque, 0),
];

impl Unit {
    /// The unit written as `text`; `·`, `²` and `°` may stand for `*`, `^2` and `deg`.
    pub fn find(text: &str) -> Option<&'static Unit> {
        let plain = text
            .replace('·', "*")
            .replace('²', "^2")
            .replace('°', "deg");
        UNITS.iter().find(|u| u.text == plain)
    }
}

impl Dimension {
    /// The units that measure it, the SI unit first.
    pub fn units(self) -> impl Iterator<Item = &'static str> {
        UNITS
            .iter()
            .filter(move |u| u.dimension == self)
            .map(|u| u.text)
    }

    /// Its SI unit; empty for a pure number.
    pub fn si(self) -> &'static str {
        self.units().next().unwrap_or("")
    }
}

impl fmt::Display for Dimension {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Dimension::One => "a plain number",
            Dimension::Length => "a length",
            Dimension::Angle => "an angle",
            Dimension::Mass => "a mass",
            Dimension::Inertia => "a moment of inertia",
            Dimension::Acceleration => "an acceleration",
            Dimension::Speed => "a speed",
            Dimension::AngularSpeed => "an angular speed",
            Dimension::Force => "a force",
            Dimension::Torque => "a torque",
        })
    }
}
