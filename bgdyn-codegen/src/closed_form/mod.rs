//! Derives closed-form efforts P_j of small mechanisms, in textbook form.
//!
//! Generated code does not use it.
//!
//! 1. Create the expression graph of the literal sum (6), for the mechanism with letters for its numbers
//!    ([`Mechanism::symbolic`]). The letters are run-time parameters, and prismatic joints of massless links
//!    that never move.
//! 2. Convert it to polynomials in normal form (`polynomial.rs`, `expand.rs`). For each group of parallel
//!    axes a term has at most one sine or cosine, of a sum of multiples of their angles. In this form every
//!    trigonometric identity is satisfied automatically, and terms cancel as soon as they are added.
//! 3. Collect the coefficients of q̈_k, q̇_k q̇_l and the rest, factored ([`ClosedForm`]).
//! 4. Print text or LaTeX ([`text`](text()), [`latex`](latex())).
//!
//! The number of terms and of products of terms is limited, so that a mechanism with too long equations is
//! refused early.

mod collect;
mod definition;
mod expand;
mod form;
mod latex;
mod notation;
mod polynomial;
mod refused;
mod text;
mod tidy;

use bgdyn_runtime::Dd;

use crate::bond_graph::{self, BondGraph, Effort};
use crate::formulation::{self, Prepared};
use crate::mechanism::{
    LinkId, Mechanism, Motion, NumberSymbol, ParameterId, SymbolicMechanism, Value,
};
use crate::method::Method;
use collect::Collected;
use definition::NamesOfSums;
use expand::{Budget, CoordinateForm, Leaves};
pub use form::{Atom, ClosedForm, Factor, NamedSum, Sum, Term};
pub use latex::latex;
pub use polynomial::Angle;
use polynomial::{Polynomial, Symbol};
pub use refused::NoClosedForm;
pub use text::text;

/// The default limit of terms, for readable equations.
pub const LIMIT: usize = 300;

/// Limit of terms of an intermediate sum, per term of the final limit.
const ON_THE_WAY: usize = 15;
/// Limit of intermediate products, per term of the final limit.
const PRODUCTS: usize = 250;

/// Returns P_j(q, q̇, q̈) of a mechanism without effects, from equation (6), with at most `limit` terms.
///
/// # Errors
/// If the equations, or intermediate sums, are longer, or if a joint is neither a rotation nor a
/// translation of its own.
pub fn closed_form(mechanism: &Mechanism, limit: usize) -> Result<ClosedForm, NoClosedForm> {
    if mechanism.base().is_some() {
        return Err(NoClosedForm::MovingBase);
    }
    if let Some(one) = mechanism
        .closure()
        .and_then(|closure| closure.loops.first())
    {
        let name = one.name.clone();
        return Err(NoClosedForm::Loop { name });
    }
    if let Some(joint) = mechanism.prescribed_names().into_iter().next() {
        return Err(NoClosedForm::Prescribed { joint });
    }
    if let Some(joint) = mechanism.compound_joints().next() {
        let joint = joint.name.clone();
        return Err(NoClosedForm::Joint { joint });
    }
    let symbolic = mechanism.symbolic();
    let mut graph = bond_graph::build(&symbolic.mechanism);
    let mut letters = symbolic.letters.clone();
    let leaves = Leaves {
        positions: coordinates(mechanism, &symbolic),
        parameters: weigh(&mut graph, &symbolic, &mut letters),
    };
    let literal = formulation::by_name("literal").expect("the specification is always there");
    let function = literal.function(&Prepared::new(&graph), Method::InverseDynamics);
    let function = function.expect("it knows inverse dynamics");
    let outputs = &function.blocks[0].outputs[..mechanism.nv()];
    let budget = Budget {
        terms: limit.saturating_mul(ON_THE_WAY),
        products: limit.saturating_mul(PRODUCTS),
        spent: 0,
    };
    let efforts = expand::expand(&function.graph, outputs, &leaves, budget)?;
    let efforts = efforts
        .iter()
        .map(|effort| Collected::new(effort, &letters));
    let efforts: Vec<Collected> = efforts.collect();
    let terms = efforts.iter().map(Collected::len).sum();
    if terms > limit {
        return Err(NoClosedForm::TooLong { terms });
    }
    let products = efforts.iter().map(Collected::products).sum();
    let mut names = NamesOfSums::new(&letters, products);
    let efforts = efforts.iter().map(|e| e.print(&mut names)).collect();
    let constants = names.into_constants();
    let form = ClosedForm {
        name: mechanism.name().into(),
        joints: joints(mechanism),
        links: mechanism.links().iter().map(|l| l.name.clone()).collect(),
        letters,
        constants,
        efforts,
    };
    Ok(form.name_alone())
}

