//! Accelerations and rates, the efforts behind given accelerations, events and contacts.

use super::laws::copied;
use super::{Laws, Own, System};
use crate::expr::{Builder, Ex, Expr, Graph, Leaf, copy_into};
use crate::formulation::{self, Formulation, Search};
use crate::function::Function;
use crate::method::{Method, Role};

/// The ways to v̇ and ẋ.
pub(super) fn derivatives(system: &System) -> Vec<Function> {
    if !system.scene.layout.modes.is_empty() {
        return vec![with_modes(system, None)];
    }
    let search = Search::new(&system.graph, None);
    let ways = search.forward_dynamics();
    ways.map(|forward| without_modes(system, forward)).collect()
}

/// The way to v̇ and ẋ on this formulation; `None` where it does not know what that takes.
pub(super) fn derivative_by(
    system: &System,
    formulation: &'static dyn Formulation,
) -> Option<Function> {
    if system.scene.layout.modes.is_empty() {
        let search = Search::new(&system.graph, Some(formulation));
        let forward = formulation.function(&search, Method::ForwardDynamics)?;
        return Some(without_modes(system, &forward));
    }
    let known = [Method::MassMatrix, Method::Bias].map(|m| formulation.knows(m));
    (known == [true, true]).then(|| with_modes(system, Some(formulation)))
}

/// v̇ and ẋ where joints may be held.
fn with_modes(system: &System, asked: Option<&'static dyn Formulation>) -> Function {
    system.one(Role::Derivative, |system, b| {
        let mut laws = Laws::new(b, &system.scene, &system.graph, Own::Inputs);
        laws.asked = asked;
        rates(system, &laws, b)
    })
}

/// v̇ and ẋ on a way to forward dynamics.
fn without_modes(system: &System, forward: &Function) -> Function {
    let b = Builder::new();
    let outputs: Vec<Expr> = {
        let laws = Laws::new(&b, &system.scene, &system.graph, Own::Inputs);
        let joints = driven(&b, forward, &laws, system);
        let all = joined(system, &laws, joints).into_iter();
        all.map(Ex::expr).collect()
    };
    let name = format!("{}; under the scene's efforts", forward.formulation);
    Function {
        ordered: forward.ordered,
        ..system.flat(Role::Derivative, name, b, outputs)
    }
}

/// Forward dynamics under the efforts of the laws.
pub(super) fn driven<'g>(
    b: &'g Builder,
    forward: &Function,
    laws: &Laws<'g, '_>,
    system: &System,
) -> Vec<Ex<'g>> {
    let efforts: Vec<Expr> = (0..system.graph.coordinates.len())
        .map(|j| laws.effort(j).expr())
        .collect();
    let placed = |_: &mut Graph, leaf| match leaf {
        Leaf::Input(j) => Some(efforts[j]),
        _ => None,
    };
    let outputs = &forward.blocks[0].outputs;
    let copies = b.with_graph(|g| copy_into(g, &forward.graph, outputs, placed));
    copies.into_iter().map(|e| b.ex(e)).collect()
}

/// The joints' accelerations with those of the other coordinates, and ẋ.
pub(super) fn joined<'g>(system: &System, laws: &Laws<'g, '_>, joints: Vec<Ex<'g>>) -> Vec<Ex<'g>> {
    let mut all = joints;
    for j in all.len()..system.scene.layout.nv() {
        all.push(laws.effort(j) / own_inertia(laws, j));
    }
    all.extend(laws.rates());
    all
}

/// Inertia of a coordinate that stores its own momentum.
pub(super) fn own_inertia<'g>(laws: &Laws<'g, '_>, j: usize) -> Ex<'g> {
    laws.inertia_of(j).unwrap_or(laws.b.number(1.0))
}

/// v̇ and ẋ, whatever the modes are.
pub(super) fn rates<'g>(system: &System, laws: &Laws<'g, '_>, b: &'g Builder) -> Vec<Ex<'g>> {
    let joints = if laws.contacts().is_empty() {
        let search = Search::new(&system.graph, None);
        let mut ways = search.forward_dynamics();
        let forward = ways.next().expect("there is a way");
        driven(b, forward, laws, system)
    } else {
        held(system, laws, b).accelerations
    };
    joined(system, laws, joints)
}

