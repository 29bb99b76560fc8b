//! The zero-phase low-pass filter, and derivatives.

mod butterworth;
mod zero_phase;

pub use butterworth::{Biquad, butterworth};
pub use zero_phase::zero_phase;

/// Returns the rate of a series with equal steps: central differences of fourth order, (x₋₂ − 8 x₋₁ + 8 x₁ − x₂)/12h,
/// of second order beside the ends, one-sided at them.
pub fn rate(x: &[f64], step: f64) -> Vec<f64> {
    let n = x.len();
    let at = |i: usize| match i {
        _ if n < 2 => 0.0,
        0 => (x[1] - x[0]) / step,
        _ if i == n - 1 => (x[i] - x[i - 1]) / step,
        _ if i == 1 || i == n - 2 => (x[i + 1] - x[i - 1]) / (2.0 * step),
        _ => (x[i - 2] - 8.0 * x[i - 1] + 8.0 * x[i + 1] - x[i + 2]) / (12.0 * step),
    };
    (0..n).map(at).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rates_of_a_cubic_are_exact_inside() {
        let x: Vec<f64> = (0..9).map(|i| (0.1 * f64::from(i)).powi(3)).collect();
        let v = rate(&x, 0.1);
        for i in 2..7 {
            assert!((v[i] - 3.0 * (0.1 * i as f64).powi(2)).abs() < 1e-14);
        }
    }
}
