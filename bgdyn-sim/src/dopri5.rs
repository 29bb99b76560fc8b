//! The integrator DOPRI5 by Dormand and Prince (1980), with dense output by Shampine and Hairer.

use bgdyn_runtime::StateVector;

use crate::coefficient::{Words, ZERO, ratio};
use crate::dense::Dense;
use crate::failure::Reason;
use crate::integrator::{Integrator, IntegratorInfo, Start, Step};
use crate::ode::Ode;
use crate::real::{Of, Real, largest};
use crate::tableau::{Stage, all, combined};

/// The pair RK5(4)7M by Dormand and Prince (1980): order 5 with an estimate of order 4, dense output of
/// order 4. All coefficients are rational and are exact to the precision of the scalar.
///
/// The default choice for nonstiff scenes, at relative tolerances from 1e-3 to 1e-8.
#[derive(Clone, Copy, Debug, Default)]
pub struct Dopri5;

const STAGES: [Stage; 6] = [
    Stage {
        c: ratio(1.0, 5.0),
        a: &[ratio(1.0, 5.0)],
    },
    Stage {
        c: ratio(3.0, 10.0),
        a: &[ratio(3.0, 40.0), ratio(9.0, 40.0)],
    },
    Stage {
        c: ratio(4.0, 5.0),
        a: &[ratio(44.0, 45.0), ratio(-56.0, 15.0), ratio(32.0, 9.0)],
    },
    Stage {
        c: ratio(8.0, 9.0),
        a: &[
            ratio(19372.0, 6561.0),
            ratio(-25360.0, 2187.0),
            ratio(64448.0, 6561.0),
            ratio(-212.0, 729.0),
        ],
    },
    Stage {
        c: ratio(1.0, 1.0),
        a: &[
            ratio(9017.0, 3168.0),
            ratio(-355.0, 33.0),
            ratio(46732.0, 5247.0),
            ratio(49.0, 176.0),
            ratio(-5103.0, 18656.0),
        ],
    },
    // The end of the step: its rates are the first rates of the next step.
    Stage {
        c: ratio(1.0, 1.0),
        a: &WEIGHTS,
    },
];

const WEIGHTS: [Words; 6] = [
    ratio(35.0, 384.0),
    ZERO,
    ratio(500.0, 1113.0),
    ratio(125.0, 192.0),
    ratio(-2187.0, 6784.0),
    ratio(11.0, 84.0),
];

/// Weights of order 5 minus those of order 4.
const ERROR: [Words; 7] = [
    ratio(71.0, 57600.0),
    ZERO,
    ratio(-71.0, 16695.0),
    ratio(71.0, 1920.0),
    ratio(-17253.0, 339_200.0),
    ratio(22.0, 525.0),
    ratio(-1.0, 40.0),
];

/// The fifth term of the dense output (Hairer, Nørsett, Wanner I, II.6).
const DENSE: [Words; 7] = [
    ratio(-12_715_105_075.0, 11_282_082_432.0),
    ZERO,
    ratio(87_487_479_700.0, 32_700_410_799.0),
    ratio(-10_690_763_975.0, 1_880_347_072.0),
    ratio(701_980_252_875.0, 199_316_789_632.0),
    ratio(-1_453_857_185.0, 822_651_844.0),
    ratio(69_997_945.0, 29_380_423.0),
];

impl<Y: StateVector> Integrator<Y> for Dopri5
where
    Of<Y>: Real,
{
    type Stages = [Y; 7];

    fn info(&self) -> IntegratorInfo {
        IntegratorInfo {
            name: "dopri5",
            order: 5,
            estimate: Some(5),
            looks: 4,
            reads_jacobian: false,
        }
    }

    fn step<O: Ode<State = Y>>(
        &self,
        ode: &O,
        from: &Start<'_, Y, [Y; 7]>,
        h: Of<Y>,
    ) -> Result<Step<Y, [Y; 7]>, Reason<O::Error>> {
        let known = from.before.map(|step| &step.stages[6]);
        let stages: [Y; 7] = all(ode, from, known, h, &STAGES)?;
        Ok(Step {
            h,
            change: combined(&WEIGHTS, &stages).times(h),
            stages,
        })
    }

    fn error(&self, step: &Step<Y, [Y; 7]>, scale: &Y) -> Option<Of<Y>> {
        let error = combined(&ERROR, &step.stages).times(step.h);
        Some(largest(&error, scale))
    }

    fn dense<O: Ode<State = Y>>(
        &self,
        _: &O,
        from: &Start<'_, Y, [Y; 7]>,
        step: &Step<Y, [Y; 7]>,
    ) -> Result<Dense<Y>, Reason<O::Error>> {
        let k = &step.stages;
        let mut terms = Dense::cubic(step.h, &step.change, &k[0], &k[6]);
        terms[3] = Some(combined(&DENSE, k).times(step.h));
        Ok(Dense::new(from.t, step.h, from.y, terms))
    }
}
