//! The balance of power: what each effect supplies, stores and dissipates.
//!
//! Σ supplied = Σ d(stored)/dt + Σ dissipated holds to round-off, whatever the effects are.

use super::dynamics::rates;
use super::holds::held;
use super::summed::summed;
use super::{Balance, Contact, Laws, Named, Own, System};
use crate::bond_graph::PowerTerm;
use crate::declaration::Element;
use crate::expr::{Builder, Ex, Expr, Graph, Leaf, Tangent};
use crate::method::Method;

/// The links' and rotors' own entry: kinetic energy.
const LINKS: &str = "links";
/// The entry of the efforts that are inputs.
const DRIVES: &str = "drives";
/// The entry of what is missing without velocity products: ½ q̇ᵀ Ṁ q̇.
const DROPPED: &str = "dropped_velocity_products";

/// The entries of a scene's balance, in order.
pub(super) fn entries(system: &System, laws: &Laws<'_, '_>) -> Vec<Named> {
    all(system, laws)
        .into_iter()
        .map(|(named, _)| named)
        .collect()
}

/// Its power is in W, its energy in J.
fn entry(name: String, about: String) -> Named {
    let unit = "";
    Named { name, unit, about }
}

/// The entries of the elements that have a term in the balance, by their nodes of the bond graph, and are
/// not nothing; then the scene's own.
fn all(system: &System, laws: &Laws<'_, '_>) -> Vec<(Named, Source)> {
    let (scene, graph) = (&system.scene, &system.graph);
    let mut found = Vec::new();
    for (i, element) in scene.elements.iter().enumerate() {
        let terms: Vec<PowerTerm> = system.network.powers_of(i).collect();
        check_terms(element, &terms, laws.balances()[i]);
        let Balance {
            supplied,
            stored,
            dissipated,
        } = laws.balances()[i];
        let holds = laws.contacts().iter().any(|c| c.element == i);
        let acts = holds || [supplied, stored, dissipated].iter().any(|x| !x.is_zero());
        if acts && !terms.is_empty() {
            let about = element.effect.summary().to_owned();
            let name = element.name.clone();
            found.push((entry(name, about), Source::Element(i)));
        }
    }
    let mut own = |name: &str, about: &str, source| {
        let (name, about) = (name.to_owned(), about.to_owned());
        found.push((entry(name, about), source));
    };
    own(LINKS, "kinetic energy of links and rotors", Source::Links);
    if (0..scene.layout.nq()).any(|j| !laws.own_effort(j).is_zero()) {
        own(
            DRIVES,
            "efforts at the joints that are inputs",
            Source::Drives,
        );
    }
    // Where the kinetic energy reads no position, M is constant and nothing is missing.
    let kinetic = laws.method(Method::KineticEnergy)[0];
    if !graph.velocity_products && laws.reads_positions(kinetic) {
        let about = "½ q̇ᵀ Ṁ q̇, which the velocity products would have supplied";
        own(DROPPED, about, Source::Dropped);
    }
    found
}

/// Panics where the law of an element has a term in the balance that none of its nodes of the bond graph
/// has: an error of the effect's author.
fn check_terms(element: &Element, terms: &[PowerTerm], balance: Balance<'_>) {
    let all = [
        (PowerTerm::Supplied, balance.supplied, "supplies"),
        (PowerTerm::Stored, balance.stored, "stores"),
        (PowerTerm::Dissipated, balance.dissipated, "dissipates"),
    ];
    for (term, value, verb) in all {
        assert!(
            value.is_zero() || terms.contains(&term),
            "the law of the effect `{}` (element `{}`) {verb} power, but none of its nodes of the bond graph does",
            element.effect.keyword(),
            element.name,
        );
    }
}

/// Where an entry comes from.
#[derive(Clone, Copy)]
enum Source {
    Element(usize),
    Links,
    Drives,
    Dropped,
}

/// Energy stored by each entry.
pub(super) fn energy<'g>(system: &System, b: &'g Builder) -> Vec<Ex<'g>> {
    let laws = summed(b, &system.scene, &system.graph, Own::Inputs);
    let all = all(system, &laws);
    let stored = |(_, source): (Named, Source)| match source {
        Source::Element(i) => laws.balances()[i].stored,
        Source::Links => laws.method(Method::KineticEnergy)[0],
        _ => b.zero(),
    };
    all.into_iter().map(stored).collect()
}

