//! Turns the simulated head under computed torque, with a lens that the model knows or does not.

use bgdyn::nalgebra::Vector2;
use bgdyn_sim::{State, rk4_step};
use camera_head::head::Head;

/// Turns `plant` for a second with efforts computed by `model`; returns the error of the tilt, in
/// degrees.
fn turn(model: &Head, plant: &Head) -> Result<f64, bgdyn::Singular> {
    let target = Vector2::new(60_f64.to_radians(), 20_f64.to_radians());
    let mut state = State {
        q: Vector2::zeros(),
        v: Vector2::zeros(),
    };
    for step in 0..1000 {
        let wanted = 100.0 * (target - state.q) - 20.0 * state.v; // rad/s²
        let tau = model.inverse_dynamics(&state.q, &state.v, &wanted);
        let t = f64::from(step) * 1e-3;
        state = rk4_step(plant, t, &state, 1e-3, |_, _| tau)?;
    }
    Ok((state.q[1] - target[1]).to_degrees())
}

fn main() -> Result<(), bgdyn::Singular> {
    let light = Head::default(); // lens_mass: 0.4
    let heavy = Head { lens_mass: 0.9 };
    println!(
        "0.4 kg, as the model has it: {:+.3}°",
        turn(&light, &light)?
    );
    println!(
        "0.9 kg, and the model says 0.4: {:+.3}°",
        turn(&light, &heavy)?
    );
    println!(
        "0.9 kg, set in the model too: {:+.3}°",
        turn(&heavy, &heavy)?
    );
    Ok(())
}
