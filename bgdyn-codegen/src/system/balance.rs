//! The balance of power: the power that each effect supplies, stores and dissipates.
//!
//! Σ supplied = Σ d(stored)/dt + Σ dissipated is satisfied to rounding, for any effects.

use super::dynamics::rates;
use super::holds::held;
use super::summed::summed;
use super::{ActuatorEfforts, Balance, Contact, EffortSums, Named, SceneEquations};
use crate::bond_graph::PowerTerm;
use crate::declaration::Element;
use crate::expr::{Builder, Expr, Graph, Leaf, Signed, Tangent};
use crate::method::Method;
use crate::scene::Level;

/// The entry of links and rotors: kinetic energy.
const LINKS: &str = "links";
/// The entry of the drives.
const DRIVES: &str = "drives";
/// The entry of the drives of prescribed joints.
const PRESCRIBED: &str = "prescribed_drives";
/// The entry of the power that is missing without velocity products: ½ q̇ᵀ Ṁ q̇.
const DROPPED: &str = "dropped_velocity_products";

/// Returns the entries of a scene's balance, in order.
pub(super) fn entries(system: &SceneEquations, sums: &EffortSums<'_, '_>) -> Vec<Named> {
    all(system, sums)
        .into_iter()
        .map(|(named, _)| named)
        .collect()
}

/// Returns an entry; its power is in W, its energy in J.
fn entry(name: String, about: String) -> Named {
    let unit = "";
    Named { name, unit, about }
}

/// Returns the entries of the elements with a nonzero term in the balance, according to their nodes of the
/// bond graph; then the scene's own entries.
fn all(system: &SceneEquations, sums: &EffortSums<'_, '_>) -> Vec<(Named, EntrySource)> {
    let (scene, graph) = (&system.scene, &system.graph);
    let mut found = Vec::new();
    for (i, element) in scene.elements.iter().enumerate() {
        let terms: Vec<PowerTerm> = system.network.powers_of(i).collect();
        check_terms(element, &terms, sums.balances()[i]);
        let Balance {
            supplied,
            stored,
            dissipated,
        } = sums.balances()[i];
        let holds = sums.contacts().iter().any(|c| c.element == i);
        let touches = sums.rigid_contacts().iter().any(|c| c.element == i);
        let acts = holds || touches || [supplied, stored, dissipated].iter().any(|x| !x.is_zero());
        if acts && !terms.is_empty() {
            let about = element.effect.summary().to_owned();
            let name = element.name.clone();
            found.push((entry(name, about), EntrySource::Element(i)));
        }
    }
    let mut own = |name: &str, about: &str, source| {
        let (name, about) = (name.to_owned(), about.to_owned());
        found.push((entry(name, about), source));
    };
    own(
        LINKS,
        "kinetic energy of links and rotors",
        EntrySource::Links,
    );
    if !sums.drive_power().is_zero() {
        own(
            DRIVES,
            "efforts at the joints that are inputs",
            EntrySource::Drives,
        );
    }
    if !scene.layout.prescribed.is_empty() {
        let about = "drives of the prescribed joints";
        own(PRESCRIBED, about, EntrySource::Prescribed);
    }
    // If the kinetic energy depends on no position, M is constant and no power is missing.
    let kinetic = sums.method(Method::KineticEnergy)[0];
    let varies = sums.reads_positions(kinetic) || !scene.layout.prescribed.is_empty();
    if !graph.velocity_products && varies {
        let about = "½ q̇ᵀ Ṁ q̇, which the velocity products would have supplied";
        own(DROPPED, about, EntrySource::Dropped);
    }
    found
}

/// Panics if the law of an element has a term in the balance that none of its bond graph nodes has: an
/// error of the effect's author.
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

/// The source of an entry.
#[derive(Clone, Copy)]
enum EntrySource {
    Element(usize),
    Links,
    Drives,
    Prescribed,
    Dropped,
}

/// Returns the energy stored by each entry.
pub(super) fn energy<'g>(system: &SceneEquations, b: &'g Builder) -> Vec<Expr<'g>> {
    let sums = summed(b, &system.scene, &system.graph, ActuatorEfforts::FromInputs);
    let all = all(system, &sums);
    let stored = |(_, source): (Named, EntrySource)| match source {
        EntrySource::Element(i) => sums.balances()[i].stored,
        EntrySource::Links => sums.method(Method::KineticEnergy)[0],
        _ => b.zero(),
    };
    all.into_iter().map(stored).collect()
}