/// For each entry: power supplied, rate of the energy stored, power dissipated.
pub(super) fn power<'g>(system: &System, b: &'g Builder) -> Vec<Ex<'g>> {
    let mut laws = summed(b, &system.scene, &system.graph, Own::Inputs);
    let rates = rates(system, &laws, b);
    // Friction that holds a joint against a moving counterpart takes its power from there. What holds
    // a coordinate at the limit of its rate has it in the element's law.
    if !laws.contacts().is_empty() {
        let holding = held(system, &laws, b).holding;
        let half = b.number(0.5);
        let contacts = laws.contacts().to_vec();
        let friction = |c: &&(Contact<'g>, Ex<'g>)| c.0.hold.range().is_some();
        for (c, holding) in contacts.into_iter().zip(holding).filter(|c| friction(&c)) {
            let mode = laws.mode_at(c.mode);
            let carried = holding * c.reference[0];
            let held = mode.abs().if_less(half, carried, b.zero());
            let supplied = &mut laws.balance_of(c.element).supplied;
            *supplied = *supplied + held;
        }
    }
    let mut along = Along::new(system, &laws, &rates);
    let kinetic = laws.method(Method::KineticEnergy)[0];
    let kinetic_rate = along.rate(b, kinetic);
    let mut out = Vec::new();
    for (_, source) in all(system, &laws) {
        let zero = b.zero();
        out.extend(match source {
            Source::Element(i) => {
                let balance = laws.balances()[i];
                let stored = along.rate(b, balance.stored);
                [balance.supplied, stored, balance.dissipated]
            }
            Source::Links => [zero, kinetic_rate, zero],
            Source::Drives => {
                let n = system.scene.layout.nq();
                let power = (0..n).fold(zero, |sum, j| sum + laws.own_effort(j) * laws.v[j]);
                [power, zero, zero]
            }
            Source::Dropped => {
                let n = system.graph.coordinates.len();
                let inertial = laws.method(Method::MassMatrix);
                let entry = |i: usize, j: usize| inertial[i.max(j) * (i.max(j) + 1) / 2 + i.min(j)];
                let mut delivered = zero;
                for i in 0..n {
                    let row = (0..n).fold(zero, |sum, j| sum + entry(i, j) * rates[j]);
                    delivered = delivered + laws.v[i] * row;
                }
                [kinetic_rate - delivered, zero, zero]
            }
        });
    }
    out
}

/// Rates of change along the motion.
struct Along {
    tangents: Vec<(Leaf, Expr)>,
}

impl Along {
    fn new<'g>(system: &System, laws: &Laws<'g, '_>, rates: &[Ex<'g>]) -> Self {
        let layout = &system.scene.layout;
        let (nq, nv, nx) = (layout.nq(), layout.nv(), layout.nx());
        let mut tangents: Vec<(Leaf, Expr)> = Vec::new();
        tangents.extend((0..nq).map(|j| (Leaf::Position(j), laws.v[j].expr())));
        tangents.extend((0..nv).map(|j| (Leaf::Velocity(j), rates[j].expr())));
        tangents.extend((0..nx).map(|i| (Leaf::State(i), rates[nv + i].expr())));
        // A reference's place moves with its rate.
        for (i, part) in layout.inputs.iter().enumerate() {
            let rate = crate::scene::Level::Rate.name(&part.name);
            if let Some(k) = layout.inputs.iter().position(|p| p.name == rate) {
                tangents.push((Leaf::Input(i), laws.inputs()[k].expr()));
            }
        }
        Along { tangents }
    }

    fn rate<'g>(&mut self, b: &'g Builder, x: Ex<'g>) -> Ex<'g> {
        let x = x.expr();
        let seed = |_: &mut Graph, leaf: Leaf| {
            let found = self.tangents.iter().find(|(l, _)| *l == leaf);
            found.map(|(_, tangent)| *tangent)
        };
        let rate = b.with_graph(|g| Tangent::new(seed).of(g, x));
        b.ex(rate)
    }
}
