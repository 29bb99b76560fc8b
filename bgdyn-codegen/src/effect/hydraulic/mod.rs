//! Hydraulics: nodes with a pressure, and resistors that let fluid run between them, joined by name.
//!
//! Nodes are supplies, tanks, volumes of lines, sides of cylinders, and junctions.
//!
//! The fluid has a constant bulk modulus β: its density is ρ = ρ₀ e^{p/β} (Merritt, Hydraulic
//! Control Systems, 1967, chapter 2), pressures measured against the surroundings. The state of a
//! volume V is the volume W that its fluid would fill at the reference density ρ₀, so p = β ln(W/V)
//! however V changes. A volume flow q carries Ẇ = q W/V: that is ṗ = β (q − V̇)/V.
//!
//! The fluid stores E = β (W − V) − p V. From ∂E/∂W = β (1 − V/W) and ∂E/∂V = −p follows
//! Ė = h q − p V̇ with h = β (W/V − 1) = β (e^{p/β} − 1), the enthalpy that a flow carries per volume.
//! So a resistor between nodes of pressures p₁ and p₂ dissipates (h₁ − h₂) q, which is never negative
//! as long as q has the sign of p₁ − p₂, and a source of pressure supplies h q. A resistor passes the
//! same volume at both ends, as hydraulics are usually written.

mod cylinder;
mod flow;
mod fluid;
mod four_way_valve;
mod junction;
mod keys;
mod leakage;
mod line;
mod orifice;
mod source;
mod volume;

pub(super) use cylinder::Cylinder;
pub(super) use fluid::Fluid;
pub(super) use four_way_valve::FourWayValve;
pub(super) use junction::JunctionEffect;
pub(super) use leakage::Leakage;
pub(super) use line::Line;
pub(super) use orifice::Orifice;
pub(super) use source::{Supply, Tank};
