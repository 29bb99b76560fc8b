//! Periodic motions: a finite Fourier series for each joint (Swevers et al. 1997),
//! q = q₀ + Σ_k (a_k sin kωt − b_k cos kωt)/(kω), whose coefficients are velocities.

/// Samples of a period for each harmonic, where the extremes of a series are looked for.
pub const SAMPLES: usize = 64;

/// The series of a joint.
#[derive(Clone, Debug, PartialEq)]
pub struct FourierSeries {
    /// q₀, rad or m.
    pub centre: f64,
    /// a_k for k = 1, 2, …, rad/s or m/s.
    pub sine: Vec<f64>,
    /// b_k.
    pub cosine: Vec<f64>,
}

/// Least and largest value over all times.
pub type Extremes = [f64; 2];

impl FourierSeries {
    /// Returns position, velocity and acceleration at time `t`, s; `frequency` is ω, rad/s.
    pub fn at(&self, frequency: f64, t: f64) -> [f64; 3] {
        let terms = self.sine.iter().zip(&self.cosine).enumerate();
        terms.fold([self.centre, 0.0, 0.0], |[q, v, a], (k, (s, c))| {
            let w = frequency * (k + 1) as f64;
            let (sine, cosine) = (w * t).sin_cos();
            [
                q + (s * sine - c * cosine) / w,
                v + s * cosine + c * sine,
                a + w * (c * cosine - s * sine),
            ]
        })
    }

    /// Returns bounds for the extremes of position, velocity and acceleration: those of the samples, widened by what
    /// the series can do between two of them. At an extreme between samples the rate is 0, and a sample is at most
    /// h/2 away, so that the value exceeds it by at most h²/8 times the largest second derivative, which is at most
    /// Σ_k (kω)² times the amplitude of the harmonic k.
    pub fn extremes(&self, frequency: f64) -> [Extremes; 3] {
        let count = SAMPLES * self.sine.len();
        let step = std::f64::consts::TAU / frequency / count as f64;
        let mut found = [[f64::INFINITY, f64::NEG_INFINITY]; 3];
        for i in 0..count {
            for (own, x) in found.iter_mut().zip(self.at(frequency, i as f64 * step)) {
                *own = [own[0].min(x), own[1].max(x)];
            }
        }
        let sizes = self.sine.iter().zip(&self.cosine);
        for (k, (s, c)) in sizes.enumerate() {
            let w = frequency * (k + 1) as f64;
            for (d, own) in found.iter_mut().enumerate() {
                let more = step * step / 8.0 * s.hypot(*c) * w.powi(d as i32 + 1);
                *own = [own[0] - more, own[1] + more];
            }
        }
        found
    }

    /// Returns the series with its motion about the centre scaled.
    pub fn scaled(&self, factor: f64) -> Self {
        let scaled = |x: &[f64]| x.iter().map(|x| x * factor).collect();
        FourierSeries {
            centre: self.centre,
            sine: scaled(&self.sine),
            cosine: scaled(&self.cosine),
        }
    }
}

/// A motion of all joints.
#[derive(Clone, Debug, PartialEq)]
pub struct PeriodicMotion {
    /// ω, rad/s.
    pub frequency: f64,
    /// The series of each joint.
    pub joints: Vec<FourierSeries>,
}

/// Position, velocity and acceleration of all joints at one time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct State {
    /// rad or m.
    pub q: Vec<f64>,
    /// rad/s or m/s.
    pub v: Vec<f64>,
    /// rad/s² or m/s².
    pub a: Vec<f64>,
}

impl PeriodicMotion {
    /// Returns the period, s.
    pub fn period(&self) -> f64 {
        std::f64::consts::TAU / self.frequency
    }

    /// Returns the state at time `t`, s.
    pub fn at(&self, t: f64) -> State {
        let mut state = State::default();
        for joint in &self.joints {
            let [q, v, a] = joint.at(self.frequency, t);
            state.q.push(q);
            state.v.push(v);
            state.a.push(a);
        }
        state
    }

    /// Returns the motion with each joint's motion about its centre scaled.
    pub fn scaled(&self, factor: f64) -> Self {
        PeriodicMotion {
            frequency: self.frequency,
            joints: self.joints.iter().map(|s| s.scaled(factor)).collect(),
        }
    }
}
