//! The derivatives of forward dynamics, column by column: dq̈ = M⁻¹ dτ.
//!
//! Forward dynamics is differentiated along efforts dτ that are leaves of the graph, once for each pattern
//! of zeros in the columns. Columns with the same pattern form a loop ([`crate::column_loop`]) if that
//! saves time.

use std::collections::BTreeMap;

use bgdyn_runtime::Dd;

use super::differentiate::{finish, reopen};
use crate::bond_graph::Multibody;
use crate::column_loop::{self, ColumnLoop, LoopedResult, ResultSource};
use crate::expr::{Builder, Graph, Leaf, Signed, copy_into};
use crate::formulation::slopes::{along_efforts, derivatives};
use crate::function::Function;
use crate::method::Method;

/// Smallest number of columns for a loop.
const COLUMNS: usize = 4;

/// Smallest number of operations for a loop: shorter columns fit in registers and in the instruction
/// cache.
const OPERATIONS: usize = 800;

/// Forward dynamics, and the efforts −∂τ/∂x of the columns of its derivatives.
#[derive(Clone)]
pub(super) struct ForwardDerivatives {
    builder: Builder,
    accelerations: Vec<Signed>,
    /// By position, then by velocity; one effort per coordinate.
    columns: Vec<Vec<Signed>>,
    /// The number of columns by position.
    by_position: usize,
}

impl ForwardDerivatives {
    pub(super) fn new(graph: &Multibody, slopes: &Function, forward: &Function) -> Self {
        let n = graph.coordinates.len();
        // In the copy, the accelerations replace their leaves.
        let (builder, accelerations) = reopen(forward);
        let placed = |_: &mut Graph, leaf: Leaf| match leaf {
            Leaf::Acceleration(j) => Some(accelerations[j]),
            _ => None,
        };
        let results = &slopes.blocks[0].outputs;
        let slopes = builder.with_graph(|g| copy_into(g, &slopes.graph, results, placed));
        let minus = |e: Signed| (-builder.expr(e)).signed();
        let (positions, velocities) = slopes.split_at(slopes.len() - n * n);
        let by_position = positions.len() / n.max(1);
        let columns = |matrix: &[Signed], width: usize| -> Vec<Vec<Signed>> {
            let column = |j: usize| matrix.chunks(width).map(|row| minus(row[j])).collect();
            (0..width).map(column).collect()
        };
        let mut all = columns(positions, by_position);
        all.extend(columns(velocities, n));
        ForwardDerivatives {
            builder,
            accelerations,
            columns: all,
            by_position,
        }
    }

    /// Returns groups of columns with zeros in the same rows that are large enough for a loop.
    pub(super) fn alike(&self) -> Vec<Vec<usize>> {
        let mut groups: BTreeMap<Vec<bool>, Vec<usize>> = BTreeMap::new();
        for (c, column) in self.columns.iter().enumerate() {
            let zeros = column.iter().map(|&e| self.is_zero(e)).collect();
            groups.entry(zeros).or_default().push(c);
        }
        let driven = |zeros: &[bool]| zeros.iter().any(|zero| !zero);
        let groups = groups.into_iter();
        let groups = groups.filter(|(zeros, all)| driven(zeros) && all.len() >= COLUMNS);
        groups.map(|(_, all)| all).collect()
    }

