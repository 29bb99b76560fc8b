//! The canonical form of a scene: momenta p = ∂T/∂v in place of velocities.
//!
//! p = M v at the joints, I v at coordinates with a store of their own. With P = M v̇ + bias, ṗ = d/dt(M
//! v) = E − bias + Ṁ v, which needs no accelerations. A joint that is held has the acceleration of its
//! counterpart, and the holding effort is the residual: ṗ = M v̇ + Ṁ v. This is equivalent to Lagrange's
//! equations: Ṁ v − bias = ∂T/∂q − gravity.

use bgdyn_runtime::Dd;

use super::coordinate_rows::own_inertia;
use super::holds::{StuckJoints, held};
use super::jacobian::{Response, expressions};
use super::{EffortSums, SceneEquations};
use crate::bond_graph::BondGraph;
use crate::choice::GraphMethods;
use crate::expr::{Builder, Expr, Graph, Leaf, Signed, Tangent, copy_into};
use crate::function::Function;
use crate::math::Vec3;
use crate::method::{Method, SceneFunction};

/// The method of computing momenta.
#[derive(Clone, Copy)]
enum MomentumFunction {
    /// M times v.
    Product,
    /// Inverse dynamics without weight and velocity products at the accelerations v.
    Recursion,
}

/// The method of computing Ṁ v − bias.
#[derive(Clone, Copy)]
enum Drift {
    /// Directly: Ṁ v is the derivative of M v along q̇ = v.
    Momenta,
    /// As ∂T/∂q − gravity.
    Energy,
}

impl MomentumFunction {
    const ALL: [MomentumFunction; 2] = [MomentumFunction::Product, MomentumFunction::Recursion];

    fn name(self) -> &'static str {
        match self {
            MomentumFunction::Product => "M v",
            MomentumFunction::Recursion => {
                "M v as inverse dynamics without weight at accelerations v"
            }
        }
    }

    /// Returns the momenta of the joints.
    fn of_joints<'g>(self, system: &SceneEquations, sums: &EffortSums<'g, '_>) -> Vec<Expr<'g>> {
        let n = system.graph.coordinates.len();
        match self {
            MomentumFunction::Product => {
                let mass = StuckJoints::new(sums);
                let row = |i: usize| {
                    let terms = (0..n).map(|j| mass.entry(i, j) * sums.v[j]);
                    terms.fold(sums.b.zero(), |sum, x| sum + x)
                };
                (0..n).map(row).collect()
            }
            MomentumFunction::Recursion => {
                let still = GraphMethods::new(weightless(&system.graph));
                let velocities = expressions(&sums.v);
                let placed = |_: &mut Graph, leaf| match leaf {
                    Leaf::Acceleration(j) => Some(velocities[j]),
                    _ => None,
                };
                sums.copied((&still, None), Method::InverseDynamics, placed)
            }
        }
    }

    /// Returns the momenta of all coordinates.
    fn of_all<'g>(self, system: &SceneEquations, sums: &EffortSums<'g, '_>) -> Vec<Expr<'g>> {
        let mut all = self.of_joints(system, sums);
        for j in all.len()..system.scene.layout.nv() {
            all.push(own_inertia(sums, j) * sums.v[j]);
        }
        all
    }
}

/// Returns the graph without weights and velocity products: P = M q̈.
fn weightless(graph: &BondGraph) -> BondGraph {
    let mut graph = graph.clone();
    for source in &mut graph.sources {
        source.efforts.clear();
    }
    graph.multibody.gravity = Vec3([Dd::ZERO; 3]);
    graph.multibody.velocity_products = false;
    graph
}

/// Returns the alternatives for the momenta of a state.
pub(super) fn momenta(system: &SceneEquations) -> Vec<Function> {
    let ways = MomentumFunction::ALL.into_iter();
    let with = |way: MomentumFunction| {
        let b = Builder::new();
        let outputs = {
            let sums = system.laws_under_driven_inputs(&b);
            expressions(&way.of_all(system, &sums))
        };
        system.flat(SceneFunction::ToCanonical, way.name().into(), b, outputs)
    };
    ways.map(with).collect()
}

/// Returns the alternatives for the velocities from momenta, which replace velocities among the leaves.
pub(super) fn velocities(system: &SceneEquations) -> Vec<Function> {
    let ways = system.graph.forward_dynamics();
    let with = |forward: &Function| {
        let b = Builder::new();
        let outputs = expressions(&solved(system, &b, forward));
        let name = format!("M⁻¹ p; {}", forward.formulation);
        Function {
            ordered: forward.ordered,
            ..system.flat(SceneFunction::FromCanonical, name, b, outputs)
        }
    };
    ways.iter().map(with).collect()
}

