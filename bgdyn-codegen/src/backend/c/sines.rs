//! Sines and cosines in C.
//!
//! Several angles are computed together, by a loop over arrays of an even length, of which compilers make wide
//! registers: four and more angles of any kind, or else those that are no sums. A sum has two words that were just
//! computed; in a short array they would be stored in halves, and the wide load would wait for both. A single angle and a
//! sum are computed together where registers are filled otherwise.

use super::block::BlockText;
use crate::expr::{Node, NodeId, Signed};
use crate::plan::AnglePair;

/// Smallest number of angles that are computed together if there are sums among them.
const WITH_SUMS: usize = 4;

impl BlockText<'_> {
    /// Computes sines and cosines of angles; `number` tells the variables of an angle apart from those of others.
    pub(super) fn sines(&self, angles: &[AnglePair], number: &mut usize, lines: &mut Vec<String>) {
        let is_together = |pair: &&AnglePair| angles.len() >= WITH_SUMS || !self.is_sum(pair);
        let (together, alone): (Vec<_>, Vec<_>) = angles.iter().partition(is_together);
        let is_worth_it = together.len() > 1 && !self.style.libm;
        let (together, alone) = match is_worth_it {
            true => (together, alone),
            false => (Vec::new(), angles.iter().collect()),
        };
        if !together.is_empty() {
            self.sines_together(&together, number, lines);
        }
        if let [first, second] = alone[..]
            && self.is_sum(first) != self.is_sum(second)
            && self.style.has_lanes()
        {
            let (single, sum) = match self.is_sum(first) {
                true => (second, first),
                false => (first, second),
            };
            return self.sines_of_pair(single, sum, number, lines);
        }
        for pair in alone {
            *number += 1;
            let (function, arguments) = match self.is_sum(pair) {
                true => (
                    "sin_cos_sum",
                    self.sum(pair.angle, *number, lines).join(", "),
                ),
                false => ("sin_cos", self.value(Signed::plus(pair.angle))),
            };
            self.sines_alone(pair, function, &arguments, *number, lines);
        }
    }

    fn is_sum(&self, pair: &AnglePair) -> bool {
        matches!(self.listing.block.graph.node(pair.angle), Node::Angle(..))
    }

    /// Computes sines and cosines of angles together. The last angle is repeated for an even number of them.
    fn sines_together(&self, angles: &[&AnglePair], number: &mut usize, lines: &mut Vec<String>) {
        *number += 1;
        let (real, first) = (self.style.real(), *number);
        let (mut values, mut tails) = (Vec::new(), Vec::new());
        for pair in angles {
            let [value, tail] = match self.is_sum(pair) {
                true => self.sum(pair.angle, *number, lines),
                false => [self.value(Signed::plus(pair.angle)), self.style.number(0.0)],
            };
            values.push(value);
            tails.push(tail);
            *number += 1;
        }
        let length = angles.len().next_multiple_of(2);
        let array = |name: &str, mut values: Vec<String>| {
            let last = values.last().cloned().unwrap_or_default();
            values.resize(length, last);
            let values = values.join(", ");
            format!("const {real} {name}{first}[{length}] = {{{values}}};")
        };
        lines.push(array("angles", values));
        let tails = match angles.iter().any(|pair| self.is_sum(pair)) {
            true => {
                lines.push(array("tails", tails));
                format!("tails{first}")
            }
            false => "NULL".to_string(),
        };
        let (function, count) = (self.style.global("sin_cos_all"), angles.len());
        lines.extend([
            format!("{real} sines{first}[{length}];"),
            format!("{real} cosines{first}[{length}];"),
            format!("{function}({count}, angles{first}, {tails}, sines{first}, cosines{first});"),
        ]);
        self.elements(angles, first, lines);
    }

    /// Computes sines and cosines of a single angle and of a sum.
    fn sines_of_pair(
        &self,
        single: &AnglePair,
        sum: &AnglePair,
        number: &mut usize,
        lines: &mut Vec<String>,
    ) {
        *number += 1;
        let (real, first) = (self.style.real(), *number);
        let function = self.style.global("sin_cos_pair");
        let angle = self.value(Signed::plus(single.angle));
        let words = self.sum(sum.angle, first, lines).join(", ");
        lines.extend([
            format!("{real} sines{first}[2];"),
            format!("{real} cosines{first}[2];"),
            format!("{function}({angle}, {words}, sines{first}, cosines{first});"),
        ]);
        self.elements(&[single, sum], first, lines);
    }

    /// Gives elements of the arrays of this number their names.
    fn elements(&self, angles: &[&AnglePair], first: usize, lines: &mut Vec<String>) {
        let real = self.style.real();
        for (k, pair) in angles.iter().enumerate() {
            for (node, array) in [(pair.sine, "sines"), (pair.cosine, "cosines")] {
                let name = node.and_then(|id| self.listing.name(id));
                let line = |name| format!("const {real} {name} = {array}{first}[{k}];");
                lines.extend(name.map(line));
            }
        }
    }

    /// Computes sine and cosine of an angle by this function.
    fn sines_alone(
        &self,
        pair: &AnglePair,
        function: &str,
        angle: &str,
        number: usize,
        lines: &mut Vec<String>,
    ) {
        let real = self.style.real();
        let name = |id: Option<NodeId>, other: &str| match id.and_then(|id| self.listing.name(id)) {
            Some(name) => name.to_string(),
            None => format!("{other}{number}"),
        };
        let (sine, cosine) = (name(pair.sine, "sine"), name(pair.cosine, "cosine"));
        let function = self.style.global(function);
        lines.push(format!("{real} {sine};"));
        lines.push(format!("{real} {cosine};"));
        lines.push(format!("{function}({angle}, &{sine}, &{cosine});"));
    }

    /// Sums the terms of an angle, with the rounding errors. Returns the names of both words.
    fn sum(&self, angle: NodeId, number: usize, lines: &mut Vec<String>) -> [String; 2] {
        let Node::Angle(terms, offset, negative) = self.listing.block.graph.node(angle) else {
            unreachable!("the caller has seen that it is a sum");
        };
        let offset = match negative {
            true => -offset.value(),
            false => offset.value(),
        };
        let offset = self.style.two_words(offset);
        let (real, function) = (self.style.real(), self.style.global("add_angle"));
        let [high, low] = offset.map(|x| self.style.number(x));
        let mut terms = terms.iter();
        let first = match offset == [0.0, 0.0] {
            true => terms.next().map(|&e| self.value(e)),
            false => None,
        };
        let first = first.unwrap_or(high);
        lines.push(format!("{real} angle{number} = {first};"));
        lines.push(format!("{real} tail{number} = {low};"));
        for &term in terms {
            let term = self.value(term);
            lines.push(format!(
                "{function}(&angle{number}, &tail{number}, {term});"
            ));
        }
        [format!("angle{number}"), format!("tail{number}")]
    }
}