/// What holding joints adds to the equations.
pub(super) struct Held<'g> {
    /// Of every coordinate.
    pub accelerations: Vec<Ex<'g>>,
    /// For each contact the effort that it holds its joint with; what is left over of the
    /// equation where it slips is nothing.
    pub holding: Vec<Ex<'g>>,
}

/// Accelerations where some coordinates are held.
pub(super) fn held<'g>(system: &System, laws: &Laws<'g, '_>, b: &'g Builder) -> Held<'g> {
    let n = system.graph.coordinates.len();
    let holds = Holds::new(laws);
    let bias = laws.method(Method::Bias);
    let force: Vec<Ex<'g>> = (0..n).map(|j| laws.effort(j) - bias[j]).collect();
    let mut accelerations = holds.solve(b, &force, &holds.counterpart);
    for j in n..system.scene.layout.nv() {
        let free = laws.effort(j) / own_inertia(laws, j);
        accelerations.push(holds.known(j, free, &holds.counterpart));
    }
    let holding = laws.contacts().iter().map(|c| {
        let j = c.coordinate;
        if j >= n {
            return own_inertia(laws, j) * accelerations[j] - laws.effort(j);
        }
        let moved = (0..n).map(|k| holds.entry(j, k) * accelerations[k]);
        moved.fold(-force[j], |sum, x| sum + x)
    });
    Held {
        holding: holding.collect(),
        accelerations,
    }
}

/// Which coordinates may be held, and how they move then: their rows of M q̈ = f are replaced by
/// q̈_j = r̈_j, and what is known goes over to the other rows. A coordinate that stores its own
/// momentum has a row of its own, I_j q̈_j = f_j.
pub(super) struct Holds<'g> {
    half: Ex<'g>,
    /// Lower triangle of M.
    triangle: Vec<Ex<'g>>,
    /// Number of coordinates that M is about.
    n: usize,
    /// Of each coordinate that may be held, r̈.
    pub counterpart: Vec<Option<Ex<'g>>>,
    modes: Vec<Vec<Ex<'g>>>,
}

impl<'g> Holds<'g> {
    pub(super) fn new(laws: &Laws<'g, '_>) -> Self {
        let triangle = laws.method(Method::MassMatrix);
        let n = (0..).find(|n| n * (n + 1) / 2 == triangle.len());
        let nv = laws.v.len();
        let mut holds = Holds {
            half: laws.b.number(0.5),
            n: n.unwrap_or(0),
            triangle,
            counterpart: vec![None; nv],
            modes: vec![Vec::new(); nv],
        };
        for c in laws.contacts() {
            holds.counterpart[c.coordinate] = Some(c.reference[1]);
            holds.modes[c.coordinate].push(laws.mode_at(c.mode));
        }
        holds
    }

    /// M_ij
    pub(super) fn entry(&self, i: usize, j: usize) -> Ex<'g> {
        self.triangle[i.max(j) * (i.max(j) + 1) / 2 + i.min(j)]
    }

    /// `yes` where coordinate `j` is held, else `no`.
    pub(super) fn choose(&self, j: usize, yes: Ex<'g>, no: Ex<'g>) -> Ex<'g> {
        let modes = self.modes[j].iter();
        modes.fold(no, |no, mode| mode.abs().if_less(self.half, yes, no))
    }

    /// The coordinate's counterpart's where it is held, else `free`.
    pub(super) fn known(&self, j: usize, free: Ex<'g>, counterpart: &[Option<Ex<'g>>]) -> Ex<'g> {
        match counterpart[j] {
            Some(reference) => self.choose(j, reference, free),
            None => free,
        }
    }

    /// The accelerations of the links' coordinates under these forces, where the counterparts of
    /// held ones accelerate so.
    pub(super) fn solve(
        &self,
        b: &'g Builder,
        force: &[Ex<'g>],
        counterpart: &[Option<Ex<'g>>],
    ) -> Vec<Ex<'g>> {
        let (zero, one) = (b.zero(), b.number(1.0));
        let mut mass: Vec<Vec<Ex<'g>>> = Vec::new();
        let mut right = force.to_vec();
        for i in 0..self.n {
            let row = (0..=i).map(|j| {
                let own = if i == j { one } else { zero };
                self.choose(i, own, self.choose(j, own, self.entry(i, j)))
            });
            mass.push(row.collect());
            for j in (0..self.n).filter(|&j| j != i) {
                if let Some(reference) = counterpart[j] {
                    right[i] = right[i] - self.choose(j, self.entry(i, j) * reference, zero);
                }
            }
        }
        let right = right.into_iter().enumerate();
        let right = right.map(|(j, f)| self.known(j, f, counterpart));
        formulation::solve_symmetric(b, mass, right.collect())
    }
}

