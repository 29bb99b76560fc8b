//! Compares each effort of a motion with that of the host.

use core::fmt::{Arguments, Display, LowerExp};

use bgdyn::{Dynamics, Scalar};

use crate::{ComputedTorque, Record};

/// The scalar of a controller: `f32` or `f64`.
pub trait Real: Scalar + Display + LowerExp + PartialOrd {
    /// 0
    const ZERO: Self;
    /// The spacing of the numbers above 1.
    const EPSILON: Self;
    /// Largest permitted difference, in units of ε times the joint's largest effort of the motion.
    const ALLOWED: Self;
}

impl Real for f32 {
    const ZERO: f32 = 0.0;
    const EPSILON: f32 = f32::EPSILON;
    const ALLOWED: f32 = 8.0;
}

impl Real for f64 {
    const ZERO: f64 = 0.0;
    const EPSILON: f64 = f64::EPSILON;
    const ALLOWED: f64 = 8.0;
}

/// Runs the motion under computed torque and prints some of its efforts and each joint's largest
/// difference from those of the host. Returns whether all are within [`Real::ALLOWED`].
pub fn motion<T: Real, M: Dynamics<T, N, N>, const N: usize>(
    name: &str,
    arm: &M,
    law: &ComputedTorque<T, N>,
    records: &[Record<T, N>],
    mut print: impl FnMut(Arguments<'_>),
) -> bool {
    let (mut largest, mut off) = ([T::ZERO; N], [T::ZERO; N]);
    for (k, record) in records.iter().enumerate() {
        let tau = law.effort(arm, record);
        if k % 100 == 0 {
            print(format_args!("{name} {k} ms: {:.3?}", tau.as_slice()));
        }
        for i in 0..N {
            largest[i] = largest[i].max(record.tau[i].abs());
            // A NaN is not within the limit.
            let error = (tau[i] + -record.tau[i]).abs();
            off[i] = if error <= off[i] { off[i] } else { error };
        }
    }
    let mut well = true;
    for i in 0..N {
        let units = off[i] / (largest[i] * T::EPSILON);
        let within = units <= T::ALLOWED;
        let (joint, most, off) = (arm.joint_names()[i], largest[i], off[i]);
        let what = if within { "" } else { "  MISSED" };
        print(format_args!(
            "{name} {joint}: up to {most:.3}, off by {off:.1e} = {units:.2} ε ({} allowed){what}",
            T::ALLOWED
        ));
        well &= within;
    }
    well
}
