//! A filter forward and backward: the phases cancel (Gustafsson 1996; here with odd reflection at the ends).

use super::Biquad;

/// Filters a series forward and backward. The ends are continued by odd reflection, 2 x₀ − x_k, over `pad` samples at
/// most, and each pass starts in the steady state of its first sample.
pub fn zero_phase(sections: &[Biquad], x: &[f64], pad: usize) -> Vec<f64> {
    let (Some(&first), Some(&last)) = (x.first(), x.last()) else {
        return Vec::new();
    };
    let pad = pad.min(x.len() - 1);
    let before = (1..=pad).rev().map(|k| 2.0 * first - x[k]);
    let after = (1..=pad).map(|k| 2.0 * last - x[x.len() - 1 - k]);
    let mut y: Vec<f64> = before.chain(x.iter().copied()).chain(after).collect();
    for _ in 0..2 {
        for section in sections {
            let start = y[0];
            section.run(&mut y, section.steady().map(|s| s * start));
        }
        y.reverse();
    }
    y[pad..pad + x.len()].to_vec()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::filter::butterworth;
    use std::f64::consts::TAU;

    /// Returns the gain at a frequency, from the middle of a long series.
    fn gain(frequency: f64) -> f64 {
        let t = |i: usize| i as f64 * 1e-3;
        let x: Vec<f64> = (0..8000).map(|i| (TAU * frequency * t(i)).sin()).collect();
        let y = zero_phase(&butterworth(10.0, 1000.0), &x, 500);
        let middle = 2000..6000;
        let dot: f64 = middle.clone().map(|i| x[i] * y[i]).sum();
        dot / middle.map(|i| x[i] * x[i]).sum::<f64>()
    }

    #[test]
    fn the_gain_is_that_of_the_squared_filter() {
        // |H|² = 1/(1 + (f/f_c)⁸), of the frequencies warped by the bilinear map.
        let warped = |f: f64| (std::f64::consts::PI * f / 1000.0).tan();
        for f in [1.0, 5.0, 10.0, 20.0] {
            let expected = 1.0 / (1.0 + (warped(f) / warped(10.0)).powi(8));
            assert!(
                (gain(f) - expected).abs() < 1e-6,
                "{f} Hz: {} for {expected}",
                gain(f)
            );
        }
    }

    #[test]
    fn straight_lines_pass_with_their_ends() {
        let x: Vec<f64> = (0..400).map(|i| 3.0 - 0.01 * f64::from(i)).collect();
        let y = zero_phase(&butterworth(20.0, 500.0), &x, 200);
        assert!(x.iter().zip(&y).all(|(x, y)| (x - y).abs() < 1e-6));
    }
}
