//! Butterworth's low-pass of order 4 as two sections of second order.

use std::f64::consts::PI;

/// A section y = (b₀ + b₁ z⁻¹ + b₂ z⁻²)/(1 + a₁ z⁻¹ + a₂ z⁻²) x, with gain 1 at frequency 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Biquad {
    /// b₀, b₁, b₂.
    pub b: [f64; 3],
    /// a₁, a₂.
    pub a: [f64; 2],
}

impl Biquad {
    /// Returns the state at which a constant input of 1 gives the output 1.
    pub fn steady(&self) -> [f64; 2] {
        [1.0 - self.b[0], self.b[2] - self.a[1]]
    }

    /// Filters in place (direct form II, transposed), from a state.
    pub fn run(&self, x: &mut [f64], mut state: [f64; 2]) {
        let ([b0, b1, b2], [a1, a2]) = (self.b, self.a);
        for x in x {
            let y = b0 * *x + state[0];
            state = [b1 * *x - a1 * y + state[1], b2 * *x - a2 * y];
            *x = y;
        }
    }
}

/// Returns the sections for a cut, both frequencies in Hz: the poles of the analog filter at the cut of the bilinear
/// map, tan(π cut/rate).
///
/// # Panics
/// If the cut is not between 0 and half the rate.
pub fn butterworth(cut: f64, rate: f64) -> [Biquad; 2] {
    assert!(
        cut > 0.0 && cut < 0.5 * rate,
        "the cut is below half the rate"
    );
    let w = (PI * cut / rate).tan();
    // Damping of the pole pairs of order 4: 2 sin(π/8), 2 sin(3π/8).
    [1.0, 3.0].map(|k: f64| {
        let damping = 2.0 * (k * PI / 8.0).sin();
        let scale = 1.0 / (1.0 + damping * w + w * w);
        let b = w * w * scale;
        Biquad {
            b: [b, 2.0 * b, b],
            a: [
                2.0 * (w * w - 1.0) * scale,
                (1.0 - damping * w + w * w) * scale,
            ],
        }
    })
}