fn joints(mechanism: &Mechanism) -> Vec<(String, Motion)> {
    let joint = |l: &LinkId| &mechanism.links()[l.0].joint;
    let joints = mechanism.coordinates().iter().map(joint);
    joints.map(|j| (j.name.clone(), j.kind.motion)).collect()
}

/// Returns the form of each coordinate of the symbolic mechanism.
fn coordinates(mechanism: &Mechanism, symbolic: &SymbolicMechanism) -> Vec<CoordinateForm> {
    let mut groups: Vec<usize> = Vec::new();
    for (j, &link) in mechanism.coordinates().iter().enumerate() {
        let before = parallel_before(mechanism, link);
        groups.push(before.map_or(j, |k| groups.get(k).copied().unwrap_or(k)));
    }
    let own = joints(mechanism).into_iter().enumerate();
    let own = own.map(|(j, (_, motion))| match motion {
        Motion::Rotation => CoordinateForm::Angle(groups[j]),
        _ => CoordinateForm::Displacement(j),
    });
    let lengths = symbolic.lengths.iter().copied();
    own.chain(lengths.map(CoordinateForm::Length)).collect()
}

/// Returns the next inboard coordinate that is an angle, if its axis is parallel to the link's.
fn parallel_before(mechanism: &Mechanism, link: LinkId) -> Option<usize> {
    let links = mechanism.links();
    let joint = &links[link.0].joint;
    let mut axis = joint.origin.rotation * joint.axis;
    let mut carrier = links[link.0].parent;
    while let Some(LinkId(i)) = carrier {
        let joint = &links[i].joint;
        if let (Motion::Rotation, Some(j)) = (joint.kind.motion, joint.coordinate) {
            let across = axis.cross(joint.axis).0;
            let parallel = across.iter().all(|x| x.hi().abs() < polynomial::CANCELLED);
            return parallel.then_some(j.0);
        }
        axis = joint.origin.rotation * axis;
        carrier = links[i].parent;
    }
    None
}

/// Returns the polynomials of the symbolic mechanism's run-time parameters. Weights become products of a
/// mass and of `g`, the last letter.
fn weigh(
    graph: &mut BondGraph,
    symbolic: &SymbolicMechanism,
    letters: &mut Vec<NumberSymbol>,
) -> Vec<Polynomial> {
    let letter = |&(letter, opposite): &(usize, bool)| {
        let symbol = Polynomial::symbol(Symbol::Letter(letter));
        Polynomial::default().plus(&symbol, opposite)
    };
    let mut parameters: Vec<Polynomial> = symbolic.parameters.iter().map(letter).collect();
    let components = graph.gravity.0;
    let across = components.iter().filter(|&&x| x != Dd::ZERO).count();
    let size = match across {
        0 => return parameters,
        1 => components.iter().fold(Dd::ZERO, |sum, x| sum + x.abs()),
        _ => graph.gravity.dot(graph.gravity).sqrt(),
    };
    let taken = letters.iter().any(|l| l.symbol == "g");
    letters.push(NumberSymbol {
        symbol: "g".into(),
        component: "",
        of: if taken { vec![0] } else { vec![] },
        meaning: "acceleration of free fall".into(),
        value: size,
        dimension: [0, 1, -2],
        run_time: false,
    });
    let g = Polynomial::symbol(Symbol::Letter(letters.len() - 1));
    for effort in graph.sources.iter_mut().flat_map(|s| &mut s.efforts) {
        let Effort::Weight { mass, gravity } = effort;
        *gravity = gravity.map(|x| x / size);
        if let Value::Parameter(ParameterId(p)) = *mass {
            parameters.push(g.times(&parameters[p]));
            *mass = Value::Parameter(ParameterId(parameters.len() - 1));
        }
    }
    parameters
}
