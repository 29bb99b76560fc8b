//! A rattleback against its own equation of motion: the balance of angular momentum about its centre of mass, with the
//! force that its contact needs (Garcia and Hubbard 1988).

use bgdyn_codegen::method::Method;
use bgdyn_codegen::random::Random;
use bgdyn_runtime::Dd;

use super::files::spec;
use super::robot::{Robot, State, close, cross, dot, largest};

const WAYS: [Option<&str>; 2] = [None, Some("subspaces")];

/// The constants of `specs/constraints/rattleback.yaml`, and the acceleration of gravity.
const HALF_AXES: [&str; 3] = ["0.2", "0.03", "0.02"];
const CENTRE_OF_MASS: &str = "-0.01";
const INERTIA: [[&str; 3]; 3] = [
    ["2e-4", "2e-5", "0"],
    ["2e-5", "1.6e-3", "0"],
    ["0", "0", "1.7e-3"],
];
const GRAVITY: &str = "9.81";

type Vector = [Dd; 3];

fn number(text: &str) -> Dd {
    text.parse().expect("a number")
}

fn three(f: impl Fn(usize) -> Dd) -> Vector {
    std::array::from_fn(f)
}

fn sum(vectors: &[Vector]) -> Vector {
    three(|k| vectors.iter().fold(Dd::ZERO, |sum, v| sum + v[k]))
}

fn scaled(v: Vector, by: Dd) -> Vector {
    v.map(|x| x * by)
}

/// Returns the vertical in body axes of an attitude x, y, z, w.
fn vertical([x, y, z, w]: [Dd; 4]) -> Vector {
    let two = Dd::from_f64(2.0);
    [
        two * (x * z - w * y),
        two * (y * z + w * x),
        Dd::ONE - two * (x * x + y * y),
    ]
}

/// Returns the contact from the centre of the ellipsoid, and its rate in body axes.
fn contact(up: Vector, omega: Vector) -> [Vector; 2] {
    let squares = HALF_AXES.map(|a| number(a) * number(a));
    let stretched = |v: Vector| three(|k| squares[k] * v[k]);
    let up_rate = cross(&up, &omega);
    let height = dot(&up, &stretched(up)).sqrt();
    let height_rate = dot(&up, &stretched(up_rate)) / height;
    let arm = scaled(stretched(up), -(Dd::ONE / height));
    let rate = sum(&[stretched(up_rate), scaled(arm, height_rate)]);
    [arm, scaled(rate, -(Dd::ONE / height))]
}

/// Returns ω̇: I ω̇ + ω × I ω = p × m (v̇ + ω × v + g z) with v = −ω × p, p from the centre of mass.
fn angular_acceleration(up: Vector, omega: Vector) -> Vector {
    let [arm, arm_rate] = contact(up, omega);
    let p = sum(&[arm, [Dd::ZERO, Dd::ZERO, -number(CENTRE_OF_MASS)]]);
    let inertia = INERTIA.map(|row| row.map(number));
    let momentum = three(|k| dot(&inertia[k], &omega));
    let velocity = scaled(cross(&omega, &p), -Dd::ONE);
    let others = sum(&[
        scaled(cross(&omega, &arm_rate), -Dd::ONE),
        cross(&omega, &velocity),
        scaled(up, number(GRAVITY)),
    ]);
    let side = sum(&[
        cross(&p, &others),
        scaled(cross(&omega, &momentum), -Dd::ONE),
    ]);
    // p × (ω̇ × p) = (p · p) ω̇ − p (p · ω̇); the mass is 1 kg.
    let square = dot(&p, &p);
    let matrix: [Vector; 3] = std::array::from_fn(|i| {
        three(|j| {
            let diagonal = if i == j { square } else { Dd::ZERO };
            inertia[i][j] + diagonal - p[i] * p[j]
        })
    });
    let [a, b, c] = matrix;
    let minors = [cross(&b, &c), cross(&c, &a), cross(&a, &b)];
    let determinant = dot(&a, &minors[0]);
    three(|i| (0..3).fold(Dd::ZERO, |x, j| x + minors[j][i] * side[j]) / determinant)
}

