//! What holds the head, and what moves it.

use bgdyn::nalgebra::Vector2;
use camera_head::head::{Head, JOINT_NAMES};

fn main() {
    let head = Head::<f64>::default();
    let q = Vector2::new(0.0, 30_f64.to_radians()); // pan, tilt: rad
    let v = Vector2::new(1.0, 0.5); // rad/s
    let a = Vector2::new(0.0, 2.0); // rad/s²

    let held = head.gravity(&q);
    let moved = head.inverse_dynamics(&q, &v, &a);
    for (j, name) in JOINT_NAMES.iter().enumerate() {
        println!(
            "{name:>4}: {:+.4} N·m holds it, {:+.4} N·m moves it",
            held[j], moved[j]
        );
    }
    println!("eye at {:+.4?} m", head.pose_eye(&q).translation.as_slice());
}
