//! Runs the motions of the firmware on a RISC-V with single precision only (RV32IMAFC), compared with the
//! host.
#![no_std]
#![no_main]

mod linux;

use bgdyn::nalgebra::SVector;
use control::{ComputedTorque, Record, check};

/// The scalar of the controllers.
type Real = f32;

include!(concat!(env!("OUT_DIR"), "/motions.rs"));
include!(concat!(env!("OUT_DIR"), "/scara.rs"));
include!(concat!(env!("OUT_DIR"), "/puma560.rs"));
include!(concat!(env!("OUT_DIR"), "/scara_payload.rs"));

/// Runs the motions; returns whether every effort agrees with that of the host.
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
