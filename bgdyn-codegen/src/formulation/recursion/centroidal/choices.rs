//! The cheapest way to compute a centroidal method, by counting.

use super::super::geometry::Geometry;
use super::super::plan::{MomentaPlan, Plan};
use super::super::plan_search::BestPlan;
use crate::expr::Cost;
use crate::method::Centroidal;

/// Largest number of joints across which vectors are rotated one by one.
const MOST_ONE_BY_ONE: usize = 6;

/// Returns the cheapest of the plans that `search` finds; it is given the way and the cost of a plan.
pub(in super::super) fn plans(
    (of, geometry): (Centroidal, &Geometry),
    search: impl Fn(MomentaPlan) -> BestPlan,
    cost: impl Fn(&Plan) -> Cost,
) -> BestPlan {
    let ways = |by_bodies| MomentaPlan {
        one_by_one: 3,
        by_bodies,
    };
    let mut best = search(ways(false));
    if of == Centroidal::Momentum {
        let other = search(ways(true));
        if other.cost().weighted() < best.cost().weighted() {
            best = other;
        }
    }
    if !matches!(of, Centroidal::Map | Centroidal::Jacobian) {
        return best;
    }
    let tried = (0..=MOST_ONE_BY_ONE.min(geometry.bodies.len())).map(|one_by_one| {
        let mut plan = best.taken().clone();
        plan.momenta.one_by_one = one_by_one;
        let cost = cost(&plan);
        (plan, cost)
    });
    let found = tried.min_by_key(|(_, cost)| cost.weighted());
    if let Some((plan, cost)) = found {
        best.take(plan, cost);
    }
    best
}
