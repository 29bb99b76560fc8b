//! Assigns names to local variables: the formulation's names if it gave any, else numbers.

use std::collections::BTreeSet;

use crate::function::Function;

/// Assigns names, each once.
#[derive(Default)]
pub(super) struct Names {
    taken: BTreeSet<String>,
    numbered: usize,
}

impl Names {
    /// Returns `wanted`, with a number as a suffix if the name is in use.
    pub(super) fn named(&mut self, wanted: &str) -> String {
        let mut name = wanted.to_string();
        let mut k = 2;
        while !self.taken.insert(name.clone()) {
            name = format!("{wanted}_{k}");
            k += 1;
        }
        name
    }

    /// Reserves a name.
    pub(super) fn reserve(&mut self, name: impl Into<String>) {
        self.taken.insert(name.into());
    }

    /// Returns the next number as a name.
    pub(super) fn numbered(&mut self) -> String {
        loop {
            self.numbered += 1;
            let name = format!("x{}", self.numbered);
            if self.taken.insert(name.clone()) {
                return name;
            }
        }
    }
}

/// Returns the name of the results of a block.
pub fn block_name(block: usize) -> String {
    format!("p{block}")
}

/// The names of the arrays of a loop over columns.
#[derive(Clone, Debug)]
pub struct LoopArrays {
    /// Values that all columns read.
    pub shared: String,
    /// Values of each column, row by row.
    pub own: String,
    /// Results of each column, row by row.
    pub found: String,
}

impl LoopArrays {
    /// Returns the names of a loop's arrays.
    pub fn of(group: usize) -> Self {
        LoopArrays {
            shared: format!("shared{group}"),
            own: format!("own{group}"),
            found: format!("found{group}"),
        }
    }
}

/// Returns the names that a function's code has around that of a block: arguments, results of blocks, arrays of loops.
pub(super) fn outer_names(function: &Function) -> Vec<String> {
    let arguments = function.method.arguments().iter();
    let arguments = arguments.map(|a| a.name().to_string());
    let blocks = (0..function.blocks.len()).map(block_name);
    let of_loop = |group| {
        let LoopArrays { shared, own, found } = LoopArrays::of(group);
        [shared, own, found]
    };
    let loops = (0..function.columns().len()).flat_map(of_loop);
    arguments.chain(blocks).chain(loops).collect()
}
