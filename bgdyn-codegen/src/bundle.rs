//! Bundles: the results of several methods by one function.
//!
//! Sines, poses, velocities and momenta that several methods need are computed once: the graphs of the methods are
//! copied into one, in which equal expressions are one node. Which formulation computes each method is chosen anew,
//! by the cost of the whole: one that costs more by itself can share more.

use crate::bond_graph::BondGraph;
use crate::choice::{Choice, Preference, prefer};
use crate::column_loop::{ColumnLoop, OWN, ResultSource, SHARED};
use crate::expr::{Cost, Graph, Leaf, Signed, copy_into, cost};
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
    let function = match preference {
        Preference::Operations => {
            let chosen = methods.iter().map(|&method| choice.function(method));
            let chosen: Vec<Function> = chosen
                .map(|function| Some(unrolled(&*function?)))
                .collect::<Option<_>>()?;
            let sharing = factor(merged(graph, whole, &most_sharing(choice, methods)));
            let each = merged(graph, whole, &chosen);
            finish(cheapest([sharing, factor(each.clone()), each])?)
        }
        Preference::Accuracy => {
            let chosen = methods
                .iter()
                .map(|&method| prefer(choice, method, preference));
            let chosen: Vec<Function> = chosen
                .map(|function| Some(unrolled(&function?)))
                .collect::<Option<_>>()?;
            finish_in_order(merged(graph, whole, &chosen).in_order())
        }
    };
    let mut begin = 0;
    let closed = graph.closed.as_deref();
    let lengths = methods
        .iter()
        .map(|&m| choice.function(m).map_or(0, |f| output_count(&f)));
    let parts = methods
        .iter()
        .zip(lengths.collect::<Vec<_>>())
        .map(|(&method, count)| {
            let outputs = begin..begin + count;
            begin += count;
            let name = method.name_in(closed, &graph.sites);
            BundlePart {
                method,
                name,
                outputs,
            }
        });
    let parts: Vec<BundlePart> = parts.collect();
    let function = Function {
        name: name.into(),
        ..function
    };
    Some(Bundle { function, parts })
}

/// Returns functions, one for each method, with the least cost together before factoring. From the first candidates on,
/// one after the other is replaced by the one with which the whole costs least, until none is.
fn most_sharing(choice: &Choice<'_>, methods: &[Method]) -> Vec<Function> {
    let candidates: Vec<Vec<Function>> = (methods.iter())
        .map(|&method| {
            let own = choice.accepted(method).into_iter();
            let all = own.chain(choice.sharing(method, methods));
            all.map(|function| unrolled(&function)).collect()
        })
        .collect();
    let mut taken = vec![0; methods.len()];
    let at = |taken: &[usize]| -> Vec<Function> {
        let parts = candidates.iter().zip(taken);
        parts.filter_map(|(all, &k)| all.get(k).cloned()).collect()
    };
    let mut least = cost_of(&at(&taken)).weighted();
    loop {
        let before = least;
        for part in 0..methods.len() {
            for k in 0..candidates[part].len() {
                let mut tried = taken.clone();
                tried[part] = k;
                let cost = cost_of(&at(&tried)).weighted();
                if cost < least {
                    (least, taken) = (cost, tried);
                }
            }
        }
        if least == before {
            return at(&taken);
        }
    }
}

/// Returns the functions of one block in one graph, with their results one after the other.
fn merged(graph: &BondGraph, method: Method, parts: &[Function]) -> Function {
    let (made, outputs) = in_one_graph(parts);
    let mut formulations: Vec<&str> = Vec::new();
    for part in parts {
        if !formulations.contains(&part.formulation.as_str()) {
            formulations.push(&part.formulation);
        }
    }
    Function::flat(graph, method, formulations.join(" + "), made, outputs)
}

/// Returns the cost of functions of one block in one graph.
fn cost_of(parts: &[Function]) -> Cost {
    let (made, outputs) = in_one_graph(parts);
    cost(&made, &outputs)
}

fn in_one_graph(parts: &[Function]) -> (Graph, Vec<Signed>) {
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

/// Returns the number of a function's results.
fn output_count(function: &Function) -> usize {
    match &function.loops {
        Some(loops) => loops.parts.len(),
        None => function
            .blocks
            .last()
            .map_or(0, |block| block.outputs.len()),
    }
}
