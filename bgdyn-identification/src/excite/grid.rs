//! Samples of a period, with the sines and cosines of all harmonics.

use super::series::{FourierSeries, PeriodicMotion, State};

/// Evenly spaced times of a period.
#[derive(Clone, Debug)]
pub struct Grid {
    frequency: f64,
    /// Sine and cosine of kωt by time and harmonic.
    turns: Vec<Vec<[f64; 2]>>,
}

impl Grid {
    /// Returns `count` times of a period of `harmonics`.
    pub fn new(count: usize, harmonics: usize, frequency: f64) -> Self {
        let turn = |i: usize, k: usize| {
            let (sine, cosine) =
                (std::f64::consts::TAU * ((i * k) % count) as f64 / count as f64).sin_cos();
            [sine, cosine]
        };
        let times = (0..count).map(|i| (1..=harmonics).map(|k| turn(i, k)).collect());
        Grid {
            frequency,
            turns: times.collect(),
        }
    }

    /// Returns the count of times.
    pub fn count(&self) -> usize {
        self.turns.len()
    }

    /// Returns position, velocity, acceleration of a joint at a time.
    pub fn at(&self, series: &FourierSeries, i: usize) -> [f64; 3] {
        let mut found = [series.centre, 0.0, 0.0];
        for (k, [sine, cosine]) in self.turns[i].iter().enumerate() {
            let w = self.frequency * (k + 1) as f64;
            let (s, c) = (series.sine[k], series.cosine[k]);
            found[0] += (s * sine - c * cosine) / w;
            found[1] += s * cosine + c * sine;
            found[2] += w * (c * cosine - s * sine);
        }
        found
    }

    /// Returns the state of all joints at a time.
    pub fn state(&self, motion: &PeriodicMotion, i: usize) -> State {
        let mut state = State::default();
        for series in &motion.joints {
            let [q, v, a] = self.at(series, i);
            state.q.push(q);
            state.v.push(v);
            state.a.push(a);
        }
        state
    }

    /// Adds to slopes by coefficients what slopes by position, velocity and acceleration at a time say.
    pub fn pull(&self, i: usize, [q, v, a]: [f64; 3], slope: &mut FourierSeries) {
        slope.centre += q;
        for (k, [sine, cosine]) in self.turns[i].iter().enumerate() {
            let w = self.frequency * (k + 1) as f64;
            slope.sine[k] += q * sine / w + v * cosine - a * w * sine;
            slope.cosine[k] += -q * cosine / w + v * sine + a * w * cosine;
        }
    }
}
