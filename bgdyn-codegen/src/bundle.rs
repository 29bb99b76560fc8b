//! Bundles: the results of several methods by one function.
//!
//! Sines, poses, velocities and momenta that several methods need are computed once: the graphs of the methods are
//! copied into one, in which equal expressions are one node. Which formulation computes each method is chosen anew,
//! by the cost of the whole: one that costs more by itself can share more.

use crate::bond_graph::BondGraph;
use crate::choice::{Choice, Preference, preferred};
use crate::column_loop::{ColumnLoop, OWN, ResultSource, SHARED};
use crate::expr::{Graph, Leaf, Signed, copy_into, cost};
use crate::function::Function;
use crate::method::Method;
use crate::model::{Bundle, BundlePart};
use crate::passes::{cheapest, factor, finish, finish_in_order};

/// Returns the bundle of these methods with this name; `None` if a formulation creates no function of one of them, or
/// if they cannot be in one bundle.
pub fn bundle(
    choice: &Choice<'_>,
    graph: &BondGraph,
    (name, methods): (&str, &[Method]),
    preference: Preference,
) -> Option<Bundle> {
    let whole = Method::bundle(methods)?;
    let preferred = methods.iter().map(|&m| preferred(choice, m, preference));
    let chosen: Vec<Function> = preferred
        .map(|function| Some(unrolled(&function?)))
        .collect::<Option<_>>()?;
    let each = merged(graph, whole, &chosen.iter().collect::<Vec<_>>());
    let function = match preference {
        Preference::Operations => {
            let candidates = candidates(choice, methods, &chosen);
            let sharing = factor(merged(graph, whole, &most_sharing(&candidates)));
            finish(cheapest([sharing, factor(each.clone()), each])?)
        }
        Preference::Accuracy => finish_in_order(each),
    };
    let closed = graph.closed.as_deref();
    let mut begin = 0;
    let parts = methods.iter().zip(&chosen).map(|(&method, function)| {
        let outputs = begin..begin + function.output_count();
        begin = outputs.end;
        let name = method.name_in(closed, &graph.sites);
        BundlePart {
            method,
            name,
            outputs,
        }
    });
    let parts = parts.collect();
    let function = Function {
        name: name.into(),
        ..function
    };
    Some(Bundle { function, parts })
}

/// Returns for each method the functions that can compute it; at least the one that is chosen for it alone.
fn candidates(choice: &Choice<'_>, methods: &[Method], chosen: &[Function]) -> Vec<Vec<Function>> {
    let of = |(&method, chosen): (&Method, &Function)| {
        let own = choice.accepted(method).into_iter();
        let all = own.chain(choice.sharing(method, methods));
        let mut all: Vec<Function> = all.map(|function| unrolled(&function)).collect();
        if all.is_empty() {
            all.push(chosen.clone());
        }
        all
    };
    methods.iter().zip(chosen).map(of).collect()
}

/// Returns functions, one of each method's, with the least cost together before factoring. From the first candidates on,
/// one after the other is replaced by the one with which the whole costs least, until none is.
fn most_sharing(candidates: &[Vec<Function>]) -> Vec<&Function> {
    let cost_of = |parts: &[&Function]| {
        let (made, outputs) = in_one_graph(parts);
        cost(&made, &outputs).weighted()
    };
    let mut taken: Vec<&Function> = candidates.iter().filter_map(|all| all.first()).collect();
    let mut least = cost_of(&taken);
    loop {
        let before = least;
        for (part, all) in candidates.iter().enumerate() {
            for candidate in all {
                let mut tried = taken.clone();
                tried[part] = candidate;
                let cost = cost_of(&tried);
                if cost < least {
                    (least, taken) = (cost, tried);
                }
            }
        }
        if least == before {
            return taken;
        }
    }
}

/// Returns the functions of one block in one graph, with their results one after the other. It is not factored if one of
/// them is not.
fn merged(graph: &BondGraph, method: Method, parts: &[&Function]) -> Function {
    let (made, outputs) = in_one_graph(parts);
    let mut formulations: Vec<&str> = Vec::new();
    for part in parts {
        if !formulations.contains(&part.formulation.as_str()) {
            formulations.push(&part.formulation);
        }
    }
    Function {
        ordered: parts.iter().any(|part| part.ordered),
        ..Function::flat(graph, method, formulations.join(" + "), made, outputs)
    }
}

fn in_one_graph(parts: &[&Function]) -> (Graph, Vec<Signed>) {
    let mut made = Graph::default();
    let mut outputs: Vec<Signed> = Vec::new();
    for part in parts {
        let results = part.blocks.last().map_or(&[][..], |block| &block.outputs);
        outputs.extend(copy_into(&mut made, &part.graph, results, |_, _| None));
    }
    (made, outputs)
}

/// Returns a function without loops over columns: the operations of every column are in its graph.
fn unrolled(function: &Function) -> Function {
    let Some(loops) = &function.loops else {
        return function.clone();
    };
    let mut graph = Graph::default();
    let results = function
        .blocks
        .last()
        .map_or(&[][..], |block| &block.outputs);
    let stage = copy_into(&mut graph, &function.graph, results, |_, _| None);
    let groups: Vec<Vec<Vec<Signed>>> = (loops.groups.iter())
        .map(|group| columns(&mut graph, group, &stage))
        .collect();
    let outputs = loops.parts.iter().map(|part| match *part {
        ResultSource::Stage(k) => stage[k],
        ResultSource::Column { group, column, row } => groups[group][column][row],
    });
    let outputs = outputs.collect();
    let mut unrolled = Function {
        graph,
        loops: None,
        ..function.clone()
    };
    unrolled.blocks.truncate(1);
    if let Some(block) = unrolled.blocks.first_mut() {
        block.outputs = outputs;
    }
    unrolled
}

/// Returns the results of each column of a loop, of the results of the stage before it.
fn columns(graph: &mut Graph, group: &ColumnLoop, stage: &[Signed]) -> Vec<Vec<Signed>> {
    let column = |own: &Vec<usize>| {
        copy_into(graph, &group.graph, &group.outputs, |_, leaf| match leaf {
            Leaf::BlockResult {
                block: SHARED,
                index,
            } => Some(stage[group.shared[index]]),
            Leaf::BlockResult { block: OWN, index } => Some(stage[own[index]]),
            _ => None,
        })
    };
    group.own.iter().map(column).collect()
}
