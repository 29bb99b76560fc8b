//! One error on the path, which holds every fault; none at the calls.

use bgdyn::nalgebra::{SMatrix, SVector, Vector2};
use bgdyn::{Dynamics, Singular};

bgdyn::bgdyn!("broken_arm.yaml");

fn falling<M: Dynamics<f64, N, N>, const N: usize>(model: &M) -> SVector<f64, N> {
    model.gravity(&SVector::zeros())
}

fn place<F, M, const N: usize>(model: &M, q: &SVector<f64, N>) -> &'static str
where
    F: bgdyn::Frame,
    M: bgdyn::Description<N> + bgdyn::Kinematics<F, f64, N, N> + bgdyn::Derivatives<f64, N, N>,
{
    model.pose(q);
    M::JOINT_LABELS[0]
}

fn main() -> Result<(), Singular> {
    let arm = broken_arm::BrokenArm::default();
    let (q, v) = (Vector2::new(0.3, -0.4), SVector::<f64, { broken_arm::NV }>::zeros());
    let tau = arm.inverse_dynamics(&q, &v, &SVector::zeros());
    let mass: SMatrix<f64, 2, 2> = arm.mass_matrix(&q);
    let a = arm.forward_dynamics(&q, &v, &tau)?;
    let energy = arm.kinetic_energy(&q, &a) + arm.potential_energy(&q) + tau[0] * 2.0;
    println!("{energy} {:?} {}", falling(&arm) - mass * arm.bias(&q, &v), broken_arm::JOINT_NAMES[1]);
    println!("{:?} {}", broken_arm::OPERATIONS[6], broken_arm::LINK_NAMES[1]);
    let single = broken_arm::BrokenArm::<f32>::default();
    println!("{:?} {single:?}", single.gravity(&SVector::zeros()).norm());
    println!("{:?}", arm.joint_names());
    let hanging = broken_arm::BrokenArm { drop: -0.1, ..arm };
    println!("{}", hanging.drop);
    let base = arm.base_parameters(&arm.parameters());
    println!("{}", (arm.base_regressor(&q, &v, &tau) * base).norm() + arm.kinetic_energy_regressor(&q, &v)[9]);
    println!("{}", place::<broken_arm::frames::Forearm, _, 2>(&arm, &q));
    Ok(())
}
