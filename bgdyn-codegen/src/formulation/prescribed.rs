//! Functions of a mechanism with prescribed joints, by any formulation.
//!
//! Such a mechanism is that in which these joints are free ([`Released`]), with their positions, velocities and
//! accelerations as run-time parameters in place of entries of q, v and a:
//!
//! | method | from the mechanism with free joints |
//! |---|---|
//! | inverse dynamics, bias, gravity | rows of P(q, v, a); a is 0 for the bias, v and a are 0 for gravity |
//! | efforts of the drives | the other rows |
//! | mass matrix | rows and columns |
//! | forward dynamics | the solution of M a = τ − bias |
//! | energies, poses, velocities | the same, with the whole motion |
//! | loads through joints | the same, with the whole motion |
//! | Jacobians | columns |
//! | centroidal methods, those of contacts | as poses, velocities, Jacobians and J̇ v |
//! | J̇ v | the acceleration where a is 0: J̇ v, and the other columns times the accelerations there |
//! | Coriolis matrix | that of v alone, and the derivative of the bias along v where v is 0 |
//!
//! The last line is C with bias = C v + gravity, because the bias is quadratic in v. C + Cᵀ is the rate of M along
//! the motion plus that along the motion of the prescribed joints alone: these joints supply power.

use std::collections::BTreeSet;

use bgdyn_runtime::Dd;

use super::{Formulation, Prepared, solve};
use crate::bond_graph::{FreeArgument, Multibody, Released};
use crate::expr::{Builder, Expr, Graph, Leaf, Signed, Tangent, copy_into};
use crate::function::{Function, in_triangle};
use crate::mechanism::{BaseMotion, ParameterId};
use crate::method::{Argument, Centroidal, ContactMethod, Method};

/// Returns the method's function by a formulation, also for a mechanism with prescribed joints: then from the
/// functions for the mechanism in which they are free. A formulation that uses functions of other methods uses those
/// of this mechanism.
pub(crate) fn create(
    formulation: &dyn Formulation,
    prepared: &Prepared<'_>,
    method: Method,
) -> Option<Function> {
    match prepared.graph.released.is_some() && formulation.reads(method).is_empty() {
        true => restricted(formulation, prepared, method),
        false => formulation.function(prepared, method),
    }
}

/// Returns the method's function, from those that the formulation creates for the mechanism with free joints.
fn restricted(
    formulation: &dyn Formulation,
    prepared: &Prepared<'_>,
    method: Method,
) -> Option<Function> {
    let released = prepared.graph.released.as_deref()?;
    let parts = FreeFunctions {
        formulation,
        prepared: prepared.released()?,
        released,
    };
    let b = Builder::new();
    let (outputs, from) = parts.outputs(&b, prepared.graph, method)?;
    let name = from.formulation.clone();
    let made = Function::flat(prepared.graph, method, name, b.into_graph(), outputs);
    Some(Function {
        plans: from.plans,
        ordered: from.ordered,
        ..made
    })
}

/// Returns the expressions of the mass matrix, its lower triangle, and then of the bias.
pub(super) fn mass_and_bias(
    formulation: &dyn Formulation,
    released: &Released,
) -> Option<(Graph, Vec<Signed>)> {
    let prepared = Prepared::new(released);
    let parts = FreeFunctions {
        formulation,
        prepared: &prepared,
        released,
    };
    let b = Builder::new();
    let (mut outputs, _) = parts.mass_matrix(&b)?;
    outputs.extend(parts.efforts(&b, Method::Bias)?.0);
    Some((b.into_graph(), outputs))
}

/// The functions of the mechanism with free joints.
struct FreeFunctions<'p, 'a> {
    formulation: &'p dyn Formulation,
    prepared: &'p Prepared<'a>,
    released: &'p Released,
}

/// Expressions, and a function that they are from.
type Made = (Vec<Signed>, Function);

