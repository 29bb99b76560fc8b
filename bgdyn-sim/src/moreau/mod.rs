//! Time stepping for rigid contacts, after Moreau and Jean.

mod convergence;
mod impulses;
mod lift;
mod middle;

use bgdyn_runtime::{ContactMap, MOST_CONTACTS, StateVector};

use self::convergence::Convergence;
use self::impulses::Impulses;
use self::lift::lifted;
use self::middle::{Inverse, Middle, positions_in_middle};
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
/// with linear velocities of planar and floating joints along axes that do not turn, except where a scene has other rates of
/// positions ([`Ode::quasi_joints`]). The impulses p are the solution of
/// Coulomb's cones ([`crate::cone`]) for the velocities γ_n⁺ + e γ_n⁻ of Newton's law of restitution and γ_t⁺, at the end
/// of the step. J and M are those in the middle. A contact that approaches by less than forces add in a step does not
/// bounce. A contact is active if its gap would be closed at the end of the step without impulses. Where a closed contact
/// overlaps afterwards, the positions are put right in the metric of M, without a spring.
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
    inverse: Option<Inverse<Y>>,
    /// v⁺ − v along axes that do not turn; `None` after an impact.
    gained: Option<Y>,
}

/// A step of an equation, or why there is none.
type Stepped<O> =
    Result<Step<<O as Ode>::State, MoreauStages<<O as Ode>::State>>, Reason<<O as Ode>::Error>>;

/// After so many evaluations of the rates the velocities at the contacts are linear in the impulses.
const MOST_NONLINEAR: usize = 16;

/// The largest number of evaluations of the rates in a step.
const MOST_ITERATIONS: usize = 40;

/// Returns room for so many maps. Maps are large: `[const { None }; K]` would clear them all.
fn no_maps<Y, const K: usize>() -> [Option<ContactMap<Y>>; K] {
    core::array::from_fn(|_| None)
}

/// Returns the velocities at the end of a step, from a guess: the rates are evaluated anew with each until they settle.
fn settled<O: Ode>(
    ode: &O,
    middle: &mut Middle<'_, O::State>,
    impulses: &mut Impulses<'_, O::State>,
    mut end: O::State,
) -> Result<O::State, Reason<O::Error>>
where
    Of<O::State>: Real,
{
    let mut convergence = Convergence::new::<Of<O::State>>();
    for iteration in 1..=MOST_ITERATIONS {
        let free = middle.free(ode, &end)?;
        let rough = convergence.is_rough() && iteration < MOST_ITERATIONS;
        impulses.set_rough(rough);
        let next = impulses.pushed(ode, middle, &free)?;
        convergence.note(middle.change(&next, &end, &free));
        end = next;
        if convergence.is_reached() && (impulses.is_solved() || !rough) {
            return Ok(end);
        }
        if iteration == MOST_NONLINEAR {
            impulses.make_velocities_linear();
            convergence.restart();
        }
        if convergence.is_slow() && middle.linearise(ode, &end)? {
            impulses.remake_maps(ode, middle)?;
            convergence.restart();
        }
    }
    // Contacts of which no impulses were found end the step as they are: the residual tells.
    let change = convergence.last();
    if change.is_finite() && impulses.give_up() {
        return Ok(end);
    }
    let iterations = MOST_ITERATIONS;
    Err(Reason::NoConvergence { iterations, change })
}

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
        // Maps are large: no more of them are cleared than there may be contacts.
        match ode.rigid_contacts() {
            n @ 0..=4 => self.step_with(ode, from, h, &mut no_maps::<_, 4>()[..n]),
            n @ 5..=16 => self.step_with(ode, from, h, &mut no_maps::<_, 16>()[..n]),
            n => self.step_with(ode, from, h, &mut no_maps::<_, MOST_CONTACTS>()[..n]),
        }
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

impl<T: Real> Moreau<T> {
    /// Computes a step, with room for the maps of all contacts.
    fn step_with<O: Ode>(
        &self,
        ode: &O,
        from: &Start<'_, O::State, MoreauStages<O::State>>,
        h: T,
        maps: &mut [Option<ContactMap<O::State>>],
    ) -> Stepped<O>
    where
        O::State: StateVector<Scalar = T>,
    {
        let y = positions_in_middle(ode, (from.t, from.y), h)?;
        let same = from.before.filter(|before| before.h == h);
        let inverse = same.and_then(|before| before.stages.inverse.as_ref());
        let mut middle = Middle::new((from.t, y), h, ode.positions(), inverse);
        let before = contacts_at(ode, from.t, from.y).map_err(Reason::Singular)?;
        let halfway = contacts_at(ode, middle.t, &middle.y).map_err(Reason::Singular)?;
        let last = from
            .before
            .map(|step| (step.stages.contacts.impulses, h / step.h));
        let gained = from
            .before
            .and_then(|step| Some((h / step.h, step.stages.gained.as_ref()?)));
        let continues = gained.is_some();
        let mut impulses = Impulses::new(self.options, maps, (before, halfway), last, continues);
        let mut guess = middle.y.clone();
        if let Some((scale, gained)) = gained {
            guess.add(scale, gained);
        }
        middle.renew(ode, &guess)?;
        let mut end = settled(ode, &mut middle, &mut impulses, guess)?;
        let gained = impulses
            .are_slow()
            .then(|| end.plus(-T::from_f64(1.0), &middle.y));
        let mut contacts = impulses.result(&middle, &end);
        middle.advance(ode, &mut end)?;
        lifted(ode, (from.t + h, h), &mut end, &impulses, &mut contacts)?;
        Ok(Step {
            h,
            change: end.plus(-T::from_f64(1.0), from.y),
            stages: MoreauStages {
                contacts,
                inverse: middle.into_inverse(),
                gained,
            },
        })
    }
}
