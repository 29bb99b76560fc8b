//! Rows for least squares: positions filtered and differentiated, the regressor and the efforts through the same filter
//! (then its gain does not bias), decimated to what the filter leaves independent.

use nalgebra::DMatrix;

use crate::even::EvenLog;
use crate::filter::{butterworth, rate, zero_phase};
use crate::model::{BODY_PARAMETERS, Model, joint_columns};

/// Time that is left out at both ends, s.
const EDGE: f64 = 0.3;
/// Every k-th row is kept, k = 0.4 rate/cut.
const KEEP: f64 = 0.4;
/// Rows of the regressor that are filtered at once.
const PART: usize = 8192;
/// Periods of the cut after which the filter has forgotten to 1e-9.
const MEMORY: f64 = 9.0;

/// Filtered rows.
#[derive(Clone, Debug, PartialEq)]
pub struct Samples {
    /// Number of joints; row `s * joints + j` belongs to joint j at time s.
    pub joints: usize,
    /// The regressor of all unknowns.
    pub rows: DMatrix<f64>,
    /// Efforts in the same order.
    pub tau: Vec<f64>,
    /// Positions in the same order.
    pub q: Vec<f64>,
    /// Velocities in the same order.
    pub v: Vec<f64>,
    /// Times, s.
    pub time: Vec<f64>,
    /// Time between two rows, s.
    pub step: f64,
}

/// Returns the filtered rows of a log; calls `progress` with the finished share.
pub fn prepare(
    model: &Model<'_>,
    log: &EvenLog,
    cut: f64,
    progress: &mut dyn FnMut(f64),
) -> Samples {
    let sections = butterworth(cut, 1.0 / log.step);
    let pad = (MEMORY / (cut * log.step)) as usize;
    let smooth = |x: &[Vec<f64>]| -> Vec<Vec<f64>> {
        x.iter().map(|x| zero_phase(&sections, x, pad)).collect()
    };
    let rates = |x: &[Vec<f64>]| -> Vec<Vec<f64>> { x.iter().map(|x| rate(x, log.step)).collect() };
    let (q, tau) = (smooth(&log.q), smooth(&log.tau));
    let v = rates(&q);
    let motion = Motion { a: rates(&v), v, q };
    let n = model.joints.len();
    let every = ((KEEP / (cut * log.step)) as usize).max(1);
    let edge = ((EDGE / log.step) as usize).min(log.len() / 4);
    let kept: Vec<usize> = (edge..log.len() - edge).step_by(every).collect();
    let of_bodies = BODY_PARAMETERS * model.rows.bodies();
    let mut rows = DMatrix::zeros(kept.len() * n, of_bodies + 4 * n);
    let mut done = 0;
    while done < kept.len() {
        // A part is filtered with its surroundings, as far as the filter remembers.
        let first = kept[done];
        let until = kept[done..].partition_point(|i| *i < first + PART) + done;
        let from = first.saturating_sub(pad);
        let to = (kept[until - 1] + pad + 1).min(log.len());
        let series = Series::new(model, &motion, from..to);
        for (column, joint, x) in series.all(of_bodies) {
            let y = zero_phase(&sections, &x, pad);
            for s in done..until {
                rows[(s * n + joint, column)] = y[kept[s] - from];
            }
        }
        done = until;
        progress(done as f64 / kept.len() as f64);
    }
    let pick = |x: &[Vec<f64>]| {
        kept.iter()
            .flat_map(|&i| x.iter().map(move |x| x[i]))
            .collect()
    };
    Samples {
        joints: n,
        tau: pick(&tau),
        q: pick(&motion.q),
        v: pick(&motion.v),
        time: kept
            .iter()
            .map(|&i| log.start + i as f64 * log.step)
            .collect(),
        step: every as f64 * log.step,
        rows: of_links(model, &rows),
    }
}

/// Positions, velocities and accelerations by joint.
struct Motion {
    q: Vec<Vec<f64>>,
    v: Vec<Vec<f64>>,
    a: Vec<Vec<f64>>,
}

/// The regressor over time, not filtered.
struct Series<'a> {
    motion: &'a Motion,
    range: std::ops::Range<usize>,
    /// The series of (joint, column of the bodies), empty where it is zero at all times.
    of_bodies: Vec<Vec<f64>>,
}

impl<'a> Series<'a> {
    fn new(model: &Model<'_>, motion: &'a Motion, range: std::ops::Range<usize>) -> Self {
        let n = model.joints.len();
        let columns = BODY_PARAMETERS * model.rows.bodies();
        let mut of_bodies: Vec<Vec<f64>> = vec![Vec::new(); n * columns];
        let mut rows = DMatrix::zeros(n, columns);
        let at = |x: &[Vec<f64>], i: usize| x.iter().map(|x| x[i]).collect::<Vec<f64>>();
        for (k, i) in range.clone().enumerate() {
            let (q, v, a) = (at(&motion.q, i), at(&motion.v, i), at(&motion.a, i));
            model.rows.effort_rows(&q, &v, &a, &mut rows);
            for (x, series) in rows.iter().zip(&mut of_bodies) {
                if *x != 0.0 || !series.is_empty() {
                    series.resize(k, 0.0);
                    series.push(*x);
                }
            }
        }
        let count = range.len();
        let filled = of_bodies.iter_mut().filter(|s| !s.is_empty());
        filled.for_each(|s| s.resize(count, 0.0));
        Series {
            motion,
            range,
            of_bodies,
        }
    }

    /// Returns column, joint and series: those of the bodies at first, then those of the joints.
    fn all(&self, columns: usize) -> impl Iterator<Item = (usize, usize, Vec<f64>)> + '_ {
        let n = self.motion.q.len();
        let bodies = self
            .of_bodies
            .iter()
            .enumerate()
            .filter(|(_, x)| !x.is_empty());
        let bodies = bodies.map(move |(k, x)| (k / n, k % n, x.clone()));
        let joints = (0..4).flat_map(move |c| (0..n).map(move |j| (c, j)));
        let joints = joints.map(move |(c, j)| {
            let (v, a) = (&self.motion.v[j], &self.motion.a[j]);
            let own = self.range.clone().map(|i| joint_columns(v[i], a[i])[c]);
            (columns + c * n + j, j, own.collect())
        });
        bodies.chain(joints)
    }
}

/// Returns the rows of links and joints from those of bodies and joints: the map is constant, so that it may follow
/// the filter.
fn of_links(model: &Model<'_>, rows: &DMatrix<f64>) -> DMatrix<f64> {
    let bodies = BODY_PARAMETERS * model.rows.bodies();
    let joints = rows.ncols() - bodies;
    let of_links = model.rows_of_links(&rows.columns(0, bodies).into());
    let links = of_links.ncols();
    let mut all = of_links.resize_horizontally(links + joints, 0.0);
    all.columns_mut(links, joints)
        .copy_from(&rows.columns(bodies, joints));
    all
}
