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
/// Frequencies count up to the one above which the power is so many times that of the steps of the encoder.
const ABOVE_STEPS: f64 = 4.0;
/// Smaller changes of a position, rad or m, are rounding of the table.
const LEAST_STEP: f64 = 1e-9;
/// The cut is at least so many times the highest excited frequency.
const MARGIN: f64 = 5.0;
/// The cut is at most this share of the rate.
const HIGHEST: f64 = 0.2;

/// Returns the default cut, Hz: the frequency above which 1e-4 of the power of the accelerations is left, but at least
/// five times the highest excited one; the largest of all joints. Noise has no part in it: its floor is the median of
/// the upper half of the spectrum, and only what exceeds it counts, up to the frequency above which the steps of the
/// encoder explain the rest.
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
    let motion = highest_of_motion(q, &power);
    // Power of the accelerations, (2πf)⁴ times that of the positions.
    let bend: Vec<f64> = power
        .iter()
        .enumerate()
        .map(|(k, p)| match k <= motion && *p > ABOVE_NOISE * noise {
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

/// Returns the highest index above which the series holds more than the steps of its encoder explain. Steps of a slow
/// joint make lines at its speed divided by the step, high above the floor and the motion; together they have the
/// variance step²/12.
fn highest_of_motion(q: &[f64], power: &[f64]) -> usize {
    let changes = q.windows(2).map(|q| (q[1] - q[0]).abs());
    let step = changes
        .filter(|change| *change > LEAST_STEP)
        .fold(f64::INFINITY, f64::min);
    if !step.is_finite() {
        return 0;
    }
    // Of white numbers with the variance s² half of Σ|X_k|² is n²/2 · 3/8 · s², with Hann's window.
    let n = q.len() as f64;
    let steps = ABOVE_STEPS * n * n * (3.0 / 16.0) * step * step / 12.0;
    let mut above = 0.0;
    let highest = power.iter().rposition(|p| {
        above += p;
        above > steps
    });
    highest.unwrap_or(0)
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

    /// A slow joint at 1 kHz: the steps make lines from 0 to 200 Hz, far above the floor beyond them.
    #[test]
    fn the_cut_does_not_follow_the_steps_of_a_slow_joint() {
        let step = TAU / 131_072.0;
        for (size, hertz) in [(0.016, 0.1), (0.004, 0.3), (0.05, 0.1), (0.3, 0.2)] {
            let q = |i: i32| size * (TAU * hertz * f64::from(i) / 1000.0).sin();
            let q: Vec<f64> = (0..20_000).map(|i| (q(i) / step).round() * step).collect();
            let log = EvenLog {
                step: 1e-3,
                start: 0.0,
                q: vec![q],
                tau: vec![],
                spikes: vec![],
            };
            let cut = default_cut(&log);
            assert!(cut <= 8.0 * hertz.max(0.125), "{size} rad: {cut} Hz");
        }
    }
}
