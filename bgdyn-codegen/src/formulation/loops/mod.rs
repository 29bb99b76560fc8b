//! Mechanisms with loops: the functions of the open tree at q̇ = S u and q̈ = S u̇ + z, multiplied by Sᵀ.
//!
//! Equation (6) with the transformers of the tree composed with S (Krut'ko and Kuzmin 2001; Blajer 1992):
//! Sᵀ P = Σ_i [ (∂r_i/∂q S)ᵀ (m_i r̈_i − R_i) + (ρ^i S)ᵀ (K̇_i − M_i) ]. The multipliers do not appear, because
//! B S = 0.

use std::rc::Rc;

use bgdyn_runtime::ACTUATORS;

use super::actuators::on_tree;
use super::arguments::Arguments;
use super::closing_loads::{add_to_joints, reactions};
use super::loop_methods::{LoopMotion, cheapest_with_fewest, compose, reads};
use super::loop_rows::{LoopForm, loop_bias, loop_residuals, loop_rows};
use super::velocity_map::{FirstPivot, VelocityMap};
use super::{Formulation, Offer, Prepared};
use crate::bond_graph::{BondGraph, ClosedTree, LinkFrame, Multibody};
use crate::expr::{Builder, Expr, Graph, Signed};
use crate::function::Function;
use crate::method::{Centroidal, ContactMethod, Method};

/// Elimination of the dependent velocities, on the functions chosen for the open tree.
pub(super) struct Elimination;

impl Formulation for Elimination {
    fn name(&self) -> &'static str {
        "elimination"
    }

    fn summary(&self) -> &'static str {
        "functions of the open tree, with the dependent velocities of the loops eliminated"
    }

    fn unserved<'a>(&self, _: &'a Multibody) -> Option<&'a LinkFrame> {
        None
    }

    fn serves(&self, graph: &BondGraph) -> bool {
        graph.closed.is_some()
    }

    fn knows(&self, method: Method) -> bool {
        !self.reads_of_tree(method).is_empty()
            || Method::OF_LOOPS.contains(&method)
            || method == Method::ConstraintBias
    }

    fn offer(&self, _: &Prepared<'_>, _: Method) -> Offer {
        Offer::Candidate
    }

    fn reads_of_tree(&self, method: Method) -> Vec<Method> {
        reads(method)
    }

    fn function(&self, prepared: &Prepared<'_>, method: Method) -> Option<Function> {
        let forms = forms(prepared.graph, method).into_iter();
        cheapest_with_fewest(forms.filter_map(|form| function(prepared, method, form)))
    }
}

/// Returns the forms of the rows that are compared.
fn forms(graph: &BondGraph, method: Method) -> Vec<LoopForm> {
    let loops = graph.closed.iter().flat_map(|closed| &closed.closure.loops);
    let in_axes_of_a = matches!(
        method,
        Method::Multipliers
            | Method::ConstraintResidual
            | Method::ConstraintJacobian
            | Method::ClosingStep
            | Method::ConstraintBias
            | Method::ConstrainedDynamics
            | Method::Reactions
            | Method::ActuatedReactions(_)
            | Method::JointReactions
            | Method::ActuatedJointReactions(_)
    );
    let reversible = !in_axes_of_a && loops.clone().any(|one| one.reversible);
    let vectors = matches!(
        method,
        Method::InverseDynamics
            | Method::Bias
            | Method::Gravity
            | Method::KineticEnergy
            | Method::Velocity(_)
            | Method::JacobianDotV(_)
            | Method::Centroidal(Centroidal::Momentum | Centroidal::Bias)
            | Method::Contact(ContactMethod::Velocity(_) | ContactMethod::Bias(_))
            | Method::TreeVelocity
            | Method::TreeAcceleration
            | Method::Multipliers
            | Method::ConstraintBias
            | Method::JointReactions
            | Method::ActuatedJointReactions(_)
    );
    let choices = |can: bool| {
        if can {
            &[false, true][..]
        } else {
            &[false][..]
        }
    };
    let with = |&reversed: &bool| {
        let each = choices(vectors).iter();
        each.map(move |&by_vectors| LoopForm {
            reversed,
            by_vectors,
            of_plane: in_axes_of_a,
            along_planes: false,
            rotates: false,
            first_pivot: None,
        })
    };
    let forms: Vec<LoopForm> = choices(reversible).iter().flat_map(with).collect();
    let closed = graph.closed.as_deref();
    let leans = closed.is_some_and(|closed| closed.closure.along_planes.is_some());
    let others = forms.iter().map(|form| LoopForm {
        along_planes: true,
        ..*form
    });
    let others = others.filter(|form| leans && !form.of_plane);
    forms.iter().copied().chain(others).collect()
}

