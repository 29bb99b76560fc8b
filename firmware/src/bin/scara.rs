//! The SCARA under computed torque.
#![no_std]
#![no_main]

use cortex_m_rt::entry;
use firmware::{Real, SCARA, SCARA_EFFORTS};

include!(concat!(env!("OUT_DIR"), "/scara.rs"));

#[entry]
fn main() -> ! {
    let arm = scara::Scara::<Real>::default();
    firmware::run("scara", &arm, &SCARA, SCARA_EFFORTS)
}
