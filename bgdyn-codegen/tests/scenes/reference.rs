//! Compares right-hand sides of textbook systems with those of their scenes.

use bgdyn_codegen::random::Random;
use std::path::Path;

use bgdyn_codegen::method::SceneFunction;
use bgdyn_runtime::Dd;

use super::common::{read, state};

fn file(name: &str) -> std::path::PathBuf {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../specs/scenes");
    folder.join(format!("{name}.scene.yaml"))
}

fn number(text: &str) -> Dd {
    text.parse().expect("a number")
}

/// The rates of a scene in random states against these, written with its q, v, x, u.
fn equals(name: &str, rates: impl Fn(&[Dd], &[Dd], &[Dd], &[Dd], &[Dd]) -> Vec<Dd>) {
    let system = read(&file(name));
    let derivative = system.function(SceneFunction::Derivative);
    for seed in 0..40 {
        let at = state(&system, &mut Random(seed), true);
        let wanted = rates(&at.q, &at.v, &at.x, &at.u, &at.modes);
        let (found, refused) = derivative.evaluate(at);
        assert!(refused.is_none(), "{name}");
        for (i, (found, wanted)) in found.iter().zip(&wanted).enumerate() {
            let size = wanted.to_f64().abs().max(1.0);
            let off = (*found - *wanted).to_f64().abs() / size;
            assert!(off < 1e-22, "{name}, rate {i}: {found:?}, not {wanted:?}");
        }
        assert_eq!(found.len(), wanted.len(), "{name}");
    }
}

/// J ω̇ = k i − b ω, L i̇ = u − R i − k ω.
#[test]
fn a_motor_alone() {
    let [r, l, k, j, b] = ["1", "1e-5", "0.05", "0.0025", "1e-4"].map(number);
    // The inputs of a scene are random too, for any source of the inputs in the scene.
    equals("motor_linear_stiff", |_, v, _, u, _| {
        let (speed, current) = (v[0], v[1]);
        vec![
            (k * current - b * speed) / j,
            (u[0] - r * current - k * speed) / l,
        ]
    });
}

/// m ẍ = −k x − s F_k while it slips with the sign s.
#[test]
fn a_block_that_slips() {
    let [k, friction] = ["100", "3"].map(number);
    equals("stick_slip", |q, _, _, _, modes| {
        vec![-(k * q[0]) - modes[0] * friction]
    });
}

/// Cart and pole, Barto, Sutton, Anderson 1983 with the rod's own moment of inertia, angles from
/// upright: (M + m) ẍ + m l (θ̈ cos θ − θ̇² sin θ) = F − b ẋ,
/// (J + m l²) θ̈ + m l ẍ cos θ − m g l sin θ = −c θ̇.
#[test]
fn a_cart_with_a_pole() {
    let [cart, m, l, j, g, b, c] =
        ["1", "0.1", "0.5", "0.00833", "9.81", "0.1", "0.002"].map(number);
    equals("cart_and_pole", |q, v, _, u, _| {
        let (sin, cos) = q[1].sin_cos();
        let (a11, a12, a22) = (cart + m, m * l * cos, j + m * l * l);
        let f1 = u[0] - b * v[0] + m * l * v[1] * v[1] * sin;
        let f2 = m * g * l * sin - c * v[1];
        let det = a11 * a22 - a12 * a12;
        vec![(f1 * a22 - a12 * f2) / det, (a11 * f2 - a12 * f1) / det]
    });
}
