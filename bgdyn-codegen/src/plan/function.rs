//! The plan of a function: its blocks, and what follows them.

use super::block::BlockPlan;
use super::columns::ColumnPlan;
use super::destinations::{Destination, elements};
use super::inline::reads_per_output;
use super::limits::PlanLimits;
use super::products::ProductPlan;
use crate::function::{Block, Function};

/// A function in the order in which it is computed.
#[derive(Debug)]
pub struct FunctionPlan<'a> {
    /// The function.
    pub function: &'a Function,
    /// Its blocks in the order of execution. Where there are several, later blocks read the results of earlier ones.
    pub blocks: Vec<BlockPlan<'a>>,
    /// What follows the blocks.
    pub tail: Tail<'a>,
}

/// What follows the blocks of a function.
#[derive(Debug)]
pub enum Tail<'a> {
    /// The results are those of the last block.
    Nothing,
    /// Loops over columns, which read the results of the last block.
    Columns(Vec<ColumnPlan<'a>>),
    /// A matrix of inner products, which reads the results of all blocks.
    Products(Box<ProductPlan<'a>>),
}

impl<'a> FunctionPlan<'a> {
    /// Plans a function. `destinations` are the destinations of its outputs in the result, if they may be stored as
    /// soon as they are known.
    pub fn new(
        function: &'a Function,
        destinations: Option<Vec<Vec<Destination>>>,
        limits: &PlanLimits,
    ) -> Self {
        let shape = function.shape();
        let is_whole = function.blocks.len() == 1;
        let (last, others) = function.blocks.split_last().expect("a block at least");
        let has_products = !last.products.is_empty();
        let tail = match &function.loops {
            Some(loops) => {
                let groups = loops.groups.iter();
                Tail::Columns(groups.map(|g| ColumnPlan::new(g, shape, limits)).collect())
            }
            None if has_products => {
                let products = ProductPlan::new(&function.graph, last, shape, limits);
                Tail::Products(Box::new(products))
            }
            None => Tail::Nothing,
        };
        let whole = destinations.filter(|_| matches!(tail, Tail::Nothing));
        let planned = others.iter().chain((!has_products).then_some(last));
        let plan_block = |block: &Block| {
            let destinations = match is_whole {
                true => whole.clone(),
                false => Some(elements(block.outputs.len())),
            };
            let (outputs, reads) = (block.outputs.clone(), reads_per_output(shape));
            BlockPlan::new(&function.graph, outputs, destinations, reads, limits)
        };
        FunctionPlan {
            function,
            blocks: planned.map(plan_block).collect(),
            tail,
        }
    }

    /// Returns whether a pivot can be refused.
    pub fn refuses(&self) -> bool {
        self.blocks.iter().any(|block| block.refuses)
    }
}
