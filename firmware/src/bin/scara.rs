//! The SCARA under computed torque.
#![no_std]
#![no_main]

use bgdyn::nalgebra::SVector;
use control::{ComputedTorque, check};
use cortex_m_rt::entry;
use cortex_m_semihosting::hprintln;
use firmware::{DAMPING, Real, SCARA, SCARA_EFFORTS, STIFFNESS, board};

include!(concat!(env!("OUT_DIR"), "/scara.rs"));

#[entry]
fn main() -> ! {
    let arm = scara::Scara::<Real>::default();
    let law = ComputedTorque {
        stiffness: STIFFNESS,
        damping: DAMPING,
        limits: SVector::from(SCARA_EFFORTS),
    };
    let names = &scara::JOINT_NAMES;
    board::exit(check::motion(
        "scara",
        names,
        &SCARA,
        |line| hprintln!("{}", line),
        |r| law.effort(&arm, r),
    ))
}
