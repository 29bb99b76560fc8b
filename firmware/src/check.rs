//! Each effort of a motion beside the host's.

use bgdyn::nalgebra::SVector;
use control::Record;
use cortex_m_semihosting::hprintln;

use crate::Real;

/// Largest difference allowed, in units of the scalar's rounding ε times the joint's largest effort
/// of the motion. ε is the spacing of the numbers above 1: 2⁻²³ in `f32`.
pub const ALLOWED: Real = 8.0;

/// Runs the motion, prints some of its efforts and each joint's largest difference from the host's.
/// Says whether all are within [`ALLOWED`].
pub fn motion<const N: usize>(
    name: &str,
    joints: &[&str; N],
    records: &[Record<Real, N>],
    mut controller: impl FnMut(&Record<Real, N>) -> SVector<Real, N>,
) -> bool {
    let (mut largest, mut off) = ([0.0; N], [0.0; N]);
    for (k, record) in records.iter().enumerate() {
        let tau = controller(record);
        if k % 100 == 0 {
            hprintln!("{} {} ms: {:.3?}", name, k, tau.as_slice());
        }
        for i in 0..N {
            largest[i] = Real::max(largest[i], record.tau[i].abs());
            // A NaN is a miss.
            let error = (tau[i] - record.tau[i]).abs();
            off[i] = if error <= off[i] { off[i] } else { error };
        }
    }
    let mut well = true;
    for i in 0..N {
        let units = off[i] / (largest[i] * Real::EPSILON);
        let within = units <= ALLOWED;
        let what = if within { "" } else { "  MISSED" };
        hprintln!(
            "{} {}: up to {:.3}, off by {:.1e} = {:.2} ε ({} allowed){}",
            name,
            joints[i],
            largest[i],
            off[i],
            units,
            ALLOWED,
            what
        );
        well &= within;
    }
    well
}
