//! The semi-implicit Euler method.

use bgdyn_runtime::{Scalar, StateVector};

use crate::failure::Reason;
use crate::integrator::{Integrator, IntegratorInfo, Start, Step};
use crate::ode::Ode;
use crate::real::Of;

/// The semi-implicit Euler method, of order 1 with fixed steps: velocities and first-order states advance
/// with their rates at the start, then positions with the velocities at the end: exactly
/// ([`Ode::position_change`]) where these are constant in axes that rotate.
///
/// It evaluates the rates once per step, and is much more accurate for oscillations than the explicit
/// method. It is symplectic if the mass matrix is constant.
#[derive(Clone, Copy, Debug, Default)]
pub struct SemiImplicitEuler;

impl<Y: StateVector> Integrator<Y> for SemiImplicitEuler {
    type Stages = ();

    fn info(&self) -> IntegratorInfo {
        IntegratorInfo {
            name: "semi_implicit_euler",
            order: 1,
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
        let rates = ode.rates(from.t, from.y).map_err(Reason::Singular)?;
        let mut change = rates.times(h);
        let positions = ode.positions();
        if positions > 0 {
            // The state with the old positions and the new velocities.
            let mut moved = from.y.plus(Of::<Y>::from_f64(1.0), &change);
            moved.entries_mut()[..positions].copy_from_slice(&from.y.entries()[..positions]);
            let moves = ode
                .position_change(from.t, &moved, h)
                .map_err(Reason::Singular)?;
            let moves = change.entries_mut().iter_mut().zip(moves.entries());
            for (change, &moved) in moves.take(positions) {
                *change = moved;
            }
        }
        Ok(Step {
            h,
            change,
            stages: (),
        })
    }
}
