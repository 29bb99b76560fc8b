//! One error on the path, which holds every fault of the scene; none at the calls.

use bgdyn::runtime::{Canonical, FixedVector, Slope, StateVector};

bgdyn::bgdyn!("broken.scene.yaml");

fn slope<S: Slope<f64> + Canonical<f64>>(scene: &S) -> f64 {
    let (y, modes) = scene.start();
    let found = scene.slope(&y, &modes, &S::Inputs::zero_vector(), 0.0);
    found.map_or(0.0, |(slope, _)| S::State::columns(&slope).iter().sum())
}

fn main() -> Result<(), bgdyn::Singular> {
    let scene = broken::Broken::<f64> { damping: 0.3 };
    let state = broken::State { elbow: 0.2, brake_mode: 1.0, ..broken::State::default() };
    let given = broken::Input { shoulder: 2.0, ..broken::Input::default() };
    let input = scene.input(&state, &given, 0.0);
    let rates = scene.derivative(&state, &input, 0.0)?;
    let power = scene.power(&state, &input, 0.0)?;
    let contacts = scene.contacts(&state, &input, 0.0)?;
    let output = scene.output(&state, &input, 0.0);
    println!("{} {}", rates.shoulder_rate - rates.elbow, power.brake.dissipated);
    println!("{} {}", contacts.brake_mode.slip, output.elbow + output.forearm_x);
    println!("{:?} {}", broken::STATE_NAMES, slope(&scene));
    let (matrix, _) = scene.jacobian(&state, &given, 0.0)?;
    println!("{} {:?}", matrix[(0, broken::NQ)], state.vector());
    Ok(())
}
