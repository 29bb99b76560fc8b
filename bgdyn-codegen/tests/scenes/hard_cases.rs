//! Stiff and sticking scenes against published or closed solutions.

use super::common::read;
use super::one::Tried;
use bgdyn_codegen::random::Random;

fn scene(name: &str) -> Tried {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../specs/scenes");
    Tried::new(read(&folder.join(format!("{name}.scene.yaml"))))
}

/// ẏ of positions, velocities and first-order states.
fn flow(tried: &Tried, y: &[f64], u: &[f64]) -> Vec<f64> {
    let layout = &tried.system.scene.layout;
    let (q, rest) = y.split_at(layout.nq());
    let (v, x) = rest.split_at(layout.nv());
    let rates = tried.rates(tried.at(q, v, x, u));
    v.iter().take(q.len()).copied().chain(rates).collect()
}

/// The state after `steps` steps of the classical Runge-Kutta method.
fn advance(
    f: &dyn Fn(f64, &[f64]) -> Vec<f64>,
    [from, to]: [f64; 2],
    start: &[f64],
    steps: u32,
) -> Vec<f64> {
    let h = (to - from) / f64::from(steps);
    let along = |y: &[f64], k: &[f64], h: f64| -> Vec<f64> {
        y.iter().zip(k).map(|(y, k)| y + h * k).collect()
    };
    let mut y = start.to_vec();
    for i in 0..steps {
        let t = from + h * f64::from(i);
        let k1 = f(t, &y);
        let k2 = f(t + h / 2.0, &along(&y, &k1, h / 2.0));
        let k3 = f(t + h / 2.0, &along(&y, &k2, h / 2.0));
        let k4 = f(t + h, &along(&y, &k3, h));
        for (j, y) in y.iter_mut().enumerate() {
            *y += h / 6.0 * (k1[j] + 2.0 * (k2[j] + k3[j]) + k4[j]);
        }
    }
    y
}

fn near(got: &[f64], wanted: &[f64], allowed: f64) {
    for (got, wanted) in got.iter().zip(wanted) {
        assert!(
            (got - wanted).abs() <= allowed * wanted.abs(),
            "{got:e}, not {wanted:e}"
        );
    }
}

/// m = 1, k = 2, σ₀ = 1e5, σ₁ = √1e5, σ₂ = 0.4, F_c = 1, F_s = 1.5, v_s = 0.001, pulled at 0.1 m/s:
/// the stick-slip example of Canudas de Wit, Olsson, Åström, Lischinsky 1995.
#[test]
fn lugre_stick_slip_is_that_of_the_article() {
    let tried = scene("lugre_stick_slip");
    let article = |t: f64, y: &[f64]| {
        let [x, v, z] = [y[0], y[1], y[2]];
        let curve = 1.0 + 0.5 * (-(v / 1e-3_f64).powi(2)).exp();
        let rate = v - 1e5 * v.abs() * z / curve;
        let friction = 1e5 * z + 1e5_f64.sqrt() * rate + 0.4 * v;
        [v, 2.0 * (0.1 * t - x) - friction, rate]
    };
    let ours = |t: f64, y: &[f64]| flow(&tried, y, &[0.1 * t, 0.1]);
    let mut random = Random(5);
    for _ in 0..200 {
        let speed = 10_f64.powf(4.0 * random.signed() - 2.0);
        let y = [
            random.signed(),
            random.signed() * speed,
            1.5e-5 * random.signed(),
        ];
        let (got, wanted) = (ours(3.0, &y), article(3.0, &y));
        for (got, wanted) in got.iter().zip(wanted) {
            let size = wanted.abs().max(1e5_f64.sqrt() * 2.0 * speed).max(1.0);
            assert!(
                (got - wanted).abs() < 1e-13 * size,
                "{got:e}, not {wanted:e}"
            );
        }
    }
    // States of the article's equations, computed with 34 digits.
    let sticking = [
        1.0280840272460651e-6,
        2.141836769794201e-6,
        9.936433994335097e-7,
    ];
    near(
        &advance(&ours, [0.0, 0.5], &[0.0; 3], 5_000),
        &sticking,
        1e-9,
    );
    let from = [0.07350830840556394, 0.24831675220715826, 1e-5];
    let to = [0.2316546268987767, 0.3622451625023764, 1e-5];
    near(&advance(&ours, [8.0, 8.5], &from, 25_000), &to, 1e-9);
}

/// A point mass of 1 kg on a spring of 1e8 N/m, in polar coordinates.
#[test]
fn the_stiff_pendulum_obeys_its_equations() {
    let tried = scene("stiff_spring_pendulum");
    let ours = |_: f64, y: &[f64]| flow(&tried, y, &[]);
    let mut random = Random(6);
    for _ in 0..200 {
        let [angle, r] = [3.0 * random.signed(), 1.0 + 1e-3 * random.signed()];
        let [rate, speed] = [4.0 * random.signed(), random.signed()];
        let got = ours(0.0, &[angle, r, rate, speed]);
        let turning = -(9.81 * angle.sin() + 2.0 * speed * rate) / r;
        let stretching = r * rate * rate + 9.81 * angle.cos() - 1e8 * (r - 1.0);
        assert!((got[2] - turning).abs() < 1e-12, "{got:?}");
        assert!((got[3] - stretching).abs() < 1e-7, "{got:?}");
    }
    // After 0.1 s, from an integration of the same equations with 34 digits.
    let start = [std::f64::consts::FRAC_PI_2, 1.0, 0.0, 0.0];
    let end = advance(&ours, [0.0, 0.1], &start, 10_000);
    let wanted = [1.5217502605621365, 1.0000000144284584, -0.9807640046941927];
    near(&end[..3], &wanted, 1e-9);
}

/// Masses of 1 and 2 kg, 100 N/m to the wall and 1e8 N/m between them.
#[test]
fn the_stiff_masses_obey_their_equations() {
    let tried = scene("stiff_spring_two_mass");
    let mut random = Random(8);
    for _ in 0..50 {
        let [x, stretch] = [random.signed(), 1e-5 * random.signed()];
        let got = flow(&tried, &[x, stretch, 0.3, -0.2], &[]);
        let first = -100.0 * x + 1e8 * stretch;
        let second = -1e8 * stretch / 2.0;
        assert!(
            (got[2] - first).abs() < 1e-11 * first.abs().max(100.0),
            "{got:?}"
        );
        let apart = second - first;
        assert!(
            (got[3] - apart).abs() < 1e-11 * apart.abs().max(100.0),
            "{got:?}"
        );
    }
    // Both frequencies: ω₁²ω₂² and ω₁² + ω₂² are determinant and trace of M⁻¹K.
    let column = |q: [f64; 2]| flow(&tried, &[q[0], q[1], 0.0, 0.0], &[]);
    let (a, b) = (column([1.0, 0.0]), column([0.0, 1.0]));
    let (trace, determinant) = (-a[2] - b[3], a[2] * b[3] - a[3] * b[2]);
    let [slow, fast] = [5.773501408895802_f64, 12247.451435571462];
    near(
        &[trace, determinant],
        &[slow * slow + fast * fast, (slow * fast).powi(2)],
        1e-8,
    );
}
