//! Motions that show the parameters of a double pendulum.

use bgdyn_identification::base::base;
use bgdyn_identification::excite::ascent::Slope;
use bgdyn_identification::excite::information::Information;
use bgdyn_identification::excite::objective::{Bounds, Objective};
use bgdyn_identification::excite::series::SAMPLES;
use bgdyn_identification::excite::shape::Shape;
use bgdyn_identification::excite::{
    Effort, Excitation, Noise, PeriodicMotion, Request, efforts_of_file, excite,
};
use bgdyn_identification::log::Log;
use bgdyn_identification::model::{COULOMB, SIGN_WIDTH};
use bgdyn_runtime::random::Random;
use nalgebra::DVector;

use pendulums::{Pendulums, SEARCH, above, limits, model, planned};

mod faults;
mod pendulums;

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
            // Coulomb friction counts in full at any speed.
            let coulomb = model().joints[j].file[COULOMB];
            let smooth = efforts[j] - coulomb * (state.v[j] / SIGN_WIDTH).tanh();
            let parts = [
                (state.q[j] - l.middle()) / l.half(),
                state.v[j] / l.speed,
                state.a[j] / l.acceleration,
                (smooth.abs() + coulomb) / 16.0,
            ];
            for (most, part) in most.iter_mut().zip(parts) {
                *most = most.max(part.abs());
            }
        }
        nearest = nearest.min(above().distance(&Pendulums, &state.q));
    }
    assert!(most.iter().all(|x| *x <= 1.0), "{most:?}");
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
    // With and without weights the log says about the same of itself: it counts in both.
    for kind in 0..2 {
        let [with, without] = [&after, &alone].map(|found| found.condition[2][kind]);
        assert!(with < 0.9 * without, "{kind}: {with} for {without}");
    }
    // Rows in other units: neither number changes if all weights change by a factor.
    let equal = planned_with(Noise::Equal, &rest, Some(&log));
    assert_eq!(equal.condition[2][0], equal.condition[2][1]);
    let near = |x: f64, y: f64| (x / y - 1.0).abs() < 1e-9;
    assert!(
        near(equal.condition[2][1], after.condition[2][1]),
        "{:?} {:?}",
        equal.condition,
        after.condition
    );
}

/// Returns what a search finds with this noise.
fn planned_with(noise: Noise, effort: &Effort, prior: Option<&Log>) -> Excitation {
    let request = Request {
        limits: &limits(None),
        keeps: &[],
        points: &Pendulums,
        harmonics: 5,
        period: 10.0,
        effort: *effort,
        noise,
        prior,
    };
    excite(&model(), &request, &mut |_| {}).expect("a motion")
}
