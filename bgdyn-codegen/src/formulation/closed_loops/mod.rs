//! Planar loops in closed form: equation (6) with the transformers of the independent joints alone.
//!
//! The directions of the dependent links are algebraic functions of the independent positions: one division and one
//! root for each loop ([`positions`]), no sine of a dependent angle. Their rates take another division ([`rates`]). The
//! functions are those of the open tree, with these directions in place of the sines, at q̇ = S u and q̈ = S u̇ + z, and
//! efforts are collected by links: an effort on a dependent joint acts on the rates of both of its links. Dependent
//! positions are not read.
//!
//! In the tree masses are moved across the closing pins ([`crate::bond_graph::with_moved_masses`]): exact for efforts
//! and accelerations, not for loads at joints, which this formulation does not compute.

mod plane;
mod positions;
mod rates;
mod sums;

use std::rc::Rc;

use bgdyn_runtime::Dd;
use positions::{ClosedPositions, PositionForm};
use rates::JointRates;
use sums::JointSum;

use super::arguments::Arguments;
use super::{Formulation, Offer, Prepared, solve};
use crate::bond_graph::{BondGraph, LinkFrame, Multibody};
use crate::expr::{
    AngleSum, Builder, Expr, Graph, Leaf, Node, NodeId, Signed, angle_sums, copy_with_turns,
    reachable,
};
use crate::function::{Function, in_triangle};
use crate::mechanism::closure::{Closure, Polygon, polygons};
use crate::method::Method;
use crate::passes::cheapest_after_factoring;

/// The largest number of angles of known arcs with whose axes polygons are tried.
const MOST_AXES: usize = 2;

/// The largest number of velocities of the open tree for which all ways of writing are tried.
const MOST_COORDINATES: usize = 12;

/// Planar loops in closed form, on functions chosen for the open tree.
pub(super) struct ClosedLoops;

/// A way to write the functions.
#[derive(Clone, Copy, Debug)]
struct WrittenForm {
    by_cosine: bool,
    axes: usize,
    style: MapStyle,
}

/// How velocities and efforts are mapped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum MapStyle {
    /// S u and Sᵀ f by the derivatives of the known arcs and the forces on their ends, without the matrix S.
    Vectors,
    /// By the columns of S.
    Columns,
    /// By the column of S for a single independent velocity u: z is u² times that for u = 1.
    Unit,
}

impl Formulation for ClosedLoops {
    fn name(&self) -> &'static str {
        "closed form"
    }

    fn summary(&self) -> &'static str {
        "functions of the open tree, with the dependent links of planar loops in closed form"
    }

    fn unserved<'a>(&self, _: &'a Multibody) -> Option<&'a LinkFrame> {
        None
    }

    fn serves(&self, graph: &BondGraph) -> bool {
        let closed = graph.closed.as_deref();
        closed.is_some_and(|closed| polygons(&closed.closure).is_some())
    }

    fn knows(&self, method: Method) -> bool {
        !self.reads_of_tree(method).is_empty()
    }

    fn offer(&self, _: &Prepared<'_>, _: Method) -> Offer {
        Offer::Candidate
    }

    fn reads_of_tree(&self, method: Method) -> Vec<Method> {
        match method {
            Method::InverseDynamics | Method::Bias => vec![Method::InverseDynamics],
            Method::ForwardDynamics => vec![Method::InverseDynamics, Method::MassMatrix],
            Method::MassMatrix
            | Method::Gravity
            | Method::KineticEnergy
            | Method::PotentialEnergy => vec![method],
            _ => vec![],
        }
    }

    fn reads_of_moved_tree(&self, method: Method) -> Vec<Method> {
        self.reads_of_tree(method)
    }

    fn closes_loops(&self) -> bool {
        true
    }

    fn function(&self, prepared: &Prepared<'_>, method: Method) -> Option<Function> {
        let closed = prepared.graph.closed.as_deref()?;
        let polygons = polygons(&closed.closure)?;
        let long = closed.tree.coordinates.len() > MOST_COORDINATES;
        let angles = polygons.iter().map(|one| one.known.len()).max();
        let most = if long { 1 } else { MOST_AXES };
        let axes = 0..=angles.unwrap_or(0).min(most);
        let single = prepared.graph.coordinates.len() == 1;
        let styles = [MapStyle::Vectors, MapStyle::Columns, MapStyle::Unit];
        let styles = styles.iter().filter(|style| match style {
            MapStyle::Vectors => !long,
            MapStyle::Columns => true,
            MapStyle::Unit => single,
        });
        let forms = styles.flat_map(|&style| {
            let axes = axes.clone();
            axes.flat_map(move |axes| {
                [false, true].map(|by_cosine| WrittenForm {
                    by_cosine,
                    axes,
                    style,
                })
            })
        });
        let made = forms.filter_map(|form| {
            let closing = (&closed.closure, &polygons[..]);
            function(prepared, method, closing, form)
        });
        cheapest_after_factoring(made)
    }
}

