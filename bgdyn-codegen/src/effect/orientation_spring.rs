//! A spring that turns one link or frame to the orientation of another, with a damper.
//!
//! Examples are a rubber bushing, and a ball joint with a restoring moment.
//!
//! With the unit vectors a_i of the axes of the first place and b_i of the second, turned by θ about n against
//! the first, Σ a_i × b_i = 2 n sin θ and Σ a_i · b_i = 1 + 2 cos θ. The moment on the second place is
//! −½ k Σ a_i × b_i − d ω = −k n sin θ − d ω, with the angular velocity ω relative to the first place. The
//! potential is ½ k (3 − Σ a_i · b_i) = k (1 − cos θ).

use bgdyn_runtime::Dd;

use super::spring::BETWEEN;
use super::{Effect, nodes};
use crate::bond_graph::{BondNetwork, NodeKind, PortSite, SiteId};
use crate::declaration::{EffectKind, Element, ValueCheck, undeclared};
use crate::effort_sums::EffortSums;
use crate::expr::Expr;
use crate::fault::Help;
use crate::format::{Dimension, Key, Reads};
use crate::math::{Mat3, Vec3};

pub(super) struct OrientationSpring;

const STIFFNESS: Key = Key {
    name: "stiffness",
    reads: Reads::Number(&[Dimension::AngularStiffness]),
    needed: true,
    about: "k, the moment per angle of small turns",
};
const DAMPING: Key = Key {
    name: "damping",
    reads: Reads::Number(&[Dimension::AngularDamping]),
    needed: false,
    about: "d, moment per relative angular velocity; 0 without it",
};
const PLACES: Key = Key {
    needed: true,
    about: "two links or frames: it turns the second to the orientation of the first",
    ..BETWEEN
};

impl EffectKind for OrientationSpring {
    fn keyword(&self) -> &'static str {
        "orientation_spring"
    }

    fn family(&self) -> &'static str {
        "springs"
    }

    fn summary(&self) -> &'static str {
        "spring and damper between two orientations: m = −k n sin θ − d ω"
    }

    fn symbol(&self) -> &'static str {
        "C"
    }

    fn acts_along_line(&self) -> bool {
        false
    }

    fn keys(&self) -> &'static [Key] {
        &[STIFFNESS, DAMPING, PLACES]
    }

    fn check_values(&self, check: &mut ValueCheck<'_>) {
        check.not_negative(&[STIFFNESS], Help::StiffnessPushes);
        check.not_negative(&[DAMPING], Help::DampingDrivesMotion);
    }
}

impl Effect for OrientationSpring {
    fn elements(&self, element: &Element, _: &[Element], network: &mut BondNetwork) {
        let [first, second] = places(element);
        let moving = [second, first]
            .into_iter()
            .filter(|site| network.moves(site));
        let moving: Vec<PortSite> = moving.map(|site| PortSite::Site(site.to_owned())).collect();
        let turning = match &moving[..] {
            [] => network.port(PortSite::Site(second.to_owned())),
            [one] => network.port(one.clone()),
            [second, first, ..] => {
                let [second, first] = [second, first].map(|place| network.port(place.clone()));
                let zero = network.add(NodeKind::Zero, "m");
                network.bond(second, zero);
                network.bond(zero, first);
                let difference = network.add(NodeKind::One, "ω");
                network.bond(zero, difference);
                difference
            }
        };
        network.add_on(turning, NodeKind::Compliance, nodes::label(element));
        if element.quantity(&DAMPING).is_some() {
            let damping = nodes::number(element, "d", &DAMPING);
            network.add_on(turning, NodeKind::Resistor, damping);
        }
    }

    fn law(&self, element: &Element, sums: &mut EffortSums<'_, '_>) {
        let [first, second] = places(element).map(|name| sums.site(name));
        let (target, axes) = (sums.pose(first).0, sums.pose(second).0);
        let columns = turning(sums, [first, second]);
        let still = |column: &Vec3<Expr<'_>>| column.0.iter().all(|x| x.is_zero());
        if columns.iter().all(still) {
            return;
        }
        let zero = Vec3([sums.b.zero(); 3]);
        let rate = columns.iter().zip(&sums.v);
        let rate = rate.fold(zero, |sum, (column, &v)| sum + column.scale(v));
        let (across, along) = compared(target, axes);
        let half = Dd::from_f64(0.5);
        let (stiffness, damping) = (
            sums.number(element, &STIFFNESS),
            sums.number(element, &DAMPING),
        );
        let resisted = rate.scale(damping);
        let moment = -across.scale(stiffness * half) - resisted;
        for (j, column) in columns.iter().enumerate() {
            sums.push_on(j, column.dot(moment));
        }
        sums.store((sums.b.number(3.0) - along) * stiffness * half);
        sums.dissipate(resisted.dot(rate));
    }
}

/// Returns the names of the two places.
fn places(element: &Element) -> [&str; 2] {
    let names = element.names(&PLACES).map(|names| names.each_ref());
    let names = names.unwrap_or_else(|| undeclared(element, "value of the key", PLACES.name));
    names.map(String::as_str)
}

/// Returns Σ a_i × b_i and Σ a_i · b_i of the columns.
fn compared<'g>(a: Mat3<Expr<'g>>, b: Mat3<Expr<'g>>) -> (Vec3<Expr<'g>>, Expr<'g>) {
    let pairs = [0, 1, 2].map(|i| (a.column(i), b.column(i)));
    let [(p, u), (q, v), (r, w)] = pairs;
    let across = p.cross(u) + q.cross(v) + r.cross(w);
    (across, p.dot(u) + q.dot(v) + r.dot(w))
}

/// Returns the angular velocity of the second site relative to the first one per unit velocity of each
/// coordinate, world axes.
fn turning<'g>(sums: &mut EffortSums<'g, '_>, [first, second]: [SiteId; 2]) -> Vec<Vec3<Expr<'g>>> {
    let [a, b] = [first, second].map(|site| sums.jacobian(site));
    let angular = |column: &[Expr<'g>; 6]| Vec3([column[0], column[1], column[2]]);
    let pairs = a.iter().zip(&b);
    pairs.map(|(a, b)| angular(b) - angular(a)).collect()
}
