//! Random motions within the limits, and the ascent from the best one.

use bgdyn_runtime::random::Random;
use nalgebra::DVector;

use super::ascent::ascend;
use super::limits::{JointLimits, Keep, least};
use super::problem::Problem;
use super::series::{Motion, SAMPLES, State};
use crate::fault::{LogFault, short};

/// Centres that are tried for a start until planes and efforts permit one.
const CENTRES: usize = 40;
/// Halvings in the search for the largest motion that planes and efforts permit.
const HALVINGS: usize = 12;
/// Random motions begin the ascent with this share of their size: inside the limits.
const INSIDE: f64 = 0.97;
/// Weights of the barriers, one after the other.
const BARRIERS: [f64; 3] = [1.0, 0.1, 0.01];
/// Samples for each harmonic at which random motions are checked against planes and efforts.
const COARSE: usize = 12;
/// An ascent ends where a step rises by less, in nepers of det.
const LEAST: f64 = 1e-2;

/// What a search found.
#[derive(Clone, Debug)]
pub struct Found {
    /// The first random motion.
    pub first: Motion,
    /// The best one.
    pub start: Motion,
    /// What the ascent made of it.
    pub motion: Motion,
    /// log det with barriers along the ascent, for each weight of these.
    pub ascents: Vec<Vec<f64>>,
}

/// Searches: `starts` random motions, then at most `rounds` steps.
///
/// # Errors
/// If no motion keeps to the planes and limits of efforts.
pub fn search(
    problem: &mut Problem<'_>,
    starts: usize,
    rounds: usize,
    seed: u64,
    progress: &mut dyn FnMut(&'static str, f64),
) -> Result<Found, Vec<LogFault>> {
    let mut random = Random(seed);
    let (mut first, mut best): (Option<Motion>, Option<(f64, Motion)>) = (None, None);
    let mut worst = Exceeded::default();
    for i in 0..starts {
        progress("starts", i as f64 / starts as f64);
        let Some(motion) = random_motion(problem, &mut random, &mut worst) else {
            continue;
        };
        first.get_or_insert_with(|| motion.clone());
        let Some(value) = problem.information.log_det(&problem.states(&motion)) else {
            continue;
        };
        if best.as_ref().is_none_or(|(most, _)| value > *most) {
            best = Some((value, motion));
        }
    }
    let Some(first) = first else {
        return Err(worst.faults(problem, CENTRES * starts));
    };
    let Some((_, start)) = best else {
        let message = format!("none of {starts} random motions shows all base parameters");
        return Err(vec![LogFault::whole("nothing-excited", message).with_help(
            "take more --harmonics, a longer --period, or larger limits",
        )]);
    };
    let mut x = problem.shape.numbers(&start.scaled(INSIDE));
    let mut ascents = Vec::new();
    let each = rounds.div_ceil(BARRIERS.len());
    let mut done = 0;
    for barrier in BARRIERS {
        problem.barrier = barrier;
        let ascent = ascend(&*problem, x, each, LEAST, &mut || {
            progress("ascent", done as f64 / rounds as f64);
            done += 1;
        });
        x = ascent.x;
        ascents.push(ascent.values);
    }
    let motion = within(problem, problem.shape.motion(&x), SAMPLES);
    // Where barriers cost more than the ascent gains, the start remains.
    let value = |motion: &Motion| problem.information.log_det(&problem.states(motion));
    let motion = match value(&motion) > value(&start) {
        true => motion,
        false => within(problem, start.clone(), SAMPLES),
    };
    Ok(Found {
        first,
        start,
        motion,
        ascents,
    })
}

/// By how much the best centre misses.
#[derive(Debug, Default)]
struct Exceeded {
    /// The largest distance from each plane that was found, m.
    keeps: Vec<f64>,
    /// The smallest share of each limit of effort.
    efforts: Vec<f64>,
}

impl Exceeded {
    /// Returns whether planes and limits of efforts permit to rest at a state; keeps what comes nearest.
    fn note(&mut self, problem: &Problem<'_>, state: &State) -> bool {
        let keeps = problem.bounds.keeps.iter();
        let own: Vec<f64> = keeps
            .map(|k| k.distance(problem.bounds.points, &state.q))
            .collect();
        let apart = own.iter().all(|d| *d > 0.0);
        self.keeps.resize(own.len(), f64::NEG_INFINITY);
        for (most, x) in self.keeps.iter_mut().zip(own) {
            *most = most.max(x);
        }
        let own = effort_shares(problem, state);
        let strong = own.iter().all(|share| *share < 1.0);
        self.efforts.resize(own.len(), f64::INFINITY);
        for (least, x) in self.efforts.iter_mut().zip(own) {
            *least = least.min(x);
        }
        apart && strong
    }

    fn faults(&self, problem: &Problem<'_>, tried: usize) -> Vec<LogFault> {
        let mut faults = Vec::new();
        for (keep, most) in problem.bounds.keeps.iter().zip(&self.keeps) {
            if *most <= 0.0 {
                let message = format!(
                    "`--keep {}` cannot be met: in {tried} positions within the limits the point is at least {} m beyond the plane",
                    keep.name,
                    short(-most)
                );
                faults.push(LogFault::whole("keep-not-met", message).with_help(
                    "move the plane, or change the limits of positions in the file so that the point is on its side",
                ));
            }
        }
        for (j, least) in self.efforts.iter().enumerate() {
            if *least >= 1.0 {
                let message = format!(
                    "joint `{}` needs at least {} % of its limit of effort at rest, in {tried} positions within the limits",
                    problem.bounds.names[j],
                    short(100.0 * least)
                );
                faults.push(LogFault::whole("effort-limit", message).with_help(
                    "check the limit of effort, the masses and gravity in the file, or take a smaller --margin",
                ));
            }
        }
        if faults.is_empty() {
            let message = format!(
                "none of {tried} positions within the limits keeps to all planes and limits of efforts at once"
            );
            faults.push(
                LogFault::whole("keep-not-met", message)
                    .with_help("move the planes, or take more --starts"),
            );
        }
        faults
    }
}

/// Returns the shares of the limits of efforts at a state, by joint; 0 where there is none.
fn effort_shares(problem: &Problem<'_>, state: &State) -> Vec<f64> {
    if !problem.has_efforts() {
        return vec![0.0; problem.bounds.joints.len()];
    }
    let efforts = problem.information.efforts(state);
    let joints = efforts.iter().zip(problem.bounds.joints);
    joints
        .map(|(effort, l)| l.effort.map_or(0.0, |most| effort.abs() / most))
        .collect()
}

/// Returns the least distances from planes along a motion, m, and the largest shares of efforts by joint.
pub fn used(problem: &Problem<'_>, motion: &Motion, samples: usize) -> (Vec<f64>, Vec<f64>) {
    let distance = |keep: &Keep| {
        let of = &mut |state: &State| keep.distance(problem.bounds.points, &state.q);
        least(motion, samples, of)
    };
    let keeps = problem.bounds.keeps.iter().map(distance).collect();
    let mut efforts = vec![0.0_f64; motion.joints.len()];
    if problem.has_efforts() {
        // Friction jumps, so that no parabola bounds the efforts: samples alone.
        least(motion, samples, &mut |state| {
            for (most, share) in efforts.iter_mut().zip(effort_shares(problem, state)) {
                *most = most.max(share);
            }
            0.0
        });
    }
    (keeps, efforts)
}

/// Returns whether planes and limits of efforts permit a motion.
fn permitted(problem: &Problem<'_>, motion: &Motion, samples: usize) -> bool {
    if problem.bounds.keeps.is_empty() && !problem.has_efforts() {
        return true;
    }
    let (keeps, efforts) = used(problem, motion, samples);
    keeps.iter().all(|d| *d > 0.0) && efforts.iter().all(|share| *share <= 1.0)
}

/// Returns the motion with each joint's motion about its centre as large as its limits permit, at most as it is; then
/// all of them as large as planes and efforts permit.
fn within(problem: &Problem<'_>, mut motion: Motion, samples: usize) -> Motion {
    for (series, limits) in motion.joints.iter_mut().zip(problem.bounds.joints) {
        *series = series.scaled(limits.room(series, motion.frequency).min(1.0));
    }
    if permitted(problem, &motion, samples) {
        return motion;
    }
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        match permitted(problem, &motion.scaled(middle), samples) {
            true => low = middle,
            false => high = middle,
        }
    }
    motion.scaled(low)
}

