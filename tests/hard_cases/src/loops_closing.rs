//! Bar C4: positions close from a distance, in few steps, on their branch, up to the end of the reach.

use bgdyn_runtime::Dd;
use hard_cases_compiled::loops::{Closed, closed, spec};

use crate::Extent;
use crate::loop_bars::exactly;
use crate::loop_exact::determinant;
use crate::loop_tree::Tree;
use crate::loops_states::MECHANISMS;
use crate::outcome::Outcome;
use crate::reference::larger;
use crate::rng::Rng;

/// The largest step of Newton's method, rad or m.
const LARGEST: f64 = 0.5;

/// Returns by how much the loops are open, in units of eps and of their sizes.
fn open(tree: &Tree, q: &[f64]) -> f64 {
    let exact = exactly(q);
    let at = tree.at(&exact, &vec![Dd::ZERO; tree.len()]);
    let rows = at.open.iter().zip(tree.sizes(&exact));
    let parts = rows.map(|(open, size)| open.to_f64().abs() / (size * f64::EPSILON));
    parts.fold(0.0, larger)
}

/// Returns the largest distance of two positions.
fn apart(p: &[f64], q: &[f64]) -> f64 {
    let parts = p.iter().zip(q).map(|(p, q)| (p - q).abs());
    parts.fold(0.0, larger)
}

/// Returns the number of Newton steps after which the loops are open by no more than 8 eps of their size; 30 at
/// the most.
fn needed(model: &dyn Closed<f64>, tree: &Tree, from: &[f64]) -> usize {
    let mut q = from.to_vec();
    for count in 0..30 {
        if open(tree, &q) <= 8.0 {
            return count;
        }
        let step = model.closing_step(&q);
        let dependents = model.dependents();
        let most = dependents.iter().map(|d| step[d.velocity].abs());
        let scale = LARGEST / most.fold(LARGEST, larger);
        for d in dependents {
            q[d.position] -= step[d.velocity] * scale;
        }
    }
    30
}

/// What comes of closing from one distance.
#[derive(Default)]
struct Count {
    tried: usize,
    /// Starts beyond a singular position: on the side of another branch.
    beyond: usize,
    open: f64,
    needed: usize,
    taken: usize,
    refused: usize,
    /// Positions on another branch, from starts on this one's side and from others.
    other: [usize; 2],
}

/// Closes from starts whose dependent positions are off by this much, rad, and in sliding joints this part of the
/// size of the loop.
fn from(name: &str, away: f64, states: usize) -> Count {
    let (model, tree) = (closed::<f64>(name), Tree::new(spec(name), name));
    let (mut count, mut rng) = (Count::default(), Rng::new(37));
    for _ in 0..states {
        let numbers: Vec<f64> = (0..model.nv()).map(|_| rng.unit()).collect();
        let q = model.sample(&numbers);
        let size = tree.sizes(&exactly(&q)).into_iter().fold(0.0, f64::max);
        let mut start = q.clone();
        // One is off by all of it, the others by up to that.
        let farthest = rng.below(tree.dependents.len());
        for (k, &j) in tree.dependents.iter().enumerate() {
            let share = if k == farthest {
                *rng.pick(&[1.0, -1.0])
            } else {
                rng.within(1.0)
            };
            start[j] += share * away * if tree.turns(j) { 1.0 } else { size };
        }
        count.tried += 1;
        let side = |q: &[f64]| determinant(&tree, &exactly(q)) > 0.0;
        let beyond = side(&start) != side(&q);
        count.beyond += usize::from(beyond);
        let Ok(found) = model.close(&start) else {
            count.refused += 1;
            continue;
        };
        count.open = larger(count.open, open(&tree, &found));
        count.taken = count.taken.max(model.count_steps(&start).0);
        count.needed = count.needed.max(needed(&*model, &tree, &start));
        if apart(&found, &q) > 1e-6 {
            count.other[usize::from(beyond)] += 1;
        }
    }
    count
}

/// Closes all mechanisms from 0.1 and 0.5 rad away.
pub(crate) fn distances(extent: Extent) -> Vec<Outcome> {
    let states = extent.of(10_000, 100);
    let mut outcomes = vec![];
    for name in MECHANISMS {
        for (away, steps) in [(0.1, 4.0), (0.5, 8.0)] {
            let count = from(name, away, states);
            let mut row = |what: &str, measured: f64, allowed: f64| {
                let quantity = format!("{what}; {away} rad away");
                let at = format!("{} states, {} beyond", count.tried, count.beyond);
                outcomes.push(Outcome::new(name, "C4", quantity, measured, allowed).at(at));
            };
            row("open after close, in eps of the size", count.open, 8.0);
            row("Newton steps until open by 8 eps", count.needed as f64, steps);
            row("Newton steps of close", count.taken as f64, steps);
            row("not closed", count.refused as f64, 0.0);
            row("on another branch, from this one's side", count.other[0] as f64, 0.0);
            row("on another branch, from beyond", count.other[1] as f64, 0.0);
        }
    }
    outcomes
}

