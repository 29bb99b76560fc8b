//! Assigns names to local variables: the formulation's names if it gave any, else numbers.

use std::collections::BTreeSet;

use proc_macro2::{Ident, Span};
use quote::format_ident;

use crate::function::Function;

/// Assigns names, each once.
#[derive(Default)]
pub(super) struct Names {
    taken: BTreeSet<String>,
    numbered: usize,
}

impl Names {
    /// Returns `wanted`, with a number as a suffix if the name is in use.
    pub(super) fn named(&mut self, wanted: &str) -> Ident {
        let mut name = wanted.to_string();
        let mut k = 2;
        while !self.taken.insert(name.clone()) {
            name = format!("{wanted}_{k}");
            k += 1;
        }
        Ident::new(&name, Span::call_site())
    }

    /// Reserves a name.
    pub(super) fn reserve(&mut self, name: &str) {
        self.taken.insert(name.to_owned());
    }

    /// Returns the next number as a name.
    pub(super) fn numbered(&mut self) -> Ident {
        loop {
            self.numbered += 1;
            let name = format!("x{}", self.numbered);
            if self.taken.insert(name.clone()) {
                return Ident::new(&name, Span::call_site());
            }
        }
    }
}

/// The names of the arrays of a loop.
pub(super) struct LoopArrays {
    pub(super) shared: Ident,
    pub(super) own: Ident,
    pub(super) found: Ident,
}

impl LoopArrays {
    pub(super) fn of(group: usize) -> Self {
        LoopArrays {
            shared: format_ident!("shared{group}"),
            own: format_ident!("own{group}"),
            found: format_ident!("found{group}"),
        }
    }
}

/// Returns the names that loops use in the code around them.
pub(super) fn loop_names(function: &Function) -> Vec<String> {
    let groups = 0..function.columns().len();
    let of = |group| {
        let LoopArrays { shared, own, found } = LoopArrays::of(group);
        [shared, own, found].map(|name| name.to_string())
    };
    groups.flat_map(of).collect()
}
