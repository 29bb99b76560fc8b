//! Motions that show the parameters of a double pendulum, whose equations are known (Lagrange).

use bgdyn_identification::base::base;
use bgdyn_identification::excite::ascent::Slope;
use bgdyn_identification::excite::information::Information;
use bgdyn_identification::excite::objective::{Bounds, Objective};
use bgdyn_identification::excite::series::SAMPLES;
use bgdyn_identification::excite::shape::Shape;
use bgdyn_identification::excite::{
    Effort, Excitation, JointLimits, Keep, Noise, PeriodicMotion, Points, Request, efforts_of_file,
    excite,
};
use bgdyn_identification::log::Log;
use bgdyn_identification::pseudo_inertia::{from_centre, transport};
use bgdyn_identification::{JointPart, LinkPart, LogFault, Model, Rows};
use bgdyn_runtime::random::Random;
use nalgebra::{DMatrix, DVector, Matrix3, Vector3};

const G: f64 = 9.81;
/// Length of the first link, m.
const LENGTH: f64 = 0.5;

/// Two links that turn about z, gravity along −y.
struct Pendulums;

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

fn model() -> Model<'static> {
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

fn limits(effort: Option<f64>) -> [JointLimits; 2] {
    let own = |low: f64, high: f64| JointLimits {
        position: [low, high],
        speed: 2.0,
        acceleration: 7.0,
        effort,
    };
    [own(-1.0, 2.0), own(-2.5, 2.5)]
}

/// The tip stays above y = −0.6 m.
fn above() -> Keep {
    Keep {
        name: "tip.y>-0.6".into(),
        point: 0,
        axis: 1,
        side: 1.0,
        level: -0.6,
    }
}