/// Returns the function of a method in one form, and its number of pivots that others follow.
fn function(prepared: &Prepared<'_>, method: Method, form: LoopForm) -> Option<(Function, usize)> {
    let graph = prepared.graph;
    let closed = graph.closed.as_deref()?;
    let b = Builder::new();
    let early;
    let outputs: Vec<Signed> = {
        let of_tree = method.of_tree();
        let own: &Multibody = if of_tree { &closed.tree } else { graph };
        let x = Arguments::new(&b, own, method);
        let first = first_pivot(closed, own, method);
        let motion = loop_motion(&b, closed, (&x, method), (form, first));
        early = motion.early_pivots();
        let residuals = loop_residuals(&b, &closed.closure, &x.q);
        let read = |method: Method| prepared.tree_function(method);
        let outputs = compose(&b, closed, method, (&x, &motion), (&read, &residuals))?;
        let outputs = with_loads(&b, closed, (method, &x), outputs);
        outputs.into_iter().map(Expr::signed).collect()
    };
    let name = match reads(method).first() {
        None => Elimination.name().into(),
        Some(&first) => {
            let of_tree = prepared.tree_function(first)?.formulation.clone();
            format!("{of_tree}; loops eliminated")
        }
    };
    let function = Function::flat(graph, method, name, b.into_graph(), outputs);
    Some((function, early))
}

/// Returns the index of the first pivot of the loops, after those of the results, if pivots are checked.
fn first_pivot(closed: &ClosedTree, own: &Multibody, method: Method) -> FirstPivot {
    let results = match method {
        Method::ActuatedInverse(number) => number,
        _ => own.coordinates.len(),
    };
    debug_assert!(results < ACTUATORS && closed.closure.loops.len() < ACTUATORS);
    method.shape().checked().then_some(results)
}

/// Returns the results of [`compose`] with loads in place of the multipliers at their end, for reactions.
fn with_loads<'g>(
    b: &'g Builder,
    closed: &ClosedTree,
    (method, x): (Method, &Arguments<'g>),
    mut outputs: Vec<Expr<'g>>,
) -> Vec<Expr<'g>> {
    if !method.has_loads() {
        return outputs;
    }
    let closure = &closed.closure;
    let lambda = outputs.split_off(outputs.len() - closure.rows.len());
    if !method.loads_joints() {
        outputs.extend(reactions(b, closure, (&x.q, &lambda)));
        return outputs;
    }
    let drives = match method {
        Method::ActuatedJointReactions(_) => on_tree(b, closed, &x.tau),
        _ => None,
    };
    let drives = drives.unwrap_or_else(|| vec![b.zero(); closure.positions.len()]);
    add_to_joints(b, closed, (&x.q, &lambda), &drives, &mut outputs);
    outputs
}

/// Returns the motion of the open tree for the arguments of a method; with `first` pivots are checked.
fn loop_motion<'a, 'g>(
    b: &'g Builder,
    closed: &'a ClosedTree,
    (x, method): (&Arguments<'g>, Method),
    (form, first): (LoopForm, FirstPivot),
) -> LoopMotion<'a, 'g> {
    let form = LoopForm {
        first_pivot: first,
        ..form
    };
    let own = &closed.closure;
    let other = own.along_planes.as_deref().filter(|_| form.along_planes);
    let closure = other.unwrap_or(own);
    let rows = loop_rows(b, closure, &x.q, form);
    let map = VelocityMap::new(b, closure, (rows, form), first);
    LoopMotion::new(map, (x, method), |v| loop_bias(b, closure, (&x.q, v), form))
}

/// Returns the expressions of the mass matrix, its lower triangle, and then of the bias, with a formulation of the
/// open tree; `None` without loops.
pub(super) fn mass_and_bias(
    of_tree: &dyn Formulation,
    graph: &BondGraph,
) -> Option<(Graph, Vec<Signed>)> {
    let closed = graph.closed.as_deref()?;
    let prepared = Prepared::new(&closed.tree);
    let read = |method: Method| of_tree.function(&prepared, method).map(Rc::new);
    let b = Builder::new();
    let outputs: Vec<Signed> = {
        let x = Arguments::new(&b, graph, Method::Bias);
        let motion = loop_motion(&b, closed, (&x, Method::Bias), (LoopForm::default(), None));
        let of = |method| compose(&b, closed, method, (&x, &motion), (&read, &[]));
        let mut all = of(Method::MassMatrix)?;
        all.extend(of(Method::Bias)?);
        all.into_iter().map(Expr::signed).collect()
    };
    Some((b.into_graph(), outputs))
}
