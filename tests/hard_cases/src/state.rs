//! A state of a mechanism, and seeded states.

use std::f64::consts::FRAC_PI_2;

use hard_cases_compiled::Model;

use crate::rng::Rng;

/// Positions, velocities, accelerations, efforts, run-time parameters.
#[derive(Clone, Debug, Default)]
pub struct State {
    /// Positions.
    pub q: Vec<f64>,
    /// Velocities.
    pub v: Vec<f64>,
    /// Accelerations.
    pub a: Vec<f64>,
    /// Efforts.
    pub tau: Vec<f64>,
    /// Run-time parameters.
    pub parameters: Vec<f64>,
}

impl State {
    /// Returns a seeded state of n joints. In half of them every joint is almost a quarter turn from zero
    /// or from another position.
    pub(crate) fn seeded(rng: &mut Rng, n: usize) -> State {
        let mut some = |size: f64| -> Vec<f64> { (0..n).map(|_| rng.within(size)).collect() };
        let mut state = State {
            q: some(1.0),
            v: some(2.0),
            a: some(3.0),
            tau: some(20.0),
            parameters: vec![],
        };
        if rng.chance(0.5) {
            let hair = *rng.pick(&[0.0, 1e-10, 1e-8, 1e-6, 1e-4, 1e-2]);
            for q in &mut state.q {
                if rng.chance(0.8) {
                    *q = rng.below(4) as f64 * FRAC_PI_2 + hair;
                }
            }
        }
        state
    }

    /// Returns a seeded state of a mechanism with quaternions. In half of them every orientation and every
    /// angle is almost quarter turns from zero.
    pub(crate) fn oriented(rng: &mut Rng, model: &dyn Model<f64>) -> State {
        let n = model.nv();
        let aligned = rng.chance(0.5);
        let hair = *rng.pick(&[0.0, 1e-10, 1e-8, 1e-6, 1e-4, 1e-2]);
        let u: Vec<f64> = (0..n)
            .map(|_| match aligned {
                true => rng.below(4) as f64 / 4.0 + hair,
                false => rng.unit(),
            })
            .collect();
        let mut some = |size: f64| -> Vec<f64> { (0..n).map(|_| rng.within(size)).collect() };
        State {
            q: model.sample(&u),
            v: some(2.0),
            a: some(3.0),
            tau: some(20.0),
            parameters: vec![],
        }
    }
}
