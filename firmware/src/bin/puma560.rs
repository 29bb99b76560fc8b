//! The PUMA 560 under computed torque.
#![no_std]
#![no_main]

use bgdyn::nalgebra::SVector;
use control::ComputedTorque;
use cortex_m_rt::entry;
use firmware::{DAMPING, PUMA560, Real, STIFFNESS, board, check, efforts};

include!(concat!(env!("OUT_DIR"), "/puma560.rs"));

#[entry]
fn main() -> ! {
    let arm = puma560::Puma560::<Real>::default();
    let law = ComputedTorque {
        stiffness: STIFFNESS,
        damping: DAMPING,
        limits: SVector::from(const { efforts(&puma560::JOINT_LIMITS) }),
    };
    let names = &puma560::JOINT_NAMES;
    board::exit(check::motion("puma560", names, &PUMA560, |r| {
        law.effort(&arm, r)
    }))
}
