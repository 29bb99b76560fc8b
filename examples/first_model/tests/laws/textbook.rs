use bgdyn::nalgebra::Vector2;
use camera_head::head::Head;

/// The head's equations by hand. Cradle: mass m at (c, d) from the tilt's axis, a box; lens: a point
/// of mass l at the distance e. With x = m's and l's distance from the pan's axis:
///   I(θ) = J_yoke + J_xx sin²θ + J_zz cos²θ + m x_m² + l x_l²
///   P_pan = I a₁ + I' v₁ v₂,   P_tilt = (J_yy + m (c² + d²) + l e²) a₂ − ½ I' v₁² + V'
fn by_hand(q: [f64; 2], v: [f64; 2], a: [f64; 2]) -> Vector2<f64> {
    let (m, c, d, l, e) = (1.2, 0.03, 0.01, 0.4, 0.14);
    let tensor = |a: f64, b: f64| m / 12.0 * (a * a + b * b);
    let (xx, yy, zz) = (tensor(0.1, 0.08), tensor(0.16, 0.08), tensor(0.16, 0.1));
    let (s, k) = q[1].sin_cos();
    let (x_m, x_l) = (c * k + d * s, e * k);
    let (dx_m, dx_l) = (d * k - c * s, -e * s);
    let inertia = 0.0012 + xx * s * s + zz * k * k + m * x_m * x_m + l * x_l * x_l;
    let slope = 2.0 * (xx - zz) * s * k + 2.0 * m * x_m * dx_m + 2.0 * l * x_l * dx_l;
    let gravity = -9.81 * (m * x_m + l * x_l); // V = g Σ m z, dz/dθ = −x
    Vector2::new(
        inertia * a[0] + slope * v[0] * v[1],
        (yy + m * (c * c + d * d) + l * e * e) * a[1] - 0.5 * slope * v[0] * v[0] + gravity,
    )
}

#[test]
fn equals_the_equations_by_hand() {
    let head = Head::<f64>::default();
    for (q, v, a) in [
        ([0.0, 0.0], [0.0, 0.0], [0.0, 0.0]),
        ([0.7, 0.5], [1.3, -0.9], [2.0, 3.0]),
        ([-2.0, -1.0], [-4.0, 2.5], [-7.0, 1.0]),
    ] {
        let generated = head.inverse_dynamics(&q.into(), &v.into(), &a.into());
        let error = (generated - by_hand(q, v, a)).amax();
        assert!(error < 1e-14, "{error} N·m at {q:?}");
    }
}