#[test]
fn the_rattleback_accelerates_as_its_own_equation_says() {
    let robot = Robot::read(&spec("rattleback"));
    let mut random = Random(77);
    for k in 0..20 {
        let mut some = |size: f64| Dd::from_f64(size * random.signed());
        let attitude: [Dd; 4] = std::array::from_fn(|_| some(1.0));
        let length = dot(&attitude, &attitude).sqrt();
        let attitude = attitude.map(|x| x / length);
        let omega: Vector = std::array::from_fn(|_| some(6.0));
        let up = vertical(attitude);
        let [arm, _] = contact(up, omega);
        let height = -dot(&arm, &up);
        let state = State {
            q: [some(1.0), some(1.0), height]
                .into_iter()
                .chain(attitude)
                .collect(),
            v: omega.to_vec(),
            a: angular_acceleration(up, omega).to_vec(),
            u: vec![Dd::ZERO; 3],
        };
        for way in WAYS {
            let what = format!("state {k}, {way:?}");
            let value = |method| -> Vec<Dd> { state.value(&robot.function(way, method)) };
            let tree = value(Method::TreeVelocity);
            let rolling = scaled(cross(&omega, &arm), -Dd::ONE);
            close(&tree[..3], &rolling, 1e-26, 1.0, &what);
            let size = largest(&state.a);
            close(
                &value(Method::ForwardDynamics),
                &state.a,
                1e-22,
                size,
                &what,
            );
            let residual = value(Method::ConstraintResidual);
            assert!(largest(&residual) < 1e-28, "{what}: {residual:?}");
        }
    }
}

/// Spun counterclockwise with a small roll it turns back, clockwise it does not; no energy is lost.
#[test]
fn the_rattleback_turns_back() {
    let robot = Robot::read(&spec("rattleback"));
    let forward = robot.function(None, Method::ForwardDynamics);
    let [kinetic, potential, height] = [
        Method::KineticEnergy,
        Method::PotentialEnergy,
        Method::ConstraintResidual,
    ]
    .map(|method| robot.function(None, method));
    type Turning = ([f64; 4], [f64; 3]);
    let state = |(attitude, omega): Turning, z: f64| State {
        q: [0.0, 0.0, z].into_iter().chain(attitude).collect(),
        v: omega.to_vec(),
        a: vec![0.0; 3],
        u: vec![0.0; 3],
    };
    let rates = |x: Turning| -> Turning {
        let omega_rate: Vec<f64> = state(x, 0.0).value(&forward);
        let ([x, y, z, w], [a, b, c]) = x;
        let attitude = [
            w * a + y * c - z * b,
            w * b + z * a - x * c,
            w * c + x * b - y * a,
            -(x * a + y * b + z * c),
        ];
        (
            attitude.map(|rate| 0.5 * rate),
            [omega_rate[0], omega_rate[1], omega_rate[2]],
        )
    };
    let moved = |x: Turning, rate: &Turning, h: f64| -> Turning {
        (
            std::array::from_fn(|k| x.0[k] + h * rate.0[k]),
            std::array::from_fn(|k| x.1[k] + h * rate.1[k]),
        )
    };
    // The height of the centre is that of contact: its residual at zero height is minus that.
    let energy = |x: Turning| -> f64 {
        let rows: Vec<f64> = state(x, 0.0).value(&height);
        let z = -rows.iter().fold(0.0, |least: f64, y| least.min(*y));
        let of = |f| -> f64 { state(x, z).value(f)[0] };
        of(&kinetic) + of(&potential)
    };
    let run = |spin: f64| -> (Turning, f64) {
        let (sin, cos) = (0.5f64.to_radians() / 2.0).sin_cos();
        let mut x: Turning = ([sin, 0.0, 0.0, cos], [0.0, 0.0, spin]);
        let start = energy(x);
        let h = 2.5e-4;
        for _ in 0..RUN {
            let a = rates(x);
            let b = rates(moved(x, &a, h / 2.0));
            let c = rates(moved(x, &b, h / 2.0));
            let d = rates(moved(x, &c, h));
            for (rate, weight) in [(a, 1.0), (b, 2.0), (c, 2.0), (d, 1.0)] {
                x = moved(x, &rate, weight * h / 6.0);
            }
            let length = x.0.iter().map(|y| y * y).sum::<f64>().sqrt();
            x.0 = x.0.map(|y| y / length);
        }
        (x, (energy(x) - start).abs())
    };
    for (spin, turns_back) in [(-5.0, false), (5.0, true)] {
        let ((_, omega), lost) = run(spin);
        let back = omega[2] * spin < 0.0;
        assert_eq!(back, turns_back, "{spin} rad/s: {omega:?}");
        assert!(lost < 1e-7, "{spin} rad/s: {lost:e} J");
    }
}

/// Steps of a run.
const RUN: usize = 20_000;
