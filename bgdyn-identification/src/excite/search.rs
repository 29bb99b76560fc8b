//! Random motions within the limits, and the ascent from the best one.

use bgdyn_runtime::random::Random;
use nalgebra::DVector;

use super::ascent::ascend;
use super::limits::{JointLimits, least};
use super::objective::Objective;
use super::series::{PeriodicMotion, SAMPLES, State};
use crate::fault::{LogFault, short};

/// Centres that are tried for a start until planes and efforts permit one.
const CENTRES: usize = 40;
/// Halvings in the search for the largest motion that planes and efforts permit.
const HALVINGS: usize = 12;
/// The motion that is found stays below the limits that it touches by this share: no rounding of its coefficients exceeds
/// them.
const BELOW: f64 = 1e-12;
/// Random motions begin the ascent with this share of their size: inside the limits.
const INSIDE: f64 = 0.97;
/// Weights of the barriers, one after the other.
const BARRIERS: [f64; 3] = [1.0, 0.1, 0.01];
/// Samples for each harmonic at which random motions are checked against planes and efforts.
const COARSE: usize = 12;
/// An ascent ends where the value rises by less.
const LEAST: f64 = 1e-2;

/// What a search found.
#[derive(Clone, Debug)]
pub struct Found {
    /// The first random motion.
    pub first: PeriodicMotion,
    /// The best one.
    pub start: PeriodicMotion,
    /// What the ascent made of it.
    pub motion: PeriodicMotion,
    /// Values with barriers along the ascent, for each weight of these.
    pub ascents: Vec<Vec<f64>>,
}

/// How far a search goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Effort {
    /// Random motions.
    pub starts: usize,
    /// So many of the best of them are improved.
    pub ascents: usize,
    /// Steps of an ascent at most.
    pub steps: usize,
    /// Of the random motions.
    pub seed: u64,
}

/// Searches: random motions, then an ascent from each of the best ones; returns the best of all.
///
/// # Errors
/// If no motion keeps to the planes and limits of efforts, or none shows all base parameters.
pub fn search(
    objective: &mut Objective<'_>,
    effort: &Effort,
    progress: &mut dyn FnMut(f64),
) -> Result<Found, Vec<LogFault>> {
    let (first, mut starts) = random_motions(objective, effort)?;
    // Equal values keep their order.
    starts.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut best: Option<(f64, Found)> = None;
    let count = effort.ascents.clamp(1, starts.len());
    for (i, (_, start)) in starts.iter().take(count).enumerate() {
        let found = improved(objective, start, effort.steps, &mut |share| {
            progress((i as f64 + share) / count as f64)
        });
        let Some((value, motion, ascents)) = found else {
            continue;
        };
        if best.as_ref().is_none_or(|(most, _)| value > *most) {
            let found = Found {
                first: first.clone(),
                start: starts[0].1.clone(),
                motion,
                ascents,
            };
            best = Some((value, found));
        }
    }
    best.map(|(_, found)| found)
        .ok_or_else(|| vec![nothing_excited(effort)])
}

fn nothing_excited(effort: &Effort) -> LogFault {
    let message = format!(
        "none of {} random motions within the limits shows all base parameters",
        effort.starts
    );
    LogFault::whole("nothing-excited", message)
        .with_help("take more --harmonics, a longer --period, larger limits, or fewer parameters")
}

/// Returns the first random motion, and all that show every base parameter, with their values.
#[expect(clippy::type_complexity, reason = "a pair of motions and their values")]
fn random_motions(
    objective: &Objective<'_>,
    effort: &Effort,
) -> Result<(PeriodicMotion, Vec<(f64, PeriodicMotion)>), Vec<LogFault>> {
    let mut random = Random(effort.seed);
    let (mut first, mut starts) = (None, Vec::new());
    let mut nearest = Nearest::default();
    for _ in 0..effort.starts {
        let Some(motion) = random_motion(objective, &mut random, &mut nearest) else {
            continue;
        };
        first.get_or_insert_with(|| motion.clone());
        if let Some(value) = value_of(objective, &motion) {
            starts.push((value, motion));
        }
    }
    let Some(first) = first else {
        return Err(nearest.faults(objective, CENTRES * effort.starts));
    };
    match starts.is_empty() {
        true => Err(vec![nothing_excited(effort)]),
        false => Ok((first, starts)),
    }
}

