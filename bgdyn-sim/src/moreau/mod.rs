//! Time stepping for rigid contacts, after Moreau and Jean.

mod impulses;
mod lift;
mod middle;

use bgdyn_runtime::{Scalar as _, StateVector};

use self::impulses::Impulses;
use self::lift::lifted;
use self::middle::Middle;
use crate::cone::ContactOptions;
use crate::contact_step::ContactStep;
use crate::dense::Dense;
use crate::failure::Reason;
use crate::integrator::{Integrator, IntegratorInfo, Start, Step};
use crate::ode::Ode;
use crate::real::{Of, Real};

/// Time stepping for rigid contacts with Coulomb friction (Moreau 1988; Jean 1999; Acary and Brogliato 2008, chapter 10),
/// with fixed steps. With the positions in the middle of the step, q_m = q + (h/2) v,
///
/// v⁺ = v + h v̇(t + h/2, q_m, (v + v⁺)/2) + M⁻¹ Jᵀ p,  q⁺ = q_m + (h/2) v⁺
///
/// where the impulses p are the solution of Coulomb's cones ([`crate::cone`]) for the velocities γ_n⁺ + e γ_n⁻ of Newton's
/// law of restitution and γ_t⁺, at the end of the step. J and M are those in the middle. A contact that approaches by less
/// than forces add in a step does not bounce. A contact is active if its gap would be closed at the end of the step without
/// impulses. Where a closed contact overlaps afterwards, the positions are put right in the metric of M, without a spring.
///
/// Order 2 without impacts, order 1 with them, as an impact is anywhere within its step, and where contacts slip along
/// curves. Implicit in the velocities, which are solved for by substitution; where that is slow, by Newton's method with the
/// slopes of the rates, if these are available.
#[derive(Clone, Copy, Debug)]
pub struct Moreau<T> {
    /// When the search for impulses ends.
    pub options: ContactOptions<T>,
}

impl<T: Real> Moreau<T> {
    /// Returns the integrator with impulses to 4096 ε of the largest (1e-12 in `f64`), which takes at most 200 sweeps and 50
    /// Newton steps of [`crate::cone::solve`] from one start.
    pub fn new() -> Self {
        let options = ContactOptions {
            tolerance: T::EPSILON * T::from_f64(4096.0),
            most_sweeps: 200,
            most_newton_steps: 50,
        };
        Moreau { options }
    }
}

impl<T: Real> Default for Moreau<T> {
    fn default() -> Self {
        Self::new()
    }
}

/// So many changes that do not fall any more end the iteration: impulses of redundant contacts have rounding errors of
/// their own, which levers and small inertias multiply. They may be up to √ε of the velocities.
const STALLS: usize = 2;

/// Changes that fall by less than this factor are reason for Newton's method.
const SLOW: f64 = 0.25;

/// The largest number of evaluations of the rates in a step.
const MOST_ITERATIONS: usize = 40;

impl<Y: StateVector> Integrator<Y> for Moreau<Of<Y>>
where
    Of<Y>: Real,
{
    type Stages = ContactStep<Of<Y>>;

    fn info(&self) -> IntegratorInfo {
        IntegratorInfo {
            name: "moreau",
            order: 1,
            estimate: None,
            looks: 1,
            reads_jacobian: true,
        }
    }

    fn keeps_lengths(&self) -> bool {
        true
    }

    fn solves_contacts(&self) -> bool {
        true
    }

    fn contact_step<'s>(&self, stages: &'s Self::Stages) -> Option<&'s ContactStep<Of<Y>>> {
        Some(stages)
    }

    fn step<O: Ode<State = Y>>(
        &self,
        ode: &O,
        from: &Start<'_, Y, Self::Stages>,
        h: Of<Y>,
    ) -> Result<Step<Y, Self::Stages>, Reason<O::Error>> {
        let mut middle = Middle::new(ode, (from.t, from.y), h)?;
        let mut impulses = Impulses::new(ode, (from, &middle), self.options)?;
        let mut end = middle.y.clone();
        let (mut before, mut stalls) = (f64::INFINITY, 0);
        let rough =
            Of::<Y>::EPSILON.to_f64().sqrt() / middle::NEGLIGIBLE / Of::<Y>::EPSILON.to_f64();
        for iteration in 1.. {
            let free = middle.free(ode, &end)?;
            let next = impulses.pushed(ode, &middle, &free)?;
            let change = middle.change(&next, &end, &free);
            end = next;
            if change > 0.5 * before {
                stalls += 1;
            }
            let settled = stalls >= STALLS && change < rough;
            if change <= 1.0 || settled {
                break;
            }
            if iteration == MOST_ITERATIONS {
                // Contacts of which no impulses were found end the step as they are: the residual tells.
                if change.is_finite() && impulses.give_up() {
                    break;
                }
                let iterations = iteration;
                return Err(Reason::NoConvergence { iterations, change });
            }
            // Substitution that is slow, or that does not converge.
            if change > SLOW * before && middle.linearise(ode, &end)? {
                impulses.remake_maps(ode, &middle)?;
                stalls = 0;
            }
            before = change;
        }
        let mut stages = impulses.result(&middle, &end);
        middle.advance(ode, &mut end)?;
        lifted(ode, (from.t + h, h), &mut end, &impulses, &mut stages)?;
        let change = end.plus(-Of::<Y>::from_f64(1.0), from.y);
        Ok(Step { h, change, stages })
    }

    /// The straight line through both ends: velocities jump somewhere within the step.
    fn dense<O: Ode<State = Y>>(
        &self,
        _: &O,
        from: &Start<'_, Y, Self::Stages>,
        step: &Step<Y, Self::Stages>,
    ) -> Result<Dense<Y>, Reason<O::Error>> {
        let mut terms = [const { None }; 7];
        terms[0] = Some(step.change.clone());
        Ok(Dense::new(from.t, step.h, from.y, terms))
    }
}
