//! Methods that were not asked for: the message says what to write.

use bgdyn::nalgebra::Vector2;
use bgdyn::runtime::{Canonical, Coriolis, Derivatives, Dynamics, Frame, HybridSystem, Kinematics, Slope};

bgdyn::bgdyn!("good_arm.yaml", methods = [gravity, pose_forearm]);
bgdyn::bgdyn!("good.scene.yaml");

#[derive(Clone, Copy)]
struct Tip;
impl Frame for Tip {
    const NAME: &'static str = "tip";
}

fn compute<const NQ: usize, const NV: usize>(_: &impl Dynamics<f64, NQ, NV>) {}
fn slow<const NQ: usize, const NV: usize>(_: &impl Coriolis<f64, NQ, NV>) {}
fn optimise<const NQ: usize, const NV: usize>(_: &impl Derivatives<f64, NQ, NV>) {}
fn reach<const NQ: usize, const NV: usize>(_: &impl Kinematics<Tip, f64, NQ, NV>) {}
fn simulate(_: &impl HybridSystem<f64>) {}
fn implicit(_: &impl Slope<f64>) {}
fn symplectic(_: &impl Canonical<f64>) {}

fn main() {
    let arm = good_arm::GoodArm::<f64>::default();
    compute::<2, 2>(&arm);
    slow::<2, 2>(&arm);
    optimise::<2, 2>(&arm);
    reach::<2, 2>(&arm);
    let scene = good::Good::<f64>::default();
    implicit(&scene);
    symplectic(&scene);
    // A mechanism is no scene.
    simulate(&arm);
    let q = Vector2::new(0.3, -0.4);
    // A method of the struct itself.
    println!("{}", arm.coriolis_matrix(&q, &q));
}
