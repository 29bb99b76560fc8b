//! ∂ẏ/∂y and ∂ẏ/∂t of a scene, including the inputs that it drives, and ∂ẏ/∂u.
//!
//! There are two methods. One differentiates the graph of ẏ. The other uses that P(q, v, v̇) = E is
//! satisfied along every motion: M ∂v̇ = ∂E − ∂P at fixed v̇, with ∂P from the recursion. Held joints have
//! ∂v̇ = ∂r̈ in place of their row. The cheaper method is chosen.

use super::summed::summed_under;
use bgdyn_runtime::Dd;

use super::coordinate_rows::{link_accelerations, own_inertia};
use super::dynamics::{joined, rates};
use super::holds::StuckJoints;
use super::{ActuatorEfforts, EffortSums, SceneEquations, signals};
use crate::expr::{Builder, Expr, Graph, Leaf, Signed, Tangent, copy_into};
use crate::function::Function;
use crate::method::{Method, SceneFunction};

/// Largest number of coordinates for which the graph of ẏ is differentiated for comparison: for more
/// coordinates it costs more, and its factoring takes long.
const MAX_DIFFERENTIATED_COORDINATES: usize = 4;

/// Returns the alternatives for the Jacobian: column by column, first y's parts and then t, the rates v̇
/// and ẋ of each, and those of coupled positions.
pub(super) fn ways(system: &SceneEquations) -> Vec<Function> {
    // The recursion's derivatives are along the tangent, the Jacobian's columns components of positions. The
    // derivatives at fixed course lack the motion of prescribed joints in time.
    let layout = &system.scene.layout;
    if !layout.coupled().is_empty() || !layout.prescribed.is_empty() {
        return vec![differentiated(system, SceneFunction::Jacobian)];
    }
    let mut ways = implicit(system, SceneFunction::Jacobian);
    if system.graph.coordinates.len() <= MAX_DIFFERENTIATED_COORDINATES {
        ways.push(differentiated(system, SceneFunction::Jacobian));
    }
    ways
}

/// Returns the alternatives for ∂ẏ/∂u: column by column the rates v̇ and ẋ, and those of coupled positions. Positions do
/// not depend on inputs, so that M ∂v̇ = ∂E holds for any of them; the motion of prescribed joints needs the derivatives
/// of the whole graph.
pub(super) fn along_inputs(system: &SceneEquations) -> Vec<Function> {
    let role = SceneFunction::InputJacobian;
    let layout = &system.scene.layout;
    if !layout.coupled().is_empty() || !layout.prescribed.is_empty() {
        return vec![differentiated(system, role)];
    }
    let mut ways = implicit(system, role);
    if system.graph.coordinates.len() <= MAX_DIFFERENTIATED_COORDINATES {
        ways.push(differentiated(system, role));
    }
    ways
}

/// Returns the leaves of the columns.
fn leaves(system: &SceneEquations, role: SceneFunction) -> Vec<Leaf> {
    match role {
        SceneFunction::InputJacobian => {
            let inputs = 0..system.scene.layout.inputs.len();
            inputs.map(Leaf::Input).collect()
        }
        _ => along_state(system).collect(),
    }
}

/// Returns those of the state and of time.
fn along_state(system: &SceneEquations) -> impl Iterator<Item = Leaf> + use<> {
    let layout = &system.scene.layout;
    let (nq, nv, nx) = (layout.nq(), layout.nv(), layout.nx());
    let y = (0..nq)
        .map(Leaf::Position)
        .chain((0..nv).map(Leaf::Velocity));
    y.chain((0..nx).map(Leaf::State)).chain([Leaf::Time])
}

/// Returns ∂/∂leaf of expressions.
fn slopes<'g>(b: &'g Builder, leaf: Leaf, of: impl Iterator<Item = Expr<'g>>) -> Vec<Expr<'g>> {
    let seed = |g: &mut Graph, l| (l == leaf).then(|| g.constant(Dd::ONE));
    let mut tangent = Tangent::new(seed);
    of.map(|x| x.signed())
        .map(|x| b.expr(b.with_graph(|g| tangent.of(g, x))))
        .collect()
}

