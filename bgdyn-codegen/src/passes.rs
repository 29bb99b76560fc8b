//! The passes over a function, in order: factor, reassociate, fuse, cut.
//!
//! | pass | job | on graphs |
//! |---|---|---|
//! | [`factor`] | extracts common factors and sums, replaces reciprocals | `expr/factor/`, `expr/quotient.rs` |
//! | [`cheapest`] | chooses one of the functions of the formulations | `expr/cost.rs` |
//! | `reassociate` | orders the terms of sums by the time of their availability | `expr/arrange.rs` |
//! | `fuse` | fuses products with sums, moves signs into them | `expr/fuse.rs`, `expr/signs.rs` |
//! | `cut` | divides long functions into blocks | `split_blocks.rs`, `inner_products.rs` |
//!
//! For a function whose accuracy depends on the order of its operations ([`Function::ordered`]), only the
//! last pass is applied.

use std::collections::HashSet;

use crate::expr::{self, Cost, Graph, NeededNodes, Signed};
use crate::function::{Considered, Function};
use crate::split_blocks::{cut, is_cut};

/// Applies the last passes to the chosen function.
pub fn finish(function: Function) -> Function {
    cut(fuse(reassociate(function)))
}

/// The same for a function that was chosen for its accuracy: the order of its sums does not change. Which
/// order loses the fewest digits is random, and an order that was no candidate was not measured.
pub fn finish_in_order(function: Function) -> Function {
    cut(fuse(function))
}

/// Extracts common factors and sums and replaces reciprocals, if that saves operations. A function with
/// several blocks is not changed.
pub fn factor(function: Function) -> Function {
    on_one_block(function, |graph, outputs| {
        let (graph, outputs) = expr::factor(graph, outputs);
        expr::fold_reciprocals(graph, outputs)
    })
}

/// Returns the form, in one block, that costs least after factoring; the first one of equals. Forms with the expressions of
/// an earlier one are left out, and a single form is not factored.
pub fn cheapest_after_factoring(forms: impl IntoIterator<Item = Function>) -> Option<Function> {
    let mut known = HashSet::new();
    let is_new = |form: &Function| {
        debug_assert!(form.blocks.len() == 1 && form.loops.is_none());
        let needed = NeededNodes::new(&form.graph, &form.blocks[0].outputs);
        known.insert((form.ordered, needed))
    };
    let mut forms: Vec<Function> = forms.into_iter().filter(is_new).collect();
    if forms.len() == 1 {
        return forms.pop();
    }
    let cost = |form: &Function| factor(form.clone()).cost().weighted();
    forms.into_iter().min_by_key(cost)
}

/// Adds the terms of sums in the order of their availability, unless the function is going to be cut.
fn reassociate(function: Function) -> Function {
    if is_cut(&function) {
        return function;
    }
    on_one_block(function, |graph, outputs| {
        expr::reassociate(&graph, &outputs)
    })
}

/// Fuses products with the sums that read them, and moves signs into the sums.
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

/// Applies a pass to the graph of a function in one block, unless the order of its operations is fixed.
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

/// Returns the cheapest of several functions for one method, with a record of the others; the first one of
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
    best.rejected.extend(others);
    Some(best)
}
