//! A priority queue of common products and two-term sums, ordered by an upper bound of the saving.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use bgdyn_runtime::Dd;

use super::divisor::{DivisorKey, number_key};
use super::network::Var;
use crate::expr::index::{Index, mix};

/// A divisor, with the variables whose sums may contain it.
struct Divisor {
    key: DivisorKey,
    occurrences: Vec<Var>,
    /// Upper bound of the saving.
    bound: isize,
}

/// All divisors. In keys, products of variables and numbers are replaced by their ids.
#[derive(Default)]
pub(super) struct Divisors {
    all: Vec<Divisor>,
    /// The divisors by their key.
    by_key: Index,
    queue: BinaryHeap<(isize, Reverse<usize>)>,
    products: Vec<Vec<Var>>,
    product_ids: Index,
    numbers: Vec<Dd>,
    number_ids: Index,
}

impl Divisors {
    /// Removes the divisor with the largest bound, and returns it with its id and bound.
    pub fn pop(&mut self) -> Option<(usize, DivisorKey, isize)> {
        while let Some((bound, Reverse(id))) = self.queue.pop() {
            if bound == self.all[id].bound {
                return Some((id, self.all[id].key, bound));
            }
        }
        None
    }

    /// Reinserts a divisor with its actual saving.
    pub fn put_back(&mut self, id: usize, saved: isize) {
        self.all[id].bound = saved;
        if saved > 0 {
            self.queue.push((saved, Reverse(id)));
        }
    }

    /// Records that a variable's sum may contain it, the saving, and the cost of defining it.
    pub fn note(&mut self, key: DivisorKey, var: Var, saved: isize, cost: isize) {
        let hash = key.quick_hash();
        let is_it = |id: u32| self.all[id as usize].key == key;
        let id = match self.by_key.find(hash, is_it) {
            Some(id) => id as usize,
            None => {
                let id = self.all.len();
                self.by_key.insert(hash, id as u32);
                self.all.push(Divisor {
                    key,
                    occurrences: Vec::new(),
                    bound: cost,
                });
                id
            }
        };
        let divisor = &mut self.all[id];
        if divisor.bound < cost {
            divisor.bound = cost;
        }
        divisor.bound += saved;
        if divisor.occurrences.last() != Some(&var) {
            divisor.occurrences.push(var);
        }
        if divisor.bound > 0 {
            self.queue.push((divisor.bound, Reverse(id)));
        }
    }

    /// Returns the variables whose sums may contain it, each once, in order.
    pub fn occurrences(&mut self, id: usize) -> Vec<Var> {
        let occurrences = &mut self.all[id].occurrences;
        occurrences.sort_unstable();
        occurrences.dedup();
        occurrences.clone()
    }

    /// Returns the id of a number.
    pub fn number_id(&mut self, k: Dd) -> u32 {
        let key = number_key(k);
        let hash = mix(mix(0, key.0), key.1 as u64);
        let is_it = |id: u32| number_key(self.numbers[id as usize]) == key;
        if let Some(id) = self.number_ids.find(hash, is_it) {
            return id;
        }
        let id = self.numbers.len() as u32;
        self.numbers.push(k);
        self.number_ids.insert(hash, id);
        id
    }

    /// Returns the number with this id.
    pub fn number(&self, id: u32) -> Dd {
        self.numbers[id as usize]
    }

    /// Returns the id of a product of variables.
    pub fn product_id(&mut self, factors: &[Var]) -> u32 {
        let hash = factors.iter().fold(1, |h, &f| mix(h, u64::from(f)));
        let is_it = |id: u32| self.products[id as usize] == factors;
        if let Some(id) = self.product_ids.find(hash, is_it) {
            return id;
        }
        let id = self.products.len() as u32;
        self.products.push(factors.to_vec());
        self.product_ids.insert(hash, id);
        id
    }

    /// Returns the factors of the product with this id.
    pub fn product(&self, id: u32) -> &[Var] {
        &self.products[id as usize]
    }
}