/// Returns the function of a method in one form; `None` if it would read a dependent angle.
fn function(
    prepared: &Prepared<'_>,
    method: Method,
    (closure, polygons): (&Closure, &[Polygon]),
    form: WrittenForm,
) -> Option<Function> {
    let graph = prepared.graph;
    let read = |method: Method| {
        let moved = prepared.moved_tree_function(method);
        moved.or_else(|| prepared.tree_function(method))
    };
    let first = *ClosedLoops.reads_of_tree(method).first()?;
    let from: Vec<Rc<Function>> = (ClosedLoops.reads_of_tree(method).into_iter())
        .map(read)
        .collect::<Option<_>>()?;
    let angles: Vec<AngleSum> = (from.iter())
        .flat_map(|f| angle_sums(&f.graph, &f.blocks[0].outputs))
        .collect();
    let b = Builder::new();
    let outputs: Vec<Signed> = {
        let x = Arguments::new(&b, graph, method);
        let first_pivot = method.shape().checked().then_some(graph.coordinates.len());
        let positions = PositionForm {
            by_cosine: form.by_cosine,
            axes: form.axes,
            angles: &angles,
            first_pivot,
        };
        let motion = ClosedMotion {
            at: ClosedPositions::new(&b, (closure, polygons), &x.q, positions),
            closure,
            read: &read,
            style: form.style,
        };
        let outputs = motion.outputs(method, &x)?;
        outputs.into_iter().map(Expr::signed).collect()
    };
    let built = b.into_graph();
    let needed = reachable(&built, &outputs);
    let sums = sums::JointSums::new(polygons);
    let reads_dependent = (0..built.len()).any(|i| {
        needed[i]
            && matches!(built.node(NodeId::at(i)), Node::Leaf(Leaf::Position(p)) if sums.depends(*p))
    });
    let of_tree = read(first)?.formulation.clone();
    let moved = match prepared.moved_tree_function(first) {
        Some(_) => ", masses across pins",
        None => "",
    };
    let name = format!("{of_tree}; loops in closed form{moved}");
    (!reads_dependent).then(|| Function::flat(graph, method, name, built, outputs))
}

/// The motion of the open tree.
struct ClosedMotion<'a, 'g, R> {
    at: ClosedPositions<'a, 'g>,
    closure: &'a Closure,
    read: R,
    style: MapStyle,
}

