//! The arm in place of a real one: a generated scene with friction that sticks and slips, drives that hold their efforts
//! between two calls of the controller, encoders with steps, and readings of efforts with noise.

use std::f64::consts::TAU;

use bgdyn::nalgebra::SVector;
use bgdyn::runtime::random::Random;
use bgdyn_identification::log::Log;
use bgdyn_sim::{HybridState, Rk4, Run, ScenePlant};

use crate::cycle::Wanted;
use crate::panda::JOINT_LIMITS;
use crate::truth::Truth;
use crate::{JOINTS, Joints};

/// Time between two calls of the controller, s.
pub const PERIOD: f64 = 1e-3;
/// Runge–Kutta steps in that time; more where friction sticks or slips within one.
const SUBSTEPS: u32 = 4;
/// Step of the encoders, rad: 17 bits a turn.
const ENCODER: f64 = TAU / (1 << 17) as f64;
/// Turns of a motor for one of its joint. Velocities are the true ones, rounded to the step that a difference of the
/// motor's encoder over a period has; the delay of such a difference is left out.
const GEAR: f64 = 100.0;
/// What the amplifiers lose of the effort that is asked for, N·m.
pub const OFFSETS: [f64; JOINTS] = [-0.001, 0.194, -0.104, 0.027, 0.053, 0.035, -0.028];
/// Deviation of the readings of efforts, N·m: 0.6 % of a load, the largest effort of gravity and 3 N·m more.
pub const READING_NOISE: [f64; JOINTS] = [0.018, 0.364, 0.199, 0.157, 0.036, 0.035, 0.018];
/// What the gripper takes up: its mass, kg, and its tensor about its centre of mass, kg·m²: a block of 80 × 80 × 100 mm.
pub const PART_MASS: f64 = 2.0;
const PART_TENSOR: [f64; 3] = [2.733e-3, 2.733e-3, 2.133e-3];

/// Positions, rad, and velocities, rad/s.
pub type ArmState = SVector<f64, { 2 * JOINTS }>;

/// What the controller was called with, what it asked for, and where the arm really was.
#[derive(Clone, Copy, Debug)]
pub struct Sample {
    /// Time, s.
    pub t: f64,
    /// The wanted motion.
    pub wanted: Wanted<JOINTS>,
    /// The positions, rad, without the steps of encoders.
    pub q: Joints,
    /// The measured positions.
    pub measured: Joints,
    /// The measured velocities, rad/s.
    pub velocity: Joints,
    /// The efforts that the drives were told to give, N·m.
    pub effort: Joints,
}

impl Sample {
    /// Returns the errors of the positions, rad.
    pub fn error(&self) -> Joints {
        self.wanted.q - self.q
    }
}

/// A run: its wanted motion over time, how long it is, and when the part is held.
pub struct Task<'a> {
    /// The wanted motion at a time, s.
    pub path: &'a dyn Fn(f64) -> Wanted<JOINTS>,
    /// Length, s.
    pub seconds: f64,
    /// From when to when the arm holds the part, s.
    pub held: Option<(f64, f64)>,
}

impl Task<'_> {
    fn holds(&self, t: f64) -> bool {
        self.held.is_some_and(|(from, to)| from <= t && t < to)
    }
}

/// Runs a task under a law that gives efforts for the wanted motion and the measured positions and velocities.
///
/// The arm is at rest in the start. The part is attached and released without an impact: the state is continuous.
pub fn run(
    task: &Task<'_>,
    mut law: impl FnMut(&Wanted<JOINTS>, &Joints, &Joints) -> Joints,
) -> Result<Vec<Sample>, String> {
    let (empty, loaded) = (Truth::default(), with_part());
    let begun = |scene, t, y, modes| {
        let from = HybridState { t, y, modes };
        Run::by(Rk4, ScenePlant::new(scene), from).unaudited()
    };
    let start = joined(&(task.path)(0.0).q, &Joints::zeros());
    let mut run = begun(&empty, 0.0, start, Joints::zeros());
    let mut holds = false;
    let calls = (task.seconds / PERIOD).round() as usize;
    let mut samples = Vec::with_capacity(calls);
    for call in 0..calls {
        let t = call as f64 * PERIOD;
        if holds != task.holds(t) {
            holds = !holds;
            let scene = if holds { &loaded } else { &empty };
            run = begun(scene, t, *run.y(), *run.modes());
        }
        let sample = sampled(t, run.y(), (task.path)(t), &mut law);
        run.plant_mut().given = sample.effort - Joints::from(OFFSETS);
        samples.push(sample);
        for _ in 0..SUBSTEPS {
            let step = run.step(PERIOD / f64::from(SUBSTEPS));
            step.map_err(|failed| format!("at {t:.3} s: {failed:?}"))?;
        }
    }
    Ok(samples)
}

/// Reads the sensors and calls the law; the drives give no more than their limits.
fn sampled(
    t: f64,
    y: &ArmState,
    wanted: Wanted<JOINTS>,
    law: &mut impl FnMut(&Wanted<JOINTS>, &Joints, &Joints) -> Joints,
) -> Sample {
    let half = |first: usize| y.fixed_rows::<JOINTS>(first).into_owned();
    let (q, v) = (half(0), half(JOINTS));
    let measured = q.map(|x| rounded(x, ENCODER));
    let velocity = v.map(|x| rounded(x, ENCODER / GEAR / PERIOD));
    let asked = law(&wanted, &measured, &velocity);
    let limited = |j: usize, _: usize| {
        let most = JOINT_LIMITS[j].effort;
        asked[j].clamp(-most, most)
    };
    Sample {
        t,
        wanted,
        q,
        measured,
        velocity,
        effort: Joints::from_fn(limited),
    }
}

/// Returns the arm with the part in its gripper.
fn with_part() -> Truth<f64> {
    let [part_xx, part_yy, part_zz] = PART_TENSOR;
    Truth {
        part_mass: PART_MASS,
        part_xx,
        part_yy,
        part_zz,
    }
}

/// Returns positions and velocities in one vector.
pub fn joined(q: &Joints, v: &Joints) -> ArmState {
    ArmState::from_fn(|i, _| if i < JOINTS { q[i] } else { v[i - JOINTS] })
}

/// Returns the nearest multiple of a step.
fn rounded(x: f64, step: f64) -> f64 {
    (x / step).round() * step
}

/// Returns the log of a run, a row for each call of the controller but the first: positions of the encoders, and efforts
/// with noise. A reading is the mean of the periods before and after, as of a current that is averaged.
pub fn logged(samples: &[Sample], seed: u64) -> Log {
    let mut random = Random(seed);
    let mut reading = |pair: &[Sample]| {
        let mean = 0.5 * (pair[0].effort + pair[1].effort);
        Joints::from_fn(|j, _| mean[j] + READING_NOISE[j] * normal(&mut random))
    };
    let efforts: Vec<Joints> = samples.windows(2).map(&mut reading).collect();
    let rows = &samples[1..];
    let by_joint = |of: &dyn Fn(usize) -> Vec<f64>| (0..JOINTS).map(of).collect();
    Log {
        time: rows.iter().map(|s| s.t).collect(),
        q: by_joint(&|j| rows.iter().map(|s| s.measured[j]).collect()),
        tau: by_joint(&|j| efforts.iter().map(|e| e[j]).collect()),
        lines: (2..samples.len() + 1).collect(),
    }
}

/// Returns a normally distributed number of mean 0 and deviation 1 (Box and Muller 1958).
fn normal(random: &mut Random) -> f64 {
    let radius = (-2.0 * (1.0 - random.unit()).ln()).sqrt();
    radius * (TAU * random.unit()).cos()
}
