//! Computed-torque controllers on a Cortex-M, checked against the host.
#![no_std]

pub mod arms;
pub mod board;
#[cfg(feature = "c")]
pub mod c;
pub mod measure;
pub mod subject;

use core::fmt::Arguments;

use bgdyn::Dynamics;
use bgdyn::nalgebra::SVector;
use control::{ComputedTorque, Record, check};
use cortex_m_semihosting::hprintln;

/// The scalar of the controllers.
#[cfg(not(feature = "double"))]
pub type Real = f32;
/// The scalar of the controllers.
#[cfg(feature = "double")]
pub type Real = f64;

include!(concat!(env!("OUT_DIR"), "/motions.rs"));

/// Runs a motion on this board, with the gains of the host, and ends the program with a status for
/// success.
pub fn run<M: Dynamics<Real, N, N>, const N: usize>(
    name: &str,
    arm: &M,
    motion: &[Record<Real, N>],
    efforts: [Real; N],
) -> ! {
    let law = ComputedTorque {
        stiffness: STIFFNESS,
        damping: DAMPING,
        limits: SVector::from(efforts),
    };
    let print = |line: Arguments<'_>| hprintln!("{}", line);
    board::exit(check::motion(name, arm, &law, motion, print))
}