/// Returns a random motion that touches a limit of each joint, unless planes or efforts shrink it; `None` if these
/// permit no centre.
fn random_motion(
    problem: &Problem<'_>,
    random: &mut Random,
    worst: &mut Exceeded,
) -> Option<Motion> {
    let numbers = DVector::from_fn(problem.shape.len(), |_, _| random.signed());
    let mut motion = problem.shape.motion(&numbers);
    let frequency = motion.frequency;
    for (series, limits) in motion.joints.iter_mut().zip(problem.bounds.joints) {
        series.centre = 0.0;
        let [q, ..] = series.extremes(frequency);
        let wide = JointLimits {
            position: [f64::NEG_INFINITY, f64::INFINITY],
            ..*limits
        };
        let size = 2.0 * limits.half() / (q[1] - q[0]);
        *series = series.scaled(size.min(wide.room(series, frequency)));
    }
    let draw = |motion: &mut Motion, random: &mut Random| {
        for (series, limits) in motion.joints.iter_mut().zip(problem.bounds.joints) {
            series.centre = 0.0;
            let [q, ..] = series.extremes(frequency);
            let [low, high] = [limits.position[0] - q[0], limits.position[1] - q[1]];
            series.centre = low + (high - low) * random.unit();
        }
    };
    for _ in 0..CENTRES {
        draw(&mut motion, random);
        if worst.note(problem, &motion.scaled(0.0).at(0.0)) {
            return Some(within(problem, motion, COARSE));
        }
    }
    None
}
