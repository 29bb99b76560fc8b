//! A state of a scene by the names of its parts, and the sums of the effects' laws.

use std::collections::BTreeMap;
use std::fmt;

use bgdyn_runtime::Dd;

use super::contact_law::Reading;
use super::mechanism::{Mechanism, Motion, Place, Wrench, seen};
use super::vector::{V3, add};

/// Numbers by name.
pub type Named = BTreeMap<String, Dd>;

/// Coordinates and velocities have the name of the joint, or of the effect that adds them.
#[derive(Clone, Debug, Default)]
pub struct State {
    pub q: Named,
    pub v: Named,
    /// First-order states.
    pub x: Named,
    pub u: Named,
    /// By the effect's name.
    pub modes: Named,
}

/// For messages of failed tests: the leading words of the numbers.
impl fmt::Display for State {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let State { q, v, x, u, modes } = self;
        for (part, named) in [("q", q), ("v", v), ("x", x), ("u", u), ("modes", modes)] {
            let numbers = named
                .iter()
                .map(|(name, x)| format!("{name}: {:e}", x.hi()));
            writeln!(
                f,
                "{part}: {{ {} }}",
                numbers.collect::<Vec<_>>().join(", ")
            )?;
        }
        Ok(())
    }
}

/// The arguments of a law.
pub struct At<'a> {
    pub mechanism: &'a Mechanism,
    pub motions: &'a [Motion],
    pub state: &'a State,
}

impl At<'_> {
    pub fn q(&self, name: &str) -> Dd {
        self.state.q[name]
    }

    pub fn v(&self, name: &str) -> Dd {
        self.state.v[name]
    }

    pub fn input(&self, name: &str) -> Dd {
        let found = self.state.u.get(name);
        *found.unwrap_or_else(|| panic!("no input {name}"))
    }

    pub fn place(&self, name: &str) -> Place {
        self.mechanism.places[name]
    }

    /// The velocity of a place's origin.
    pub fn velocity(&self, place: Place) -> V3 {
        let (arm, _, carrier) = seen(place, self.motions);
        carrier.velocity_at(arm)
    }
}

/// The sums of the laws.
#[derive(Clone, Debug, Default)]
pub struct Sums {
    /// Efforts on joints and on coordinates of effects.
    pub efforts: Named,
    pub wrenches: Vec<Wrench>,
    /// Rates of first-order states.
    pub rates: Named,
    /// Inertia of coordinates that effects add.
    pub inertia: Named,
    /// Accelerations of coordinates that friction holds.
    pub held: Named,
    /// Energy stored by the effects.
    pub stored: Dd,
    /// Volume flows into the nodes of hydraulics.
    pub flows: Named,
    /// Pressures of nodes.
    pub pressures: Named,
    /// What contacts do, by the effects' names.
    pub contacts: BTreeMap<String, Reading>,
}

impl Sums {
    pub fn push(&mut self, coordinate: &str, effort: Dd) {
        let sum = self.efforts.entry(coordinate.into()).or_insert(Dd::ZERO);
        *sum += effort;
    }

    pub fn flow(&mut self, node: &str, flow: Dd) {
        let sum = self.flows.entry(node.into()).or_insert(Dd::ZERO);
        *sum += flow;
    }

    /// Adds a force at a site's origin and a moment; in the world they have no effect.
    pub fn wrench(&mut self, at: &At<'_>, place: Place, force: V3, moment: V3) {
        let (arm, _, carrier) = seen(place, at.motions);
        if let Some(body) = place.body {
            let at = add(carrier.place, arm);
            self.wrenches.push(Wrench {
                body,
                at,
                force,
                moment,
            });
        }
    }
}
