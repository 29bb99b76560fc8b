//! The Rosenbrock method RODAS4P by Steinebach.

use bgdyn_runtime::{Scalar, StateVector};

use crate::coefficient::{Words, ZERO, decimal, ratio};
use crate::dense::Dense;
use crate::failure::Reason;
use crate::integrator::{Integrator, IntegratorInfo, Start, Step};
use crate::lu::Lu;
use crate::ode::Ode;
use crate::real::{Of, Real, largest};
use crate::tableau::combined;

/// RODAS4P: a Rosenbrock method of order 4 with an estimate of order 3 and dense output of order 3,
/// stiffly accurate and L-stable (Steinebach 1995; its form and a relative are in Hairer, Wanner,
/// Solving Ordinary Differential Equations II, 1996, IV.7 and VI.4).
///
/// For stiff scenes: friction that is almost rigid, motors with fast windings, hydraulics. One step needs
/// six evaluations of the rates, one of their slopes and one factorisation, and no iteration. Of its
/// family it is the method that retains its order if the fast part is driven. It damps oscillations on a
/// stiff spring unless the steps resolve them; a [`crate::Gauss`] integrator does not. The coefficients
/// are published to 16 digits, which limits its accuracy in double-double.
#[derive(Clone, Copy, Debug, Default)]
pub struct Rodas4;

/// (I/(hγ) − J) uᵢ = f(t + cᵢh, y + Σ aᵢⱼ uⱼ) + Σ (kᵢⱼ/h) uⱼ + h gᵢ ∂f/∂t
struct RosenbrockStage {
    c: Words,
    a: &'static [Words],
    k: &'static [Words],
    g: Words,
}

const GAMMA: Words = ratio(1.0, 4.0);
const ONE: Words = ratio(1.0, 1.0);

const STAGES: [RosenbrockStage; 6] = [
    RosenbrockStage {
        c: ZERO,
        a: &[],
        k: &[],
        g: GAMMA,
    },
    RosenbrockStage {
        c: ratio(3.0, 4.0),
        a: &[decimal("3")],
        k: &[decimal("-12")],
        g: ratio(-1.0, 2.0),
    },
    RosenbrockStage {
        c: decimal("0.21"),
        a: &[decimal("1.831036793486759"), decimal("0.4955183967433795")],
        k: &[decimal("-8.791795173947035"), decimal("-2.207865586973518")],
        g: decimal("-0.023504"),
    },
    RosenbrockStage {
        c: decimal("0.63"),
        a: &[
            decimal("2.304376582692669"),
            decimal("-0.05249275245743001"),
            decimal("-1.176798761832782"),
        ],
        k: &[
            decimal("10.81793056857153"),
            decimal("6.780270611428266"),
            decimal("19.53485944642410"),
        ],
        g: decimal("-0.0362"),
    },
    RosenbrockStage {
        c: ONE,
        a: &LAST,
        k: &[
            decimal("34.19095006749676"),
            decimal("15.49671153725963"),
            decimal("54.74760875964130"),
            decimal("14.16005392148534"),
        ],
        g: ZERO,
    },
    RosenbrockStage {
        c: ONE,
        a: &[LAST[0], LAST[1], LAST[2], LAST[3], ONE],
        k: &[
            decimal("34.62605830930532"),
            decimal("15.30084976114473"),
            decimal("56.99955578662667"),
            decimal("18.40807009793095"),
            ratio(-40.0, 7.0),
        ],
        g: ZERO,
    },
];

const LAST: [Words; 4] = [
    decimal("-7.170454962423024"),
    decimal("-4.741636671481785"),
    decimal("-16.31002631330971"),
    decimal("-1.062004044111401"),
];

/// Weights of the step; without the last stage it is of order 3.
const WEIGHTS: [Words; 6] = [LAST[0], LAST[1], LAST[2], LAST[3], ONE, ONE];

/// The third and the fourth term of the dense output.
const DENSE: [[Words; 5]; 2] = [
    [
        decimal("25.09876703708589"),
        decimal("11.62013104361867"),
        decimal("28.49148307714626"),
        decimal("-5.664021568594133"),
        ZERO,
    ],
    [
        decimal("1.638054557396973"),
        decimal("-0.7373619806678748"),
        decimal("8.477918219238990"),
        decimal("15.99253148779520"),
        ratio(-32.0, 17.0),
    ],
];

impl<Y: StateVector> Integrator<Y> for Rodas4
where
    Of<Y>: Real,
{
    /// u₁ … u₆
    type Stages = [Y; 6];

    fn info(&self) -> IntegratorInfo {
        IntegratorInfo {
            name: "rodas4",
            order: 4,
            estimate: Some(4),
            looks: 4,
            reads_jacobian: true,
        }
    }

    fn step<O: Ode<State = Y>>(
        &self,
        ode: &O,
        from: &Start<'_, Y, [Y; 6]>,
        h: Of<Y>,
    ) -> Result<Step<Y, [Y; 6]>, Reason<O::Error>> {
        let one = Of::<Y>::from_f64(1.0);
        let jacobian = ode.jacobian(from.t, from.y).ok_or(Reason::NoJacobian)?;
        let jacobian = jacobian.map_err(Reason::Singular)?;
        let factors = factors(&jacobian.state, h, from.y).ok_or(Reason::SingularMatrix)?;
        let mut u: [Y; 6] = core::array::from_fn(|_| from.y.zero());
        for (i, stage) in STAGES.iter().enumerate() {
            let there = from.y.plus(one, &combined(stage.a, &u));
            let time = from.t + stage.c.to::<Of<Y>>() * h;
            let mut right = ode.rates(time, &there).map_err(Reason::Singular)?;
            right.add(one / h, &combined(stage.k, &u));
            right.add(h * stage.g.to(), &jacobian.time);
            factors.solve(&mut right);
            u[i] = right;
        }
        Ok(Step {
            h,
            change: combined(&WEIGHTS, &u),
            stages: u,
        })
    }

    fn error(&self, step: &Step<Y, [Y; 6]>, scale: &Y) -> Option<Of<Y>> {
        Some(largest(&step.stages[5], scale))
    }

    fn dense<O: Ode<State = Y>>(
        &self,
        _: &O,
        from: &Start<'_, Y, [Y; 6]>,
        step: &Step<Y, [Y; 6]>,
    ) -> Result<Dense<Y>, Reason<O::Error>> {
        let [second, third] = DENSE.map(|weights| Some(combined(&weights, &step.stages)));
        let first = Some(step.change.clone());
        let terms = [first, second, third, None, None, None, None];
        Ok(Dense::new(from.t, step.h, from.y, terms))
    }
}

/// Factors I/(hγ) − J.
fn factors<Y: StateVector>(jacobian: &Y::Matrix, h: Of<Y>, like: &Y) -> Option<Lu<Y>>
where
    Of<Y>: Real,
{
    let shift = Of::<Y>::from_f64(1.0) / (h * GAMMA.to());
    let mut matrix = jacobian.clone();
    let entries = Y::columns_mut(&mut matrix);
    entries.iter_mut().for_each(|m| *m = -*m);
    let n = like.entries().len();
    for m in entries.iter_mut().step_by(n + 1) {
        *m = *m + shift;
    }
    Lu::new(matrix, like)
}
