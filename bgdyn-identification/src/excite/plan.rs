//! Runs the search, and says what its motion uses and shows.

use nalgebra::DMatrix;

use super::information::Information;
use super::limits::{JointLimits, Keep, Points};
use super::objective::{Bounds, Objective};
use super::search::{Effort, Found, search, used};
use super::series::{Extremes, PeriodicMotion, SAMPLES, State};
use super::shape::Shape;
use crate::base::{Base, base};
use crate::even::even;
use crate::fault::LogFault;
use crate::log::Log;
use crate::model::Model;
use crate::prepare::prepare;
use crate::spectrum::default_cut;

/// The sign of Coulomb friction is smoothed over this share of a joint's speed limit.
const SMOOTHED: f64 = 0.05;
/// Random states at which efforts are taken for the noise of joints without a limit of effort.
const STATES: usize = 50;
/// Noise of an effort, as a share of its limit or of its largest size.
const NOISE: f64 = 0.01;

/// Noise of the efforts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Noise {
    /// 1 % of each joint's limit of effort; without limits of all joints, of the largest size of its effort by the file
    /// at random states.
    #[default]
    Relative,
    /// The same for all joints, N·m or N.
    Equal,
}

/// What is asked for.
pub struct Request<'a> {
    /// Limits of joints, with margins.
    pub limits: &'a [JointLimits],
    /// Planes.
    pub keeps: &'a [Keep],
    /// Points that are kept.
    pub points: &'a dyn Points,
    /// K ≥ 2.
    pub harmonics: usize,
    /// s
    pub period: f64,
    /// How far the search goes.
    pub effort: Effort,
    /// Noise of efforts.
    pub noise: Noise,
    /// A log whose rows count too.
    pub prior: Option<&'a Log>,
}

/// A motion, what it uses of the limits, and what it shows.
#[derive(Clone, Debug)]
pub struct Excitation {
    /// The motion.
    pub motion: PeriodicMotion,
    /// Names of the base parameters.
    pub base: Vec<String>,
    /// Noise of the efforts, N·m or N, by joint.
    pub sigma: Vec<f64>,
    /// Bounds of position, velocity, acceleration, between samples too, by joint.
    pub extremes: Vec<[Extremes; 3]>,
    /// Shares of the limits of position, speed, acceleration, effort; the last one is 0 without a limit.
    pub shares: Vec<[f64; 4]>,
    /// Least distance from each plane, m.
    pub distances: Vec<f64>,
    /// Condition number, columns scaled, rows weighted and not: of the first random motion, of the best one, of this.
    pub condition: [[f64; 2]; 3],
    /// log det of the same three, columns scaled; `None` for a motion that does not show all base parameters.
    pub log_det: [Option<f64>; 3],
    /// What was raised, with barriers, along the ascent for each weight of the barriers.
    pub ascents: Vec<Vec<f64>>,
    /// Rows of the period that were counted.
    pub rows: usize,
}

impl Excitation {
    /// A larger condition number means that a log of the motion, with the usual noise, does not show all parameters.
    pub const WEAK: f64 = 1000.0;

    /// Returns whether a log of the motion would not show all base parameters.
    pub fn is_weak(&self) -> bool {
        self.condition[2][0].is_nan() || self.condition[2][0] > Self::WEAK
    }

    /// Returns the count of steps of the ascent.
    pub fn steps(&self) -> usize {
        let steps = self.ascents.iter().map(|a| a.len().saturating_sub(1));
        steps.sum()
    }
}

/// Finds a motion. Tells the finished share to `progress`.
///
/// # Errors
/// If no motion keeps to the planes and limits, or none shows all base parameters.
pub fn excite(
    model: &Model<'_>,
    request: &Request<'_>,
    progress: &mut dyn FnMut(f64),
) -> Result<Excitation, Vec<LogFault>> {
    let frequency = std::f64::consts::TAU / request.period;
    let base = base(model);
    if base.kept.is_empty() {
        let message = "no parameter has an effect on the efforts".to_owned();
        let help = "give the links masses, or identify friction or rotors too";
        return Err(vec![
            LogFault::whole("nothing-excited", message).with_help(help),
        ]);
    }
    let shape = Shape::new(request.harmonics, frequency, request.limits);
    let sigma = noise(model, request);
    let widths = request.limits.iter().map(|l| SMOOTHED * l.speed).collect();
    let mut information = Information::new(model, &base, &sigma, widths);
    let bounds = Bounds {
        names: model.joints.iter().map(|j| j.name.clone()).collect(),
        joints: request.limits,
        keeps: request.keeps,
        points: request.points,
    };
    if let Some(log) = request.prior {
        let (rows_of_log, step) = of_log(model, &base, log);
        // A row of the log has the weight of the time to the next one.
        information.set_prior(&rows_of_log, step / request.period);
    }
    let mut objective = Objective::new(&information, &shape, &bounds, request.harmonics, frequency);
    let found = search(&mut objective, &request.effort, progress)?;
    Ok(report(model, &base, &objective, found, sigma))
}

