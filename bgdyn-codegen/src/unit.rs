//! Units of numbers, and the physical dimension of each.

use std::fmt;

/// The physical dimension of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dimension {
    /// A pure number.
    One,
    /// Length, m.
    Length,
    /// Length per angle, m/rad.
    Lead,
    /// Angle per length, rad/m.
    AnglePerLength,
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
    /// Time, s.
    Time,
    /// Frequency, Hz.
    Frequency,
    /// Stiffness of a displacement, N/m.
    Stiffness,
    /// Stiffness of an angle, N·m/rad.
    AngularStiffness,
    /// Effort per speed, N·s/m.
    Damping,
    /// Effort per angular speed, N·m·s/rad.
    AngularDamping,
    /// Effort per square of a speed, N·s²/m².
    QuadraticDamping,
    /// Force per power 3/2 of a length, N/m^1.5.
    ContactStiffness,
    /// Inverse of a speed, s/m.
    InverseSpeed,
    /// Inverse of a length, 1/m.
    InverseLength,
    /// Voltage, V.
    Voltage,
    /// Current, A.
    Current,
    /// Electric resistance, Ω.
    Resistance,
    /// Inductance, H.
    Inductance,
    /// Torque per current, N·m/A, which is V·s/rad.
    TorqueConstant,
    /// Pressure, Pa.
    Pressure,
    /// Volume, m³.
    Volume,
    /// Area, m².
    Area,
    /// Volume flow per root of a pressure, m³/(s·√Pa).
    OrificeFlow,
    /// Volume flow per pressure, m³/(s·Pa).
    Leakage,
    /// Pressure per volume flow, Pa·s/m³.
    FlowResistance,
}

/// A factor of a unit that is not a power of ten.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum UnitFactor {
    /// 1
    One,
    /// π/180: the unit contains a degree.
    Degree,
    /// 1/(2π): the unit is per turn.
    PerTurn,
}

/// A unit: `text` is 10^`exponent` times a factor of the SI unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Unit {
    /// Its text in the spec.
    pub text: &'static str,
    /// Its dimension.
    pub dimension: Dimension,
    /// The power of ten of the factor to the SI unit.
    pub exponent: i32,
    /// Another factor to the SI unit.
    pub factor: UnitFactor,
}

const fn unit(text: &'static str, dimension: Dimension, exponent: i32) -> Unit {
    Unit {
        text,
        dimension,
        exponent,
        factor: UnitFactor::One,
    }
}

const fn degrees(text: &'static str, dimension: Dimension) -> Unit {
    Unit {
        text,
        dimension,
        exponent: 0,
        factor: UnitFactor::Degree,
    }
}

const fn per_turn(text: &'static str, exponent: i32) -> Unit {
    Unit {
        text,
        dimension: Dimension::Lead,
        exponent,
        factor: UnitFactor::PerTurn,
    }
}

