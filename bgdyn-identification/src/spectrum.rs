//! The default cut of the filter, from the spectrum of the positions.

use std::f64::consts::TAU;

use rustfft::FftPlanner;
use rustfft::num_complex::Complex;

use crate::even::EvenLog;
use crate::statistics::median;

/// Share of the power of the accelerations that may lie above the cut.
const LEFT: f64 = 1e-4;
/// A frequency is excited if it has this share of the largest power of the accelerations.
const EXCITED: f64 = 0.01;
/// A frequency counts if its power is so many times the floor of the noise.
const ABOVE_NOISE: f64 = 20.0;
/// The cut is at least so many times the highest excited frequency.
const MARGIN: f64 = 5.0;
/// The cut is at most this share of the rate.
const HIGHEST: f64 = 0.2;

/// Returns the default cut, Hz: the frequency above which 1e-4 of the power of the accelerations is left, but at least
/// five times the highest excited one; the largest of all joints. Noise has no part in it: its floor is the median of
/// the upper half of the spectrum, and only what exceeds it counts.
pub fn default_cut(log: &EvenLog) -> f64 {
    let rate = 1.0 / log.step;
    let cuts = log.q.iter().map(|q| cut_of(q, rate));
    cuts.fold(0.0, f64::max)
        .clamp(1.0_f64.min(HIGHEST * rate), HIGHEST * rate)
}

fn cut_of(q: &[f64], rate: f64) -> f64 {
    let power = power_spectrum(q);
    let n = q.len();
    let frequency = |k: usize| k as f64 * rate / n as f64;
    let noise = median(power[power.len() / 2..].to_vec());
    // Power of the accelerations, (2πf)⁴ times that of the positions.
    let bend: Vec<f64> = power
        .iter()
        .enumerate()
        .map(|(k, p)| match *p > ABOVE_NOISE * noise {
            true => (TAU * frequency(k)).powi(4) * (p - noise),
            false => 0.0,
        })
        .collect();
    let total: f64 = bend.iter().sum();
    let most = bend.iter().fold(0.0_f64, |m, p| m.max(*p));
    let excited = bend.iter().rposition(|p| *p > EXCITED * most).unwrap_or(0);
    let mut above = 0.0;
    let left = (0..bend.len()).rev().find(|&k| {
        above += bend[k];
        above > LEFT * total
    });
    frequency(left.unwrap_or(0)).max(MARGIN * frequency(excited))
}

/// Returns |X_k|² up to half the rate, of the series without its straight line, under Hann's window.
fn power_spectrum(x: &[f64]) -> Vec<f64> {
    let n = x.len();
    let (first, last) = (x[0], x[n - 1]);
    let line = |i: usize| first + (last - first) * i as f64 / (n - 1).max(1) as f64;
    let window = |i: usize| 0.5 - 0.5 * (TAU * (i as f64 + 0.5) / n as f64).cos();
    let mut buffer: Vec<Complex<f64>> = x
        .iter()
        .enumerate()
        .map(|(i, x)| Complex::new((x - line(i)) * window(i), 0.0))
        .collect();
    FftPlanner::new().plan_fft_forward(n).process(&mut buffer);
    buffer[..n / 2].iter().map(Complex::norm_sqr).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_cut_follows_the_motion_and_not_the_noise() {
        // 0.5 Hz with the steps of an encoder of 17 bits, at 500 Hz: noise has most of the power of the accelerations.
        let step = TAU / 131_072.0;
        let q = |i: i32| {
            0.8 * (TAU * 0.5 * f64::from(i) / 500.0).sin()
                + 0.3 * (0.1234 * f64::from(i) / 500.0).cos()
        };
        let q: Vec<f64> = (0..10_000).map(|i| (q(i) / step).round() * step).collect();
        let log = EvenLog {
            step: 2e-3,
            start: 0.0,
            q: vec![q],
            tau: vec![],
            spikes: vec![],
        };
        let cut = default_cut(&log);
        assert!((2.4..3.2).contains(&cut), "{cut} Hz");
    }
}
