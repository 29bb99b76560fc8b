//! Names of local variables: the formulation's where it gave one, else numbers.

use std::collections::BTreeSet;

use proc_macro2::{Ident, Span};

/// Hands out names, each once.
#[derive(Default)]
pub(super) struct Names {
    taken: BTreeSet<String>,
    numbered: usize,
}

impl Names {
    /// `wanted`, with a number behind it where it is taken already.
    pub(super) fn named(&mut self, wanted: &str) -> Ident {
        let mut name = wanted.to_string();
        let mut k = 2;
        while !self.taken.insert(name.clone()) {
            name = format!("{wanted}_{k}");
            k += 1;
        }
        Ident::new(&name, Span::call_site())
    }

    /// Keeps a name from being handed out.
    pub(super) fn reserve(&mut self, name: &str) {
        self.taken.insert(name.to_owned());
    }

    /// The next number.
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