/// All units; a dimension's SI unit is first.
static UNITS: [Unit; 67] = [
    unit("m", Dimension::Length, 0),
    unit("cm", Dimension::Length, -2),
    unit("mm", Dimension::Length, -3),
    unit("m/rad", Dimension::Lead, 0),
    unit("mm/rad", Dimension::Lead, -3),
    per_turn("m/turn", 0),
    per_turn("mm/turn", -3),
    unit("rad/m", Dimension::AnglePerLength, 0),
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
    unit("s", Dimension::Time, 0),
    unit("ms", Dimension::Time, -3),
    unit("us", Dimension::Time, -6),
    unit("Hz", Dimension::Frequency, 0),
    unit("kHz", Dimension::Frequency, 3),
    unit("N/m", Dimension::Stiffness, 0),
    unit("N/mm", Dimension::Stiffness, 3),
    unit("N*m/rad", Dimension::AngularStiffness, 0),
    unit("N*s/m", Dimension::Damping, 0),
    unit("N*m*s/rad", Dimension::AngularDamping, 0),
    unit("N*s^2/m^2", Dimension::QuadraticDamping, 0),
    unit("N/m^1.5", Dimension::ContactStiffness, 0),
    unit("kN/m^1.5", Dimension::ContactStiffness, 3),
    unit("s/m", Dimension::InverseSpeed, 0),
    unit("1/m", Dimension::InverseLength, 0),
    unit("1/mm", Dimension::InverseLength, 3),
    unit("V", Dimension::Voltage, 0),
    unit("mV", Dimension::Voltage, -3),
    unit("A", Dimension::Current, 0),
    unit("mA", Dimension::Current, -3),
    unit("ohm", Dimension::Resistance, 0),
    unit("mohm", Dimension::Resistance, -3),
    unit("H", Dimension::Inductance, 0),
    unit("mH", Dimension::Inductance, -3),
    unit("uH", Dimension::Inductance, -6),
    unit("N*m/A", Dimension::TorqueConstant, 0),
    unit("mN*m/A", Dimension::TorqueConstant, -3),
    unit("V*s/rad", Dimension::TorqueConstant, 0),
    unit("Pa", Dimension::Pressure, 0),
    unit("kPa", Dimension::Pressure, 3),
    unit("MPa", Dimension::Pressure, 6),
    unit("GPa", Dimension::Pressure, 9),
    unit("bar", Dimension::Pressure, 5),
    unit("m^3", Dimension::Volume, 0),
    unit("l", Dimension::Volume, -3),
    unit("cm^3", Dimension::Volume, -6),
    unit("m^2", Dimension::Area, 0),
    unit("cm^2", Dimension::Area, -4),
    unit("mm^2", Dimension::Area, -6),
    unit("m^3/(s*Pa^0.5)", Dimension::OrificeFlow, 0),
    unit("m^3/(s*Pa)", Dimension::Leakage, 0),
    unit("Pa*s/m^3", Dimension::FlowResistance, 0),
];

impl Unit {
    /// Returns the unit written as `text`; `·`, `²`, `³`, `°`, `Ω` and `µ` may replace `*`, `^2`, `^3`,
    /// `deg`, `ohm` and `u`.
    pub fn find(text: &str) -> Option<&'static Unit> {
        let plain = text
            .replace('·', "*")
            .replace('²', "^2")
            .replace('³', "^3")
            .replace('Ω', "ohm")
            .replace('µ', "u")
            .replace('°', "deg");
        UNITS.iter().find(|u| u.text == plain)
    }
}

impl Dimension {
    /// Returns the units of the dimension, the SI unit first.
    pub fn units(self) -> impl Iterator<Item = &'static str> {
        UNITS
            .iter()
            .filter(move |u| u.dimension == self)
            .map(|u| u.text)
    }

    /// Returns the dimension of this SI unit; a pure number if it is empty.
    pub fn measured_in(si: &str) -> Dimension {
        Unit::find(si).map_or(Dimension::One, |unit| unit.dimension)
    }

    /// Returns its SI unit; empty for a pure number.
    pub fn si(self) -> &'static str {
        self.units().next().unwrap_or("")
    }
}

impl fmt::Display for Dimension {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Dimension::One => "a plain number",
            Dimension::Length => "a length",
            Dimension::Lead => "a length per turn or per radian",
            Dimension::AnglePerLength => "an angle per length",
            Dimension::Angle => "an angle",
            Dimension::Mass => "a mass",
            Dimension::Inertia => "a moment of inertia",
            Dimension::Acceleration => "an acceleration",
            Dimension::Speed => "a speed",
            Dimension::AngularSpeed => "an angular speed",
            Dimension::Force => "a force",
            Dimension::Torque => "a torque",
            Dimension::Time => "a time",
            Dimension::Frequency => "a frequency",
            Dimension::Stiffness => "a stiffness",
            Dimension::AngularStiffness => "an angular stiffness",
            Dimension::Damping => "a damping",
            Dimension::AngularDamping => "an angular damping",
            Dimension::QuadraticDamping => "a quadratic damping",
            Dimension::ContactStiffness => "a stiffness of a contact",
            Dimension::InverseSpeed => "an inverse speed",
            Dimension::InverseLength => "an inverse length",
            Dimension::Voltage => "a voltage",
            Dimension::Current => "a current",
            Dimension::Resistance => "a resistance",
            Dimension::Inductance => "an inductance",
            Dimension::TorqueConstant => "a torque constant",
            Dimension::Pressure => "a pressure",
            Dimension::Volume => "a volume",
            Dimension::Area => "an area",
            Dimension::OrificeFlow => "a flow per root of a pressure",
            Dimension::Leakage => "a flow per pressure",
            Dimension::FlowResistance => "a flow resistance",
        })
    }
}
