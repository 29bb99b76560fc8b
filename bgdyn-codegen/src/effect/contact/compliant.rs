//! Contact with a compliant normal force and friction: the surfaces may overlap a little.

use super::super::{Effect, hunt_crossley, nodes};
use super::{CONTACT, friction, normal, one_law};
use crate::bond_graph::{BondNetwork, NodeKind, PowerTerm};
use crate::declaration::{EffectKind, Element, SceneContext, ValueCheck};
use crate::effort_sums::{ContactMotion, EffortSums};
use crate::expr::Expr;
use crate::fault::{Faults, wording};
use crate::format::{Dimension, Key};
use crate::layout::StateLayout;
use crate::math::Vec3;
use crate::mechanism::ContactPartner;

pub(in crate::effect) struct CompliantContact;

impl EffectKind for CompliantContact {
    fn keyword(&self) -> &'static str {
        "compliant_contact"
    }

    fn family(&self) -> &'static str {
        "contact"
    }

    fn summary(&self) -> &'static str {
        "compliant contact: λ = E(δ) (1 + (3/2) d δ̇) ≥ 0, E = k δ^(3/2) or k δ, along the normal, friction up to μ λ (smooth) or μ E (bristles) along the plane"
    }

    fn symbol(&self) -> &'static str {
        "C"
    }

    fn keys(&self) -> &'static [Key] {
        &[
            normal::STIFFNESS,
            normal::LINEAR_STIFFNESS,
            normal::DAMPING,
            normal::RESTITUTION,
            normal::IMPACT_SPEED,
            friction::KINETIC,
            friction::STATIC,
            friction::STRIBECK_SPEED,
            friction::WIDTH,
            friction::BRISTLES,
            friction::BRISTLE_DAMPING,
            friction::RELEASE,
            CONTACT,
        ]
    }

    fn check_values(&self, check: &mut ValueCheck<'_>) {
        normal::check(check);
        friction::check(check);
    }

    fn check_in_scene(&self, element: &Element, beside: &SceneContext<'_>, faults: &mut Faults) {
        one_law(element, beside, faults);
        let name = element.needed_name(&CONTACT);
        let pair = beside.mechanism.contact_pair(name);
        let round = pair.is_some_and(|pair| matches!(pair.partner, ContactPartner::Sphere(_)));
        if round && friction::has_bristles(element) {
            faults.push(wording::bristles_of_spheres(&element.location, name));
        }
    }

    fn declare(&self, element: &Element, layout: &mut StateLayout) {
        let (name, contact) = (&element.name, element.needed_name(&CONTACT));
        if friction::has_bristles(element) {
            for (state, axis) in friction::states(element).into_iter().zip(["x", "y"]) {
                let about =
                    format!("deflection of the bristles at `{contact}` along {axis} of the plane");
                layout.state(state, Dimension::Length, about);
            }
            let about = format!("the slip at `{contact}` turns against the bristles");
            layout.event(friction::reverses(element), about);
        }
        let about = [
            format!("`{contact}` touches"),
            format!("`{contact}` touches no more"),
            format!("the surfaces at `{contact}` part faster than they spring back, or no more"),
        ];
        hunt_crossley::declare(name, layout, about);
    }

    fn owns_state(&self, element: &Element, state: &str) -> bool {
        friction::states(element).iter().any(|own| own == state)
    }
}

impl Effect for CompliantContact {
    fn elements(&self, element: &Element, _: &[Element], network: &mut BondNetwork) {
        let port = nodes::contact(element, network);
        let both = [PowerTerm::Stored, PowerTerm::Dissipated];
        let pressed = network.add_on(port, NodeKind::Compliance, nodes::label(element));
        network.set_powers(pressed, &both);
        if friction::acts(element) {
            let text = format!("friction of {}", element.name);
            match friction::has_bristles(element) {
                true => {
                    let bristles = network.add_on(port, NodeKind::Compliance, text);
                    network.set_powers(bristles, &both);
                }
                false => {
                    network.add_on(port, NodeKind::Resistor, text);
                }
            }
        }
    }

    fn law(&self, element: &Element, sums: &mut EffortSums<'_, '_>) {
        let motion = sums.contact_motion(element);
        normal::note_spring(element, sums);
        let normal = normal::force(element, sums, (motion.gap, motion.rate));
        sums.store(normal.stored);
        sums.dissipate(normal.push.dissipated);
        let zero = sums.b.zero();
        let (along, more) = match friction::acts(element) {
            true => friction::force(element, sums, (&motion, &normal)),
            false => (Vec3([zero; 3]), zero),
        };
        let pressed = normal.push.force + more;
        sums.push_contact(&motion, motion.normal.scale(pressed) + along);
        hunt_crossley::set_events(&element.name, sums, (motion.gap, normal.push.follows));
        readings(element, sums, &motion, (pressed, along));
    }
}

/// Adds the outputs of a contact.
fn readings<'g>(
    element: &Element,
    sums: &mut EffortSums<'g, '_>,
    motion: &ContactMotion<'g>,
    (pressed, along): (Expr<'g>, Vec3<Expr<'g>>),
) {
    let name = &element.name;
    let mut add = |end: &str, value, unit, about: &str| {
        sums.reading(format!("{name}_{end}"), value, unit, about.to_owned());
    };
    add(
        "gap",
        motion.gap,
        "m",
        "distance of the surfaces, negative where they overlap",
    );
    add("normal", pressed, "N", "normal force");
    match motion.along {
        Some([x, y]) => {
            add(
                "friction_x",
                x.dot(along),
                "N",
                "force along x of the plane",
            );
            add(
                "friction_y",
                y.dot(along),
                "N",
                "force along y of the plane",
            );
        }
        None => add(
            "friction",
            along.dot(along).sqrt(),
            "N",
            "force along the plane of contact",
        ),
    }
    add(
        "slip",
        motion.slip.dot(motion.slip).sqrt(),
        "m/s",
        "speed along the plane of contact",
    );
}
