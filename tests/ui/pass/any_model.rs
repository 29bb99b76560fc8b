//! A controller that takes any generated model.

use bgdyn::nalgebra::SVector;
use bgdyn::{Dynamics, Singular};

bgdyn::bgdyn!("arm.yaml");
bgdyn::bgdyn!("robots/lift.yaml");

fn falling<M: Dynamics<f64, N, N>, const N: usize>(
    model: &M,
) -> Result<SVector<f64, N>, Singular> {
    let rest = SVector::zeros();
    model.forward_dynamics(&rest, &rest, &rest)
}

fn main() -> Result<(), Singular> {
    let models = (arm::Arm::default(), lift::Lift::default());
    assert_eq!(models.0.joint_names().len(), 2);
    assert!((falling(&models.1)?[0] + 9.81).abs() < 1e-12);
    assert!(falling(&models.0)?[0] > 0.0);
    Ok(())
}
