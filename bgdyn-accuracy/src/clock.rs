//! Measures the times of configurations, alternating between them.

use std::hint::black_box;
use std::time::Instant;

use crate::configuration::{Configuration, Grid, StepControl};
use crate::step_sequence::Effort;

/// Largest number of runs of one measurement.
const RUNS: usize = 1000;

/// Measurements of a round, of which the shortest counts, without interruptions.
const BEST_OF: usize = 3;

/// Returns the time of each of these runs per simulated millisecond, ns: the median of the rounds. Every
/// round measures all of them in turn, so that a temporary slowdown of the machine affects all equally.
pub(crate) fn times(
    jobs: &[(&Configuration, StepControl)],
    grid: &Grid,
    effort: &Effort,
) -> Vec<f64> {
    let repeat: Vec<usize> = jobs
        .iter()
        .map(|job| {
            let once = seconds(job, grid, 1).max(1e-9);
            ((effort.resolution / once).ceil() as usize).clamp(1, RUNS)
        })
        .collect();
    let mut rounds = vec![Vec::with_capacity(effort.rounds); jobs.len()];
    for _ in 0..effort.rounds {
        for ((job, &runs), found) in jobs.iter().zip(&repeat).zip(&mut rounds) {
            let tried = (0..BEST_OF).map(|_| seconds(job, grid, runs));
            found.push(tried.fold(f64::INFINITY, f64::min) / runs as f64);
        }
    }
    let per_ms = 1e9 / (1e3 * grid.end);
    rounds
        .iter_mut()
        .map(|found| per_ms * median(found))
        .collect()
}

/// Rounds in which calls are measured, as a multiple of those for runs.
const CALL_ROUNDS: usize = 5;

/// The distribution of a time over the rounds of its measurement, ns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spread {
    /// The shortest round.
    pub least: f64,
    /// The first and the third quartile.
    pub quartiles: [f64; 2],
    /// The median.
    pub median: f64,
}

impl Spread {
    /// Returns a time without spread: an estimate.
    pub fn exact(ns: f64) -> Self {
        Spread {
            least: ns,
            quartiles: [ns; 2],
            median: ns,
        }
    }

    /// Returns the distribution of the times of some rounds.
    fn of_rounds(rounds: &mut [f64]) -> Self {
        rounds.sort_by(f64::total_cmp);
        let at = |quarters: usize| rounds[quarters * (rounds.len() - 1) / 4];
        Spread {
            least: at(0),
            quartiles: [at(1), at(3)],
            median: at(2),
        }
    }
}

/// Returns the time of one call, ns, of each of these functions, whose argument is the number of calls,
/// measured as [`times`] measures runs, in more rounds.
pub(crate) fn calls(jobs: &[&dyn Fn(usize)], effort: &Effort) -> Vec<Spread> {
    let spent = |job: &dyn Fn(usize), count: usize| {
        let begin = Instant::now();
        job(black_box(count));
        begin.elapsed().as_secs_f64()
    };
    let enough = |job: &dyn Fn(usize)| {
        let mut count = 64;
        while spent(job, count) < effort.resolution && count < 1 << 24 {
            count *= 2;
        }
        count
    };
    let counts: Vec<usize> = jobs.iter().map(|job| enough(*job)).collect();
    let repeats = CALL_ROUNDS * effort.rounds;
    let mut rounds = vec![Vec::with_capacity(repeats); jobs.len()];
    for _ in 0..repeats {
        for ((job, &count), found) in jobs.iter().zip(&counts).zip(&mut rounds) {
            let tried = (0..BEST_OF).map(|_| spent(*job, count));
            found.push(1e9 * tried.fold(f64::INFINITY, f64::min) / count as f64);
        }
    }
    let spread = |found: &mut Vec<f64>| Spread::of_rounds(found);
    rounds.iter_mut().map(spread).collect()
}

/// Measures this number of runs, s.
fn seconds(
    (configuration, step_control): &(&Configuration, StepControl),
    grid: &Grid,
    runs: usize,
) -> f64 {
    let begin = Instant::now();
    for _ in 0..runs {
        let _ = black_box((configuration.run)(
            black_box(grid),
            black_box(*step_control),
        ));
    }
    begin.elapsed().as_secs_f64()
}

fn median(numbers: &mut [f64]) -> f64 {
    numbers.sort_by(f64::total_cmp);
    numbers[numbers.len() / 2]
}

#[cfg(test)]
mod tests {
    use super::Spread;

    #[test]
    fn a_spread_has_least_quartiles_and_median() {
        let spread = Spread::of_rounds(&mut [9.0, 1.0, 2.0, 100.0, 3.0]);
        assert_eq!((spread.least, spread.median), (1.0, 3.0));
        assert_eq!(spread.quartiles, [2.0, 9.0]);
        let one = Spread::of_rounds(&mut [7.0]);
        assert_eq!(one, Spread::exact(7.0));
    }

    #[test]
    fn the_middle_one_counts() {
        assert_eq!(super::median(&mut [9.0, 1.0, 2.0, 100.0, 3.0]), 3.0);
    }
}
