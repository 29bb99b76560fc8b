//! A double pendulum, whose equations are known (Lagrange), and searches for its motions.

use bgdyn_identification::excite::{
    Effort, Excitation, JointLimits, Keep, Noise, Points, Request, excite,
};
use bgdyn_identification::log::Log;
use bgdyn_identification::pseudo_inertia::{from_centre, transport};
use bgdyn_identification::{JointPart, LinkPart, LogFault, Model, Rows};
use nalgebra::{DMatrix, Matrix3, Vector3};

const G: f64 = 9.81;
/// Length of the first link, m.
const LENGTH: f64 = 0.5;

/// Two links that turn about z, gravity along −y.
pub(crate) struct Pendulums;

impl Rows for Pendulums {
    fn joints(&self) -> usize {
        2
    }

    fn bodies(&self) -> usize {
        2
    }

    fn effort_rows(&self, q: &[f64], v: &[f64], a: &[f64], rows: &mut DMatrix<f64>) {
        rows.fill(0.0);
        let (both, l) = (q[0] + q[1], LENGTH);
        rows[(0, 1)] = G * q[0].cos();
        rows[(0, 2)] = -G * q[0].sin();
        rows[(0, 9)] = a[0];
        rows[(0, 10)] = l * l * a[0] + G * l * q[0].cos();
        let fall = [G * both.cos(), -G * both.sin()];
        let (at, rate) = ([q[1].cos(), -q[1].sin()], [-q[1].sin(), -q[1].cos()]);
        for k in 0..2 {
            rows[(0, 11 + k)] = l * at[k] * (2.0 * a[0] + a[1])
                + l * rate[k] * v[1] * (2.0 * v[0] + v[1])
                + fall[k];
            rows[(1, 11 + k)] = l * at[k] * a[0] - l * rate[k] * v[0] * v[0] + fall[k];
        }
        rows[(0, 19)] = a[0] + a[1];
        rows[(1, 19)] = a[0] + a[1];
    }
}

/// The tip of the second link, 0.4 m long.
impl Points for Pendulums {
    fn point(&self, _: usize, q: &[f64]) -> [f64; 3] {
        let both = q[0] + q[1];
        [
            LENGTH * q[0].cos() + 0.4 * both.cos(),
            LENGTH * q[0].sin() + 0.4 * both.sin(),
            0.0,
        ]
    }
}

pub(crate) fn model() -> Model<'static> {
    let tensor = Matrix3::from_diagonal(&Vector3::new(0.02, 0.03, 0.04));
    let link = |body: usize| LinkPart {
        name: format!("link{body}"),
        body,
        in_body: transport(&Matrix3::identity(), &Vector3::zeros()),
        file: from_centre(1.5, &Vector3::new(0.2, 0.05, 0.0), &tensor),
        free: true,
    };
    let joint = |name: &str| JointPart {
        name: name.into(),
        linear: false,
        range: [None; 2],
        speed: None,
        effort: None,
        file: [0.1, 0.2, 0.3, 0.0],
    };
    Model {
        rows: &Pendulums,
        links: vec![link(0), link(1)],
        joints: vec![joint("shoulder"), joint("elbow")],
        columns: [true; 4],
    }
}

pub(crate) fn limits(effort: Option<f64>) -> [JointLimits; 2] {
    let own = |low: f64, high: f64| JointLimits {
        position: [low, high],
        speed: 2.0,
        acceleration: 7.0,
        effort,
    };
    [own(-1.0, 2.0), own(-2.5, 2.5)]
}

/// The tip stays above y = −0.6 m.
pub(crate) fn above() -> Keep {
    Keep {
        name: "tip.y>-0.6".into(),
        point: 0,
        axis: 1,
        side: 1.0,
        level: -0.6,
    }
}

pub(crate) fn planned(
    limits: &[JointLimits],
    keeps: &[Keep],
    effort: &Effort,
    prior: Option<&Log>,
) -> Result<Excitation, Vec<LogFault>> {
    let request = Request {
        limits,
        keeps,
        points: &Pendulums,
        harmonics: 5,
        period: 10.0,
        effort: *effort,
        noise: Noise::Relative,
        prior,
    };
    excite(&model(), &request, &mut |_| {})
}

pub(crate) const SEARCH: Effort = Effort {
    starts: 10,
    ascents: 2,
    steps: 60,
    seed: 1,
};
