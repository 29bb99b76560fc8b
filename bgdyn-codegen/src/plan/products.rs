//! A symmetric matrix whose entries are mainly inner products of the vectors of two tables.
//!
//! The tables contain results of earlier blocks, the vectors of rows component by component. So a loop over the rows
//! of a column runs in the lanes of a register.

use std::collections::BTreeSet;

use super::block::BlockPlan;
use super::inline::reads_per_output;
use super::limits::PlanLimits;
use crate::expr::{Graph, Signed};
use crate::function::{Block, InnerProducts, in_triangle};
use crate::method::Shape;

/// The last block of a function whose result is a matrix of inner products.
#[derive(Debug)]
pub struct ProductPlan<'a> {
    /// The entries that are no inner products: row and column, the row not above the column's.
    pub alone: Vec<(usize, usize)>,
    /// The plan of the entries `alone`, which are its first outputs, and of the vectors.
    pub block: BlockPlan<'a>,
    /// The tables.
    pub tables: Vec<ProductTable>,
}

/// Two tables of vectors, and the entries that are inner products of them.
#[derive(Debug)]
pub struct ProductTable {
    /// The vectors of the rows: of each component, the values of rows 0, 1, …; `None` for a row without a vector.
    pub components: Vec<Vec<Option<Signed>>>,
    /// The vector of the column of each run.
    pub columns: Vec<Vec<Signed>>,
    /// The runs: a column, its first row, and the row after its last one.
    pub runs: Vec<[usize; 3]>,
}

impl<'a> ProductPlan<'a> {
    pub(super) fn new(graph: &'a Graph, block: &Block, shape: Shape, limits: &PlanLimits) -> Self {
        let products = &block.products;
        let looped: BTreeSet<(usize, usize)> =
            products.iter().flat_map(InnerProducts::entries).collect();
        let triangle = (0..).flat_map(|row| (0..=row).map(move |column| (row, column)));
        let alone = triangle.take(block.outputs.len());
        let alone: Vec<(usize, usize)> = alone.filter(|entry| !looped.contains(entry)).collect();
        let entry = |&(row, column): &(usize, usize)| block.outputs[in_triangle(row, column)];
        let vectors = products
            .iter()
            .flat_map(|p| p.rows.values().chain(p.columns.values()));
        let vectors = vectors.flatten().copied();
        let outputs: Vec<Signed> = alone.iter().map(entry).chain(vectors).collect();
        let reads = reads_per_output(shape);
        ProductPlan {
            block: BlockPlan::new(graph, outputs, None, reads, limits),
            alone,
            tables: products.iter().map(table).collect(),
        }
    }

    /// Returns the entries that are no inner products, with their values.
    pub fn entries(&self) -> impl Iterator<Item = ((usize, usize), Signed)> {
        self.alone
            .iter()
            .copied()
            .zip(self.block.outputs.iter().copied())
    }
}

fn table(products: &InnerProducts) -> ProductTable {
    let terms = products.rows.values().next().map_or(0, Vec::len);
    let last = products.rows.keys().next_back().copied().unwrap_or(0);
    let component = |i: usize| {
        let value = |row: usize| products.rows.get(&row).map(|vector| vector[i]);
        (0..=last).map(value).collect()
    };
    let runs = products.runs.iter();
    ProductTable {
        components: (0..terms).map(component).collect(),
        columns: runs
            .clone()
            .map(|(c, _)| products.columns[c].clone())
            .collect(),
        runs: runs
            .map(|(column, rows)| [*column, rows.start, rows.end])
            .collect(),
    }
}
