//! Wheels on a base that can move in every way: equation (6) in the twist of the base, in its own axes.
//!
//! The open tree of a vehicle often begins with joints of links without mass: heading, height, lean, pitch. The velocities
//! of its base, the first link with mass, are sums of their rates with coefficients that turn; its twist w in its own
//! axes takes their place here ([`tree`]). The bodies then do not depend on the pose of the base but for the
//! direction of gravity, the rows of wheels have constant pivots, and the axes of all links are along those of joints
//! ([`axes`]). The independent velocities u remain: ω = Σ a_j θ̇_j are further rows, with the rates θ̇_j of the
//! replaced joints as further velocities ([`rows`]). q̇ = S u, q̈ = S u̇ + z and Sᵀ·(6) are as in [`super::loops`], with
//! w and θ̇ in q̇; efforts act along u alone.

mod axes;
mod rows;
mod tree;

use bgdyn_runtime::Dd;
use rows::BaseRows;
use tree::BaseTree;

use super::arguments::Arguments;
use super::loop_methods::{entries, minus, reduced};
use super::loop_rows::LoopForm;
use super::velocity_map::VelocityMap;
use super::{Formulation, Offer, Prepared, solve, subspaces};
use crate::bond_graph::{BondGraph, LinkFrame, Multibody};
use crate::expr::{Builder, Expr, Signed};
use crate::function::Function;
use crate::method::Method;
use crate::passes::factor;

/// The tree in the twist of its base, with dependent velocities eliminated.
pub(super) struct BaseTwist;

impl Formulation for BaseTwist {
    fn name(&self) -> &'static str {
        "base twist"
    }

    fn summary(&self) -> &'static str {
        "wheels on a free base, in the velocities of the base along and about its own axes"
    }

    fn unserved<'a>(&self, _: &'a Multibody) -> Option<&'a LinkFrame> {
        None
    }

    fn serves(&self, graph: &BondGraph) -> bool {
        let closed = graph.closed.as_deref().filter(|closed| closed.closure.nonholonomic());
        closed.is_some_and(|closed| {
            BaseTree::new(closed).is_some_and(|tree| BaseRows::new(closed, &tree, false).is_some())
        })
    }

    fn knows(&self, method: Method) -> bool {
        matches!(
            method,
            Method::InverseDynamics
                | Method::Bias
                | Method::Gravity
                | Method::MassMatrix
                | Method::ForwardDynamics
                | Method::KineticEnergy
        )
    }

    fn offer(&self, _: &Prepared<'_>, _: Method) -> Offer {
        Offer::Candidate
    }

    fn function(&self, prepared: &Prepared<'_>, method: Method) -> Option<Function> {
        let graph = prepared.graph;
        let tree = BaseTree::new(graph.closed.as_deref()?)?;
        let leans = graph.closed.as_deref()?.closure.along_planes.is_some();
        let forms = [(false, false), (true, false), (false, true), (true, true)];
        let forms = forms.into_iter().filter(|(_, planes)| leans || !planes);
        let made = forms.filter_map(|form| function(graph, &tree, method, form));
        // As for loops: see `Elimination`.
        let chosen =
            made.min_by_key(|(made, early)| (*early, factor(made.clone()).cost().weighted()));
        chosen.map(|(made, _)| made)
    }
}

/// Returns the function of a method in one form, by vectors and with rows along planes or not, and its number of pivots
/// that others follow.
fn function(
    graph: &BondGraph,
    tree: &BaseTree,
    method: Method,
    (by_vectors, along_planes): (bool, bool),
) -> Option<(Function, usize)> {
    let closed = graph.closed.as_deref()?;
    let rows = BaseRows::new(closed, tree, along_planes)?;
    let b = Builder::new();
    let early;
    let outputs: Vec<Signed> = {
        let x = Arguments::new(&b, graph, method);
        let checked = method.shape().checked();
        let form = LoopForm {
            by_vectors,
            first_pivot: checked.then_some(graph.coordinates.len()),
            ..LoopForm::default()
        };
        let rates = rows.rates(&b, &x.q, form);
        let map = VelocityMap::new(&b, &rows.all, (rates, form), form.first_pivot);
        early = map.early_pivots();
        let velocities = map.velocities(&x.v);
        let bias = rows.bias(&b, (&x.q, &velocities), form);
        let gravity = rows.of_base(&b, &x.q, closed.tree.gravity).0;
        let motion = BaseMotion {
            b: &b,
            tree,
            map,
            velocities,
            bias,
            gravity,
        };
        let outputs = motion.outputs(method, &x)?;
        outputs.into_iter().map(Expr::signed).collect()
    };
    let name = "twist of the base; wheels eliminated".into();
    let function = Function::flat(graph, method, name, b.into_graph(), outputs);
    Some((function, early))
}

