//! The classical Runge–Kutta method of order 4 (Kutta 1901).

use bgdyn_runtime::StateVector;

use crate::coefficient::{Words, ZERO, ratio};
use crate::failure::Reason;
use crate::integrator::{Integrator, IntegratorInfo, Start, Step};
use crate::ode::Ode;
use crate::real::Of;
use crate::tableau::{Stage, all, combined};

/// The classical Runge–Kutta method, of order 4 with fixed steps.
#[derive(Clone, Copy, Debug, Default)]
pub struct Rk4;

const HALF: Words = ratio(1.0, 2.0);
const ONE: Words = ratio(1.0, 1.0);

const STAGES: [Stage; 3] = [
    Stage {
        c: HALF,
        a: &[HALF],
    },
    Stage {
        c: HALF,
        a: &[ZERO, HALF],
    },
    Stage {
        c: ONE,
        a: &[ZERO, ZERO, ONE],
    },
];

const WEIGHTS: [Words; 4] = [
    ratio(1.0, 6.0),
    ratio(1.0, 3.0),
    ratio(1.0, 3.0),
    ratio(1.0, 6.0),
];

impl<Y: StateVector> Integrator<Y> for Rk4 {
    type Stages = ();

    fn info(&self) -> IntegratorInfo {
        IntegratorInfo {
            name: "rk4",
            order: 4,
            estimate: None,
            looks: 1,
            reads_jacobian: false,
        }
    }

    fn step<O: Ode<State = Y>>(
        &self,
        ode: &O,
        from: &Start<'_, Y, ()>,
        h: Of<Y>,
    ) -> Result<Step<Y, ()>, Reason<O::Error>> {
        let rates: [Y; 4] = all(ode, from, None, h, &STAGES)?;
        Ok(Step {
            h,
            change: combined(&WEIGHTS, &rates).times(h),
            stages: (),
        })
    }
}
