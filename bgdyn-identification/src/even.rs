//! Equal steps: spikes of the efforts are replaced, and all series are taken at multiples of the median step.

use crate::log::Log;
use crate::statistics::{median, quantile};

/// Half the width of the running median.
const HALF: usize = 2;
/// Robust deviations beyond which an effort is a spike.
const SPIKE: f64 = 6.0;
/// Relative jitter above which series are interpolated by cubics, not by lines.
const JITTER: f64 = 0.05;

/// A log with equal steps.
#[derive(Clone, Debug, PartialEq)]
pub struct EvenLog {
    /// The step, s.
    pub step: f64,
    /// The time of the first sample, s.
    pub start: f64,
    /// Positions by joint, rad or m.
    pub q: Vec<Vec<f64>>,
    /// Efforts by joint, N·m or N.
    pub tau: Vec<Vec<f64>>,
    /// Number of replaced efforts by joint.
    pub spikes: Vec<usize>,
}

impl EvenLog {
    /// Returns the number of samples.
    pub fn len(&self) -> usize {
        self.q.first().map_or(0, Vec::len)
    }

    /// Returns whether there are no samples.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Returns the samples of a range.
    pub fn part(&self, range: std::ops::Range<usize>) -> EvenLog {
        let cut = |all: &[Vec<f64>]| all.iter().map(|x| x[range.clone()].to_vec()).collect();
        EvenLog {
            step: self.step,
            start: self.start + range.start as f64 * self.step,
            q: cut(&self.q),
            tau: cut(&self.tau),
            spikes: self.spikes.clone(),
        }
    }
}

/// Returns the log with equal steps.
pub fn even(log: &Log) -> EvenLog {
    let step = log.median_step();
    let count = ((log.time[log.time.len() - 1] - log.time[0]) / step + 1e-6) as usize + 1;
    let cubic = log.jitter() > JITTER;
    let resample = |x: &[f64], cubic: bool| -> Vec<f64> {
        let mut at = 0;
        let times = (0..count).map(|i| log.time[0] + i as f64 * step);
        times
            .map(|t| interpolate(&log.time, x, t, &mut at, cubic))
            .collect()
    };
    let cleaned: Vec<(Vec<f64>, usize)> = log.tau.iter().map(|tau| without_spikes(tau)).collect();
    EvenLog {
        step,
        start: log.time[0],
        q: log.q.iter().map(|q| resample(q, cubic)).collect(),
        tau: cleaned
            .iter()
            .map(|(tau, _)| resample(tau, false))
            .collect(),
        spikes: cleaned.iter().map(|(_, count)| *count).collect(),
    }
}

/// Replaces efforts that differ from the running median by more than [`SPIKE`] robust deviations; returns their number.
fn without_spikes(x: &[f64]) -> (Vec<f64>, usize) {
    let smooth: Vec<f64> = (0..x.len())
        .map(|i| median(x[i.saturating_sub(HALF)..(i + HALF + 1).min(x.len())].to_vec()))
        .collect();
    let off: Vec<f64> = x.iter().zip(&smooth).map(|(x, s)| (x - s).abs()).collect();
    // Where a slope is steeper than the noise most samples are the median themselves: the 90 % quantile is robust too.
    let bound = SPIKE * quantile(off.clone(), 0.9) / 1.645 + 1e-12;
    let mut clean = x.to_vec();
    let mut spikes = 0;
    for i in 0..x.len() {
        if off[i] > bound {
            clean[i] = smooth[i];
            spikes += 1;
        }
    }
    (clean, spikes)
}

/// Returns the value at a time: on the line between the neighbours, or on the cubic through four of them (Lagrange).
/// `at` is the last interval, for calls with increasing times.
fn interpolate(times: &[f64], x: &[f64], t: f64, at: &mut usize, cubic: bool) -> f64 {
    while *at + 2 < times.len() && times[*at + 1] < t {
        *at += 1;
    }
    let i = *at;
    if i + 1 >= times.len() {
        return x[i];
    }
    if !cubic || i == 0 || i + 2 >= times.len() {
        let share = ((t - times[i]) / (times[i + 1] - times[i])).clamp(0.0, 1.0);
        return x[i] + share * (x[i + 1] - x[i]);
    }
    let four = i - 1..i + 3;
    let weight = |k: usize| -> f64 {
        let others = four.clone().filter(|j| *j != k);
        others
            .map(|j| (t - times[j]) / (times[k] - times[j]))
            .product()
    };
    four.clone().map(|k| weight(k) * x[k]).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spike_is_replaced_and_a_curve_is_not() {
        let mut x: Vec<f64> = (0..200)
            .map(|i| (0.05 * f64::from(i)).sin() + 0.02 * f64::from(i * 7 % 5 - 2))
            .collect();
        x[77] += 3.0;
        let (clean, spikes) = without_spikes(&x);
        assert_eq!(spikes, 1);
        assert!((clean[77] - (0.05 * 77.0_f64).sin()).abs() < 0.1);
    }

    #[test]
    fn uneven_stamps_of_a_cubic_are_evened_exactly() {
        let time: Vec<f64> = (0..60)
            .map(|i| f64::from(i) + 0.2 * f64::from(i * 7 % 5 - 2))
            .collect();
        let x: Vec<f64> = time.iter().map(|t| t * t * t - 4.0 * t).collect();
        let mut at = 0;
        for t in [5.0, 17.3, 40.0] {
            let y = interpolate(&time, &x, t, &mut at, true);
            assert!((y - (t * t * t - 4.0 * t)).abs() < 1e-8 * y.abs());
        }
    }
}