/// The motion of the tree, in the twist of its base.
struct BaseMotion<'a, 'g> {
    b: &'g Builder,
    tree: &'a BaseTree,
    map: VelocityMap<'a, 'g>,
    /// S u
    velocities: Vec<Expr<'g>>,
    /// −γ, row by row.
    bias: Vec<Expr<'g>>,
    /// g in the axes of the base.
    gravity: [Expr<'g>; 3],
}

impl<'g> BaseMotion<'_, 'g> {
    fn outputs(&self, method: Method, x: &Arguments<'g>) -> Option<Vec<Expr<'g>>> {
        let b = self.b;
        let still = vec![b.zero(); self.map.independents()];
        Some(match method {
            Method::InverseDynamics => self.map.efforts(&self.efforts(x, &x.a)?),
            Method::Bias => self.map.efforts(&self.efforts(x, &still)?),
            Method::Gravity => {
                let nothing = vec![b.zero(); self.velocities.len()];
                self.map.efforts(&self.tree_efforts(x, nothing)?)
            }
            Method::MassMatrix => entries(&self.mass_matrix(x)?),
            Method::ForwardDynamics => {
                let bias = self.map.efforts(&self.efforts(x, &still)?);
                solve::ltdl(b, self.mass_matrix(x)?, minus(&x.tau, &bias))
            }
            Method::KineticEnergy => {
                let arguments = self.arguments(x, self.velocities.clone());
                subspaces::outputs(b, &self.tree.multibody, method, &arguments)?
            }
            _ => return None,
        })
    }

    /// Returns the efforts on the tree at q̈ = S u̇ + z.
    fn efforts(&self, x: &Arguments<'g>, a: &[Expr<'g>]) -> Option<Vec<Expr<'g>>> {
        self.tree_efforts(x, self.map.accelerations(a, &self.bias))
    }

    /// Returns the efforts on the tree at these accelerations; those of further velocities are zero.
    fn tree_efforts(&self, x: &Arguments<'g>, mut a: Vec<Expr<'g>>) -> Option<Vec<Expr<'g>>> {
        for (j, g) in self.tree.linear.iter().zip(self.gravity) {
            a[j.0] = a[j.0] - g;
        }
        let arguments = self.arguments(x, a);
        let graph = &self.tree.multibody;
        let mut all = subspaces::outputs(self.b, graph, Method::InverseDynamics, &arguments)?;
        all.resize(self.velocities.len(), self.b.zero());
        Some(all)
    }

    /// Returns the lower triangle of Sᵀ M S.
    fn mass_matrix(&self, x: &Arguments<'g>) -> Option<Vec<Vec<Expr<'g>>>> {
        let graph = &self.tree.multibody;
        let arguments = self.arguments(x, Vec::new());
        let mass = subspaces::outputs(self.b, graph, Method::MassMatrix, &arguments)?;
        Some(reduced(self.b, &mass, &self.map.map[..graph.coordinates.len()]).reduced)
    }

    /// Returns the arguments of a function of the tree. The pose of the base enters none.
    fn arguments(&self, x: &Arguments<'g>, a: Vec<Expr<'g>>) -> Arguments<'g> {
        let neutral = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0].map(|x| self.b.constant(Dd::from_f64(x)));
        Arguments {
            q: x.q.iter().copied().chain(neutral).collect(),
            v: self.velocities.clone(),
            a,
            tau: Vec::new(),
            active: true,
            base: None,
        }
    }
}
