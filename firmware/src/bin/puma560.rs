//! The PUMA 560 under computed torque.
#![no_std]
#![no_main]

use cortex_m_rt::entry;
use firmware::{PUMA560, PUMA560_EFFORTS, Real};

include!(concat!(env!("OUT_DIR"), "/puma560.rs"));

#[entry]
fn main() -> ! {
    let arm = puma560::Puma560::<Real>::default();
    firmware::run("puma560", &arm, &PUMA560, PUMA560_EFFORTS)
}