impl FreeFunctions<'_, '_> {
    fn outputs(&self, b: &Builder, graph: &Multibody, method: Method) -> Option<Made> {
        let n = self.released.velocities.len();
        match method {
            Method::InverseDynamics | Method::Bias | Method::Gravity => self.efforts(b, method),
            Method::DriveEfforts(_) => {
                let drives = self.released.prescribed.iter();
                let rows: Vec<usize> = drives.map(|drive| drive.coordinate.0).collect();
                self.copied(b, method, Method::InverseDynamics, &rows)
            }
            Method::MassMatrix => self.mass_matrix(b),
            Method::ForwardDynamics => self.accelerations(b),
            Method::CoriolisMatrix => self.coriolis_matrix(b, graph),
            Method::InverseDynamicsDerivatives => {
                let blocks = [self.block(0, n), self.block(n * n, n)].concat();
                self.copied(b, method, method, &blocks)
            }
            Method::Jacobian(_)
            | Method::Contact(ContactMethod::Jacobian(_))
            | Method::Centroidal(Centroidal::Jacobian | Centroidal::Map) => self.columns(b, method),
            Method::JacobianDotV(site) => self.rate(b, method, Method::Jacobian(site)),
            Method::Centroidal(Centroidal::Bias) => {
                self.rate(b, method, Method::Centroidal(Centroidal::Map))
            }
            Method::Contact(ContactMethod::Bias(contacts)) => {
                let jacobian = ContactMethod::Jacobian(contacts);
                self.rate(b, method, Method::Contact(jacobian))
            }
            Method::Contact(of) if of.is_dynamic() => None,
            Method::Centroidal(_) | Method::Contact(_) => {
                let all: Vec<usize> = (0..method.shape().len(n)).collect();
                self.copied(b, method, method, &all)
            }
            Method::KineticEnergy
            | Method::PotentialEnergy
            | Method::Pose(_)
            | Method::Velocity(_) => {
                let all: Vec<usize> = (0..method.shape().len(n)).collect();
                self.copied(b, method, method, &all)
            }
            Method::JointReactions => {
                let shown = self.released.frames.iter().filter(|frame| !frame.hidden);
                let all: Vec<usize> = (0..6 * shown.count()).collect();
                self.copied(b, method, method, &all)
            }
            // Derivatives of forward dynamics use other methods; loops beside prescribed joints are refused.
            _ => None,
        }
    }

    /// Returns the indices of an n × n matrix's entries in rows and columns of v; `first` is that of the first.
    fn block(&self, first: usize, n: usize) -> Vec<usize> {
        let own = self.released.own_velocities();
        let row = |i: usize| own.iter().map(move |j| first + i * n + j);
        own.iter().flat_map(|&i| row(i)).collect()
    }

    /// Returns the rows of P that belong to v, for the arguments of this method.
    fn efforts(&self, b: &Builder, method: Method) -> Option<Made> {
        let rows = self.released.own_velocities();
        self.copied(b, method, Method::InverseDynamics, &rows)
    }

    /// Returns the lower triangle of M.
    fn mass_matrix(&self, b: &Builder) -> Option<Made> {
        let own = self.released.own_velocities();
        let row = |i: usize| own[..=i].iter().map(move |&j| (i, j));
        let entries = (0..own.len()).flat_map(row);
        let entries: Vec<usize> = entries.map(|(i, j)| in_triangle(own[i], j)).collect();
        self.copied(b, Method::MassMatrix, Method::MassMatrix, &entries)
    }

    /// Returns the columns of v of a matrix that has a column for each velocity.
    fn columns(&self, b: &Builder, method: Method) -> Option<Made> {
        let (n, own) = (
            self.released.velocities.len(),
            self.released.own_velocities(),
        );
        let rows = 0..method.shape().len(1);
        let columns = rows.flat_map(|row| own.iter().map(move |j| row * n + j));
        self.copied(b, method, method, &columns.collect::<Vec<_>>())
    }

    /// Returns the acceleration of a site, the rate of the momentum or of the velocities at contacts, where a is 0; `map` is
    /// the matrix to which it belongs.
    fn rate(&self, b: &Builder, method: Method, map: Method) -> Option<Made> {
        let n = self.released.velocities.len();
        let rows = method.shape().len(n);
        let all: Vec<usize> = (0..rows).collect();
        let (mut sums, from) = self.copied(b, method, method, &all)?;
        let jacobian = self.made(map)?;
        for prescribed in &self.released.prescribed {
            let column: Vec<usize> = (0..rows).map(|i| i * n + prescribed.coordinate.0).collect();
            let column = self.copied_from(b, method, &jacobian, &column, |_| false);
            let acceleration = b.leaf(Leaf::Parameter(prescribed.motion[2].0));
            for (sum, entry) in sums.iter_mut().zip(column) {
                *sum = (b.expr(*sum) + b.expr(entry) * acceleration).signed();
            }
        }
        Some((sums, from))
    }

