//! The SCARA under computed torque.
#![no_std]
#![no_main]

use bgdyn::nalgebra::SVector;
use control::ComputedTorque;
use cortex_m_rt::entry;
use firmware::{DAMPING, Real, SCARA, STIFFNESS, board, check, efforts};

include!(concat!(env!("OUT_DIR"), "/scara.rs"));

#[entry]
fn main() -> ! {
    let arm = scara::Scara::<Real>::default();
    let law = ComputedTorque {
        stiffness: STIFFNESS,
        damping: DAMPING,
        limits: SVector::from(const { efforts(&scara::JOINT_LIMITS) }),
    };
    let names = &scara::JOINT_NAMES;
    board::exit(check::motion("scara", names, &SCARA, |r| {
        law.effort(&arm, r)
    }))
}
