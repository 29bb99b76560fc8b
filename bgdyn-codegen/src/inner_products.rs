//! Finds the entries of a matrix that are inner products of the vectors of two tables, which a loop can compute.
//!
//! The mass matrix of 64 links has 2,016 entries, most of them sums of six products: a vector of the
//! column times a vector of the row. Unrolled, they exceed the instruction cache.
//!
//! The search uses neither names nor physics. A candidate entry is a sum of products without other
//! readers. Two entries of a row have the row's vector in common: the nodes that both read. The other
//! factors are the column's vector. Such entries form the last block (`Block::products`), each summed in
//! the order of the vectors, so that the evaluator and the loop round in the same way. Other entries (the
//! diagonal, the first columns with their zeros) are values of the earlier blocks. Generated code fills
//! the tables and calls `inner_products` of the runtime, whose inner loop runs in the lanes of a register.
//! It executes exactly the operations that are counted.

use std::collections::VecDeque;
use std::ops::Range;

use crate::expr::{Graph, Node, NodeId, QuickMap, Signed, reads};
use crate::function::InnerProducts;

/// Smallest number of entries for which a loop saves time.
const MIN_LOOP_ENTRIES: usize = 64;

/// One product of a sum, with its sign.
#[derive(Clone, Copy)]
struct ProductTerm {
    factors: [NodeId; 2],
    negative: bool,
}

/// An entry that is a sum of products.
struct MatrixEntry {
    /// Its row and column.
    place: [usize; 2],
    /// The products in the order of summation.
    terms: Vec<ProductTerm>,
}

impl MatrixEntry {
    /// Returns the other factors of the products with those of `vector`, in its order, with their signs;
    /// `None` if a term contains none of them.
    fn with_vector(&self, vector: &[Signed]) -> Option<Vec<Signed>> {
        let other = |x: &Signed| {
            let mut with = self.terms.iter().filter(|t| t.factors.contains(&x.node));
            let term = with.next().filter(|_| with.next().is_none())?;
            let [a, b] = term.factors;
            let node = if a == x.node { b } else { a };
            Some(Signed::plus(node).flipped(term.negative ^ x.negative))
        };
        (vector.len() == self.terms.len()).then_some(())?;
        vector.iter().map(other).collect()
    }

    /// Returns one factor of each term that the other entry has too.
    fn shared(&self, other: &MatrixEntry) -> Option<Vec<Signed>> {
        let has = |x: &NodeId| other.terms.iter().any(|t| t.factors.contains(x));
        let one = |term: &ProductTerm| {
            let mut both = term.factors.into_iter().filter(has);
            both.next().filter(|_| both.next().is_none())
        };
        let terms = self.terms.iter();
        terms.map(|term| one(term).map(Signed::plus)).collect()
    }
}

/// Returns the tables of a symmetric matrix given by its lower triangle, row by row. Nothing else reads
/// the entries in them.
pub fn products(graph: &Graph, triangle: &[Signed]) -> Vec<InnerProducts> {
    let entries = entries(graph, triangle);
    let mut by_node: QuickMap<NodeId, Vec<usize>> = QuickMap::default();
    for (e, entry) in entries.iter().enumerate() {
        for node in entry.terms.iter().flat_map(|t| t.factors) {
            by_node.entry(node).or_default().push(e);
        }
    }
    let mut found = Vec::new();
    let mut tried = vec![false; entries.len()];
    for first in 0..entries.len() {
        let grown = (!tried[first]).then(|| FactorTables::grow(&entries, &by_node, first, &tried));
        let Some(tables) = grown.flatten() else {
            continue;
        };
        tables.members.iter().for_each(|(e, _)| tried[*e] = true);
        if tables.members.len() >= MIN_LOOP_ENTRIES {
            found.extend(tables.products(&entries));
        }
    }
    found
}

/// Returns the entries that are sums of two or more products without other readers.
fn entries(graph: &Graph, triangle: &[Signed]) -> Vec<MatrixEntry> {
    let reads = reads(graph, triangle);
    let places = (0..).flat_map(|row| (0..=row).map(move |column| [row, column]));
    let entry = |(&e, place): (&Signed, [usize; 2])| {
        let terms = terms(graph, &reads, e)?;
        Some(MatrixEntry { place, terms })
    };
    triangle.iter().zip(places).filter_map(entry).collect()
}

