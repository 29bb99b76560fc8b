//! Motions of hard cases, compiled and integrated, against reference solutions: chaos, large ratios of
//! masses, stiffness, friction that sticks. `tests/hard_cases/README.md` says where the solutions
//! come from and what is allowed of each.
#![forbid(unsafe_code)]

mod follow;
mod outcome;
mod reference;
mod smooth;
mod stick_slip;
mod stiff;

/// The scenes, compiled.
pub mod scenes {
    include!(concat!(env!("OUT_DIR"), "/modules.rs"));
}

pub use outcome::Outcome;

/// Runs one case: what was measured, quantity by quantity.
pub type Case = fn() -> Vec<Outcome>;

/// All cases, by the names of their files in `tests/hard_cases`.
pub const CASES: [(&str, Case); 12] = [
    ("a01_simple_pendulum", smooth::a01_simple_pendulum),
    ("double_pendulum_chaotic", smooth::double_pendulum_chaotic),
    ("chain8_rods", smooth::chain8_rods),
    ("arm6_3d", smooth::arm6_3d),
    ("mass_ratio_1e6_1", smooth::mass_ratio_1e6_1),
    ("mass_ratio_1e9_1", smooth::mass_ratio_1e9_1),
    ("stiff_spring_pendulum", stiff::stiff_spring_pendulum),
    ("stiff_spring_two_mass", stiff::stiff_spring_two_mass),
    ("motor_linear_stiff", stiff::motor_linear_stiff),
    ("hydraulic_cylinder", stiff::hydraulic_cylinder),
    ("lugre_stick_slip", stick_slip::lugre_stick_slip),
    (
        "coulomb_stick_slip_belt",
        stick_slip::coulomb_stick_slip_belt,
    ),
];

/// Runs all cases, in the order of [`CASES`].
pub fn cases() -> Vec<Outcome> {
    CASES.iter().flat_map(|(_, case)| case()).collect()
}
