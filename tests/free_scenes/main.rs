//! Scenes whose mechanisms have joints with several degrees of freedom, compiled: reference motions, orders
//! of integrators, lengths of quaternions, symmetries, balances of energy and momentum, Jacobians, poses held.

mod balances;
mod hold_runs;
mod holds;
mod jacobians;
mod lanes;
mod lengths;
mod references;
mod rotations;
mod symmetries;

bgdyn::bgdyn!("buoy_run.scene.yaml", jacobian = true);
bgdyn::bgdyn!("cart_run.scene.yaml", jacobian = true);
bgdyn::bgdyn!("disc_run.scene.yaml");
bgdyn::bgdyn!("heavy_top_run.scene.yaml", jacobian = true);
bgdyn::bgdyn!("heavy_top_hold.scene.yaml");
bgdyn::bgdyn!("loose_ball_hold.scene.yaml", jacobian = true);
bgdyn::bgdyn!("platform_hold.scene.yaml", jacobian = true);
bgdyn::bgdyn!("probe_guided.scene.yaml", jacobian = true);
bgdyn::bgdyn!("probe_hold.scene.yaml", jacobian = true);
bgdyn::bgdyn!("probe_swing.scene.yaml");
bgdyn::bgdyn!("satellite_torques.scene.yaml");
bgdyn::bgdyn!("../free_joints/satellite_arm6.yaml");

/// Returns the rotation matrix of a quaternion x, y, z, w, row by row.
fn rotation(q: [f64; 4]) -> [f64; 9] {
    let r = bgdyn::runtime::manifold::rotation(q);
    std::array::from_fn(|i| r[(i / 3, i % 3)])
}

/// Returns the quaternion at an index of a state.
fn quaternion(y: &[f64], at: usize) -> [f64; 4] {
    std::array::from_fn(|i| y[at + i])
}

/// Returns |q|² − 1 of the quaternion at an index of a state.
fn excess(y: &[f64], at: usize) -> f64 {
    let [x, y, z, w] = quaternion(y, at);
    x * x + y * y + z * z + (w - 1.0) * (w + 1.0)
}