/// A mechanism at the end of its reach: the independent position there, in two words, its place in q, and the
/// dependent positions.
struct End {
    name: &'static str,
    at: Dd,
    place: usize,
    q: Vec<f64>,
}

/// Returns x with sin x = y, from an approximation.
fn arc(y: Dd, near: f64) -> Dd {
    let mut x = Dd::from_f64(near);
    for _ in 0..4 {
        let (sin, cos) = x.sin_cos();
        x -= (sin - y) / cos;
    }
    x
}

/// A crank of 0.2 m with a rod of 0.15 m: sin θ = 3/4, the rod upright. And two cranks of 0.25 m whose elbows are
/// 0.7 m apart, twice the rods' length, both as far outward: sin φ = 4/5, φ from upright.
fn ends() -> [End; 2] {
    let number = |x: f64| Dd::from_f64(x);
    let crank = arc(number(0.75), 0.848);
    let quarter = arc(number(1.0) / number(2.0).sqrt(), 0.785);
    let right_angle = quarter + quarter;
    let lean = arc(number(4.0) / number(5.0), 0.927);
    let short = crank.to_f64();
    let upright = right_angle.to_f64();
    let [first, second] = [upright + lean.to_f64(), upright - lean.to_f64()];
    [
        End {
            name: "short_rod",
            at: crank,
            place: 0,
            q: vec![short, -upright - short, 0.2 * short.cos()],
        },
        End {
            name: "five_bar",
            at: right_angle + lean,
            place: 0,
            q: vec![first, -first, second, std::f64::consts::PI - second],
        },
    ]
}

/// Distances from the end of the reach in units in the last place of its position.
struct Reached {
    /// The nearest one inside from which on all close.
    inside: f64,
    /// The farthest one outside that closes to 8 eps.
    accepted: f64,
    /// The farthest one outside that closes to more than 8 eps.
    wrong: f64,
}

/// Closes on either side of the end, from the positions at the end or from those `back`, rad, inside.
fn reach(end: &End, back: f64) -> Reached {
    let (model, tree) = (closed::<f64>(end.name), Tree::new(spec(end.name), end.name));
    let ulp = f64::EPSILON * 2_f64.powi(end.at.to_f64().log2().floor() as i32);
    let mut guess = end.q.clone();
    // A walk from the start of the mechanism keeps the branch.
    if back > 0.0 {
        guess = model.neutral();
        let (from, to) = (guess.clone(), end.at.to_f64() - back);
        for k in 1..=200 {
            for j in &tree.independents {
                let wanted = if *j == end.place { to } else { end.q[*j] };
                guess[*j] = from[*j] + (wanted - from[*j]) * f64::from(k) / 200.0;
            }
            guess = model.close(&guess).expect("inside");
        }
    }
    let mut reached = Reached {
        inside: 0.0,
        accepted: 0.0,
        wrong: 0.0,
    };
    // Eight distances an octave, up to 0.05 rad.
    let mut distances: Vec<f64> = (0..400).map(|k| 2_f64.powf(f64::from(k) / 8.0).round()).collect();
    distances.retain(|d| d * ulp < 0.05);
    for d in distances {
        let mut at = |x: f64| {
            guess[end.place] = x;
            model.close(&guess).ok()
        };
        let here = end.at.to_f64();
        if at(here - d * ulp).is_none() {
            reached.inside = d;
        }
        if let Some(q) = at(here + d * ulp) {
            match open(&tree, &q) <= 8.0 {
                true => reached.accepted = d,
                false => reached.wrong = d,
            }
        }
    }
    reached
}

/// Closes near the end of the reach.
pub(crate) fn ends_of_reach(_: Extent) -> Vec<Outcome> {
    let mut outcomes = vec![];
    for end in ends() {
        for (back, guess) in [(0.0, "the end"), (0.01, "0.01 rad inside")] {
            let Reached {
                inside,
                accepted,
                wrong,
            } = reach(&end, back);
            let mut row = |what: &str, measured: f64, allowed: f64| {
                let quantity = format!("{what}, ulp; from {guess}");
                outcomes.push(Outcome::new(end.name, "C4", quantity, measured, allowed));
            };
            row("refused inside the reach, up to", inside, 4.0);
            row("closed beyond the reach, up to", accepted, 4.0);
            row("beyond, but open by more than 8 eps, up to", wrong, 0.0);
        }
    }
    outcomes
}
