//! Random functions: every kind of node, every sign of an operand, blocks, loops over columns.

use bgdyn_codegen::column_loop::{ColumnLoop, LoopedResult, ResultSource};
use bgdyn_codegen::expr::{Builder, Expr, Graph, Leaf, Signed, fuse};
use bgdyn_codegen::function::{Block, Function};
use bgdyn_codegen::method::Method;
use bgdyn_runtime::Dd;

use super::common::rng::Rng;

/// Operations of a block.
const OPERATIONS: usize = 60;
/// Results of a block.
const RESULTS: usize = 8;

/// Returns every kind of argument.
fn arguments(b: &Builder) -> Vec<Expr<'_>> {
    let some = [
        Leaf::Position,
        Leaf::Velocity,
        Leaf::Acceleration,
        Leaf::State,
        Leaf::Input,
        Leaf::Mode,
        Leaf::Parameter,
    ];
    let leaves = some.iter().flat_map(|leaf| (0..2).map(leaf));
    leaves
        .chain([Leaf::Time])
        .map(|leaf| b.leaf(leaf))
        .collect()
}

/// Returns results of a block as arguments of a later one.
fn results_of(b: &Builder, block: usize, count: usize) -> Vec<Expr<'_>> {
    let leaf = |index| b.leaf(Leaf::BlockResult { block, index });
    (0..count).map(leaf).collect()
}

/// Adds random operations to `pool`, and returns random ones of all.
fn results<'g>(b: &'g Builder, pool: &mut Vec<Expr<'g>>, rng: &mut Rng) -> Vec<Expr<'g>> {
    for joint in 0..OPERATIONS {
        let [x, y, z, w] = std::array::from_fn(|_| signed(pool, rng));
        let made = match rng.below(22) {
            0 | 1 => x + y,
            2 | 3 => x - y,
            4 | 5 => x * y,
            6 | 7 => x * y + z,
            8 | 9 => z - x * y,
            10 => x / (y.abs() + b.number(0.5)),
            11 => (x * x).sqrt(),
            12 => b.cos_sin(&[x], Dd::ZERO).0,
            13 => b.cos_sin(&[x, y, z], Dd::from_f64(rng.within(9.0))).1,
            14 => x.tanh().exp(),
            15 => (x * x + b.number(0.1)).ln(),
            16 => x.tanh(),
            17 => x.abs() - b.number(rng.unit()),
            18 => x.min(y),
            19 => x.max(y),
            20 => x.sign() + y.if_less(x, z, w),
            _ if rng.chance(0.1) => x.pivot(y, joint),
            _ => (x.abs() + b.number(0.1)).pivot(y, joint),
        };
        pool.push(made);
    }
    (0..RESULTS).map(|_| signed(pool, rng)).collect()
}

fn signed<'g>(pool: &[Expr<'g>], rng: &mut Rng) -> Expr<'g> {
    // Later ones more often, so that functions are deep.
    let from = if rng.chance(0.5) { pool.len() / 2 } else { 0 };
    let x = pool[from + rng.below(pool.len() - from)];
    if rng.chance(0.5) { -x } else { x }
}

/// Returns expressions as outputs of a block.
pub fn outputs(exprs: &[Expr<'_>]) -> Vec<Signed> {
    exprs.iter().map(|e| e.signed()).collect()
}

/// Returns a function of these blocks.
pub fn function(graph: Graph, blocks: Vec<Vec<Signed>>, loops: Option<LoopedResult>) -> Function {
    let block = |outputs| Block {
        outputs,
        products: vec![],
    };
    Function {
        method: Method::ForwardDynamics,
        name: "random".into(),
        formulation: "random".into(),
        plans: vec![],
        rejected: vec![],
        ordered: true,
        graph,
        blocks: blocks.into_iter().map(block).collect(),
        loops,
    }
}

/// Returns a loop over three columns that reads results of a block.
fn columns(rng: &mut Rng) -> ColumnLoop {
    let b = Builder::new();
    let mut pool = results_of(&b, 0, 3);
    pool.extend(results_of(&b, 1, 4));
    let found = outputs(&results(&b, &mut pool, rng));
    let (graph, found) = fuse(&b.into_graph(), &found);
    let mut some = |count: usize| {
        (0..count)
            .map(|_| rng.below(RESULTS))
            .collect::<Vec<usize>>()
    };
    ColumnLoop {
        graph,
        outputs: found,
        shared: some(3),
        own: (0..3).map(|_| some(4)).collect(),
    }
}

/// Returns a function of two blocks and a loop over columns.
pub fn random(rng: &mut Rng) -> Function {
    let b = Builder::new();
    let mut pool = arguments(&b);
    let first = outputs(&results(&b, &mut pool, rng));
    let mut pool = results_of(&b, 0, RESULTS);
    pool.extend(arguments(&b));
    let second = outputs(&results(&b, &mut pool, rng));
    let (graph, both) = fuse(&b.into_graph(), &[first, second].concat());
    let (first, second) = both.split_at(RESULTS);
    let groups = vec![columns(rng), columns(rng)];
    let part = |k: usize| match k % 4 {
        0 => ResultSource::Stage(rng.below(RESULTS)),
        _ => ResultSource::Column {
            group: rng.below(2),
            column: rng.below(3),
            row: rng.below(RESULTS),
        },
    };
    let parts = (0..30).map(part).collect();
    let loops = Some(LoopedResult { groups, parts });
    function(graph, vec![first.to_vec(), second.to_vec()], loops)
}
