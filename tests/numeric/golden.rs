//! Every method of every robot equals its golden value: 1e-12 relative, forward dynamics to the
//! larger of that and 1e-15 × cond(M); single precision to the same with its own rounding error.

use bgdyn::Dynamics;

use crate::golden_values::equals_golden;
use crate::robots::for_each_robot;

fn in_double<M: Dynamics<f64, N, N>, const N: usize>(
    robot: &str,
    model: &M,
    joints: &[&'static str; N],
) {
    equals_golden::<f64, M, N>(robot, model, joints, 1.0, |x| x);
}

fn in_single<M: Dynamics<f32, N, N>, const N: usize>(
    robot: &str,
    model: &M,
    joints: &[&'static str; N],
) {
    let unit = f64::from(f32::EPSILON) / f64::EPSILON;
    equals_golden::<f32, M, N>(robot, model, joints, unit, f64::from);
}

#[test]
fn every_robot_in_double_precision() {
    for_each_robot!(in_double);
}

#[test]
fn every_robot_in_single_precision() {
    for_each_robot!(in_single);
}