/// Returns what the search raises, without barriers.
fn value_of(objective: &Objective<'_>, motion: &PeriodicMotion) -> Option<f64> {
    objective.information.value(&objective.samples(motion))
}

/// Returns the value of what an ascent makes of a motion, the motion, within the limits, and the values along the ascent
/// for each weight of the barriers; `None` if neither it nor the start is within the limits and has a value.
fn improved(
    objective: &mut Objective<'_>,
    start: &PeriodicMotion,
    steps: usize,
    progress: &mut dyn FnMut(f64),
) -> Option<(f64, PeriodicMotion, Vec<Vec<f64>>)> {
    let mut x = objective.shape.numbers(&start.scaled(INSIDE));
    let mut ascents = Vec::new();
    let mut done = 0;
    for (i, barrier) in BARRIERS.into_iter().enumerate() {
        objective.barrier = barrier;
        let until = |i: usize| steps * i / BARRIERS.len();
        let each = until(i + 1) - until(i);
        let ascent = ascend(&*objective, x, each, LEAST, &mut || {
            progress(done as f64 / steps as f64);
            done += 1;
        });
        x = ascent.x;
        ascents.push(ascent.values);
    }
    let valued = |motion: PeriodicMotion| {
        let motion = within(objective, motion, SAMPLES)?.scaled(1.0 - BELOW);
        Some((value_of(objective, &motion)?, motion))
    };
    let (ascended, start) = (valued(objective.shape.motion(&x)), valued(start.clone()));
    // Where barriers cost more than the ascent gains, the start remains.
    let (value, motion) = match (ascended, start) {
        (Some(ascended), Some(start)) if ascended.0 > start.0 => ascended,
        (Some(only), None) | (_, Some(only)) => only,
        (None, None) => return None,
    };
    Some((value, motion, ascents))
}

/// The nearest that positions at rest come to planes and limits of efforts.
#[derive(Debug, Default)]
struct Nearest {
    /// The largest distance from each plane that was found, m.
    keeps: Vec<f64>,
    /// The smallest share of each limit of effort.
    efforts: Vec<f64>,
}

impl Nearest {
    /// Returns whether planes and limits of efforts permit to rest at a state; keeps what comes nearest.
    fn note(&mut self, objective: &Objective<'_>, state: &State) -> bool {
        let keeps = objective.bounds.keeps.iter();
        let own: Vec<f64> = keeps
            .map(|k| k.distance(objective.bounds.points, &state.q))
            .collect();
        let apart = own.iter().all(|d| *d > 0.0);
        self.keeps.resize(own.len(), f64::NEG_INFINITY);
        for (most, x) in self.keeps.iter_mut().zip(own) {
            *most = most.max(x);
        }
        let own = effort_shares(objective, state);
        let strong = own.iter().all(|share| *share < 1.0);
        self.efforts.resize(own.len(), f64::INFINITY);
        for (least, x) in self.efforts.iter_mut().zip(own) {
            *least = least.min(x);
        }
        apart && strong
    }

