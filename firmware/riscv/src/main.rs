//! The motions of the firmware on a RISC-V with single precision only (RV32IMAFC), beside the host's.
#![no_std]
#![no_main]

mod linux;

use bgdyn::nalgebra::SVector;
use control::{ComputedTorque, Record, check};

/// What the controllers compute with.
type Real = f32;

include!(concat!(env!("OUT_DIR"), "/motions.rs"));
include!(concat!(env!("OUT_DIR"), "/scara.rs"));
include!(concat!(env!("OUT_DIR"), "/puma560.rs"));
include!(concat!(env!("OUT_DIR"), "/scara_payload.rs"));

/// Runs the motions; whether every effort is the host's.
fn run() -> bool {
    let mut well = true;
    macro_rules! arm {
        ($module:ident, $model:expr, $motion:ident, $efforts:ident) => {
            let arm = $model;
            let law = ComputedTorque {
                stiffness: STIFFNESS,
                damping: DAMPING,
                limits: SVector::from($efforts),
            };
            let name = stringify!($module);
            well &= check::motion(name, &arm, &law, &$motion, linux::print);
        };
    }
    arm!(scara, scara::Scara::<Real>::default(), SCARA, SCARA_EFFORTS);
    let puma = puma560::Puma560::<Real>::default();
    arm!(puma560, puma, PUMA560, PUMA560_EFFORTS);
    let laden = scara_payload::ScaraPayload { payload: PAYLOAD };
    arm!(scara_payload, laden, SCARA_PAYLOAD, SCARA_PAYLOAD_EFFORTS);
    well
}