fn report(
    model: &Model<'_>,
    base: &Base,
    objective: &Objective<'_>,
    found: Found,
    sigma: Vec<f64>,
) -> Excitation {
    let motions = [&found.first, &found.start, &found.motion];
    let samples = motions.map(|motion| objective.samples(motion));
    let (distances, efforts) = used(objective, &found.motion, SAMPLES);
    let joints = || found.motion.joints.iter().zip(objective.bounds.joints);
    let frequency = found.motion.frequency;
    let shares = joints().zip(efforts).map(|((series, limits), effort)| {
        let [q, v, a] = limits.shares(series, frequency);
        [q, v, a, effort]
    });
    Excitation {
        base: base.names(model),
        sigma,
        extremes: joints().map(|(s, _)| s.extremes(frequency)).collect(),
        shares: shares.collect(),
        distances,
        condition: samples
            .each_ref()
            .map(|s| objective.information.condition(s)),
        log_det: samples.each_ref().map(|s| objective.information.log_det(s)),
        rows: objective.count(),
        ascents: found.ascents,
        motion: found.motion,
    }
}

/// Returns the noise of each joint's effort.
fn noise(model: &Model<'_>, request: &Request<'_>) -> Vec<f64> {
    let n = model.joints.len();
    let limits: Option<Vec<f64>> = request.limits.iter().map(|l| l.effort).collect();
    match (request.noise, limits) {
        (Noise::Equal, _) => vec![1.0; n],
        (Noise::Relative, Some(limits)) if limits.iter().all(|l| *l > 0.0) => {
            limits.iter().map(|l| NOISE * l).collect()
        }
        (Noise::Relative, _) => by_sizes(model, request),
    }
}

/// Returns the noise in proportion to the largest efforts of the file's numbers at random states within the limits; at
/// least a hundredth of the largest of all joints.
fn by_sizes(model: &Model<'_>, request: &Request<'_>) -> Vec<f64> {
    let n = model.joints.len();
    let mut random = bgdyn_runtime::random::Random(1);
    let mut sizes = vec![0.0_f64; n];
    for _ in 0..STATES {
        let mut draw = |of: &dyn Fn(&JointLimits) -> [f64; 2]| -> Vec<f64> {
            let one = |l: &JointLimits| of(l)[0] + of(l)[1] * random.signed();
            request.limits.iter().map(one).collect()
        };
        let state = State {
            q: draw(&|l| [l.middle(), l.half()]),
            v: draw(&|l| [0.0, l.speed]),
            a: draw(&|l| [0.0, l.acceleration]),
        };
        for (size, x) in sizes.iter_mut().zip(efforts_of_file(model, &state)) {
            *size = size.max(x.abs());
        }
    }
    let largest = sizes.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
    let sizes = sizes.into_iter().map(|x| NOISE * x.max(0.01 * largest));
    sizes.collect()
}

/// Returns the efforts of the file's numbers at a state, N·m or N, by joint.
pub fn efforts_of_file(model: &Model<'_>, state: &State) -> Vec<f64> {
    let n = model.joints.len();
    let none = Base {
        free: vec![],
        kept: vec![],
        map: DMatrix::zeros(0, 0),
    };
    let information = Information::new(model, &none, &vec![1.0; n], vec![1.0; n]);
    information.efforts(state).as_slice().to_vec()
}

/// Returns the rows of base parameters of a log, prepared as `identify` does it, n for each time, and the time between
/// two, s.
fn of_log(model: &Model<'_>, base: &Base, log: &Log) -> (DMatrix<f64>, f64) {
    let even = even(log);
    let samples = prepare(model, &even, default_cut(&even), &mut |_| {});
    let unknowns = model.unknowns();
    let place = |kept: &usize| {
        let own = unknowns.iter().position(|u| *u == base.free[*kept]);
        own.expect("a free unknown is one")
    };
    let kept: Vec<usize> = base.kept.iter().map(place).collect();
    (samples.rows.select_columns(&kept), samples.step)
}