/// Returns, for each entry, power supplied, rate of the stored energy, power dissipated.
pub(super) fn power<'g>(system: &SceneEquations, b: &'g Builder) -> Vec<Expr<'g>> {
    let mut sums = summed(b, &system.scene, &system.graph, ActuatorEfforts::FromInputs);
    let rates = rates(system, &sums, b);
    // Friction that holds a joint against a moving counterpart receives its power from the counterpart.
    // For a coordinate held at the limit of its rate, the element's law accounts for the power.
    if !sums.contacts().is_empty() {
        let holding = held(system, &sums, b).holding;
        let half = b.number(0.5);
        let contacts = sums.contacts().to_vec();
        let friction = |c: &&(Contact<'g>, Expr<'g>)| c.0.hold.range().is_some();
        for (c, holding) in contacts.into_iter().zip(holding).filter(|c| friction(&c)) {
            let mode = sums.mode_at(c.mode);
            let carried = holding * c.reference[0];
            let held = mode.abs().if_less(half, carried, b.zero());
            let supplied = &mut sums.balance_of(c.element).supplied;
            *supplied = *supplied + held;
        }
    }
    let mut along = TimeDerivative::new(system, &sums, &rates);
    let kinetic = sums.method(Method::KineticEnergy)[0];
    let kinetic_rate = along.rate(b, kinetic);
    let mut out = Vec::new();
    for (_, source) in all(system, &sums) {
        let zero = b.zero();
        out.extend(match source {
            EntrySource::Element(i) => {
                let balance = sums.balances()[i];
                let stored = along.rate(b, balance.stored);
                [balance.supplied, stored, balance.dissipated]
            }
            EntrySource::Links => [zero, kinetic_rate, zero],
            EntrySource::Drives => [sums.drive_power(), zero, zero],
            EntrySource::Prescribed => [supplied_by_prescribed(&sums, &rates), zero, zero],
            EntrySource::Dropped if !system.scene.layout.prescribed.is_empty() => {
                let inertial = inertial_power(&sums, &rates);
                let weights = sums.potential_energy();
                let lifted = weights.iter().fold(zero, |sum, &v| sum + along.rate(b, v));
                [kinetic_rate + lifted - inertial, zero, zero]
            }
            EntrySource::Dropped => {
                let n = system.graph.coordinates.len();
                let inertial = sums.method(Method::MassMatrix);
                let entry = |i: usize, j: usize| inertial[i.max(j) * (i.max(j) + 1) / 2 + i.min(j)];
                let mut delivered = zero;
                for i in 0..n {
                    let row = (0..n).fold(zero, |sum, j| sum + entry(i, j) * rates[j]);
                    delivered = delivered + sums.v[i] * row;
                }
                [kinetic_rate - delivered, zero, zero]
            }
        });
    }
    out
}

/// Returns Σ P_k σ_k over the prescribed joints, with their efforts P_k at these accelerations.
fn supplied_by_prescribed<'g>(sums: &EffortSums<'g, '_>, accelerations: &[Expr<'g>]) -> Expr<'g> {
    let joints = &sums.scene().layout.prescribed;
    let efforts = sums.method_at(Method::DriveEfforts(joints.len()), accelerations);
    let rates = joints
        .iter()
        .map(|joint| sums.reference(Some(joint), Level::Rate));
    let products = efforts.into_iter().zip(rates).map(|(p, rate)| p * rate);
    products.fold(sums.b.zero(), |sum, power| sum + power)
}

/// Returns the power of all P at these accelerations, those of the prescribed joints included.
fn inertial_power<'g>(sums: &EffortSums<'g, '_>, accelerations: &[Expr<'g>]) -> Expr<'g> {
    let efforts = sums.method_at(Method::InverseDynamics, accelerations);
    let products = efforts.into_iter().zip(&sums.v).map(|(p, &v)| p * v);
    let own = products.fold(sums.b.zero(), |sum, power| sum + power);
    own + supplied_by_prescribed(sums, accelerations)
}

/// The rates of change along the motion.
struct TimeDerivative {
    tangents: Vec<(Leaf, Signed)>,
}

impl TimeDerivative {
    fn new<'g>(system: &SceneEquations, sums: &EffortSums<'g, '_>, rates: &[Expr<'g>]) -> Self {
        let layout = &system.scene.layout;
        let (nv, nx) = (layout.nv(), layout.nx());
        let mut tangents: Vec<(Leaf, Signed)> = Vec::new();
        let position_rates = sums.position_rates().into_iter().enumerate();
        tangents.extend(position_rates.map(|(p, rate)| (Leaf::Position(p), rate.signed())));
        tangents.extend((0..nv).map(|j| (Leaf::Velocity(j), rates[j].signed())));
        tangents.extend((0..nx).map(|i| (Leaf::State(i), rates[nv + i].signed())));
        // A reference's position changes with its rate.
        for (i, part) in layout.inputs.iter().enumerate() {
            let rate = crate::scene::Level::Rate.name(&part.name);
            if let Some(k) = layout.inputs.iter().position(|p| p.name == rate) {
                tangents.push((Leaf::Input(i), sums.inputs()[k].signed()));
            }
        }
        // The rate of a prescribed joint changes with its acceleration.
        for joint in &layout.prescribed {
            let rate = Level::Rate.name(joint);
            if let Some(i) = layout.inputs.iter().position(|p| p.name == rate) {
                let acceleration = sums.reference(Some(joint), Level::Acceleration);
                tangents.push((Leaf::Input(i), acceleration.signed()));
            }
        }
        TimeDerivative { tangents }
    }

    fn rate<'g>(&mut self, b: &'g Builder, x: Expr<'g>) -> Expr<'g> {
        let x = x.signed();
        let seed = |_: &mut Graph, leaf: Leaf| {
            let found = self.tangents.iter().find(|(l, _)| *l == leaf);
            found.map(|(_, tangent)| *tangent)
        };
        let rate = b.with_graph(|g| Tangent::new(seed).of(g, x));
        b.expr(rate)
    }
}