fn planned(
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

const SEARCH: Effort = Effort {
    starts: 10,
    ascents: 2,
    steps: 60,
    seed: 1,
};

/// Returns many times of a period: ten for each one at which the search looks.
fn dense(motion: &PeriodicMotion) -> Vec<f64> {
    let count = 10 * SAMPLES * motion.joints[0].sine.len();
    let time = |i: usize| i as f64 / count as f64 * motion.period();
    (0..count).map(time).collect()
}

#[test]
fn motions_begin_at_rest_and_return() {
    let mut random = Random(3);
    for harmonics in [2, 3, 7] {
        let shape = Shape::new(harmonics, 0.8, &limits(None));
        let x = DVector::from_fn(shape.len(), |_, _| random.signed());
        let motion = shape.motion(&x);
        let (start, end) = (motion.at(0.0), motion.at(motion.period()));
        for j in 0..2 {
            assert!(
                start.v[j].abs() < 1e-14 && start.a[j].abs() < 1e-13,
                "{start:?}"
            );
            assert!((start.q[j] - end.q[j]).abs() < 1e-12);
            let series = &motion.joints[j];
            let sum: f64 = series.sine.iter().sum();
            let turned = series.cosine.iter().enumerate();
            let turned: f64 = turned.map(|(k, b)| (k + 1) as f64 * b).sum();
            assert!(sum.abs() < 1e-13 && turned.abs() < 1e-13);
        }
        assert!((shape.numbers(&motion) - x).amax() < 1e-13);
        // Velocities and accelerations are the rates.
        for t in [0.3, 2.1, 5.9] {
            let (h, at) = (1e-4, |t: f64| motion.at(t));
            for j in 0..2 {
                let v = (at(t + h).q[j] - at(t - h).q[j]) / (2.0 * h);
                let a = (at(t + h).v[j] - at(t - h).v[j]) / (2.0 * h);
                assert!((v - at(t).v[j]).abs() < 1e-6 && (a - at(t).a[j]).abs() < 1e-5);
            }
        }
    }
}

#[test]
fn extremes_bound_the_series_between_samples_closely() {
    let mut random = Random(5);
    for harmonics in [2, 5, 12] {
        let shape = Shape::new(harmonics, 0.6, &limits(None));
        let x = DVector::from_fn(shape.len(), |_, _| random.signed());
        let motion = shape.motion(&x);
        let found = motion.joints[1].extremes(0.6);
        let mut seen = [[f64::INFINITY, f64::NEG_INFINITY]; 3];
        for t in dense(&motion) {
            for (own, x) in seen.iter_mut().zip(motion.joints[1].at(0.6, t)) {
                *own = [own[0].min(x), own[1].max(x)];
            }
        }
        for (bound, seen) in found.iter().zip(seen) {
            let size = 0.01 * (seen[1] - seen[0]);
            assert!(
                bound[0] <= seen[0] && seen[0] < bound[0] + size,
                "{bound:?} {seen:?}"
            );
            assert!(
                bound[1] >= seen[1] && seen[1] > bound[1] - size,
                "{bound:?} {seen:?}"
            );
        }
    }
}

#[test]
fn a_motion_keeps_to_all_limits_and_shows_more_than_random_ones() {
    let limits = limits(Some(16.0));
    let found = planned(&limits, &[above()], &SEARCH, None).expect("a motion");
    let (mut most, mut nearest) = ([0.0_f64; 4], f64::INFINITY);
    for t in dense(&found.motion) {
        let state = found.motion.at(t);
        let efforts = efforts_of_file(&model(), &state);
        for (j, l) in limits.iter().enumerate() {
            let parts = [
                (state.q[j] - l.middle()) / l.half(),
                state.v[j] / l.speed,
                state.a[j] / l.acceleration,
                efforts[j] / 16.0,
            ];
            for (most, part) in most.iter_mut().zip(parts) {
                *most = most.max(part.abs());
            }
        }
        nearest = nearest.min(above().distance(&Pendulums, &state.q));
    }
    // Efforts jump with friction: between samples they are not bounded exactly.
    assert!(
        most[..3].iter().all(|x| *x <= 1.0) && most[3] < 1.002,
        "{most:?}"
    );
    assert!(
        nearest > 0.0 && found.distances[0] <= nearest + 1e-9,
        "{nearest}"
    );
    assert!(most.iter().any(|x| *x > 0.97), "{most:?}");
    // What is reported is what is used.
    for (i, most) in most.iter().enumerate() {
        let share = found.shares.iter().map(|s| s[i]).fold(0.0, f64::max);
        assert!((share - most).abs() < 0.01, "{i}: {share} {most}");
    }
    let [first, best, motion] = found.log_det.map(|x| x.expect("all are shown"));
    assert!(first <= best && best + 1.0 < motion, "{:?}", found.log_det);
    for values in &found.ascents {
        assert!(values.windows(2).all(|w| w[1] > w[0]), "{values:?}");
    }
    assert!(
        found.condition[2][0] < found.condition[0][0],
        "{:?}",
        found.condition
    );
}

#[test]
fn slopes_are_those_of_differences() {
    let model = model();
    let limits = limits(Some(30.0));
    let keeps = [above()];
    let bounds = Bounds {
        names: vec!["shoulder".into(), "elbow".into()],
        joints: &limits,
        keeps: &keeps,
        points: &Pendulums,
    };
    let shape = Shape::new(3, 0.8, &limits);
    let information = Information::new(&model, &base(&model), &[0.5, 0.2], vec![0.1; 2]);
    let mut objective = Objective::new(&information, &shape, &bounds, 3, 0.8);
    objective.barrier = 0.7;
    let mut random = Random(9);
    let x = DVector::from_fn(shape.len(), |i, _| {
        0.2 * random.signed() + if i == 0 { 0.3 } else { 0.0 }
    });
    let slope = objective.slope(&x).expect("inside");
    for i in 0..x.len() {
        let at = |step: f64| {
            let mut x = x.clone();
            x[i] += step;
            objective.value(&x).expect("inside")
        };
        let h = 1e-5;
        let difference = (at(h) - at(-h)) / (2.0 * h);
        assert!(
            (slope[i] - difference).abs() < 1e-5 * slope.amax(),
            "{i}: {} for {difference}",
            slope[i]
        );
    }
}

#[test]
fn a_seed_decides_the_motion() {
    let plan = |seed: u64| {
        let effort = Effort {
            seed,
            steps: 9,
            ..SEARCH
        };
        planned(&limits(None), &[], &effort, None)
            .expect("a motion")
            .motion
    };
    assert_eq!(plan(4), plan(4));
    assert_ne!(plan(4), plan(5));
}

#[test]
fn an_earlier_log_counts() {
    let rest = Effort {
        starts: 1,
        steps: 0,
        ..SEARCH
    };
    let other = planned(&limits(None), &[], &SEARCH, None)
        .expect("a motion")
        .motion;
    let times: Vec<f64> = (0..5000).map(|i| f64::from(i) / 250.0).collect();
    let column = |of: &dyn Fn(f64) -> Vec<f64>| -> Vec<Vec<f64>> {
        (0..2)
            .map(|j| times.iter().map(|t| of(*t)[j]).collect())
            .collect()
    };
    let log = Log {
        q: column(&|t| other.at(t).q),
        tau: column(&|t| efforts_of_file(&model(), &other.at(t))),
        lines: (2..5002).collect(),
        time: times.clone(),
    };
    let alone = planned(&limits(None), &[], &rest, None).expect("a motion");
    let after = planned(&limits(None), &[], &rest, Some(&log)).expect("a motion");
    assert_eq!(alone.motion, after.motion);
    assert!(after.log_det[2] > alone.log_det[2]);
    assert!(after.condition[2][0] < alone.condition[2][0]);
}

#[test]
fn what_cannot_be_kept_is_a_fault_with_its_numbers() {
    let faults = |limits: &[JointLimits], keeps: &[Keep]| {
        let faults = planned(limits, keeps, &SEARCH, None).expect_err("no motion");
        let texts: Vec<String> = faults.iter().map(ToString::to_string).collect();
        texts.join("\n")
    };
    let high = Keep {
        name: "tip.y>2".into(),
        level: 2.0,
        ..above()
    };
    let told = faults(&limits(None), &[high]);
    assert!(
        told.contains("[keep-not-met]") && told.contains("`--keep tip.y>2`"),
        "{told}"
    );
    assert!(
        told.contains("at least 1.") && told.contains("help: "),
        "{told}"
    );
    let bare = Model {
        links: vec![],
        columns: [false; 4],
        ..model()
    };
    let request = Request {
        limits: &limits(None),
        keeps: &[],
        points: &Pendulums,
        harmonics: 2,
        period: 1.0,
        effort: SEARCH,
        noise: Noise::Equal,
        prior: None,
    };
    let told = excite(&bare, &request, &mut |_| {}).expect_err("nothing to show");
    assert_eq!(told[0].rule, "nothing-excited");
    let narrow = limits(Some(0.5)).map(|l| JointLimits {
        position: [-0.1, 0.1],
        ..l
    });
    let told = faults(&narrow, &[]);
    assert!(
        told.contains("[effort-limit]") && told.contains("joint `shoulder`"),
        "{told}"
    );
}
