//! γ = v_a(c) − v_b(c), the velocity of the sphere's link at the contact point less that of its partner's.
//!
//! Joints that carry both links move both alike, and have no part in γ: the paths of both links begin at the last link that
//! carries both.

use std::collections::BTreeMap;

use super::frame::PairFrame;
use crate::bond_graph::Multibody;
use crate::expr::{Builder, Expr};
use crate::formulation::placement::Placement;
use crate::math::Vec3;
use crate::mechanism::{ContactPair, CoordinateId, LinkId};

/// The relative motion of a pair.
pub(super) struct PairMotion<'a, 'g> {
    b: &'g Builder,
    graph: &'a Multibody,
    placement: &'a Placement<'g>,
    frame: PairFrame<'g>,
    /// The links from the last one that carries both, without it, to the sphere's link and to its partner's.
    paths: [Vec<LinkId>; 2],
}

impl<'a, 'g> PairMotion<'a, 'g> {
    /// Returns the motion of a pair that touches at this frame.
    pub(super) fn new(
        b: &'g Builder,
        graph: &'a Multibody,
        placement: &'a Placement<'g>,
        (pair, frame): (&ContactPair, PairFrame<'g>),
    ) -> Self {
        let links = [pair.sphere.link, pair.partner.link()];
        let [a, b_links] = links.map(|link| path(graph, link));
        let pairs = a.iter().zip(&b_links);
        let common = pairs.take_while(|(x, y)| x == y).count();
        PairMotion {
            b,
            graph,
            placement,
            frame,
            paths: [a, b_links].map(|path| path[common..].to_vec()),
        }
    }

    /// Returns γ along the axes of the contact.
    pub(super) fn velocity(&self, v: &[Expr<'g>]) -> Vec<Expr<'g>> {
        let [a, b] = [0, 1].map(|k| self.velocity_of(&self.paths[k], v));
        self.frame.axes.map(|axis| axis.dot(a - b)).to_vec()
    }

    /// Returns the velocity at the contact point of the link at the end of a path, relative to the link before it.
    fn velocity_of(&self, path: &[LinkId], v: &[Expr<'g>]) -> Vec3<Expr<'g>> {
        let zero = Vec3([self.b.zero(); 3]);
        let (mut angular, mut linear) = (zero, zero);
        let mut origin = None;
        for &LinkId(i) in path {
            let own = self.placement.origins[i];
            if let Some(before) = origin {
                linear = linear + angular.cross(own - before);
            }
            let frame = &self.graph.frames[i];
            for (j, column) in self.placement.columns(self.b, i, frame) {
                angular = angular + column.angular.scale(v[j.0]);
                linear = linear + column.linear.scale(v[j.0]);
            }
            origin = Some(own);
        }
        let lever = origin.map(|origin| self.frame.point - origin);
        lever.map_or(linear, |lever| linear + angular.cross(lever))
    }

    /// Returns the rows of J, one after the other: zero for coordinates that do not move one link relative to the other.
    pub(super) fn jacobian(&self) -> Vec<Expr<'g>> {
        let columns = self.columns();
        let n = self.graph.coordinates.len();
        let entry = |axis: Vec3<Expr<'g>>, j: usize| {
            let column = columns.get(&CoordinateId(j));
            column.map_or(self.b.zero(), |column| axis.dot(*column))
        };
        let rows = self.frame.axes.into_iter();
        rows.flat_map(|axis| (0..n).map(move |j| (axis, j)))
            .map(|(axis, j)| entry(axis, j))
            .collect()
    }

    /// Returns the columns of γ by v, fixed axes. A coordinate may move a link through its own joint and through joints that
    /// follow it.
    fn columns(&self) -> BTreeMap<CoordinateId, Vec3<Expr<'g>>> {
        let mut columns: BTreeMap<CoordinateId, Vec3<Expr<'g>>> = BTreeMap::new();
        for (path, partner) in self.paths.iter().zip([false, true]) {
            for &LinkId(i) in path {
                let lever = self.frame.point - self.placement.origins[i];
                let frame = &self.graph.frames[i];
                for (j, column) in self.placement.columns(self.b, i, frame) {
                    let moved = column.linear + column.angular.cross(lever);
                    let moved = if partner { -moved } else { moved };
                    let sum = columns.entry(j);
                    sum.and_modify(|sum| *sum = *sum + moved).or_insert(moved);
                }
            }
        }
        columns
    }
}

/// Returns the links from the base to this one.
fn path(graph: &Multibody, link: Option<LinkId>) -> Vec<LinkId> {
    let parent = |link: &LinkId| graph.frames[link.0].parent;
    let mut path: Vec<LinkId> = std::iter::successors(link, parent).collect();
    path.reverse();
    path
}
