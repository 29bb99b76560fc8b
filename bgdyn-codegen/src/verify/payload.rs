//! Checks regressors of payloads against the literal regressor of the link that carries the payload.
//!
//! The payload is any point masses: their parameters about the frame, and about the link, are sums over the points.

use bgdyn_runtime::Dd;

use super::compare::{SizedLaw, dot, largest, times};
use super::regressor::LiteralRegressors;
use crate::bond_graph::{Multibody, Site};
use crate::expr::Inputs;
use crate::math::Vec3;
use crate::mechanism::LinkId;
use crate::method::{PARAMETERS_PER_BODY, PayloadRegressor};
use crate::random::Random;

/// Number of point masses: their parameters are in general position.
const POINTS: usize = 6;

/// A mass at a place.
type PlacedMass = (Dd, Vec3<Dd>);

/// Returns the law of a regressor of a payload; `found` is its result at `at`.
pub(super) fn laws(
    (graph, literals): (&Multibody, &LiteralRegressors),
    (of, found): (PayloadRegressor, &[Dd]),
    at: &Inputs<Dd>,
) -> Option<Vec<SizedLaw>> {
    let mut random = Random(47);
    let mut number = || Dd::from_f64(random.signed());
    let points: Vec<PlacedMass> = (0..POINTS)
        .map(|_| (number(), Vec3([number(), number(), number()])))
        .collect();
    let (link, carried) = on_moving_link(graph, &graph.sites[of.site().0], points.clone())?;
    let bodies = graph.moving_links();
    let body = bodies.iter().position(|other| *other == link)?;
    let mut parameters = vec![Dd::ZERO; PARAMETERS_PER_BODY * bodies.len()];
    parameters[PARAMETERS_PER_BODY * body..][..PARAMETERS_PER_BODY]
        .copy_from_slice(&of_points(&carried));
    let own = of_points(&points);
    let law = match of {
        PayloadRegressor::Regressor(_) => {
            let (_, efforts) = literals.by_any(at, parameters);
            let size = largest(&efforts);
            ("Y_X π = Y π of its link", times(found, &own), efforts, size)
        }
        PayloadRegressor::AdaptiveStep(_) => {
            let efforts = literals.two_velocities(at, parameters);
            let size = largest(&efforts) * largest(&at.u);
            let expected = vec![dot(&at.u, &efforts)];
            (
                "π·Y_Xᵀ s = s·Y π of its link",
                vec![dot(found, &own)],
                expected,
                size,
            )
        }
    };
    Some(vec![law])
}

/// Returns the link that joints move and that carries a frame, and points of the frame in the link's axes.
fn on_moving_link(
    graph: &Multibody,
    site: &Site,
    mut points: Vec<PlacedMass>,
) -> Option<(LinkId, Vec<PlacedMass>)> {
    let moving = graph.moving_links();
    let (mut link, mut pose) = (site.link?, site.pose);
    loop {
        for (_, x) in &mut points {
            *x = pose.translation + pose.rotation * *x;
        }
        if moving.contains(&link) {
            return Some((link, points));
        }
        let frame = &graph.frames[link.0];
        (link, pose) = (frame.parent?, frame.origin);
    }
}

/// Returns m, h and I about the origin.
fn of_points(points: &[PlacedMass]) -> [Dd; PARAMETERS_PER_BODY] {
    let one = |(m, x): &PlacedMass| {
        let [x, y, z] = x.0;
        let tensor = [
            y * y + z * z,
            -x * y,
            x * x + z * z,
            -x * z,
            -y * z,
            x * x + y * y,
        ];
        let [xx, xy, yy, xz, yz, zz] = tensor;
        [Dd::ONE, x, y, z, xx, xy, yy, xz, yz, zz].map(|entry| *m * entry)
    };
    let sum = |sum: [Dd; PARAMETERS_PER_BODY], own: [Dd; PARAMETERS_PER_BODY]| {
        std::array::from_fn(|k| sum[k] + own[k])
    };
    let zero = [Dd::ZERO; PARAMETERS_PER_BODY];
    points.iter().map(one).fold(zero, sum)
}
