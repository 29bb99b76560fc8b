//! Wheels on a base that can move along three axes: equation (6) in the twist of the base, in its own axes.
//!
//! The open tree of a vehicle often begins with joints of links without mass: heading, height, lean, pitch. The
//! velocities of the bodies are sums of their rates with coefficients that turn. Here the twist w of one link, the base,
//! takes their place ([`crate::bond_graph::FreeBase`]). Then the pose of the base enters by the direction of gravity
//! alone, rows of wheels have constant pivots, and the axes of links are along those of joints. The independent
//! velocities u remain: ω = Σ a_j θ̇_j are further rows, with the rates θ̇_j of the replaced joints as further velocities
//! ([`rows`]). q̇ = S u, q̈ = S u̇ + z and Sᵀ·(6) are as in [`super::loops`], with w and θ̇ in q̇; efforts act along u
//! alone.

mod rows;

use std::rc::Rc;

use bgdyn_runtime::Dd;
use rows::{BaseRows, row_axes};

use super::arguments::Arguments;
use super::loop_methods::{cheapest_with_fewest, entries, minus, reduced};
use super::loop_rows::LoopForm;
use super::velocity_map::VelocityMap;
use super::{Formulation, Offer, Prepared, solve};
use crate::bond_graph::{BondGraph, FreeBase, LinkFrame, Multibody};
use crate::expr::{Builder, Expr, Leaf, Signed, copy_into};
use crate::function::{Function, in_triangle};
use crate::mechanism::closure::ContactAxes;
use crate::method::Method;

/// The tree in the twist of the base with this index, with dependent velocities eliminated.
pub(super) struct BaseTwist(pub usize);

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
        let closed = graph
            .closed
            .as_deref()
            .filter(|closed| closed.closure.nonholonomic());
        closed.is_some_and(|closed| {
            let bases = FreeBase::all(closed);
            let base = bases.get(self.0);
            base.is_some_and(|base| BaseRows::new(closed, base, &[]).is_some())
        })
    }

    fn knows(&self, method: Method) -> bool {
        !reads(method).is_empty()
    }

    fn reads_of_free_base(&self, method: Method) -> Vec<(usize, Method)> {
        reads(method)
            .iter()
            .map(|&method| (self.0, method))
            .collect()
    }

    fn offer(&self, _: &Prepared<'_>, _: Method) -> Offer {
        Offer::Candidate
    }

    fn function(&self, prepared: &Prepared<'_>, method: Method) -> Option<Function> {
        let closed = prepared.graph.closed.as_deref()?;
        let bases = FreeBase::all(closed);
        let base = bases.get(self.0)?;
        let ways = row_axes(&closed.closure);
        let both = ways.iter().flat_map(|axes| [(axes, false), (axes, true)]);
        let forms = both.map(|(axes, other)| BaseForm {
            base: self.0,
            by_vectors: other && !has_mass(method),
            in_stages: other && has_mass(method),
            axes: axes.clone(),
        });
        cheapest_with_fewest(forms.filter_map(|form| function(prepared, base, method, &form)))
    }
}

/// A way to write a function.
struct BaseForm {
    /// The index of the base.
    base: usize,
    /// Whether S u and Sᵀ f are computed without the matrix S.
    by_vectors: bool,
    /// Whether M is reduced in stages: by the rows that give the velocity of the base first.
    in_stages: bool,
    /// The axes of the rows of each contact, if others than usual.
    axes: Vec<Option<ContactAxes>>,
}

/// Returns the methods of the tree that a method is composed of; none if it is not made here.
fn reads(method: Method) -> &'static [Method] {
    match method {
        Method::InverseDynamics | Method::Bias | Method::Gravity => &[Method::InverseDynamics],
        Method::ForwardDynamics => &[Method::InverseDynamics, Method::MassMatrix],
        Method::MassMatrix => &[Method::MassMatrix],
        Method::KineticEnergy => &[Method::KineticEnergy],
        _ => &[],
    }
}

