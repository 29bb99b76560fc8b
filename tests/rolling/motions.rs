//! Motions against reference solutions, at every sample.

use std::path::PathBuf;

use bgdyn::Dynamics;
use bgdyn::nalgebra::{SVector, vector};
use bgdyn_sim::rk4_step;
use serde_json::Value;

use crate::chaplygin_sleigh::ChaplyginSleigh;
use crate::robot::Robot;
use crate::snakeboard::Snakeboard;

/// The samples of a reference, with their columns.
pub(crate) struct Reference {
    columns: Vec<String>,
    pub(crate) samples: Vec<Vec<f64>>,
    /// Errors of `f64` by sample, where the file has them.
    pub(crate) tolerances: Vec<f64>,
}

impl Reference {
    pub(crate) fn read(name: &str) -> Self {
        let folder = "tests/golden/velocity_constraints";
        let path: PathBuf = [env!("CARGO_MANIFEST_DIR"), folder, name].iter().collect();
        let text = std::fs::read_to_string(path).expect("a reference");
        let file: Value = serde_json::from_str(&text).expect("JSON");
        let list = |value: &Value| value.as_array().expect("a list").clone();
        let name = |x: &Value| x.as_str().expect("a name").to_owned();
        let number = |x: &Value| x.as_f64().expect("a number");
        Reference {
            columns: list(&file["columns"]).iter().map(name).collect(),
            samples: (list(&file["samples"]).iter())
                .map(|row| list(row).iter().map(number).collect())
                .collect(),
            tolerances: (file["tolerance_f64_per_sample"].as_array().into_iter())
                .flatten()
                .map(number)
                .collect(),
        }
    }

    pub(crate) fn at(&self, sample: usize, column: &str) -> f64 {
        let k = self.columns.iter().position(|c| c == column);
        self.samples[sample][k.expect("a column")]
    }
}

/// Positions and velocities.
pub type State<const NQ: usize, const NV: usize> = (SVector<f64, NQ>, SVector<f64, NV>);

/// One step of `rk4_step`.
pub fn step<M: Dynamics<f64, NQ, NV>, const NQ: usize, const NV: usize>(
    model: &M,
    (q, v): State<NQ, NV>,
    (t, h): (f64, f64),
    tau: impl Fn(f64, &State<NQ, NV>) -> SVector<f64, NV>,
) -> State<NQ, NV> {
    let efforts = |t, s: &bgdyn_sim::State<f64, NQ, NV>| tau(t, &(s.q, s.v));
    match rk4_step(model, t, &bgdyn_sim::State { q, v }, h, efforts) {
        Ok(moved) => (moved.q, moved.v),
        Err(_) => panic!("no acceleration at {t} s"),
    }
}

/// Returns the largest error of positions and velocities at all samples, and asserts fourth order: twice the steps
/// have a sixteenth of the error.
pub fn errors<M: Dynamics<f64, NQ, NV>, const NQ: usize, const NV: usize>(
    model: &M,
    reference: &Reference,
    state: impl Fn(usize) -> State<NQ, NV>,
    tau: impl Fn(f64, &State<NQ, NV>) -> SVector<f64, NV>,
    steps: usize,
) -> f64 {
    let error = |steps: usize| {
        let (mut now, mut worst) = (state(0), 0.0_f64);
        for k in 1..reference.samples.len() {
            let (from, to) = (reference.at(k - 1, "t"), reference.at(k, "t"));
            let h = (to - from) / steps as f64;
            for i in 0..steps {
                now = step(model, now, (from + i as f64 * h, h), &tau);
            }
            let expected = state(k);
            worst = worst
                .max((now.0 - expected.0).amax())
                .max((now.1 - expected.1).amax());
        }
        worst
    };
    let [coarse, fine] = [error(steps), error(2 * steps)];
    let order = (coarse / fine).log2();
    assert!(
        (3.8..4.3).contains(&order),
        "{coarse:e}, {fine:e}: order {order}"
    );
    error(8 * steps)
}

/// The sleigh turns over, from backward to forward motion.
#[test]
fn the_sleigh_follows_its_reference() {
    let (model, file) = (
        ChaplyginSleigh::<f64>::default(),
        Reference::read("chaplygin_sleigh.json"),
    );
    let state = |k: usize| {
        let at = |column| file.at(k, column);
        (
            vector![at("x"), at("y"), at("theta")],
            vector![at("v"), at("omega")],
        )
    };
    let error = errors(&model, &file, state, |_, _| vector![0.0, 0.0], 20);
    assert!(error < 2e-10, "{error:e}");
}

/// The angles of the wheels are not in the reference: they are 10 (path ± 0.25 angle of the cart).
#[test]
fn the_robot_follows_its_reference() {
    let (model, file) = (
        Robot::<f64>::default(),
        Reference::read("differential_drive.json"),
    );
    let speeds = |k: usize| vector![file.at(k, "wR"), file.at(k, "wL")];
    let tau = |_: f64, (_, v): &State<5, 2>| vector![0.3 - 0.02 * v[0], 0.2 - 0.02 * v[1]];
    let start = SVector::from_element(0.0);
    let (mut now, mut worst) = ((start, speeds(0)), 0.0_f64);
    let (steps, last) = (200, file.samples.len());
    for k in 1..last {
        let (from, to) = (file.at(k - 1, "t"), file.at(k, "t"));
        let h = (to - from) / f64::from(steps);
        for i in 0..steps {
            now = step(&model, now, (from + f64::from(i) * h, h), tau);
        }
        for (j, column) in ["x", "y", "theta"].into_iter().enumerate() {
            worst = worst.max((now.0[j] - file.at(k, column)).abs());
        }
        worst = worst.max((now.1 - speeds(k)).amax());
        let turned = now.0[3] - now.0[4] - 5.0 * now.0[2];
        worst = worst.max(turned.abs());
    }
    assert!(worst < 1e-11, "{worst:e}");
}

/// The rotor and the steering drive the board ahead.
#[test]
fn the_snakeboard_follows_its_reference() {
    let (model, file) = (
        Snakeboard::<f64>::default(),
        Reference::read("snakeboard.json"),
    );
    let state = |k: usize| {
        let at = |column| file.at(k, column);
        let (sin, cos) = at("board").sin_cos();
        let ahead = cos * at("x_rate") + sin * at("y_rate");
        let q = ["x", "y", "board", "rotor", "front_axle"].map(at);
        (
            SVector::from(q),
            vector![ahead, at("rotor_rate"), at("front_axle_rate")],
        )
    };
    let tau = |t: f64, (q, _): &State<5, 3>| {
        let steering = 0.05 * (2.0 * t + 1.0).sin() - 0.3 * (q[4] - 0.2);
        vector![0.0, 0.4 * (2.0 * t).sin(), steering]
    };
    let error = errors(&model, &file, state, tau, 10);
    assert!(error < 6e-9, "{error:e}");
}

/// `integrate` follows the constraints at constant velocities: the sleigh's blade on an arc of a circle.
#[test]
fn constant_velocities_lead_along_a_circle() {
    let model = ChaplyginSleigh::<f64>::default();
    let q = model.integrate(&vector![0.0, 0.0, 0.0], &vector![3.0, 1.5]);
    let (sin, cos) = 1.5_f64.sin_cos();
    let expected = vector![2.0 * sin, 2.0 * (1.0 - cos), 1.5];
    assert!((q - expected).amax() < 1e-15, "{q}");
}
