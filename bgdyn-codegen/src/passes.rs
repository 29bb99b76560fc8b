//! The passes over a function, in order: factor, reassociate, fuse, cut.
//!
//! | pass | job | on graphs |
//! |---|---|---|
//! | [`factor`] | common factors and sums, reciprocals: fewer operations | `expr/factor/`, `expr/quotient.rs` |
//! | [`cheapest`] | takes one of the functions that formulations wrote | `expr/cost.rs` |
//! | `reassociate` | orders the terms of sums by when they are known | `expr/arrange.rs` |
//! | `fuse` | joins products to sums, moves signs into them | `expr/fuse.rs`, `expr/signs.rs` |
//! | `cut` | splits what is too long into blocks | `cut.rs`, `products.rs` |
//!
//! A function whose digits rest on the order of its operations ([`Function::ordered`]) passes all but
//! the last as it is.

use crate::expr::{self, Cost, Graph, Signed};
use crate::function::{Considered, Function};
use crate::split_blocks::{cut, is_cut};

/// The last passes over a function that is taken.
pub fn finish(function: Function) -> Function {
    cut(fuse(reassociate(function)))
}

/// The same for a function that was taken for its digits: its sums keep their order. Which order loses
/// the fewest digits is chance, and one that is not among the candidates was not measured.
pub fn finish_in_order(function: Function) -> Function {
    cut(fuse(function))
}

/// Factors common factors and sums out and multiplies by reciprocals, where that saves operations. A
/// function in several blocks stays as it is.
pub fn factor(function: Function) -> Function {
    on_one_block(function, |graph, outputs| {
        let (graph, outputs) = expr::factor(graph, outputs);
        expr::fold_reciprocals(graph, outputs)
    })
}

/// Adds the terms of sums in the order in which they are known, unless the function is going to be cut.
fn reassociate(function: Function) -> Function {
    if is_cut(&function) {
        return function;
    }
    on_one_block(function, |graph, outputs| {
        expr::reassociate(&graph, &outputs)
    })
}

/// Joins products to the sums that read them, and moves signs into these.
fn fuse(function: Function) -> Function {
    let join = |graph: Graph, outputs: Vec<Signed>| {
        let (graph, outputs) = expr::fuse(&graph, &outputs);
        expr::absorb_negations(&graph, &outputs)
    };
    let mut function = on_one_block(function, join);
    if !function.ordered
        && function.blocks.len() == 1
        && let Some(loops) = &mut function.loops
    {
        for one in &mut loops.groups {
            let graph = std::mem::take(&mut one.graph);
            (one.graph, one.outputs) = join(graph, std::mem::take(&mut one.outputs));
        }
    }
    function
}

/// A pass over the graph of a function in one block, unless the order of its operations is to stay.
fn on_one_block(
    mut function: Function,
    pass: impl FnOnce(Graph, Vec<Signed>) -> (Graph, Vec<Signed>),
) -> Function {
    if let ([block], false) = (&mut function.blocks[..], function.ordered) {
        let graph = std::mem::take(&mut function.graph);
        (function.graph, block.outputs) = pass(graph, std::mem::take(&mut block.outputs));
    }
    function
}

/// The cheapest of several functions for one method, with the others noted in it; the first one of
/// equals.
pub fn cheapest(candidates: impl IntoIterator<Item = Function>) -> Option<Function> {
    let candidates = candidates.into_iter();
    let mut candidates: Vec<(Cost, Function)> = candidates.map(|f| (f.cost(), f)).collect();
    candidates.sort_by_key(|(cost, _)| cost.weighted());
    let mut candidates = candidates.into_iter();
    let (_, mut best) = candidates.next()?;
    let others = candidates.map(|(cost, f)| Considered {
        what: f.formulation,
        cost,
    });
    best.passed_over.extend(others);
    Some(best)
}
