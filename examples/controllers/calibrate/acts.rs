//! The three acts: a log of a planned motion, a calibrated model under computed torque, an unknown load.

use std::time::Instant;

use bgdyn::nalgebra::SVector;
use bgdyn_identification::excite::{
    Effort, Excitation, JointLimits, Keep, Noise, PeriodicMotion, Request, excite,
};
use bgdyn_identification::log::Log;
use bgdyn_identification::{Identification, LogFault, Options, identify};

use crate::control::{Adaptive, computed_torque};
use crate::cycle::{Cycle, Gripper, Leg, Wanted};
use crate::load::Load;
use crate::plant::{Sample, Task, logged, run};
use crate::robot::{ArmModel, Generated, Numbers, identified_model, place_of_tool};
use crate::{JOINTS, Joints};

/// Share of the limits that stays free.
const MARGIN: f64 = 0.08;
/// Largest acceleration of the motion for the log, rad/s².
const ACCELERATION: f64 = 7.0;
/// The tool stays above this height, m.
const HEIGHT: f64 = 0.1;
/// Period of the motion for the log, s, and how often the log has it; the motion that judges is run once.
const MOTION: f64 = 10.0;
const REPETITIONS: f64 = 2.0;

/// Rows of joints that are slower have no weight, rad/s: under the model of the spec, dry friction holds a joint for a
/// while where its velocity changes its sign.
const STICKS: f64 = 0.02;

/// What the first act gives.
pub struct Calibration {
    /// The planned motion.
    pub motion: Excitation,
    /// Time of the plan, s.
    pub planned_in: f64,
    /// The log, and the one of another motion, which judges.
    pub logs: [Log; 2],
    /// What was found.
    pub found: Identification,
    /// Time of the identification, s.
    pub identified_in: f64,
    /// Largest error of the positions while the log was recorded, rad.
    pub worst_error: f64,
}

/// Plans a motion, runs it with the spec's numbers, and identifies from the log.
pub fn calibrate(spec: &ArmModel) -> Result<Calibration, String> {
    let before = Instant::now();
    let search = |starts, ascents, seed| Effort {
        starts,
        ascents,
        steps: 150,
        seed,
    };
    let motion = plan(search(60, 3, 1))?;
    let planned_in = before.elapsed().as_secs_f64();
    let other = plan(search(10, 1, 7))?;
    let train = follow(&motion.motion, REPETITIONS * MOTION, spec)?;
    let judge = follow(&other.motion, MOTION, spec)?;
    within_limits(&train)?;
    within_limits(&judge)?;
    let (log, test) = (logged(&train, 11), logged(&judge, 12));
    let options = Options {
        skip_below: STICKS,
        ..Options::default()
    };
    let before = Instant::now();
    let found = identify(
        &identified_model(),
        &log,
        Some(&test),
        &options,
        &mut |_, _| {},
    );
    Ok(Calibration {
        motion,
        planned_in,
        found: found.map_err(|faults| listed(&faults))?,
        identified_in: before.elapsed().as_secs_f64(),
        logs: [log, test],
        worst_error: train.iter().map(|s| s.error().amax()).fold(0.0, f64::max),
    })
}

/// Plans a motion within the limits of the spec, less the margin, with the tool above a plane.
fn plan(effort: Effort) -> Result<Excitation, String> {
    let limits = crate::panda::JOINT_LIMITS.map(|limits| {
        let [low, high] = [limits.lower, limits.upper];
        let (middle, half) = (0.5 * (low + high), 0.5 * (1.0 - MARGIN) * (high - low));
        JointLimits {
            position: [middle - half, middle + half],
            speed: (1.0 - MARGIN) * limits.velocity,
            acceleration: ACCELERATION,
            effort: Some((1.0 - MARGIN) * limits.effort),
        }
    });
    let keep = Keep {
        name: format!("tool.z>{HEIGHT} m"),
        point: 0,
        axis: 2,
        side: 1.0,
        level: HEIGHT,
    };
    let request = Request {
        limits: &limits,
        keeps: &[keep],
        points: &Generated,
        harmonics: 5,
        period: MOTION,
        effort,
        noise: Noise::Relative,
        prior: None,
    };
    excite(&identified_model(), &request, &mut |_| {}).map_err(|faults| listed(&faults))
}

/// Checks that a run stayed within the limits of positions.
fn within_limits(samples: &[Sample]) -> Result<(), String> {
    for sample in samples {
        for (j, limits) in crate::panda::JOINT_LIMITS.iter().enumerate() {
            let range = limits.lower..=limits.upper;
            if !range.contains(&sample.q[j]) {
                let (t, name) = (sample.t, crate::panda::JOINT_NAMES[j]);
                return Err(format!("{name} leaves its range at {t:.3} s of the log"));
            }
        }
    }
    Ok(())
}

fn listed(faults: &[LogFault]) -> String {
    let lines: Vec<String> = faults.iter().map(ToString::to_string).collect();
    lines.join("\n")
}

