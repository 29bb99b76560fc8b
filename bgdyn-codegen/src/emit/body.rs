//! Emits the body of a method: straight-line code, or calls of its blocks.

use std::collections::BTreeSet;

use proc_macro2::TokenStream;
use quote::{ToTokens, format_ident, quote};

use super::code::{Naming, is_part, leaves};
use super::columns::columns;
use super::entries::{Entries, EntryTargets};
use super::explain::checked;
use super::loops;
use super::tokens::{argument_type, ident};
use super::writer::Writer;
use crate::expr::Leaf;
use crate::function::{Block, Function};
use crate::mechanism::closure::Closure;
use crate::method::{Argument, Method, Shape};
use crate::model::Model;

/// The body of a method, and the private functions of its blocks if it has several.
pub(super) struct FunctionBody {
    pub(super) body: TokenStream,
    pub(super) blocks: Vec<TokenStream>,
}

/// Returns the body of a method, and its blocks. `finish` builds the result from its components; for a
/// matrix, the targets give their positions in it.
pub(super) fn body(
    function: &Function,
    naming: &Naming<'_>,
    places: Option<EntryTargets>,
    finish: impl Fn(&[TokenStream]) -> TokenStream,
) -> FunctionBody {
    let shape = function.shape();
    if let [block] = function.blocks.as_slice() {
        let mut writer = Writer::new(function, naming, &block.outputs);
        if let Some(places) = places.filter(|_| function.loops.is_none()) {
            writer.entries = Entries::new(&block.outputs, places, &finish);
        }
        let statements = writer.block(&block.outputs, function);
        // Only results that are returned unchecked are written entry by entry.
        if let Some(result) = writer.stored_matrix() {
            return FunctionBody {
                body: quote! { #statements #result },
                blocks: vec![],
            };
        }
        let refused = shape.checked().then(|| {
            let mutable = writer.pivots.then(|| quote! { mut });
            quote! { let #mutable refused = T::none_refused(); }
        });
        let (loops, results) = with_loops(function, naming, writer.results(&block.outputs));
        let result = finish(&results);
        return FunctionBody {
            body: quote! { #refused #statements #loops #result },
            blocks: vec![],
        };
    }
    let mut blocks = Vec::new();
    let mut calls = TokenStream::new();
    let last = &function.blocks[function.blocks.len() - 1];
    let looped = !last.products.is_empty();
    for b in 0..function.blocks.len() - usize::from(looped) {
        let (block, call) = separate_block(function, naming, b);
        let passed = format_ident!("p{b}");
        calls.extend(quote! { let #passed = #call; });
        blocks.push(block);
    }
    if looped {
        let matrix = loops::matrix(function, naming, last);
        let body = quote! { #calls #matrix };
        return FunctionBody { body, blocks };
    }
    let refused = shape
        .checked()
        .then(|| quote! { let mut refused = T::none_refused(); });
    let last = format_ident!("p{}", function.blocks.len() - 1);
    let element = |i: usize| {
        let i = proc_macro2::Literal::usize_unsuffixed(i);
        quote! { #last[#i] }
    };
    let last_block = &function.blocks[function.blocks.len() - 1];
    let results = (0..last_block.outputs.len()).map(element).collect();
    let (loops, results) = with_loops(function, naming, results);
    let result = finish(&results);
    FunctionBody {
        body: quote! { #refused #calls #loops #result },
        blocks,
    }
}

/// Adds the loops after the blocks, and the function's results, from those of the blocks.
fn with_loops(
    function: &Function,
    naming: &Naming<'_>,
    results: Vec<TokenStream>,
) -> (TokenStream, Vec<TokenStream>) {
    match &function.loops {
        Some(loops) => columns(function, loops, naming, &results),
        None => (TokenStream::new(), results),
    }
}

/// Emits a block as a private function, and the call of it.
fn separate_block(
    function: &Function,
    naming: &Naming<'_>,
    b: usize,
) -> (TokenStream, TokenStream) {
    let outputs = &function.blocks[b].outputs;
    let mut writer = Writer::new(function, naming, outputs);
    let array = |values: &[TokenStream]| quote! { [#(#values),*] };
    writer.entries = Entries::of_array(outputs, &array);
    let statements = writer.block(outputs, function);
    let result = match writer.stored_matrix() {
        Some(result) => result.into_token_stream(),
        None => array(&writer.results(outputs)),
    };
    let read = leaves(&function.graph, outputs);
    let mut parameters = Vec::new();
    let mut arguments = Vec::new();
    for &argument in function.method.arguments() {
        let mut components = naming.components(argument).into_iter();
        let part = |leaf: &Leaf| is_part(argument, *leaf);
        if components.any(|(leaf, _)| read.contains(&leaf)) || read.iter().any(part) {
            let (name, ty) = (ident(argument.name()), argument_type(argument));
            parameters.push(quote! { #name: #ty });
            arguments.push(quote! { #name });
        }
    }
    for earlier in 0..b {
        let reads = |l: &Leaf| matches!(l, Leaf::BlockResult { block, .. } if *block == earlier);
        if read.iter().any(reads) {
            let (name, n) = (
                format_ident!("p{earlier}"),
                function.blocks[earlier].outputs.len(),
            );
            parameters.push(quote! { #name: &[T; #n] });
            arguments.push(quote! { &#name });
        }
    }
    if writer.pivots {
        parameters.push(quote! { refused: &mut T::Refused });
        arguments.push(quote! { &mut refused });
    }
    let name = format_ident!("{}_block_{b}", function.name());
    let n = outputs.len();
    let block = quote! {
        #[inline(never)]
        fn #name(&self, #(#parameters),*) -> [T; #n] {
            #statements
            #result
        }
    };
    (block, quote! { self.#name(#(#arguments),*) })
}

fn leaves_of(function: &Function) -> BTreeSet<Leaf> {
    let of_block = |b: &Block| leaves(&function.graph, &b.outputs);
    function.blocks.iter().flat_map(of_block).collect()
}

/// Returns whether a function reads a position of a dependent joint; one in closed form does not.
pub(super) fn reads_dependents(function: &Function, closure: &Closure) -> bool {
    let read = leaves_of(function);
    let mut positions = closure.dependents().filter_map(|j| closure.positions[j.0]);
    positions.any(|p| read.contains(&Leaf::Position(p.0)))
}

/// Returns the names that a function does not read: arguments, as `q[joint]`, and run-time parameters.
pub(super) fn unread(function: &Function, model: &Model) -> Vec<String> {
    let read = leaves_of(function);
    let mut unread = Vec::new();
    let naming = Naming::of_model(model, false);
    for argument in function.method.arguments() {
        let components = naming.components(*argument);
        let is_read = |j: usize| read.contains(&components[j].0);
        let joints = match argument {
            Argument::Q => &naming.positions,
            Argument::TreeV | Argument::TreeTau => &naming.tree_joints,
            Argument::ActuatedTau => &naming.actuated,
            _ => &naming.joints,
        };
        let missing: Vec<_> = (0..joints.len()).filter(|&j| !is_read(j)).collect();
        if missing.len() == joints.len() {
            unread.push(format!("`{}`", argument.name()));
        } else {
            let name = |&j: &usize| format!("`{}[{j}]` ({})", argument.name(), joints[j]);
            unread.extend(missing.iter().map(name));
        }
    }
    let parameters = model.mechanism.parameters().iter().enumerate();
    let missing = parameters.filter(|(p, _)| !read.contains(&Leaf::Parameter(*p)));
    unread.extend(missing.map(|(_, parameter)| format!("the parameter `{}`", parameter.name)));
    unread
}

/// The numbers of velocities of a mechanism.
#[derive(Clone, Copy)]
pub(super) struct Sizes {
    /// The independent ones.
    pub(super) nv: usize,
    /// Those of the open tree, for a mechanism with loops.
    pub(super) of_tree: Option<usize>,
}

/// Returns the result of a method from its components.
pub(super) fn result(method: Method, sizes: Sizes, values: &[TokenStream]) -> TokenStream {
    let nv = sizes.nv;
    let pivots = match sizes.of_tree {
        None => quote! { &JOINT_NAMES },
        Some(_) => quote! { &PIVOT_NAMES },
    };
    let square = |values: &[TokenStream]| matrix(nv, values);
    let squares = |values: &[TokenStream], count: usize| -> Vec<TokenStream> {
        let one = |k: usize| square(&values[k * nv * nv..(k + 1) * nv * nv]);
        (0..count).map(one).collect()
    };
    match method.shape() {
        Shape::Scalar => quote! { #(#values)* },
        Shape::Vector => vector(values),
        Shape::CheckedVector => {
            let accelerations = vector(values);
            checked(method, &accelerations, &pivots)
        }
        Shape::CheckedActuated(_) => {
            checked(method, &vector(values), &quote! { &ACTUATED_PIVOT_NAMES })
        }
        Shape::Symmetric => {
            let entry = |k: usize| {
                let (i, j) = (k / nv, k % nv);
                values[i.max(j) * (i.max(j) + 1) / 2 + i.min(j)].clone()
            };
            square(&(0..nv * nv).map(entry).collect::<Vec<_>>())
        }
        Shape::Square => square(values),
        Shape::SquarePair => {
            let squares = squares(values, 2);
            quote! { [#(#squares),*] }
        }
        Shape::CheckedSquares => {
            let (accelerations, rest) = values.split_at(nv);
            let accelerations = vector(accelerations);
            let squares = squares(rest, 3);
            let found = checked(method, &accelerations, &pivots);
            quote! {
                #found?;
                ::core::result::Result::Ok([#(#squares),*])
            }
        }
        Shape::SlopesByTree => {
            let (by_q, by_v) = values.split_at(nv * sizes.of_tree.unwrap_or(nv));
            let by_q = matrix(sizes.of_tree.unwrap_or(nv), by_q);
            let by_v = square(by_v);
            quote! { (#by_q, #by_v) }
        }
        Shape::CheckedSlopesByTree => {
            let (accelerations, rest) = values.split_at(nv);
            let (by_q, rest) = rest.split_at(nv * sizes.of_tree.unwrap_or(nv));
            let by_q = matrix(sizes.of_tree.unwrap_or(nv), by_q);
            let squares = squares(rest, 2);
            let found = checked(method, &vector(accelerations), &pivots);
            quote! {
                #found?;
                ::core::result::Result::Ok((#by_q, #(#squares),*))
            }
        }
        Shape::Pose => {
            let rotation = matrix(3, &values[..9]);
            let translation = &values[9..];
            quote! {
                __rt::Pose { rotation: #rotation, translation: __na::Vector3::new(#(#translation),*) }
            }
        }
        Shape::CheckedTree => checked(method, &vector(values), &quote! { &TREE_PIVOT_NAMES }),
        Shape::CheckedTreeAndRows => {
            let (accelerations, multipliers) = values.split_at(sizes.of_tree.unwrap_or(nv));
            let (found, multipliers) = (vector(accelerations), vector(multipliers));
            let found = checked(method, &found, &quote! { &TREE_PIVOT_NAMES });
            quote! {
                let found = #found?;
                ::core::result::Result::Ok((found, #multipliers))
            }
        }
        Shape::CheckedWrenches => {
            let (accelerations, rest) = values.split_at(nv);
            let found = checked(method, &vector(accelerations), &pivots);
            let wrenches = wrenches(rest);
            quote! {
                #found?;
                ::core::result::Result::Ok(#wrenches)
            }
        }
        Shape::LinkWrenches => wrenches(values),
        Shape::Spatial | Shape::Drives(_) => vector(values),
        Shape::Jacobian => matrix(nv, values),
        Shape::TreeVector | Shape::RowVector => vector(values),
        Shape::TreeMatrix => matrix(nv, values),
        Shape::RowMatrix => matrix(sizes.of_tree.unwrap_or(nv), values),
        Shape::Parts | Shape::CheckedParts => unreachable!("a scene makes its own results"),
    }
}

pub(super) fn vector(values: &[TokenStream]) -> TokenStream {
    quote! { __rt::vector([#(#values),*]) }
}

/// Returns an array of forces and moments.
fn wrenches(values: &[TokenStream]) -> TokenStream {
    let each = values.chunks(6).map(|values| {
        let (force, moment) = values.split_at(3);
        quote! {
            __rt::Wrench {
                force: __na::Vector3::new(#(#force),*),
                moment: __na::Vector3::new(#(#moment),*),
            }
        }
    });
    quote! { [#(#each),*] }
}

/// Returns a matrix with this number of columns from its entries, row by row.
fn matrix(columns: usize, values: &[TokenStream]) -> TokenStream {
    let column = |j: usize| {
        let entries = values.iter().skip(j).step_by(columns);
        quote! { [#(#entries),*] }
    };
    let columns = (0..columns).map(column);
    quote! { __rt::matrix([#(#columns),*]) }
}