fn has_mass(method: Method) -> bool {
    matches!(method, Method::MassMatrix | Method::ForwardDynamics)
}

/// Returns the function of a method in one form, and its number of pivots that others follow.
fn function(
    prepared: &Prepared<'_>,
    tree: &FreeBase,
    method: Method,
    form: &BaseForm,
) -> Option<(Function, usize)> {
    let graph = prepared.graph;
    let closed = graph.closed.as_deref()?;
    let rows = BaseRows::new(closed, tree, &form.axes)?;
    let b = Builder::new();
    let early;
    let outputs: Vec<Signed> = {
        let x = Arguments::new(&b, graph, method);
        let checked = method.shape().checked();
        let rows_form = LoopForm {
            by_vectors: form.by_vectors,
            rotates: true,
            first_pivot: checked.then_some(graph.coordinates.len()),
            ..LoopForm::default()
        };
        let rates = rows.rates(&b, &x.q, rows_form);
        let map = VelocityMap::new(&b, &rows.all, (rates, rows_form), rows_form.first_pivot);
        early = map.early_pivots();
        let velocities = map.velocities(&x.v);
        let bias = rows.bias(&b, (&x.q, &velocities), rows_form);
        let gravity = rows.of_base(&b, &x.q, closed.tree.gravity).0;
        let of_tree = |method: Method| prepared.function_on_free_base(form.base, method);
        let motion = TwistMotion {
            b: &b,
            tree,
            in_stages: form.in_stages,
            of_tree: &of_tree,
            map,
            velocities,
            bias,
            gravity,
        };
        let outputs = motion.outputs(method, &x)?;
        outputs.into_iter().map(Expr::signed).collect()
    };
    let base = &closed.tree.frames[tree.base().0].name;
    let of_tree = prepared.function_on_free_base(form.base, *reads(method).first()?)?;
    let of_tree = of_tree.formulation.clone();
    let name = format!("{of_tree}; twist of {base}; wheels eliminated");
    let function = Function::flat(graph, method, name, b.into_graph(), outputs);
    Some((function, early))
}

