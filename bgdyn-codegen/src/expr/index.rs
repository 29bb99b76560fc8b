//! A hash table of interned values.
//!
//! The owner stores the values in a list, in the order of insertion; the table stores their indices.
//!
//! Most of the generator's time is spent on looking up nodes, and Cargo builds macros for development
//! without optimisation: there this simple table takes a tenth of the time of the standard library's.

use std::collections::HashMap;
use std::hash::{BuildHasherDefault, Hasher};

/// Open addressing with a power of two of slots.
#[derive(Clone, Debug, Default)]
pub(super) struct Index {
    /// The upper half of the hash, and the index plus 1 in the lower half; 0 is free.
    slots: Vec<u64>,
    len: usize,
}

impl Index {
    /// Returns the index of the value with this hash for which `is_sought` is true.
    pub fn find(&self, hash: u64, mut is_sought: impl FnMut(u32) -> bool) -> Option<u32> {
        if self.slots.is_empty() {
            return None;
        }
        let tag = hash >> 32;
        let mut at = self.home(tag);
        loop {
            let slot = self.slots[at];
            if slot == 0 {
                return None;
            }
            let index = slot as u32;
            if slot >> 32 == tag && is_sought(index - 1) {
                return Some(index - 1);
            }
            at = (at + 1) & (self.slots.len() - 1);
        }
    }

    /// Adds a value that is not in the table.
    pub fn insert(&mut self, hash: u64, index: u32) {
        self.len += 1;
        if self.len * 3 > self.slots.len() * 2 {
            let size = (4 * self.slots.len()).max(256);
            let before = std::mem::replace(&mut self.slots, vec![0; size]);
            for slot in before {
                if slot != 0 {
                    self.put(slot);
                }
            }
        }
        let hash = hash & !u64::from(u32::MAX);
        self.put(hash | (u64::from(index) + 1));
    }

    fn put(&mut self, slot: u64) {
        let mut at = self.home(slot >> 32);
        while self.slots[at] != 0 {
            at = (at + 1) & (self.slots.len() - 1);
        }
        self.slots[at] = slot;
    }

    fn home(&self, tag: u64) -> usize {
        tag as usize & (self.slots.len() - 1)
    }
}

/// Mixes one more word into a hash: rotate, multiply. Its upper half has the better distribution.
pub(super) fn mix(hash: u64, word: u64) -> u64 {
    (hash.rotate_left(26) ^ word).wrapping_mul(0x9e37_79b9_7f4a_7c15)
}

/// A fast hash for small keys: multiply and rotate. Its order has no effect on results.
#[derive(Clone, Default, Debug)]
pub(crate) struct QuickHasher(u64);

impl Hasher for QuickHasher {
    fn write(&mut self, bytes: &[u8]) {
        for &b in bytes {
            self.write_u64(u64::from(b));
        }
    }
    fn write_u8(&mut self, x: u8) {
        self.write_u64(u64::from(x));
    }
    fn write_u32(&mut self, x: u32) {
        self.write_u64(u64::from(x));
    }
    fn write_u64(&mut self, x: u64) {
        self.0 = mix(self.0, x);
    }
    fn write_usize(&mut self, x: usize) {
        self.write_u64(x as u64);
    }
    fn write_isize(&mut self, x: isize) {
        self.write_u64(x as u64);
    }
    fn finish(&self) -> u64 {
        self.0 ^ (self.0 >> 32)
    }
}

pub(crate) type QuickMap<K, V> = HashMap<K, V, BuildHasherDefault<QuickHasher>>;
