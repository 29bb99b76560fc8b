//! Bar 8: every integrator reaches its order.

use bgdyn_sim::{INTEGRATORS, with_integrator};

use crate::Extent;
use crate::order::Errors;
use crate::outcome::Outcome;
use crate::problems::slope;

/// Returns by how much the order fitted over three halvings is less than the stated one.
pub(crate) fn orders(_: Extent) -> Vec<Outcome> {
    let all = INTEGRATORS
        .iter()
        .flat_map(|name| [(name, true), (name, false)]);
    // Rosenbrock methods need the slopes.
    let runs = all.filter(|(name, slopes)| **name != "rodas4" || *slopes);
    let outcome = |(name, slopes): (&&str, bool)| {
        let (info, errors) = with_integrator(name, Errors { slopes }).expect("a name of the list");
        let short = f64::from(info.order) - slope(&errors);
        let how = if slopes {
            "slopes known"
        } else {
            "slopes unknown"
        };
        let quantity = format!("order {} less the fitted one, {how}", info.order);
        Outcome::new(*name, "8", quantity, short, 0.2)
    };
    runs.map(outcome).collect()
}
