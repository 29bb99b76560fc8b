//! Emits the body of a method: straight-line code, or calls of its blocks.

use proc_macro2::{Literal, TokenStream};
use quote::{ToTokens, quote};

use super::code::{RESULT, Spelling};
use super::columns::columns;
use super::explain::checked;
use super::products;
use super::tokens::{argument_type, ident};
use super::writer::{Matrices, StoredResult, Writer};
use crate::expr::Leaf;
use crate::function::Function;
use crate::method::{Argument, Entries, Method, Shape};
use crate::plan::{
    BlockPlan, Destination, FunctionPlan, Listing, PlanLimits, Tail, block_name, is_part,
};

/// What the plans of Rust functions keep to: the lanes of the widest register, and results that are so small that
/// storing their entries early gains nothing.
pub const LIMITS: PlanLimits = PlanLimits {
    sines: 8,
    store_from: 16,
};

/// The body of a method, and the private functions of its blocks if it has several.
pub(super) struct FunctionBody {
    pub(super) body: TokenStream,
    pub(super) blocks: Vec<TokenStream>,
}

/// Returns the body of a method, and its blocks. `finish` builds the result from its components; for a
/// matrix, the destinations give their positions in it.
pub(super) fn body(
    function: &Function,
    spelling: &Spelling<'_>,
    destinations: Option<Vec<Vec<Destination>>>,
    finish: impl Fn(&[TokenStream]) -> TokenStream,
) -> FunctionBody {
    let plan = FunctionPlan::new(function, destinations, &LIMITS);
    match plan.blocks.as_slice() {
        [block] if function.blocks.len() == 1 => FunctionBody {
            body: whole(&plan, block, spelling, &finish),
            blocks: vec![],
        },
        _ => in_blocks(&plan, spelling, &finish),
    }
}