    /// Returns the solution of M a = τ − bias.
    fn accelerations(&self, b: &Builder) -> Option<Made> {
        // Articulated bodies are the mechanism with free joints.
        if !self.formulation.knows(Method::MassMatrix) {
            return None;
        }
        let (mass, from) = self.mass_matrix(b)?;
        let (bias, _) = self.efforts(b, Method::Bias)?;
        let n = bias.len();
        let row = |i: usize| -> Vec<Expr<'_>> {
            let entry = |j: usize| b.expr(mass[in_triangle(i, j)]);
            (0..=i).map(entry).collect()
        };
        let drive = |j: usize| b.leaf(Leaf::Input(j)) - b.expr(bias[j]);
        let solved = solve::ltdl(b, (0..n).map(row).collect(), (0..n).map(drive).collect());
        Some((solved.into_iter().map(Expr::signed).collect(), from))
    }

    /// Returns C, row by row.
    fn coriolis_matrix(&self, b: &Builder, graph: &Multibody) -> Option<Made> {
        let n = graph.coordinates.len();
        let made = self.made(Method::CoriolisMatrix)?;
        let still = self.still(graph);
        let alone = self.copied_from(
            b,
            Method::CoriolisMatrix,
            &made,
            &self.block(0, self.released.velocities.len()),
            |leaf| still.contains(&leaf),
        );
        let moving = Builder::silent();
        let (bias, _) = self.efforts(&moving, Method::Bias)?;
        let mut slopes = Vec::new();
        for j in 0..n {
            let own = |g: &mut Graph, leaf: Leaf| {
                (leaf == Leaf::Velocity(j)).then(|| g.constant(Dd::ONE))
            };
            let mut tangent = Tangent::new(own);
            let column = bias
                .iter()
                .map(|&e| moving.with_graph(|g| tangent.of(g, e)));
            slopes.push(column.collect::<Vec<_>>());
        }
        let rows: Vec<Signed> = (0..n)
            .flat_map(|i| slopes.iter().map(move |column| column[i]))
            .collect();
        let at_rest = |g: &mut Graph, leaf: Leaf| match leaf {
            Leaf::Velocity(_) => Some(g.constant(Dd::ZERO)),
            _ => None,
        };
        let moving = moving.into_graph();
        let slopes = b.with_graph(|g| copy_into(g, &moving, &rows, at_rest));
        let entries = alone.iter().zip(slopes);
        let entries = entries.map(|(&x, y)| (b.expr(x) + b.expr(y)).signed());
        Some((entries.collect(), made))
    }

    /// Returns the parameters that the Coriolis matrix of v alone does not depend on: the rates of the prescribed
    /// joints, and the motion of the base.
    fn still(&self, graph: &Multibody) -> BTreeSet<Leaf> {
        let rates = self.released.prescribed.iter().map(|p| p.motion[1]);
        let base = graph.base.iter().flat_map(BaseMotion::parameters);
        let all = rates.chain(base);
        all.map(|ParameterId(p)| Leaf::Parameter(p)).collect()
    }

    fn made(&self, method: Method) -> Option<Function> {
        let formulation = self.formulation;
        if !formulation.knows(method) || !formulation.serves(self.prepared.graph) {
            return None;
        }
        formulation.function(self.prepared, method)
    }

    /// Returns some results of a method of the mechanism with free joints, with the arguments of `method`.
    fn copied(&self, b: &Builder, method: Method, of: Method, results: &[usize]) -> Option<Made> {
        let made = self.made(of)?;
        let copied = self.copied_from(b, method, &made, results, |_| false);
        Some((copied, made))
    }

    /// Returns some results of a function of the mechanism with free joints, with the arguments of `method`.
    /// Leaves that are `zero` are 0.
    fn copied_from(
        &self,
        b: &Builder,
        method: Method,
        made: &Function,
        results: &[usize],
        zero: impl Fn(Leaf) -> bool,
    ) -> Vec<Signed> {
        let outputs = &made.blocks[0].outputs;
        let wanted: Vec<Signed> = results.iter().map(|&k| outputs[k]).collect();
        let placed = |g: &mut Graph, leaf: Leaf| {
            let leaf = self.leaf(method, leaf).filter(|&leaf| !zero(leaf));
            Some(match leaf {
                Some(leaf) => g.leaf(leaf),
                None => g.constant(Dd::ZERO),
            })
        };
        b.with_graph(|g| copy_into(g, &made.graph, &wanted, placed))
    }

    /// Returns the leaf in place of one of the mechanism with free joints; `None` for one that is 0.
    fn leaf(&self, method: Method, leaf: Leaf) -> Option<Leaf> {
        let r = self.released;
        let prescribed = |k: usize, part: usize| Leaf::Parameter(r.prescribed[k].motion[part].0);
        let own = |argument, leaf| method.arguments().contains(&argument).then_some(leaf);
        match leaf {
            Leaf::Position(p) => match r.positions[p] {
                FreeArgument::Own(k) => Some(Leaf::Position(k)),
                FreeArgument::Prescribed(k) => Some(prescribed(k, 0)),
            },
            Leaf::Velocity(j) => match r.velocities[j] {
                FreeArgument::Own(k) => own(Argument::V, Leaf::Velocity(k)),
                FreeArgument::Prescribed(k) => Some(prescribed(k, 1)),
            },
            Leaf::Acceleration(j) => match r.velocities[j] {
                FreeArgument::Own(k) => own(Argument::A, Leaf::Acceleration(k)),
                FreeArgument::Prescribed(k) => Some(prescribed(k, 2)),
            },
            other => Some(other),
        }
    }
}
