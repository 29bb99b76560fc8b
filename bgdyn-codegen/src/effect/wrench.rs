//! An external wrench on a link or at a frame: six inputs, or those asked for. A source of effort on
//! the flow V = [ω; v] of the place: τ_j += J_jᵀ w.

use super::{Effect, nodes};
use crate::bond_graph::{BondNetwork, NodeKind};
use crate::declaration::{Beside, Declaration, Element, Given};
use crate::expr::Ex;
use crate::fault::{Faults, wording};
use crate::format::{Dimension, Key, Reads};
use crate::laws::Laws;
use crate::layout::Layout;
use crate::math::Vec3;

pub(super) struct Wrench;

/// The place of a link that an effect acts at.
pub(super) const AT: Key = Key {
    name: "at",
    reads: Reads::Place,
    needed: true,
    about: "the link or frame at whose origin it acts",
};

/// Moments first, as everywhere.
const COMPONENTS: [&str; 6] = ["mx", "my", "mz", "fx", "fy", "fz"];

/// The components that are inputs.
fn components(element: &Element) -> Vec<&'static str> {
    let asked = element.words("components");
    let wanted = |c: &&str| asked.is_none_or(|asked| asked.iter().any(|a| a == c));
    COMPONENTS.into_iter().filter(wanted).collect()
}

/// Refuses a place that cannot move.
pub(super) fn moves(element: &Element, beside: &Beside<'_>, faults: &mut Faults) {
    let mut frames = beside.mechanism.frames().iter();
    let at = element.name(AT.name).unwrap_or_default();
    if frames.any(|f| f.name == at && f.link.is_none()) {
        faults.push(wording::acts_on_the_world(
            &element.place,
            &element.name,
            at,
        ));
    }
}

/// V = Σ_j J_j q̇_j, angular part first, world axes.
pub(super) fn twist<'g>(jacobian: &[[Ex<'g>; 6]], laws: &Laws<'g, '_>) -> [Ex<'g>; 6] {
    std::array::from_fn(|i| {
        let products = jacobian.iter().zip(&laws.v).map(|(j, &v)| j[i] * v);
        products.fold(laws.b.zero(), |sum, x| sum + x)
    })
}

/// Σ a_i b_i
pub(super) fn dot<'g>(a: &[Ex<'g>; 6], b: &[Ex<'g>; 6], laws: &Laws<'g, '_>) -> Ex<'g> {
    let products = a.iter().zip(b).map(|(&a, &b)| a * b);
    products.fold(laws.b.zero(), |sum, x| sum + x)
}

/// τ_j += J_jᵀ w
pub(super) fn act<'g>(jacobian: &[[Ex<'g>; 6]], wrench: &[Ex<'g>; 6], laws: &mut Laws<'g, '_>) {
    for (j, column) in jacobian.iter().enumerate() {
        let effort = dot(column, wrench, laws);
        laws.push_on(j, effort);
    }
}

impl Declaration for Wrench {
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
        &[
            AT,
            Key {
                name: "axes",
                reads: Reads::Word(&["world", "link"]),
                needed: false,
                about: "axes of its components: `world` (also where nothing is said), or `link`, those of the place",
            },
            Key {
                name: "components",
                reads: Reads::Words(&COMPONENTS),
                needed: false,
                about: "those that are inputs, all six without it",
            },
        ]
    }

    fn rules(&self, given: &mut Given<'_>) {
        let Some(asked) = given.element.words("components") else {
            return;
        };
        let twice = (1..asked.len()).find(|&i| asked[..i].contains(&asked[i]));
        let place = &given.element.place;
        let fault = match twice {
            Some(i) => wording::repeated_component(place, &asked[i]),
            None if asked.is_empty() => wording::no_components(place),
            None => return,
        };
        given.report(fault);
    }

    fn fits(&self, element: &Element, beside: &Beside<'_>, faults: &mut Faults) {
        moves(element, beside, faults);
    }

    fn declare(&self, element: &Element, layout: &mut Layout) {
        let (name, at) = (&element.name, element.name(AT.name).unwrap_or_default());
        let axes = match element.name("axes") {
            Some("link") => "its own axes",
            _ => "world axes",
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

impl Effect for Wrench {
    fn elements(&self, element: &Element, _: &[Element], network: &mut BondNetwork) {
        let site = nodes::site(element, network);
        network.add_on(site, NodeKind::EffortSource, nodes::label(element));
    }

    fn law(&self, element: &Element, laws: &mut Laws<'_, '_>) {
        let site = laws.site(element.name(AT.name).unwrap_or_default());
        let inputs = components(element);
        let given = COMPONENTS.map(|c| match inputs.contains(&c) {
            true => laws.input(&format!("{}_{c}", element.name)),
            false => laws.b.zero(),
        });
        let [mx, my, mz, fx, fy, fz] = given;
        let wrench = if element.name("axes") == Some("link") {
            let axes = laws.pose(site).0;
            let (moment, force) = (axes * Vec3([mx, my, mz]), axes * Vec3([fx, fy, fz]));
            let ([mx, my, mz], [fx, fy, fz]) = (moment.0, force.0);
            [mx, my, mz, fx, fy, fz]
        } else {
            given
        };
        let jacobian = laws.jacobian(site);
        act(&jacobian, &wrench, laws);
        let power = dot(&wrench, &twist(&jacobian, laws), laws);
        laws.supply(power);
    }
}
