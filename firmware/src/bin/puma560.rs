//! The PUMA 560 under computed torque.
#![no_std]
#![no_main]

use bgdyn::nalgebra::SVector;
use control::{ComputedTorque, check};
use cortex_m_rt::entry;
use cortex_m_semihosting::hprintln;
use firmware::{DAMPING, PUMA560, PUMA560_EFFORTS, Real, STIFFNESS, board};

include!(concat!(env!("OUT_DIR"), "/puma560.rs"));

#[entry]
fn main() -> ! {
    let arm = puma560::Puma560::<Real>::default();
    let law = ComputedTorque {
        stiffness: STIFFNESS,
        damping: DAMPING,
        limits: SVector::from(PUMA560_EFFORTS),
    };
    let names = &puma560::JOINT_NAMES;
    board::exit(check::motion(
        "puma560",
        names,
        &PUMA560,
        |line| hprintln!("{}", line),
        |r| law.effort(&arm, r),
    ))
}