/// The motion of the tree, in the twist of its base.
struct TwistMotion<'a, 'g> {
    b: &'g Builder,
    tree: &'a FreeBase,
    in_stages: bool,
    /// Returns the function of a method of the tree.
    of_tree: &'a dyn Fn(Method) -> Option<Rc<Function>>,
    map: VelocityMap<'a, 'g>,
    /// S u
    velocities: Vec<Expr<'g>>,
    /// −γ, row by row.
    bias: Vec<Expr<'g>>,
    /// g in the axes of the base.
    gravity: [Expr<'g>; 3],
}

impl<'g> TwistMotion<'_, 'g> {
    fn outputs(&self, method: Method, x: &Arguments<'g>) -> Option<Vec<Expr<'g>>> {
        let b = self.b;
        let still = vec![b.zero(); self.map.independents()];
        Some(match method {
            Method::InverseDynamics => self.map.efforts(&self.efforts(&x.a)?),
            Method::Bias => self.map.efforts(&self.efforts(&still)?),
            Method::Gravity => {
                let nothing = vec![b.zero(); self.velocities.len()];
                self.map.efforts(&self.tree_efforts(nothing)?)
            }
            Method::MassMatrix => entries(&self.mass_matrix()?),
            Method::ForwardDynamics => {
                let bias = self.map.efforts(&self.efforts(&still)?);
                solve::ltdl(b, self.mass_matrix()?, minus(&x.tau, &bias))
            }
            Method::KineticEnergy => self.read(method, &[])?,
            _ => return None,
        })
    }

    /// Returns the efforts on the tree at q̈ = S u̇ + z.
    fn efforts(&self, a: &[Expr<'g>]) -> Option<Vec<Expr<'g>>> {
        self.tree_efforts(self.map.accelerations(a, &self.bias))
    }

    /// Returns the efforts on the tree at these accelerations; those of further velocities are zero.
    fn tree_efforts(&self, mut a: Vec<Expr<'g>>) -> Option<Vec<Expr<'g>>> {
        for (j, g) in self.tree.linear.iter().zip(self.gravity) {
            a[j.0] = a[j.0] - g;
        }
        let mut all = self.read(Method::InverseDynamics, &a)?;
        all.resize(self.velocities.len(), self.b.zero());
        Some(all)
    }

    /// Returns the lower triangle of Sᵀ M S.
    fn mass_matrix(&self) -> Option<Vec<Vec<Expr<'g>>>> {
        let mass = self.read(Method::MassMatrix, &[])?;
        let map = &self.map.map[..self.tree.graph.coordinates.len()];
        if !self.in_stages {
            return Some(reduced(self.b, &mass, map).reduced);
        }
        let (kept, mass) = without_translation(&mass, (self.map.rates(), self.tree))?;
        let rows: Vec<Vec<Expr<'g>>> = kept.iter().map(|&j| map[j].clone()).collect();
        Some(reduced(self.b, &mass, &rows).reduced)
    }

    /// Returns the results of a method of the tree at its velocities and these accelerations.
    fn read(&self, method: Method, a: &[Expr<'g>]) -> Option<Vec<Expr<'g>>> {
        let function = (self.of_tree)(method)?;
        let signed = |all: &[Expr<'g>]| -> Vec<Signed> { all.iter().map(|x| x.signed()).collect() };
        let (velocities, accelerations) = (signed(&self.velocities), signed(a));
        let leaf = |leaf: Leaf| match leaf {
            Leaf::Velocity(j) => Some(velocities[j]),
            Leaf::Acceleration(j) => accelerations.get(j).copied(),
            _ => None,
        };
        let outputs = &function.blocks[0].outputs;
        let copied = self
            .b
            .with_graph(|g| copy_into(g, &function.graph, outputs, |_, l| leaf(l)));
        Some(copied.into_iter().map(|e| self.b.expr(e)).collect())
    }
}

/// Returns the other velocities of the tree than those of the base along its axes, and the lower triangle of M for them,
/// if rows give these: v = V w with one row for each. With the parts of M it is M_ww + M_wv V + Vᵀ (M_vw + M_vv V).
/// `None` without such rows.
fn without_translation<'g>(
    mass: &[Expr<'g>],
    (rates, tree): (&[Vec<Expr<'g>>], &FreeBase),
) -> Option<(Vec<usize>, Vec<Expr<'g>>)> {
    let linear = tree.linear.map(|j| j.0);
    let gives = |k: usize| {
        let only = |row: &&Vec<Expr<'g>>| {
            let one = row[k].as_constant() == Some(Dd::ONE);
            one && linear
                .iter()
                .all(|&other| other == k || row[other].is_zero())
        };
        rates.iter().find(only)
    };
    let rows = [gives(linear[0])?, gives(linear[1])?, gives(linear[2])?];
    let all = 0..tree.graph.coordinates.len();
    let kept: Vec<usize> = all.filter(|j| !linear.contains(j)).collect();
    let entry = |i: usize, j: usize| mass[in_triangle(i.max(j), i.min(j))];
    // M_vw + M_vv V
    let momentum = |k: usize, j: usize| {
        let moved = (0..3).map(|l| entry(linear[k], linear[l]) * -rows[l][j]);
        moved.fold(entry(linear[k], j), |sum, x| sum + x)
    };
    let mut lower = Vec::new();
    for (i, &own) in kept.iter().enumerate() {
        for &other in &kept[..=i] {
            let mut sum = entry(own, other);
            for k in 0..3 {
                sum = sum - entry(own, linear[k]) * rows[k][other];
                sum = sum - rows[k][own] * momentum(k, other);
            }
            lower.push(sum);
        }
    }
    Some((kept, lower))
}