/// Returns the products of a sum in the order of addition: x₀ y₀, then fused with one after the other.
fn terms(graph: &Graph, reads: &[u32], e: Signed) -> Option<Vec<ProductTerm>> {
    let mut terms = Vec::new();
    let Signed { mut node, negative } = e;
    let mut negative = negative;
    loop {
        (reads[node.index()] == 1).then_some(())?;
        let (factors, minus, rest) = match *graph.node(node) {
            Node::MulAdd(a, b, minus, rest) => ([a, b], minus, Some(rest)),
            Node::Mul(a, b) => ([a, b], false, None),
            _ => return None,
        };
        terms.push(ProductTerm {
            factors,
            negative: negative ^ minus,
        });
        let Some(rest) = rest else { break };
        (node, negative) = (rest.node, negative ^ rest.negative);
    }
    terms.reverse();
    (terms.len() > 1).then_some(terms)
}

/// Entries that are connected by common vectors.
#[derive(Default)]
struct FactorTables {
    /// Entries with the vectors of their row and their column.
    members: Vec<(usize, [Vec<Signed>; 2])>,
    /// Every vector by its first factor, with its side: of rows (0) or of columns (1).
    known: QuickMap<NodeId, (usize, Vec<Signed>)>,
    /// Vectors whose entries are not searched yet.
    open: VecDeque<NodeId>,
}

impl FactorTables {
    /// Returns all entries connected with a given entry, without entries that were tried before. The
    /// vector of its row is the common part with another entry of that row.
    fn grow(
        entries: &[MatrixEntry],
        by_node: &QuickMap<NodeId, Vec<usize>>,
        first: usize,
        tried: &[bool],
    ) -> Option<FactorTables> {
        let start = &entries[first];
        let [a, b] = start.terms[0].factors;
        let near = by_node[&a].iter().chain(&by_node[&b]);
        let of_row = near.filter(|&&e| e != first && entries[e].place[0] == start.place[0]);
        let mut vectors = of_row.filter_map(|&e| start.shared(&entries[e]));
        let row = vectors.find(|v| start.with_vector(v).is_some())?;
        let mut tables = FactorTables::default();
        tables.meet(0, &row);
        let mut seen = tried.to_vec();
        while let Some(key) = tables.open.pop_front() {
            let (side, vector) = tables.known[&key].clone();
            for &e in &by_node[&key] {
                let other = entries[e].with_vector(&vector).filter(|_| !seen[e]);
                if let Some(other) = other.filter(|other| tables.meet(1 - side, other)) {
                    let mut both = [vector.clone(), other];
                    both.rotate_left(side);
                    tables.members.push((e, both));
                    seen[e] = true;
                }
            }
        }
        Some(tables)
    }

    /// Adds a vector of a side; returns whether it is consistent with the known vector of its first
    /// factor.
    fn meet(&mut self, side: usize, vector: &[Signed]) -> bool {
        let key = vector[0].node;
        if let Some((known_side, known)) = self.known.get(&key) {
            return *known_side == side && known == vector;
        }
        self.known.insert(key, (side, vector.to_vec()));
        self.open.push_back(key);
        true
    }

    /// Returns the products; `None` if a row or a column has several vectors.
    fn products(&self, entries: &[MatrixEntry]) -> Option<InnerProducts> {
        let mut products = InnerProducts::default();
        let mut places: Vec<[usize; 2]> = Vec::new();
        for (e, [row, column]) in &self.members {
            let [i, j] = entries[*e].place;
            places.push([j, i]);
            for (table, place, vector) in [
                (&mut products.rows, i, row),
                (&mut products.columns, j, column),
            ] {
                let known = table.entry(place).or_insert_with(|| vector.clone());
                (known == vector).then_some(())?;
            }
        }
        places.sort_unstable();
        products.runs = runs(&places);
        Some(products)
    }
}

/// Returns columns with ranges of rows, from sorted (column, row).
fn runs(places: &[[usize; 2]]) -> Vec<(usize, Range<usize>)> {
    let mut runs: Vec<(usize, Range<usize>)> = Vec::new();
    for &[column, row] in places {
        match runs.last_mut() {
            Some((of, rows)) if *of == column && rows.end == row => rows.end += 1,
            _ => runs.push((column, row..row + 1)),
        }
    }
    runs
}