    fn faults(&self, objective: &Objective<'_>, tried: usize) -> Vec<LogFault> {
        let mut faults = Vec::new();
        for (keep, most) in objective.bounds.keeps.iter().zip(&self.keeps) {
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
                    "joint `{}` needs at least {} % of its limit of effort, less the margin, to begin to move: bodies at rest and Coulomb friction, in {tried} positions within the limits",
                    objective.bounds.names[j],
                    short(100.0 * least)
                );
                faults.push(LogFault::whole("effort-limit", message).with_help(
                    "check the limit of effort, the masses, friction and gravity in the file, or take a smaller --margin",
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

/// Returns the shares of the limits of efforts at a state, by joint, with Coulomb friction in full at any speed; 0 where
/// there is no limit.
fn effort_shares(objective: &Objective<'_>, state: &State) -> Vec<f64> {
    if !objective.has_efforts() {
        return vec![0.0; objective.bounds.joints.len()];
    }
    let sample = objective.information.samples(vec![state.clone()]);
    let efforts = objective.information.smooth_efforts(&sample[0]);
    shares_of(objective, |j| efforts[j].abs())
}

/// Returns the shares of the limits of efforts from efforts without Coulomb friction.
fn shares_of(objective: &Objective<'_>, effort: impl Fn(usize) -> f64) -> Vec<f64> {
    let joints = objective.bounds.joints.iter().enumerate();
    let all = joints.zip(objective.information.coulomb());
    all.map(|((j, l), coulomb)| l.effort.map_or(0.0, |most| (effort(j) + coulomb) / most))
        .collect()
}

/// Returns the least distances from planes along a motion, m, and the largest shares of efforts by joint. Without
/// Coulomb friction, which jumps and is counted in full, efforts are smooth: both are estimated between samples too.
pub fn used(
    objective: &Objective<'_>,
    motion: &PeriodicMotion,
    samples: usize,
) -> (Vec<f64>, Vec<f64>) {
    let (count, n) = (objective.bounds.keeps.len(), motion.joints.len());
    let smallest = least(motion, samples, &mut |state| {
        let keeps = objective.bounds.keeps.iter();
        let mut all: Vec<f64> = keeps
            .map(|k| k.distance(objective.bounds.points, &state.q))
            .collect();
        if objective.has_efforts() {
            let sample = objective.information.samples(vec![state]);
            let efforts = objective.information.smooth_efforts(&sample[0]);
            all.extend(efforts.iter().flat_map(|effort| [*effort, -effort]));
        }
        all
    });
    let (keeps, efforts) = smallest.split_at(count);
    let shares = match objective.has_efforts() {
        true => shares_of(objective, |j| (-efforts[2 * j]).max(-efforts[2 * j + 1])),
        false => vec![0.0; n],
    };
    (keeps.to_vec(), shares)
}

/// Returns whether planes and limits of efforts permit a motion.
fn permitted(objective: &Objective<'_>, motion: &PeriodicMotion, samples: usize) -> bool {
    if objective.bounds.keeps.is_empty() && !objective.has_efforts() {
        return true;
    }
    let (keeps, efforts) = used(objective, motion, samples);
    keeps.iter().all(|d| *d > 0.0) && efforts.iter().all(|share| *share <= 1.0)
}

/// Returns the motion with each joint's motion about its centre as large as its limits permit, at most as it is; then
/// all of them as large as planes and efforts permit; `None` if these do not permit the centres.
fn within(
    objective: &Objective<'_>,
    mut motion: PeriodicMotion,
    samples: usize,
) -> Option<PeriodicMotion> {
    for (series, limits) in motion.joints.iter_mut().zip(objective.bounds.joints) {
        *series = series.scaled(limits.room(series, motion.frequency).min(1.0));
    }
    if permitted(objective, &motion, samples) {
        return Some(motion);
    }
    if !permitted(objective, &motion.scaled(0.0), 1) {
        return None;
    }
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        match permitted(objective, &motion.scaled(middle), samples) {
            true => low = middle,
            false => high = middle,
        }
    }
    Some(motion.scaled(low))
}

/// Returns a random motion that touches a limit of each joint, unless planes or efforts shrink it; `None` if these
/// permit no centre.
fn random_motion(
    objective: &Objective<'_>,
    random: &mut Random,
    nearest: &mut Nearest,
) -> Option<PeriodicMotion> {
    let numbers = DVector::from_fn(objective.shape.len(), |_, _| random.signed());
    let mut motion = objective.shape.motion(&numbers);
    let frequency = motion.frequency;
    for (series, limits) in motion.joints.iter_mut().zip(objective.bounds.joints) {
        series.centre = 0.0;
        let [q, ..] = series.extremes(frequency);
        let wide = JointLimits {
            position: [f64::NEG_INFINITY, f64::INFINITY],
            ..*limits
        };
        let size = 2.0 * limits.half() / (q[1] - q[0]);
        *series = series.scaled(size.min(wide.room(series, frequency)));
    }
    let draw = |motion: &mut PeriodicMotion, random: &mut Random| {
        for (series, limits) in motion.joints.iter_mut().zip(objective.bounds.joints) {
            series.centre = 0.0;
            let [q, ..] = series.extremes(frequency);
            let [low, high] = [limits.position[0] - q[0], limits.position[1] - q[1]];
            series.centre = low + (high - low) * random.unit();
        }
    };
    for _ in 0..CENTRES {
        draw(&mut motion, random);
        if nearest.note(objective, &motion.scaled(0.0).at(0.0)) {
            return within(objective, motion, COARSE);
        }
    }
    None
}