/// Returns the body of a function in one block.
fn whole(
    plan: &FunctionPlan<'_>,
    block: &BlockPlan<'_>,
    spelling: &Spelling<'_>,
    finish: &dyn Fn(&[TokenStream]) -> TokenStream,
) -> TokenStream {
    let (function, shape) = (plan.function, plan.function.shape());
    let listing = Listing::new(block, function, &spelling.naming, &spelling.reserved());
    let mut writer = Writer::new(&listing, spelling);
    writer.target = Some(StoredResult {
        whole: finish,
        matrices: match shape {
            Shape::SquarePair | Shape::FourSquares => Matrices::List,
            Shape::FourCubes => Matrices::Lists,
            _ => Matrices::One,
        },
    });
    let statements = writer.statements();
    // Only results that are returned unchecked are written entry by entry.
    if block.begins() {
        let result = ident(RESULT);
        return quote! { #statements #result };
    }
    let refused = shape.checked().then(|| {
        let mutable = block.refuses.then(|| quote! { mut });
        quote! { let #mutable refused = T::none_refused(); }
    });
    let (loops, results) = with_loops(plan, spelling, writer.values(&block.outputs));
    let result = finish(&results);
    quote! { #refused #statements #loops #result }
}

/// Returns the body of a function that calls its blocks, and the blocks.
fn in_blocks(
    plan: &FunctionPlan<'_>,
    spelling: &Spelling<'_>,
    finish: &dyn Fn(&[TokenStream]) -> TokenStream,
) -> FunctionBody {
    let mut blocks = Vec::new();
    let mut calls = TokenStream::new();
    for b in 0..plan.blocks.len() {
        let (block, call) = separate_block(plan, spelling, b);
        let passed = ident(&block_name(b));
        calls.extend(quote! { let #passed = #call; });
        blocks.push(block);
    }
    if let Tail::Products(products) = &plan.tail {
        let matrix = products::matrix(plan.function, products, spelling);
        let body = quote! { #calls #matrix };
        return FunctionBody { body, blocks };
    }
    let refused = plan.function.shape().checked();
    let refused = refused.then(|| quote! { let mut refused = T::none_refused(); });
    let last = ident(&block_name(plan.blocks.len() - 1));
    let element = |i: usize| {
        let i = Literal::usize_unsuffixed(i);
        quote! { #last[#i] }
    };
    let count = plan.blocks.last().map_or(0, |block| block.outputs.len());
    let results = (0..count).map(element).collect();
    let (loops, results) = with_loops(plan, spelling, results);
    let result = finish(&results);
    FunctionBody {
        body: quote! { #refused #calls #loops #result },
        blocks,
    }
}

/// Adds the loops after the blocks, and the function's results, from those of the blocks.
fn with_loops(
    plan: &FunctionPlan<'_>,
    spelling: &Spelling<'_>,
    results: Vec<TokenStream>,
) -> (TokenStream, Vec<TokenStream>) {
    match &plan.tail {
        Tail::Columns(loops) => columns(plan.function, loops, spelling, &results),
        _ => (TokenStream::new(), results),
    }
}

/// Emits a block as a private function, and the call of it.
fn separate_block(
    plan: &FunctionPlan<'_>,
    spelling: &Spelling<'_>,
    b: usize,
) -> (TokenStream, TokenStream) {
    let (function, block) = (plan.function, &plan.blocks[b]);
    let listing = Listing::new(block, function, &spelling.naming, &spelling.reserved());
    let mut writer = Writer::new(&listing, spelling);
    let array = |values: &[TokenStream]| quote! { [#(#values),*] };
    writer.separate = true;
    writer.target = Some(StoredResult {
        whole: &array,
        matrices: Matrices::One,
    });
    let statements = writer.statements();
    let result = match block.begins() {
        true => ident(RESULT).into_token_stream(),
        false => array(&writer.values(&block.outputs)),
    };
    let mut parameters = Vec::new();
    let mut arguments = Vec::new();
    for argument in arguments_read(function, &listing) {
        let (name, ty) = (ident(argument.name()), argument_type(argument));
        parameters.push(quote! { #name: #ty });
        arguments.push(quote! { #name });
    }
    for earlier in block.blocks_read() {
        let name = ident(&block_name(earlier));
        let n = plan.blocks[earlier].outputs.len();
        parameters.push(quote! { #name: &[T; #n] });
        arguments.push(quote! { &#name });
    }
    if block.refuses {
        parameters.push(quote! { refused: &mut T::Refused });
        arguments.push(quote! { &mut refused });
    }
    let name = ident(&format!("{}_block_{b}", function.name()));
    let n = block.outputs.len();
    let block = quote! {
        #[inline(never)]
        fn #name(&self, #(#parameters),*) -> [T; #n] {
            #statements
            #result
        }
    };
    (block, quote! { self.#name(#(#arguments),*) })
}

/// Returns the arguments that a block reads.
fn arguments_read(function: &Function, listing: &Listing<'_>) -> Vec<Argument> {
    let reads = &listing.block.reads;
    let is_read = |argument: &Argument| {
        let part = |leaf: &Leaf| is_part(*argument, *leaf);
        let bound = listing
            .arguments
            .iter()
            .any(|names| names.argument == *argument);
        bound || reads.iter().any(part)
    };
    let arguments = function.method.arguments().iter().copied();
    arguments.filter(is_read).collect()
}

/// The numbers of velocities of a mechanism.
#[derive(Clone, Copy)]
pub(super) struct Sizes {
    /// The independent ones.
    pub(super) nv: usize,
    /// Those of the open tree, for a mechanism with loops.
    pub(super) of_tree: Option<usize>,
    /// Whether the pivots are those of the joints and of the directions of a task.
    pub(super) of_task: bool,
}

/// Returns the result of a method from its components.
pub(super) fn result(method: Method, sizes: Sizes, values: &[TokenStream]) -> TokenStream {
    let nv = sizes.nv;
    let pivots = match sizes.of_tree {
        _ if sizes.of_task => quote! { &OPERATIONAL_PIVOT_NAMES },
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
        Shape::FourSquares => {
            let squares = squares(values, 4);
            quote! { [#(#squares),*] }
        }
        Shape::FourCubes => {
            let squares = squares(values, 4 * nv);
            let cubes = (0..4).map(|k| {
                let cube = &squares[k * nv..(k + 1) * nv];
                quote! { [#(#cube),*] }
            });
            quote! { [#(#cubes),*] }
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
        Shape::Checked(entries) => {
            let (finite, values) = values.split_at(nv);
            let found = checked(method, &vector(finite), &pivots);
            let values = entries.spread(values, nv);
            let result = match entries {
                Entries::Joints => square(&values),
                Entries::Task | Entries::TaskColumns => matrix(6, &values),
                Entries::TaskVector => vector(&values),
                Entries::VectorTriple => vectors(nv, &values),
                Entries::Symmetric(columns) | Entries::Columns(columns) => matrix(columns, &values),
                Entries::ParameterColumns(_) => matrix(values.len() / nv.max(1), &values),
            };
            quote! {
                #found?;
                ::core::result::Result::Ok(#result)
            }
        }
        Shape::VectorTriple => vectors(nv, values),
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
        Shape::Pose => pose(values),
        Shape::Poses(_) => {
            let each = values.chunks(Shape::Pose.len(nv)).map(pose);
            quote! { [#(#each),*] }
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
        Shape::Spatial | Shape::Drives(_) | Shape::Numbers(_) => vector(values),
        Shape::Jacobian => matrix(nv, values),
        Shape::Point => vector(values),
        Shape::PointJacobian | Shape::Rows(_) => matrix(nv, values),
        Shape::TreeVector | Shape::RowVector => vector(values),
        Shape::TreeMatrix => matrix(nv, values),
        Shape::RowMatrix => matrix(sizes.of_tree.unwrap_or(nv), values),
        Shape::ParameterColumns(_) => matrix(values.len() / nv.max(1), values),
        Shape::ParameterVector(_) => vector(values),
        Shape::Parts | Shape::CheckedParts => unreachable!("a scene makes its own results"),
        Shape::Bundle | Shape::CheckedBundle => unreachable!("each part has its own result"),
    }
}

pub(super) fn vector(values: &[TokenStream]) -> TokenStream {
    quote! { __rt::vector([#(#values),*]) }
}

/// Returns a pose from the entries of its rotation, row by row, and its point.
fn pose(values: &[TokenStream]) -> TokenStream {
    let (rotation, translation) = values.split_at(9);
    let rotation = matrix(3, rotation);
    quote! {
        __rt::Pose { rotation: #rotation, translation: __na::Vector3::new(#(#translation),*) }
    }
}

/// Returns an array of vectors of this length.
fn vectors(length: usize, values: &[TokenStream]) -> TokenStream {
    let each = values.chunks(length.max(1)).map(vector);
    quote! { [#(#each),*] }
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
