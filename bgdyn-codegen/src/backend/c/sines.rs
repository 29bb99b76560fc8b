//! Sines and cosines in C.
//!
//! Two and more single angles are computed together: by a loop over arrays of an even length, of which compilers make
//! wide registers. A sum of angles is computed alone: two words of it, just computed, would be stored in halves, and a
//! wide load waits for both.

use super::block::BlockText;
use crate::expr::{Node, NodeId, Signed};
use crate::plan::AnglePair;

impl BlockText<'_> {
    /// Computes sines and cosines of angles; `number` tells the variables of an angle apart from those of others.
    pub(super) fn sines(&self, angles: &[AnglePair], number: &mut usize, lines: &mut Vec<String>) {
        let is_sum =
            |pair: &AnglePair| matches!(self.listing.block.graph.node(pair.angle), Node::Angle(..));
        let (sums, single): (Vec<&AnglePair>, Vec<_>) = angles.iter().partition(|p| is_sum(p));
        if single.len() > 1 && !self.style.libm {
            *number += 1;
            self.sines_together(&single, *number, lines);
        } else {
            for pair in single {
                *number += 1;
                let angle = self.value(Signed::plus(pair.angle));
                self.sines_alone(pair, "sin_cos", &angle, *number, lines);
            }
        }
        for pair in sums {
            *number += 1;
            let angle = self.sum(pair.angle, *number, lines);
            self.sines_alone(pair, "sin_cos_sum", &angle, *number, lines);
        }
    }

    /// Computes sines and cosines of single angles together. The last angle is repeated for an even number of them.
    fn sines_together(&self, angles: &[&AnglePair], number: usize, lines: &mut Vec<String>) {
        let real = self.style.real();
        let mut values: Vec<String> = angles
            .iter()
            .map(|pair| self.value(Signed::plus(pair.angle)))
            .collect();
        if let (Some(last), 1) = (values.last().cloned(), values.len() % 2) {
            values.push(last);
        }
        let (length, all) = (values.len(), values.join(", "));
        let function = self.style.global("sin_cos_all");
        lines.extend([
            format!("const {real} angles{number}[{length}] = {{{all}}};"),
            format!("{real} sines{number}[{length}];"),
            format!("{real} cosines{number}[{length}];"),
            format!(
                "{function}({}, angles{number}, sines{number}, cosines{number});",
                angles.len()
            ),
        ]);
        for (k, pair) in angles.iter().enumerate() {
            for (node, array) in [(pair.sine, "sines"), (pair.cosine, "cosines")] {
                let name = node.and_then(|id| self.listing.name(id));
                lines.extend(
                    name.map(|name| format!("const {real} {name} = {array}{number}[{k}];")),
                );
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
    fn sum(&self, angle: NodeId, number: usize, lines: &mut Vec<String>) -> String {
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
        format!("angle{number}, tail{number}")
    }
}