/// Follows a periodic motion under computed torque.
fn follow(motion: &PeriodicMotion, seconds: f64, model: &ArmModel) -> Result<Vec<Sample>, String> {
    let path = |t: f64| {
        let state = motion.at(t);
        let [q, v, a] = [state.q, state.v, state.a].map(Joints::from_vec);
        Wanted { q, v, a }
    };
    let task = Task {
        path: &path,
        seconds,
        held: None,
    };
    run(&task, |wanted, q, v| computed_torque(model, wanted, q, v))
}

/// Returns the cycle of pick and place.
pub fn cycle() -> Cycle<JOINTS> {
    let home = pose(0.0, [0.0, -35.0], [0.0, -130.0], 0.0);
    let above_pick = pose(-50.0, [15.0, 25.0], [-10.0, -95.0], -20.0);
    let pick = pose(-50.0, [15.0, 45.0], [-10.0, -105.0], -20.0);
    let above_place = pose(55.0, [-15.0, 10.0], [10.0, -125.0], 40.0);
    let put = pose(55.0, [-15.0, 28.0], [10.0, -135.0], 40.0);
    let legs = vec![
        Leg::new("approach", above_pick, 1.2),
        Leg::new("down", pick, 0.8),
        Leg::new("grasp", pick, 0.2).then(Gripper::Takes),
        Leg::new("up", above_pick, 0.8),
        Leg::new("over", above_place, 2.0),
        Leg::new("down", put, 0.8),
        Leg::new("release", put, 0.2).then(Gripper::Releases),
        Leg::new("up", above_place, 0.8),
        Leg::new("home", home, 1.2),
    ];
    Cycle { start: home, legs }
}

/// Returns a pose, all angles in degrees: the direction of the base; turn and elevation of the upper arm; turn and bend
/// of the forearm; the turn of the hand. The sixth joint points the hand down where both turns are 0.
fn pose(base: f64, [turn, lift]: [f64; 2], [roll, bend]: [f64; 2], hand: f64) -> Joints {
    Joints::from([base, lift, turn, bend, roll, lift - bend, 45.0 + hand].map(f64::to_radians))
}

/// Runs the cycle under computed torque, without a part.
pub fn pick_and_place(model: &ArmModel) -> Result<Vec<Sample>, String> {
    let cycle = cycle();
    let task = Task {
        path: &|t| cycle.at(t),
        seconds: cycle.seconds(),
        held: None,
    };
    run(&task, |wanted, q, v| computed_torque(model, wanted, q, v))
}

/// A run with the part.
pub struct Carried {
    /// The samples.
    pub samples: Vec<Sample>,
    /// What was known of the load at each.
    pub loads: Vec<Load>,
}

/// Runs the cycle with the part under the adaptive law, or without its adaptation.
pub fn carry(model: &ArmModel, adapts: bool) -> Result<Carried, String> {
    let cycle = cycle();
    let task = Task {
        path: &|t| cycle.at(t),
        seconds: cycle.seconds(),
        held: Some(cycle.carried()),
    };
    let mut law = Adaptive::new(model, &cycle.start, adapts);
    let mut loads = Vec::new();
    let samples = run(&task, |wanted, q, v| {
        loads.push(law.load);
        law.effort(wanted, q, v)
    })?;
    Ok(Carried { samples, loads })
}

/// Errors of the positions in a run.
#[derive(Clone, Copy, Debug)]
pub struct Tracking {
    /// Root mean square by joint, rad.
    pub rms: Joints,
    /// Largest, by joint, rad.
    pub most: Joints,
    /// Root mean square of the distance of the tool from its path, m.
    pub tool: f64,
}

impl Tracking {
    /// Returns the errors of samples.
    pub fn of<'a>(samples: impl IntoIterator<Item = &'a Sample>) -> Self {
        let mut squares: Joints = Joints::zeros();
        let mut most = squares;
        let (mut tool, mut count) = (0.0, 0.0);
        for sample in samples {
            let error = sample.error();
            squares += error.component_mul(&error);
            most = most.sup(&error.abs());
            tool += miss(sample).norm_squared();
            count += 1.0;
        }
        Tracking {
            rms: squares.map(|x| (x / count).sqrt()),
            most,
            tool: f64::sqrt(tool / count),
        }
    }

    /// Returns the root mean square over time and joints, rad.
    pub fn whole(&self) -> f64 {
        (self.rms.norm_squared() / JOINTS as f64).sqrt()
    }
}

/// Returns the way from the tool to where it is wanted, m.
pub fn miss(sample: &Sample) -> SVector<f64, 3> {
    place_of_tool(&sample.wanted.q) - place_of_tool(&sample.q)
}

/// Returns the model with the numbers that were found: of bodies that can exist.
pub fn calibrated(found: &Identification) -> ArmModel {
    ArmModel::new(&Numbers::of_spec().with(&found.numbers))
}
