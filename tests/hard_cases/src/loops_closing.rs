//! Bar C4: positions close from a distance, in few steps, on their branch, up to the end of the reach.

use bgdyn_runtime::Dd;
use hard_cases_compiled::loops::{Closed, closed, spec};

use crate::Extent;
use crate::loop_bars::exactly;
use crate::loop_tree::Tree;
use crate::loops_states::{MECHANISMS, Walk};
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
/// the most. None in closed form.
fn needed(model: &dyn Closed<f64>, tree: &Tree, from: &[f64]) -> usize {
    if model.closes_at_once() {
        return 0;
    }
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
    /// States in which more steps than allowed are needed.
    slow: usize,
    open: f64,
    needed: usize,
    refused: usize,
    /// Positions on another branch.
    other: usize,
}

/// Closes from starts whose dependent angles are off by this much, rad.
fn from(name: &str, away: f64, steps: usize, states: usize) -> Count {
    let (model, tree) = (closed::<f64>(name), Tree::new(spec(name), name));
    let (mut count, mut rng) = (Count::default(), Rng::new(37));
    let angles = tree.dependents.iter().copied().filter(|&j| tree.turns(j));
    let angles: Vec<usize> = angles.collect();
    let mut walk = Walk::new(&*model, &tree);
    for _ in 0..states {
        let q = walk.next(&mut rng);
        let mut start = q.clone();
        // One is off by all of it, the others by up to that.
        let farthest = rng.below(angles.len());
        for (k, &j) in angles.iter().enumerate() {
            let share = if k == farthest {
                *rng.pick(&[1.0, -1.0])
            } else {
                rng.within(1.0)
            };
            start[j] += share * away;
        }
        let Ok(found) = model.close(&start) else {
            count.refused += 1;
            continue;
        };
        count.open = larger(count.open, open(&tree, &found));
        if apart(&found, &q) > 1e-6 {
            count.other += 1;
            continue;
        }
        let needed = needed(&*model, &tree, &start);
        count.slow += usize::from(needed > steps);
        count.needed = count.needed.max(needed);
    }
    count
}

/// Closes all mechanisms from 0.1 and 0.5 rad away.
pub(crate) fn distances(extent: Extent) -> Vec<Outcome> {
    let states = extent.of(3_000, 100);
    let mut outcomes = vec![];
    for name in MECHANISMS {
        for (away, steps) in [(0.1, 4), (0.5, 8)] {
            let count = from(name, away, steps, states);
            let mut row = |what: &str, measured: f64, allowed: f64, at: String| {
                let quantity = format!("{what}; {away} rad away");
                outcomes.push(Outcome::new(name, "C4", quantity, measured, allowed).at(at));
            };
            let none = String::new();
            row("open, in eps of its size", count.open, 8.0, none);
            let at = format!("{} of {states} states", count.slow);
            row(
                "Newton steps to 8 eps",
                count.needed as f64,
                steps as f64,
                at,
            );
            let lost = (count.refused + count.other) as f64;
            let at = format!("{} not closed of {states} states", count.refused);
            row("not closed, or on another branch", lost, 0.0, at);
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
    /// The farthest one inside that is refused.
    inside: f64,
    /// The farthest one outside that closes to 8 eps.
    accepted: f64,
    /// The farthest one outside that closes to more than 8 eps.
    wrong: f64,
}

/// Walks from the start of the mechanism to a distance from the end, rad, inside; this keeps the branch.
fn walk(model: &dyn Closed<f64>, tree: &Tree, end: &End, distance: f64) -> Vec<f64> {
    let mut q = model.neutral();
    let (from, to) = (q.clone(), end.at.to_f64() - distance);
    for k in 1..=200 {
        for j in &tree.independents {
            let wanted = if *j == end.place { to } else { end.q[*j] };
            q[*j] = from[*j] + (wanted - from[*j]) * f64::from(k) / 200.0;
        }
        q = model.close(&q).expect("inside");
    }
    q
}

/// Closes on either side of the end, from `back`, rad, inside; inside also from twice as far from it.
fn reach(end: &End, back: f64) -> (Reached, f64) {
    let (model, tree) = (closed::<f64>(end.name), Tree::new(spec(end.name), end.name));
    let ulp = f64::EPSILON * 2_f64.powi(end.at.to_f64().log2().floor() as i32);
    let guess = walk(&*model, &tree, end, back);
    let here = end.at.to_f64();
    let close = |guess: &[f64], x: f64| {
        let mut q = guess.to_vec();
        q[end.place] = x;
        model.close(&q).ok()
    };
    let mut reached = Reached {
        inside: 0.0,
        accepted: 0.0,
        wrong: 0.0,
    };
    // Eight distances an octave, up to 0.01 rad.
    let mut distances: Vec<f64> = (0..400)
        .map(|k| 2_f64.powf(f64::from(k) / 8.0).round())
        .collect();
    distances.retain(|d| d * ulp < back);
    for d in distances {
        if close(&guess, here - d * ulp).is_none() {
            reached.inside = d;
        }
        if let Some(q) = close(&guess, here + d * ulp) {
            match open(&tree, &q) <= 8.0 {
                true => reached.accepted = d,
                false => reached.wrong = d,
            }
        }
    }
    let (mut q, mut distance) = (guess, back);
    while distance > ulp {
        match close(&q, here - distance / 2.0) {
            Some(next) => (q, distance) = (next, distance / 2.0),
            None => break,
        }
    }
    // Beyond the end, from the nearest position inside.
    for d in 1..=1_000 {
        let d = f64::from(d);
        if let Some(q) = close(&q, here + d * ulp) {
            match open(&tree, &q) <= 8.0 {
                true => reached.accepted = reached.accepted.max(d),
                false => reached.wrong = reached.wrong.max(d),
            }
        }
    }
    (reached, distance / ulp)
}

/// Closes near the end of the reach.
pub(crate) fn ends_of_reach(_: Extent) -> Vec<Outcome> {
    let mut outcomes = vec![];
    for end in ends() {
        let (reached, halving) = reach(&end, 0.01);
        let mut row = |what: &str, measured: f64, allowed: f64| {
            let quantity = format!("{what}, in ulp");
            outcomes.push(Outcome::new(end.name, "C4", quantity, measured, allowed));
        };
        row(
            "refused within reach, from 0.01 rad inside",
            reached.inside,
            4.0,
        );
        row("refused within reach, from twice as far", halving, 4.0);
        row("closed to 8 eps beyond reach", reached.accepted, 4.0);
        row("closed to more than 8 eps beyond reach", reached.wrong, 0.0);
    }
    outcomes
}