/// Returns the expressions without their graph.
pub(super) fn expressions(all: &[Expr<'_>]) -> Vec<Signed> {
    all.iter().map(|x| x.signed()).collect()
}

/// Differentiates the graph of ẏ.
fn differentiated(system: &SceneEquations, role: SceneFunction) -> Function {
    let b = Builder::new();
    let derivative = system.cheapest(SceneFunction::Derivative);
    let outputs: Vec<Signed> = {
        let inputs = expressions(&system.inputs_of(role, &b));
        let placed = |_: &mut Graph, leaf| match leaf {
            Leaf::Input(i) => Some(inputs[i]),
            _ => None,
        };
        let of = &derivative.blocks[0].outputs;
        let rates = b.with_graph(|g| copy_into(g, &derivative.graph, of, placed));
        let rates: Vec<Expr<'_>> = rates.into_iter().map(|e| b.expr(e)).collect();
        let leaves = leaves(system, role).into_iter();
        let columns = leaves.map(|leaf| slopes(&b, leaf, rates.iter().copied()));
        expressions(&columns.flatten().collect::<Vec<_>>())
    };
    let name = format!("{}; differentiated", derivative.formulation);
    Function {
        ordered: derivative.ordered,
        ..system.flat(role, name, b, outputs)
    }
}

/// Solves M ∂v̇ = ∂E − ∂P, with each alternative for M⁻¹.
fn implicit(system: &SceneEquations, role: SceneFunction) -> Vec<Function> {
    if system.may_hold_joints() {
        let b = Builder::new();
        let columns = {
            let sums = system.laws_under_inputs_of(role, &b);
            let holds = StuckJoints::new(&sums);
            let rates = rates(system, &sums, &b);
            columns((system, role), &sums, &rates, &holds, None)
        };
        let name = "M ∂v̇ = ∂E − ∂P, joints held or free".to_owned();
        return vec![system.flat(role, name, b, columns)];
    }
    let ways = system.graph.forward_dynamics();
    let with = |forward: &Function| {
        let b = Builder::new();
        let columns = {
            let sums = system.laws_under_inputs_of(role, &b);
            let holds = StuckJoints::new(&sums);
            let joints = link_accelerations(forward, &sums, system);
            let rates = joined(system, &sums, joints);
            let response = Response::new(forward);
            columns((system, role), &sums, &rates, &holds, Some(&response))
        };
        let name = format!("M ∂v̇ = ∂E − ∂P; {}", forward.formulation);
        Function {
            ordered: forward.ordered,
            ..system.flat(role, name, b, columns)
        }
    };
    ways.iter().map(with).collect()
}

/// Returns the columns of the Jacobian. M⁻¹ f is that of `response`, or that of the joints held or free.
fn columns<'g>(
    (system, role): (&SceneEquations, SceneFunction),
    sums: &EffortSums<'g, '_>,
    rates: &[Expr<'g>],
    holds: &StuckJoints<'g>,
    response: Option<&Response>,
) -> Vec<Signed> {
    let b = sums.b;
    let (n, nv) = (system.graph.coordinates.len(), system.scene.layout.nv());
    let at = expressions(&rates[..n]);
    let links = Method::InverseDynamicsDerivatives;
    let links = sums.copied((&system.graph, None), links, |_, leaf| match leaf {
        Leaf::Acceleration(j) => Some(at[j]),
        _ => None,
    });
    // ∂P_i/∂leaf
    let of_links = |i: usize, leaf| match leaf {
        Leaf::Position(j) if j < n => links[i * n + j],
        Leaf::Velocity(j) if j < n => links[(n + i) * n + j],
        _ => b.zero(),
    };
    let mut all = Vec::new();
    for leaf in leaves(system, role) {
        let efforts = (0..n).map(|j| sums.effort(j));
        let own = (n..nv).map(|j| sums.effort(j) / own_inertia(sums, j));
        let states = sums.rates().iter().copied();
        let driven = slopes(b, leaf, efforts.chain(own).chain(states));
        let counterparts: Vec<Vec<Expr<'g>>> = (holds.at.counterparts.iter())
            .map(|all| slopes(b, leaf, all.iter().copied()))
            .collect();
        let force: Vec<Expr<'g>> = (0..n).map(|i| driven[i] - of_links(i, leaf)).collect();
        all.extend(match response {
            Some(response) => response.solve(b, &force),
            None => holds.solve(b, &force, &counterparts),
        });
        all.extend((n..nv).map(|j| holds.at.known(j, driven[j], &counterparts[j])));
        all.extend_from_slice(&driven[nv..]);
    }
    expressions(&all)
}

/// Computes M⁻¹ f by a function for forward dynamics, which is linear in the efforts: its derivative along
/// f.
pub(super) struct Response {
    graph: Graph,
    /// Accelerations of the efforts that replace the accelerations among the leaves.
    outputs: Vec<Signed>,
}

impl Response {
    pub(super) fn new(forward: &Function) -> Self {
        let b = Builder::from(forward.graph.clone());
        let mut tangent = Tangent::new(|g: &mut Graph, leaf| match leaf {
            Leaf::Input(j) => Some(g.leaf(Leaf::Acceleration(j))),
            _ => None,
        });
        let accelerations = &forward.blocks[0].outputs;
        let outputs = b.with_graph(|g| accelerations.iter().map(|&e| tangent.of(g, e)).collect());
        Response {
            graph: b.into_graph(),
            outputs,
        }
    }

    /// Returns M⁻¹ f.
    pub(super) fn solve<'g>(&self, b: &'g Builder, force: &[Expr<'g>]) -> Vec<Expr<'g>> {
        let force = expressions(force);
        let placed = |_: &mut Graph, leaf| match leaf {
            Leaf::Acceleration(j) => Some(force[j]),
            _ => None,
        };
        let copies = b.with_graph(|g| copy_into(g, &self.graph, &self.outputs, placed));
        copies.into_iter().map(|e| b.expr(e)).collect()
    }
}

impl SceneEquations {
    /// Returns the inputs: those that the scene drives, and the given ones.
    pub(super) fn driven_inputs<'g>(&self, b: &'g Builder) -> Vec<Expr<'g>> {
        match self.scene.layout.inputs.is_empty() {
            true => vec![],
            false => {
                let mut inputs = signals::inputs(self, b);
                // What sampled controllers give is held.
                for &i in self
                    .scene
                    .control
                    .iter()
                    .flat_map(|control| &control.controlled)
                {
                    inputs[i] = b.leaf(Leaf::Input(i));
                }
                inputs
            }
        }
    }

    /// Returns the inputs under which a Jacobian is: those that the scene drives, or all as they are given.
    fn inputs_of<'g>(&self, role: SceneFunction, b: &'g Builder) -> Vec<Expr<'g>> {
        match role {
            SceneFunction::InputJacobian => {
                let inputs = 0..self.scene.layout.inputs.len();
                inputs.map(|i| b.leaf(Leaf::Input(i))).collect()
            }
            _ => self.driven_inputs(b),
        }
    }

    /// Returns the laws under the inputs that the scene drives.
    pub(super) fn laws_under_driven_inputs<'g, 'a>(&'a self, b: &'g Builder) -> EffortSums<'g, 'a> {
        self.laws_under_inputs_of(SceneFunction::Jacobian, b)
    }

    /// Returns the laws under the inputs of a Jacobian.
    fn laws_under_inputs_of<'g, 'a>(
        &'a self,
        role: SceneFunction,
        b: &'g Builder,
    ) -> EffortSums<'g, 'a> {
        let inputs = || self.inputs_of(role, b);
        summed_under(
            b,
            &self.scene,
            (&self.graph, None),
            ActuatorEfforts::FromInputs,
            inputs,
        )
    }
}
