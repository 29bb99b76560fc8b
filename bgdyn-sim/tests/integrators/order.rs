//! Errors of an integrator for repeatedly halved steps. Also used by the package of hard cases.

use bgdyn_runtime::Dd;
use bgdyn_sim::{Integrator, IntegratorInfo, Ode, Start, WithIntegrator};
use nalgebra::SVector;

use crate::problems::{Known, dd, distance, known, ode};

/// States of the problem with a known solution.
pub type Y = SVector<Dd, 4>;

/// Errors at t = 2 for 12 steps and three halvings.
pub struct Errors {
    /// Whether the problem provides its slopes.
    pub slopes: bool,
}

impl WithIntegrator<Y> for Errors {
    type Output = (IntegratorInfo, Vec<f64>);

    fn with<M: Integrator<Y>>(self, method: M) -> Self::Output {
        let info = method.info();
        let problem = Known {
            slopes: self.slopes,
        };
        let after = |n| {
            let found = known_run(&method, &ode::<Dd, _, 4>(&problem), n);
            distance(&found, &known(dd(2.0)))
        };
        (info, [12, 24, 48, 96].map(after).to_vec())
    }
}

/// A method by reference.
pub fn known_run<M: Integrator<Y>, O: Ode<State = Y>>(method: &M, ode: &O, n: u32) -> Y {
    let h = dd(2.0) / dd(n.into());
    let (mut y, mut before) = (known(dd(0.0)), None);
    for i in 0..n {
        let t = h * dd(i.into());
        let start = Start {
            t,
            y: &y,
            before: before.as_ref(),
        };
        let step = method.step(ode, &start, h);
        let Ok(step) = step else {
            panic!("a step fails")
        };
        y += step.change;
        before = Some(step);
    }
    y
}