/// Returns v = M⁻¹ p by a function for forward dynamics.
fn solved<'g>(system: &SceneEquations, b: &'g Builder, forward: &Function) -> Vec<Expr<'g>> {
    let (n, nv) = (system.graph.coordinates.len(), system.scene.layout.nv());
    let sums = system.laws_under_driven_inputs(b);
    let momenta = &sums.v;
    let mut all = Response::new(forward).solve(b, &momenta[..n]);
    for j in n..nv {
        all.push(momenta[j] / own_inertia(&sums, j));
    }
    all
}

/// Returns the alternatives for the rates from momenta: q̇, ṗ, ẋ.
pub(super) fn rates(system: &SceneEquations) -> Vec<Function> {
    // Without velocity products the bias lacks terms of Lagrange's equations.
    let drifts: &[Drift] = match system.graph.velocity_products {
        true => &[Drift::Momenta, Drift::Energy],
        false => &[Drift::Momenta],
    };
    let ways = system.graph.forward_dynamics();
    let Some(forward) = ways.first() else {
        return vec![];
    };
    let with = |&drift: &Drift| {
        let (at_velocities, outputs) = at_velocities(system, drift);
        let b = Builder::new();
        let outputs = {
            let velocities = expressions(&solved(system, &b, forward));
            let placed = |_: &mut Graph, leaf| match leaf {
                Leaf::Velocity(j) => Some(velocities[j]),
                _ => None,
            };
            b.with_graph(|g| copy_into(g, &at_velocities, &outputs, placed))
        };
        let name = format!("{}; M⁻¹ p; {}", drift.name(), forward.formulation);
        Function {
            ordered: forward.ordered,
            ..system.flat(SceneFunction::CanonicalRates, name, b, outputs)
        }
    };
    drifts.iter().map(with).collect()
}

/// Returns q̇, ṗ and ẋ, with velocities among the leaves.
fn at_velocities(system: &SceneEquations, drift: Drift) -> (Graph, Vec<Signed>) {
    let b = Builder::new();
    let (nq, n) = (system.scene.layout.nq(), system.graph.coordinates.len());
    let outputs = {
        let sums = system.laws_under_driven_inputs(&b);
        let bias = sums.method(Method::Bias);
        let drifts = drift.of_joints(system, &sums, &bias);
        let free = |j: usize| sums.effort(j) + drifts.get(j).copied().unwrap_or(b.zero());
        let mut momenta: Vec<Expr<'_>> = (0..sums.v.len()).map(free).collect();
        if !sums.contacts().is_empty() {
            let accelerations = held(system, &sums, &b).accelerations;
            let holds = StuckJoints::new(&sums);
            for (j, momentum) in momenta.iter_mut().enumerate() {
                let moved = if j < n {
                    let terms = (0..n).map(|k| holds.entry(j, k) * accelerations[k]);
                    terms.fold(bias[j] + drifts[j], |sum, x| sum + x)
                } else {
                    own_inertia(&sums, j) * accelerations[j]
                };
                *momentum = holds.at.choose(j, moved, *momentum);
            }
        }
        let places = sums.v[..nq].iter().copied();
        let states = sums.rates().iter().copied();
        let all: Vec<Expr<'_>> = places.chain(momenta).chain(states).collect();
        expressions(&all)
    };
    (b.into_graph(), outputs)
}

impl Drift {
    fn name(self) -> &'static str {
        match self {
            Drift::Momenta => "ṗ = E − bias + Ṁ v",
            Drift::Energy => "ṗ = E − gravity + ∂T/∂q",
        }
    }

    /// Returns Ṁ v − bias at the joints.
    fn of_joints<'g>(
        self,
        system: &SceneEquations,
        sums: &EffortSums<'g, '_>,
        bias: &[Expr<'g>],
    ) -> Vec<Expr<'g>> {
        let b = sums.b;
        let n = system.graph.coordinates.len();
        match self {
            Drift::Momenta => {
                let rates = expressions(&sums.v);
                let mut along = Tangent::new(|_: &mut Graph, leaf| match leaf {
                    Leaf::Position(j) => Some(rates[j]),
                    _ => None,
                });
                let momenta =
                    expressions(&MomentumFunction::Product.of_joints(system, sums)).into_iter();
                let moved = momenta.map(|p| b.expr(b.with_graph(|g| along.of(g, p))));
                moved.zip(bias).map(|(moved, &bias)| moved - bias).collect()
            }
            Drift::Energy => {
                let kinetic = sums.method(Method::KineticEnergy)[0];
                let gravity = sums.method(Method::Gravity);
                (0..n)
                    .map(|j| sums.slope(kinetic, j) - gravity[j])
                    .collect()
            }
        }
    }
}
