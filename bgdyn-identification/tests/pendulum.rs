//! A pendulum, whose equation is known: τ = (I_yy + rotor) a − g (m x cos q + m z sin q) + friction.

use bgdyn_identification::log::Log;
use bgdyn_identification::pseudo_inertia::{from_centre, transport};
use bgdyn_identification::{Identification, JointPart, LinkPart, Model, Options, Rows, identify};
use nalgebra::{DMatrix, Matrix3, Vector3};

const G: f64 = 9.81;

struct Pendulum;

impl Rows for Pendulum {
    fn joints(&self) -> usize {
        1
    }

    fn bodies(&self) -> usize {
        1
    }

    fn effort_rows(&self, q: &[f64], _: &[f64], a: &[f64], rows: &mut DMatrix<f64>) {
        rows.fill(0.0);
        rows[(0, 1)] = -G * q[0].cos();
        rows[(0, 3)] = -G * q[0].sin();
        rows[(0, 6)] = a[0];
    }
}

fn model(columns: [bool; 4]) -> Model<'static> {
    let tensor = Matrix3::from_diagonal(&Vector3::new(0.02, 0.03, 0.02));
    let bob = LinkPart {
        name: "bob".into(),
        body: 0,
        in_body: transport(&Matrix3::identity(), &Vector3::zeros()),
        file: from_centre(1.0, &Vector3::new(0.0, 0.0, -0.4), &tensor),
        free: true,
    };
    let swing = JointPart {
        name: "swing".into(),
        linear: false,
        range: [None; 2],
        speed: None,
        effort: None,
        file: [0.0; 4],
    };
    Model {
        rows: &Pendulum,
        links: vec![bob],
        joints: vec![swing],
        columns,
    }
}

/// I_yy, m x, m z, viscous, Coulomb, offset.
const TRUTH: [f64; 6] = [0.25, 0.05, -0.6, 0.3, 0.2, 0.1];

/// Returns a log of `count` rows at 500 Hz, with noise that a seeded generator makes.
fn log(count: usize, noise: f64) -> Log {
    let mut seed = 7_u64;
    let mut random = || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        (seed >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
    };
    let mut log = Log {
        time: vec![],
        q: vec![vec![]],
        tau: vec![vec![]],
        lines: vec![],
    };
    for i in 0..count {
        let t = i as f64 / 500.0;
        let terms = [(1.2, 2.1, 0.3), (0.4, 5.3, 1.0), (0.1, 11.7, 2.0)];
        let [q, v, a] = terms.iter().fold([0.0; 3], |[q, v, a], (size, w, phase)| {
            let (sine, cosine) = (w * t + phase).sin_cos();
            [
                q + size * sine,
                v + size * w * cosine,
                a - size * w * w * sine,
            ]
        });
        let [iyy, mx, mz, viscous, coulomb, offset] = TRUTH;
        let clean = iyy * a - G * (mx * q.cos() + mz * q.sin());
        let normal: f64 = (0..12).map(|_| random()).sum();
        log.time.push(t);
        log.q[0].push(q);
        log.tau[0].push(clean + viscous * v + coulomb * v.signum() + offset + noise * normal);
        log.lines.push(i + 2);
    }
    log
}

fn found(count: usize, noise: f64, columns: [bool; 4]) -> Identification {
    let result = identify(
        &model(columns),
        &log(count, noise),
        None,
        &Options::default(),
        &mut |_, _| {},
    );
    result.expect("a sound log")
}

#[test]
fn base_parameters_are_those_of_the_equation() {
    let found = found(5000, 0.02, [true; 4]);
    let names: Vec<&str> = found.base.iter().map(|p| p.name.as_str()).collect();
    let wanted = [
        "bob.mx",
        "bob.mz",
        "bob.Iyy + swing.rotor",
        "swing.viscous",
        "swing.coulomb",
        "swing.offset",
    ];
    assert_eq!(names, wanted);
    let truth = [TRUTH[1], TRUTH[2], TRUTH[0], TRUTH[3], TRUTH[4], TRUTH[5]];
    for (p, truth) in found.base.iter().zip(truth) {
        assert!(
            (p.value - truth).abs() < 4.0 * p.deviation,
            "{p:?} for {truth}"
        );
        assert!(p.deviation < 0.02 && p.seen, "{p:?}");
    }
    assert!(found.eigenvalues[0] > 0.0);
    assert!(found.judgement.last_third);
}

#[test]
fn a_log_in_several_parts_is_as_sharp_as_without_noise() {
    // 20,000 rows: the regressor is filtered in three parts, whose borders must not show.
    let found = found(20_000, 0.0, [false, true, true, true]);
    let left = &found.judgement.left[1][0];
    assert!(left.rms < 1e-3 * left.effort, "{left:?}");
    assert!(
        (found.base[1].value - TRUTH[2]).abs() < 1e-4,
        "{:?}",
        found.base[1]
    );
}

#[test]
fn what_is_not_identified_keeps_its_number_and_shows() {
    // Without friction the velocity explains the rest.
    let found = found(10_000, 0.02, [false; 4]);
    assert!(
        found.judgement.left[1][0].by_velocity > 0.5,
        "{:?}",
        found.judgement.left[1]
    );
}
