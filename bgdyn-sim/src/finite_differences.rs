//! Jacobians of the rates by finite differences.

use bgdyn_runtime::{ContactMap, ImpactLaw, QuasiJoint, RigidContact, Scalar, StateVector};

use crate::ode::{Jacobian, Ode, ScalarOf};
use crate::real::{Of, Real};

/// An equation whose slopes are central differences of its rates, for implicit integrators if no
/// derivatives were generated. The differences need two evaluations per component, and two thirds of their
/// digits are correct. That suffices for the stability of a Rosenbrock method, but its error falls with
/// the method's order only down to this accuracy.
#[derive(Clone, Copy, Debug)]
pub struct FiniteDifferences<O>(pub O);

impl<O: Ode> Ode for FiniteDifferences<O>
where
    ScalarOf<O>: Real,
{
    type State = O::State;
    type Error = O::Error;

    fn rates(&self, t: ScalarOf<O>, y: &O::State) -> Result<O::State, O::Error> {
        self.0.rates(t, y)
    }

    fn jacobian(
        &self,
        t: ScalarOf<O>,
        y: &O::State,
    ) -> Option<Result<Jacobian<O::State>, O::Error>> {
        Some(differences(&self.0, t, y))
    }

    fn positions(&self) -> usize {
        self.0.positions()
    }

    fn position_rates(&self, t: ScalarOf<O>, y: &O::State) -> Result<O::State, O::Error> {
        self.0.position_rates(t, y)
    }

    fn position_change(
        &self,
        t: ScalarOf<O>,
        y: &O::State,
        h: ScalarOf<O>,
    ) -> Result<O::State, O::Error> {
        self.0.position_change(t, y, h)
    }

    fn quasi_joints(&self) -> Option<&[QuasiJoint]> {
        self.0.quasi_joints()
    }

    fn project(&self, t: ScalarOf<O>, y: &mut O::State) -> Result<bool, O::Error> {
        self.0.project(t, y)
    }

    fn project_in_two(
        &self,
        t: ScalarOf<O>,
        y: &mut O::State,
        low: &mut O::State,
    ) -> Result<bool, O::Error> {
        self.0.project_in_two(t, y, low)
    }

    fn strays(&self, y: &O::State) -> bool {
        self.0.strays(y)
    }

    fn rigid_contacts(&self) -> usize {
        self.0.rigid_contacts()
    }

    fn impact_law(&self) -> ImpactLaw {
        self.0.impact_law()
    }

    fn rigid_contact_states(
        &self,
        t: ScalarOf<O>,
        y: &O::State,
        contacts: &mut [RigidContact<ScalarOf<O>>],
    ) -> Result<(), O::Error> {
        self.0.rigid_contact_states(t, y, contacts)
    }

    fn rigid_contact_maps(
        &self,
        t: ScalarOf<O>,
        y: &O::State,
        maps: &mut [Option<ContactMap<O::State>>],
    ) -> Result<(), O::Error> {
        self.0.rigid_contact_maps(t, y, maps)
    }
}

/// Returns central differences over a step of ∛eps times a component's size.
pub(crate) fn differences<O: Ode>(
    ode: &O,
    t: ScalarOf<O>,
    y: &O::State,
) -> Result<Jacobian<O::State>, O::Error>
where
    ScalarOf<O>: Real,
{
    let [one, half, least, third] = [1.0, 0.5, 1e-3, 1.0 / 3.0].map(ScalarOf::<O>::from_f64);
    let small = (ScalarOf::<O>::EPSILON.ln() * third).exp();
    // A component can be 0 now and larger later; so its size is at least a fraction of the largest one.
    let all = y.entries().iter().fold(small, |most, x| most.max(x.abs()));
    let slope = |ahead: O::State, behind: &O::State, distance: Of<O::State>| {
        ahead.plus(-one, behind).times(half / distance)
    };
    let n = y.entries().len();
    let mut state = y.matrix();
    for c in 0..n {
        let x = y.entries()[c];
        let distance = small * x.abs().max(least * all);
        let mut moved = y.clone();
        moved.entries_mut()[c] = x + distance;
        let ahead = ode.rates(t, &moved)?;
        moved.entries_mut()[c] = x - distance;
        let column = slope(ahead, &ode.rates(t, &moved)?, distance);
        O::State::columns_mut(&mut state)[c * n..(c + 1) * n].copy_from_slice(column.entries());
    }
    let distance = small * t.abs().max(one);
    let time = slope(
        ode.rates(t + distance, y)?,
        &ode.rates(t - distance, y)?,
        distance,
    );
    Ok(Jacobian { state, time })
}
