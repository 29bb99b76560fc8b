//! An external wrench on a link or at a frame, with six inputs or a selection of them.
//!
//! It is an effort source on the flow V = [ω; v] of the site: τ_j += J_jᵀ w.

use super::keys::AT;
use super::{Effect, nodes};
use crate::bond_graph::{BondNetwork, NodeKind};
use crate::declaration::{EffectKind, Element, SceneContext, ValueCheck};
use crate::effort_sums::EffortSums;
use crate::expr::Expr;
use crate::fault::{Faults, wording};
use crate::format::{Dimension, Key, Reads};
use crate::layout::StateLayout;
use crate::math::Vec3;

pub(super) struct WrenchEffect;

/// Moments first, as in all spatial vectors.
const COMPONENTS: [&str; 6] = ["mx", "my", "mz", "fx", "fy", "fz"];

/// The word for the axes of the link.
const OF_LINK: &str = "link";

const AXES: Key = Key {
    name: "axes",
    reads: Reads::Word(&["world", OF_LINK]),
    needed: false,
    about: "axes of its components: `world` (also where nothing is said), or `link`, those of the place",
};
const SELECTED: Key = Key {
    name: "components",
    reads: Reads::Words(&COMPONENTS),
    needed: false,
    about: "the components that are inputs; default all six",
};

/// Returns the components that are inputs.
fn components(element: &Element) -> Vec<&'static str> {
    let asked = element.words(&SELECTED);
    let wanted = |c: &&str| asked.is_none_or(|asked| asked.iter().any(|a| a == c));
    COMPONENTS.into_iter().filter(wanted).collect()
}

/// Refuses a site that cannot move.
pub(super) fn moves(element: &Element, beside: &SceneContext<'_>, faults: &mut Faults) {
    let mut frames = beside.mechanism.frames().iter();
    let at = element.needed_name(&AT);
    if frames.any(|f| f.name == at && f.link.is_none()) {
        faults.push(wording::acts_on_the_world(
            &element.location,
            &element.name,
            at,
        ));
    }
}

/// Returns V = Σ_j J_j q̇_j, angular part first, world axes.
pub(super) fn twist<'g>(jacobian: &[[Expr<'g>; 6]], sums: &EffortSums<'g, '_>) -> [Expr<'g>; 6] {
    std::array::from_fn(|i| {
        let products = jacobian.iter().zip(&sums.v).map(|(j, &v)| j[i] * v);
        products.fold(sums.b.zero(), |sum, x| sum + x)
    })
}

/// Returns Σ a_i b_i.
pub(super) fn dot<'g>(a: &[Expr<'g>; 6], b: &[Expr<'g>; 6], sums: &EffortSums<'g, '_>) -> Expr<'g> {
    let products = a.iter().zip(b).map(|(&a, &b)| a * b);
    products.fold(sums.b.zero(), |sum, x| sum + x)
}

/// Adds τ_j += J_jᵀ w.
pub(super) fn act<'g>(
    jacobian: &[[Expr<'g>; 6]],
    wrench: &[Expr<'g>; 6],
    sums: &mut EffortSums<'g, '_>,
) {
    for (j, column) in jacobian.iter().enumerate() {
        let effort = dot(column, wrench, sums);
        sums.push_on(j, effort);
    }
}

impl EffectKind for WrenchEffect {
    fn keyword(&self) -> &'static str {
        "wrench"
    }

    fn family(&self) -> &'static str {
        "wrenches"
    }

    fn summary(&self) -> &'static str {
        "external wrench w = [m; f] on a link: τ_j = J_jᵀ w"
    }

    fn symbol(&self) -> &'static str {
        "Se"
    }

    fn keys(&self) -> &'static [Key] {
        &[AT, AXES, SELECTED]
    }

    fn check_values(&self, check: &mut ValueCheck<'_>) {
        let Some(asked) = check.element.words(&SELECTED) else {
            return;
        };
        let twice = (1..asked.len()).find(|&i| asked[..i].contains(&asked[i]));
        let location = &check.element.location;
        let fault = match twice {
            Some(i) => wording::repeated_component(location, &asked[i]),
            None if asked.is_empty() => wording::no_components(location),
            None => return,
        };
        check.report(fault);
    }

    fn check_in_scene(&self, element: &Element, beside: &SceneContext<'_>, faults: &mut Faults) {
        moves(element, beside, faults);
    }

    fn declare(&self, element: &Element, layout: &mut StateLayout) {
        let (name, at) = (&element.name, element.needed_name(&AT));
        let axes = match element.says(&AXES, OF_LINK) {
            true => "its own axes",
            false => "world axes",
        };
        for component in components(element) {
            let (what, dimension) = match component.as_bytes() {
                [b'm', ..] => ("moment", Dimension::Torque),
                _ => ("force", Dimension::Force),
            };
            let about = format!("{what} along {} on `{at}`, {axes}", &component[1..]);
            layout.input(format!("{name}_{component}"), dimension, about);
        }
    }
}

impl Effect for WrenchEffect {
    fn elements(&self, element: &Element, _: &[Element], network: &mut BondNetwork) {
        let site = nodes::site(element, network);
        network.add_on(site, NodeKind::EffortSource, nodes::label(element));
    }

    fn law(&self, element: &Element, sums: &mut EffortSums<'_, '_>) {
        let site = sums.site(element.needed_name(&AT));
        let inputs = components(element);
        let check = COMPONENTS.map(|c| match inputs.contains(&c) {
            true => sums.input(&format!("{}_{c}", element.name)),
            false => sums.b.zero(),
        });
        let [mx, my, mz, fx, fy, fz] = check;
        let wrench = if element.says(&AXES, OF_LINK) {
            let axes = sums.pose(site).0;
            let (moment, force) = (axes * Vec3([mx, my, mz]), axes * Vec3([fx, fy, fz]));
            let ([mx, my, mz], [fx, fy, fz]) = (moment.0, force.0);
            [mx, my, mz, fx, fy, fz]
        } else {
            check
        };
        let jacobian = sums.jacobian(site);
        act(&jacobian, &wrench, sums);
        let power = dot(&wrench, &twist(&jacobian, sums), sums);
        sums.supply(power);
    }
}
