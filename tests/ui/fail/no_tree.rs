//! Where the number of joints is not sure, the methods take what they are given.

use bgdyn::nalgebra::{SMatrix, SVector, Vector2};
use bgdyn::{Dynamics, Singular};

bgdyn::bgdyn!("no_tree.yaml");

fn hold<M: Dynamics<f64, N, N>, const N: usize>(model: &M, q: &SVector<f64, N>) -> SVector<f64, N> {
    model.gravity(q)
}

fn labels<M, const N: usize>(_: &M, _: &SVector<f64, N>) -> [&'static str; N]
where
    M: bgdyn::Description<N> + bgdyn::Coriolis<f64, N, N> + bgdyn::Derivatives<f64, N, N>,
{
    M::JOINT_LABELS
}

fn main() -> Result<(), Singular> {
    let arm = no_tree::NoTree::default();
    let (q, v) = (Vector2::new(0.3, -0.4), SVector::<f64, 2>::zeros());
    let tau = arm.inverse_dynamics(&q, &v, &SVector::zeros());
    let mass: SMatrix<f64, 2, 2> = arm.mass_matrix(&q);
    let a = arm.forward_dynamics(&q, &v, &tau)?;
    let energy = arm.kinetic_energy(&q, &a) + arm.potential_energy(&q) + tau[0] * 2.0;
    println!("{energy} {:?} {}", hold(&arm, &q) - mass * arm.bias(&q, &v), no_tree::NV);
    println!("{:?} {:?}", no_tree::JOINT_NAMES, no_tree::LINK_NAMES.len());
    println!("{:?} {:?}", labels(&arm, &q), no_tree::JOINT_LABELS);
    Ok(())
}
