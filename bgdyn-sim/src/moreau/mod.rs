//! Time stepping for rigid contacts, after Moreau and Jean.

mod impulses;
mod lift;
mod middle;

use bgdyn_runtime::{Scalar as _, StateVector};

use self::impulses::Impulses;
use self::lift::lifted;
use self::middle::{Factors, Middle, positions_in_middle};
use crate::cone::ContactOptions;
use crate::contact_step::ContactStep;
use crate::contacts_at::contacts_at;
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

/// Data of a step of [`Moreau`] for the next one.
#[derive(Clone, Debug)]
pub struct MoreauStages<Y: StateVector> {
    contacts: ContactStep<Of<Y>>,
    factors: Option<Factors<Y>>,
}

/// So many changes that do not fall any more end the iteration: impulses of redundant contacts have rounding errors of
/// their own, which levers and small inertias multiply. They may be up to √ε of the velocities.
const STALLS: usize = 2;

/// Changes that fall by less than this factor are reason for Newton's method: its slopes serve the steps after this one, too.
const SLOW: f64 = 0.02;

/// After so many evaluations of the rates the velocities at the contacts are linear in the impulses.
const MOST_NONLINEAR: usize = 16;

/// The largest number of evaluations of the rates in a step.
const MOST_ITERATIONS: usize = 40;

impl<Y: StateVector> Integrator<Y> for Moreau<Of<Y>>
where
    Of<Y>: Real,
{
    type Stages = MoreauStages<Y>;

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
        Some(&stages.contacts)
    }

    fn step<O: Ode<State = Y>>(
        &self,
        ode: &O,
        from: &Start<'_, Y, Self::Stages>,
        h: Of<Y>,
    ) -> Result<Step<Y, Self::Stages>, Reason<O::Error>> {
        let y = positions_in_middle(ode, (from.t, from.y), h)?;
        let same = from.before.filter(|before| before.h == h);
        let factors = same.and_then(|before| before.stages.factors.as_ref());
        let mut middle = Middle::new((from.t, y), h, ode.positions(), factors);
        let before = contacts_at(ode, from.t, from.y).map_err(Reason::Singular)?;
        let halfway = contacts_at(ode, middle.t, &middle.y).map_err(Reason::Singular)?;
        let number = ode.rigid_contacts();
        let given = (before, halfway);
        let last = from
            .before
            .map(|step| (step.stages.contacts.impulses, h / step.h));
        let mut impulses = Impulses::new(self.options, number, given, last);
        let mut end = middle.y.clone();
        let (mut before, mut slowest, mut stalls) = (f64::INFINITY, 1.0_f64, 0);
        let rough =
            Of::<Y>::EPSILON.to_f64().sqrt() / middle::NEGLIGIBLE / Of::<Y>::EPSILON.to_f64();
        for iteration in 1.. {
            let free = middle.free(ode, &end)?;
            impulses.set_rough(before > rough && iteration < MOST_ITERATIONS);
            let next = impulses.pushed(ode, &middle, &free)?;
            let change = middle.change(&next, &end, &free);
            end = next;
            // What is left of changes that fall like a geometric series, by the slower of the last two ratios (Hairer and
            // Wanner 1996, section IV.8).
            let ratio = change / before;
            let slower = slowest.max(ratio);
            let left = change * slower / (1.0 - slower);
            slowest = ratio;
            if ratio > 0.5 {
                stalls += 1;
            }
            let settled = stalls >= STALLS && change < rough;
            let converged = change <= 1.0 || (slower < 1.0 && left <= 1.0) || settled;
            if converged && (impulses.is_solved() || before <= rough) {
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
            if iteration == MOST_NONLINEAR {
                impulses.linearise();
                stalls = 0;
            }
            // Substitution that is slow, or that does not converge. The second change has impulses that the first had not: it
            // does not tell.
            if iteration > 2 && ratio > SLOW && middle.linearise(ode, &end)? {
                impulses.remake_maps(ode, &middle)?;
                stalls = 0;
            }
            before = change;
        }
        let mut contacts = impulses.result(&middle, &end);
        middle.advance(ode, &mut end)?;
        lifted(ode, (from.t + h, h), &mut end, &impulses, &mut contacts)?;
        let change = end.plus(-Of::<Y>::from_f64(1.0), from.y);
        let factors = middle.into_factors();
        let stages = MoreauStages { contacts, factors };
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
