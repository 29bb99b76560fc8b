//! The normal force of Hunt and Crossley 1975: λ = E(δ) (1 + μ δ̇) ≥ 0 at the depth δ, with the elastic force of Hertz,
//! E = k δ^{3/2}, or a linear one, E = k δ.
//!
//! It stores (2/5) k δ^{5/2}, or k δ²/2; the resistor takes (λ − E) δ̇ ≥ 0, also where λ is cut off at 0 because the surfaces
//! part faster than they spring back. μ is (3/2) d, or follows from a restitution at an impact speed, as for stops: the
//! equation between them does not depend on the exponent.

use bgdyn_runtime::Dd;

use super::super::hunt_crossley::{self, Push};
use crate::declaration::{Element, ValueCheck};
use crate::effort_sums::EffortSums;
use crate::expr::Expr;
use crate::fault::{Help, wording};
use crate::format::{Dimension, Key, Reads};

pub(super) const STIFFNESS: Key = Key {
    name: "stiffness",
    reads: Reads::Number(&[Dimension::ContactStiffness]),
    needed: false,
    about: "k, the elastic force at a depth δ is k δ^(3/2) (Hertz)",
};
pub(super) const LINEAR_STIFFNESS: Key = Key {
    name: "linear_stiffness",
    reads: Reads::Number(&[Dimension::Stiffness]),
    needed: false,
    about: "k, the elastic force is k δ; instead of `stiffness`",
};
pub(super) const DAMPING: Key = Key {
    name: "damping",
    reads: Reads::Number(&[Dimension::InverseSpeed]),
    needed: false,
    about: "d: the force has the factor 1 + (3/2) d δ̇; or `restitution` and `impact_speed`",
};
pub(super) const RESTITUTION: Key = Key {
    name: "restitution",
    reads: Reads::Number(&[Dimension::One]),
    needed: false,
    about: "e, speed after an impact to the speed before it, instead of `damping`",
};
pub(super) const IMPACT_SPEED: Key = Key {
    name: "impact_speed",
    reads: Reads::Number(&[Dimension::Speed]),
    needed: false,
    about: "the speed of the impact that has this restitution",
};

/// The least depth of which a root is taken, m: smaller than any depth, so that the root has a derivative.
const LEAST: f64 = 1e-30;

/// The normal force.
#[derive(Clone, Copy, Debug)]
pub(super) struct NormalForce<'g> {
    /// λ, N, and its power.
    pub(super) push: Push<'g>,
    /// E, N.
    pub(super) elastic: Expr<'g>,
    /// ∂E/∂δ, N/m.
    pub(super) slope: Expr<'g>,
    /// Stored energy, J.
    pub(super) stored: Expr<'g>,
}

/// Checks the numbers of the law.
pub(super) fn check(check: &mut ValueCheck<'_>) {
    check.fixed(&[RESTITUTION, IMPACT_SPEED]);
    check.positive(&[STIFFNESS, LINEAR_STIFFNESS], Help::ContactIsOptional);
    check.not_negative(&[DAMPING], Help::DampingDrivesMotion);
    check.positive(&[RESTITUTION], Help::RestitutionIsPositive);
    check.at_most_one(&RESTITUTION, Help::RestitutionAboveOne);
    check.positive(&[IMPACT_SPEED], Help::SpeedOfImpact);
    let element = check.element;
    let (name, given) = (&element.name, |key: &Key| check.number(key).is_some());
    let both = given(&STIFFNESS) && given(&LINEAR_STIFFNESS);
    if given(&STIFFNESS) == given(&LINEAR_STIFFNESS) {
        let location = check.location(&LINEAR_STIFFNESS);
        check.report(wording::not_one_stiffness(&location, name, both));
    }
    let [damping, restitution, speed] =
        [DAMPING, RESTITUTION, IMPACT_SPEED].map(|key| check.number(&key).is_some());
    match (restitution, speed) {
        (true, true) if damping => {
            let location = check.location(&DAMPING);
            check.report(wording::damping_beside_restitution(&location, name));
        }
        (true, false) => {
            let location = check.location(&RESTITUTION);
            let keys = [RESTITUTION.name, IMPACT_SPEED.name];
            check.report(wording::restitution_alone(&location, name, keys));
        }
        (false, true) => {
            let location = check.location(&IMPACT_SPEED);
            let keys = [IMPACT_SPEED.name, RESTITUTION.name];
            check.report(wording::restitution_alone(&location, name, keys));
        }
        _ => {}
    }
}

/// Returns the normal force at a gap, m, that changes at a rate, m/s.
pub(super) fn force<'g>(
    element: &Element,
    sums: &EffortSums<'g, '_>,
    (gap, rate): (Expr<'g>, Expr<'g>),
) -> NormalForce<'g> {
    let zero = sums.b.zero();
    let depth = (-gap).max(zero);
    let (elastic, slope, stored) = match sums.optional(element, &LINEAR_STIFFNESS) {
        Some(stiffness) => {
            let elastic = stiffness * depth;
            (elastic, stiffness, elastic * depth * Dd::from_f64(0.5))
        }
        None => {
            let root = (-gap).max(sums.b.number(LEAST)).sqrt();
            let secant = sums.number(element, &STIFFNESS) * root;
            let elastic = secant * depth;
            let share = Dd::from_f64(2.0) / Dd::from_f64(5.0);
            (elastic, secant * Dd::from_f64(1.5), elastic * depth * share)
        }
    };
    let slope = gap.if_less(zero, slope, zero);
    NormalForce {
        push: hunt_crossley::push(sums, elastic, (damping(element, sums), -rate)),
        elastic,
        slope,
        stored,
    }
}

/// Notes the spring of the contact.
pub(super) fn note_spring(element: &Element, sums: &mut EffortSums<'_, '_>) {
    let linear = sums.optional(element, &LINEAR_STIFFNESS);
    let stiffness = linear.unwrap_or_else(|| sums.number(element, &STIFFNESS));
    sums.spring_at_contact(element, stiffness, linear.is_none());
}

/// Returns μ, s/m.
fn damping<'g>(element: &Element, sums: &EffortSums<'g, '_>) -> Expr<'g> {
    let value = |key| element.quantity(key).map(|q| q.value);
    match (value(&RESTITUTION), value(&IMPACT_SPEED)) {
        (Some(restitution), Some(speed)) => {
            sums.b.constant(hunt_crossley::damping(restitution, speed))
        }
        _ => sums.number(element, &DAMPING) * Dd::from_f64(1.5),
    }
}