impl<'g, R: Fn(Method) -> Option<Rc<Function>>> ClosedMotion<'_, 'g, R> {
    fn b(&self) -> &'g Builder {
        self.at.b
    }

    /// Returns values of the independent velocities by their number in the open tree.
    fn own(&self, u: &[Expr<'g>]) -> Vec<Expr<'g>> {
        let mut own = vec![self.b().zero(); self.closure.positions.len()];
        for (i, &x) in self.closure.independents.iter().zip(u) {
            own[i.0] = x;
        }
        own
    }

    fn outputs(&self, method: Method, x: &Arguments<'g>) -> Option<Vec<Expr<'g>>> {
        let rates = self.rates(&x.v);
        Some(match method {
            Method::InverseDynamics | Method::Bias => {
                let moved = self.accelerations(&rates, x);
                self.reduced(&self.tree(Method::InverseDynamics, &rates, Some(&moved))?)
            }
            Method::Gravity => self.reduced(&self.tree(method, &rates, None)?),
            Method::MassMatrix => self.mass_matrix(&rates)?.into_iter().flatten().collect(),
            Method::ForwardDynamics => {
                let z = self.accelerations(&rates, x);
                let bias = self.tree(Method::InverseDynamics, &rates, Some(&z))?;
                let bias = self.reduced(&bias);
                let drive = x.tau.iter().zip(bias).map(|(&tau, h)| tau - h).collect();
                solve::ltdl(self.b(), self.mass_matrix(&rates)?, drive)
            }
            Method::KineticEnergy | Method::PotentialEnergy => self.tree(method, &rates, None)?,
            _ => return None,
        })
    }

    /// Returns the rates of all joints for those of the independent ones.
    fn rates(&self, u: &[Expr<'g>]) -> JointRates<'g> {
        match self.style {
            MapStyle::Vectors => self.at.rates(self.own(u)),
            _ => self.combined(u),
        }
    }

    /// Returns S u̇ + z.
    fn accelerations(&self, rates: &JointRates<'g>, x: &Arguments<'g>) -> JointRates<'g> {
        if self.style != MapStyle::Unit {
            return self.at.accelerations(rates, self.own(&x.a));
        }
        let mut sum = self.combined(&x.a);
        let per = self.at.accelerations(&self.columns()[0], self.own(&[]));
        let square = x.v[0] * x.v[0];
        for (sum, per) in sum.unknown.iter_mut().zip(per.unknown) {
            *sum = *sum + square * per;
        }
        sum
    }

    /// Returns the columns of S times these numbers.
    fn combined(&self, u: &[Expr<'g>]) -> JointRates<'g> {
        let mut sum = self.at.still(self.closure.positions.len());
        sum.own = self.own(u);
        for (column, &u) in self.columns().iter().zip(u) {
            for (sum, s) in sum.unknown.iter_mut().zip(&column.unknown) {
                *sum = *sum + *s * u;
            }
        }
        sum
    }

    /// Returns the results of a method of the tree; without accelerations they are zero.
    fn tree(
        &self,
        method: Method,
        rates: &JointRates<'g>,
        moved: Option<&JointRates<'g>>,
    ) -> Option<Vec<Expr<'g>>> {
        let b = self.b();
        let function = (self.read)(method)?;
        let signed =
            |all: Vec<Expr<'g>>| -> Vec<Signed> { all.iter().map(|x| x.signed()).collect() };
        let velocities = signed(self.at.of_tree(rates));
        let moved = moved.map(|moved| signed(self.at.of_tree(moved)));
        let zero = b.zero().signed();
        let outputs = &function.blocks[0].outputs;
        let turns = self.turns(&function.graph, outputs);
        let slides: Vec<Option<Signed>> = (0..self.closure.start.len())
            .map(|p| self.at.position(p).map(|x| x.signed()))
            .collect();
        let leaf = |leaf: Leaf| match leaf {
            Leaf::Velocity(j) => Some(velocities[j]),
            Leaf::Acceleration(j) => Some(moved.as_ref().map_or(zero, |all| all[j])),
            Leaf::Position(p) => slides[p],
            _ => None,
        };
        let turn = |node: NodeId| {
            turns
                .iter()
                .find(|(known, _)| *known == node)
                .map(|(_, x)| *x)
        };
        let copied = b.with_graph(|g| copy_with_turns(g, &function.graph, outputs, leaf, turn));
        Some(copied.into_iter().map(|e| b.expr(e)).collect())
    }

    /// Returns cosine and sine of the sums of angles with dependent ones.
    fn turns(&self, graph: &Graph, outputs: &[Signed]) -> Vec<(NodeId, [Signed; 2])> {
        let turn = |angle: AngleSum| {
            let mut sum = JointSum::default();
            let mut depends = false;
            for (leaf, negative) in &angle.terms {
                let Some(Leaf::Position(p)) = leaf else {
                    return None;
                };
                depends |= self.at.sums.depends(*p);
                sum.add(&self.at.sums.position(*p), if *negative { -1 } else { 1 });
            }
            let direction = depends.then(|| self.at.direction(&sum, angle.offset))?;
            Some((angle.node, direction.0.map(|x| x.signed())))
        };
        angle_sums(graph, outputs)
            .into_iter()
            .filter_map(turn)
            .collect()
    }

    /// Returns Sᵀ f.
    fn reduced(&self, f: &[Expr<'g>]) -> Vec<Expr<'g>> {
        let gathered = self.at.gathered(f);
        let independents = self.closure.independents.iter();
        if self.style == MapStyle::Vectors {
            let own = self.at.transposed(gathered);
            return independents.map(|i| own[i.0]).collect();
        }
        let columns = self.columns();
        let one = |(i, column): (&crate::mechanism::CoordinateId, &JointRates<'g>)| {
            let terms = column.unknown.iter().zip(&gathered.unknown);
            terms.fold(gathered.own[i.0], |sum, (s, g)| sum + *s * *g)
        };
        independents.zip(&columns).map(one).collect()
    }

    /// Returns the columns of S.
    fn columns(&self) -> Vec<JointRates<'g>> {
        let n = self.closure.independents.len();
        let unit = |k: usize| {
            let one = |i: usize| self.b().constant(if i == k { Dd::ONE } else { Dd::ZERO });
            self.at
                .rates(self.own(&(0..n).map(one).collect::<Vec<_>>()))
        };
        (0..n).map(unit).collect()
    }

    /// Returns the lower triangle of Sᵀ M S, row by row.
    fn mass_matrix(&self, rates: &JointRates<'g>) -> Option<Vec<Vec<Expr<'g>>>> {
        let mass = self.tree(Method::MassMatrix, rates, None)?;
        let joints = self.closure.positions.len();
        let entry = |i: usize, j: usize| mass[in_triangle(i.max(j), i.min(j))];
        // Rows, then columns, by links.
        let rows: Vec<JointRates<'g>> = (0..joints)
            .map(|j| {
                self.at
                    .gathered(&(0..joints).map(|i| entry(i, j)).collect::<Vec<_>>())
            })
            .collect();
        let own = |i: usize| rows.iter().map(|row| row.own[i]).collect::<Vec<_>>();
        let unknown = |k: usize| rows.iter().map(|row| row.unknown[k]).collect::<Vec<_>>();
        let of_own: Vec<JointRates<'g>> = (self.closure.independents.iter())
            .map(|i| self.at.gathered(&own(i.0)))
            .collect();
        let of_unknown: Vec<JointRates<'g>> = (0..rates.unknown.len())
            .map(|k| self.at.gathered(&unknown(k)))
            .collect();
        let columns = self.columns();
        let independents = &self.closure.independents;
        // Row r of the matrix of links times a column of S.
        let moved = |row: &JointRates<'g>, l: usize| {
            let terms = row.unknown.iter().zip(&columns[l].unknown);
            terms.fold(row.own[independents[l].0], |sum, (m, s)| sum + *m * *s)
        };
        let entry = |k: usize, l: usize| {
            let terms = of_unknown.iter().zip(&columns[k].unknown);
            terms.fold(moved(&of_own[k], l), |sum, (row, s)| {
                sum + *s * moved(row, l)
            })
        };
        let n = independents.len();
        Some(
            (0..n)
                .map(|k| (0..=k).map(|l| entry(k, l)).collect())
                .collect(),
        )
    }
}