/// The own effort of each coordinate behind given accelerations.
pub(super) fn inverse<'g>(system: &System, b: &'g Builder) -> Vec<Ex<'g>> {
    let laws = Laws::new(b, &system.scene, &system.graph, Own::Sought);
    let nv = system.scene.layout.nv();
    let given: Vec<Ex<'g>> = (0..nv).map(|j| b.leaf(Leaf::Acceleration(j))).collect();
    efforts(system, &laws, &given)
}

/// The own effort of each coordinate at these accelerations: everything the laws do but the
/// coordinates' own efforts is taken off.
pub(super) fn efforts<'g>(system: &System, laws: &Laws<'g, '_>, at: &[Ex<'g>]) -> Vec<Ex<'g>> {
    let placed: Vec<Expr> = at.iter().map(|a| a.expr()).collect();
    let links = copied(
        laws.b,
        (&system.graph, laws.asked),
        Method::InverseDynamics,
        |_, leaf| match leaf {
            Leaf::Acceleration(j) => Some(placed[j]),
            _ => None,
        },
    );
    let all = (0..at.len()).map(|j| {
        let inertial = match links.get(j) {
            Some(&effort) => effort,
            None => own_inertia(laws, j) * at[j],
        };
        laws.before_gear(j, inertial - laws.effort(j))
    });
    all.collect()
}

/// Values whose fall through zero is an event. A contact's: its slip in the direction it slips in,
/// or how much more it would hold.
pub(super) fn events<'g>(system: &System, b: &'g Builder) -> Vec<Ex<'g>> {
    let laws = Laws::new(b, &system.scene, &system.graph, Own::Inputs);
    let of_contacts = if laws.contacts().is_empty() {
        vec![]
    } else {
        let holding = held(system, &laws, b).holding;
        let half = b.number(0.5);
        let contacts = laws.contacts().iter().zip(holding);
        contacts
            .map(|(c, holding)| {
                let mode = laws.mode_at(c.mode);
                let margin = c.limit - holding.abs();
                let name = &system.scene.layout.modes[c.mode].name;
                (
                    name.clone(),
                    mode.abs().if_less(half, margin, c.slip * mode),
                )
            })
            .collect()
    };
    let value = |part: &crate::scene::Part| {
        let contact = of_contacts.iter().find(|(name, _)| *name == part.name);
        contact
            .map(|(_, value)| *value)
            .or_else(|| laws.event_named(&part.name))
            .unwrap_or(b.number(1.0))
    };
    system.scene.layout.events.iter().map(value).collect()
}

/// For each mode: its slip, the acceleration of its slip, the effort it holds or would have to hold
/// to keep its present acceleration, and the most that it can hold.
pub(super) fn contacts<'g>(system: &System, b: &'g Builder) -> Vec<Ex<'g>> {
    let laws = Laws::new(b, &system.scene, &system.graph, Own::Inputs);
    let held = held(system, &laws, b);
    let mut rows = vec![[b.zero(); 4]; system.scene.layout.modes.len()];
    for (c, holding) in laws.contacts().iter().zip(held.holding) {
        let relative = held.accelerations[c.coordinate] - c.reference[1];
        rows[c.mode] = [c.slip, relative, holding, c.limit];
    }
    rows.into_iter().flatten().collect()
}