    /// Returns the function, with a loop for each of these groups of columns.
    pub(super) fn function(
        self,
        graph: &Multibody,
        method: Method,
        forward: &Function,
        groups: &[Vec<usize>],
    ) -> Function {
        let n = self.accelerations.len();
        let mut stage = Stage::default();
        let by_position = self.by_position;
        let inverse_at = n + (by_position + n) * n;
        let mut parts = vec![ResultSource::Stage(0); inverse_at + n * n];
        // The index of row i of a column; columns of both matrices are numbered consecutively.
        let index = |c: usize, i: usize| match c.checked_sub(by_position) {
            None => n + i * by_position + c,
            Some(c) => n + by_position * n + i * n + c,
        };
        let mut loops = Vec::new();
        let mut looped = vec![false; self.columns.len()];
        for all in groups {
            let Some(found) = self.group(&mut stage, all) else {
                continue;
            };
            for (column, &c) in all.iter().enumerate() {
                looped[c] = true;
                for row in 0..n {
                    let group = loops.len();
                    parts[index(c, row)] = ResultSource::Column { group, column, row };
                }
            }
            loops.push(found);
        }
        for (i, &e) in self.accelerations.iter().enumerate() {
            parts[i] = ResultSource::Stage(stage.add(e));
        }
        for c in (0..self.columns.len()).filter(|&c| !looped[c]) {
            for (i, e) in self.along(&self.columns[c]).into_iter().enumerate() {
                parts[index(c, i)] = ResultSource::Stage(stage.add(e));
            }
        }
        // Of two symmetric entries of M⁻¹ use the one nearer to the base, which needs fewer operations.
        let inverse = derivatives(&self.builder, &self.accelerations, n, Leaf::Input);
        for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
            let entry = stage.add(inverse[i.max(j)][i.min(j)]);
            parts[inverse_at + i * n + j] = ResultSource::Stage(entry);
        }
        let made = |results| finish(graph, method, forward, self.builder, results);
        if loops.is_empty() {
            let in_order = |part: &ResultSource| match *part {
                ResultSource::Stage(k) => stage.results[k],
                ResultSource::Column { .. } => unreachable!("there is no loop"),
            };
            return made(parts.iter().map(in_order).collect());
        }
        let groups = loops;
        Function {
            loops: Some(LoopedResult { groups, parts }),
            ..made(stage.results)
        }
    }

    /// Returns the loop over some columns, with its arguments in `stage`; `None` if it is too short.
    fn group(&self, stage: &mut Stage, all: &[usize]) -> Option<ColumnLoop> {
        let first = &self.columns[all[0]];
        let rows: Vec<usize> = (0..first.len())
            .filter(|&i| !self.is_zero(first[i]))
            .collect();
        let block = column_loop::OWN;
        let mut drive = first.clone();
        for (index, &row) in rows.iter().enumerate() {
            let leaf = Leaf::BlockResult { block, index };
            drive[row] = self.builder.leaf(leaf).signed();
        }
        let outputs = self.along(&drive);
        let column = |g: &mut Graph| column_loop::column(g, &outputs);
        let (graph, outputs, shared) = self.builder.with_graph(column);
        let operations = crate::expr::count(&graph, &outputs).total();
        (all.len() * operations >= OPERATIONS).then_some(())?;
        // Row by row, so that the values of the columns are adjacent.
        let mut own = vec![Vec::new(); all.len()];
        for &row in &rows {
            for (own, &c) in own.iter_mut().zip(all) {
                own.push(stage.add_anew(self.columns[c][row]));
            }
        }
        Some(ColumnLoop {
            graph,
            outputs,
            shared: shared.into_iter().map(|e| stage.add(e)).collect(),
            own,
        })
    }

    /// Returns the accelerations due to given efforts.
    fn along(&self, drive: &[Signed]) -> Vec<Signed> {
        along_efforts(&self.builder, &self.accelerations, drive)
    }

    fn is_zero(&self, e: Signed) -> bool {
        self.builder.expr(e).as_constant() == Some(Dd::ZERO)
    }
}

/// The results of the straight-line code.
#[derive(Default)]
struct Stage {
    results: Vec<Signed>,
    known: BTreeMap<Signed, usize>,
}

impl Stage {
    /// Returns the index of the expression among the results; adds it if it is new.
    fn add(&mut self, e: Signed) -> usize {
        match self.known.get(&e) {
            Some(&index) => index,
            None => self.add_anew(e),
        }
    }

    /// Adds the expression as a separate result.
    fn add_anew(&mut self, e: Signed) -> usize {
        let index = self.results.len();
        self.results.push(e);
        self.known.entry(e).or_insert(index);
        index
    }
}
