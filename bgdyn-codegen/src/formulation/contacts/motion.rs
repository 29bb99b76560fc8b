//! γ = v_a(c) − v_b(c), the velocity of the sphere's link at the contact point less that of its partner's.
//!
//! Both are computed at the centre of the sphere, and moved from there to c. Joints that carry both links move both alike,
//! and have no part in γ: the paths to both links begin behind the last link that carries both.

use std::collections::BTreeMap;

use super::frame::PairFrame;
use crate::bond_graph::Multibody;
use crate::expr::{Builder, Expr};
use crate::formulation::placement::Placement;
use crate::math::Vec3;
use crate::mechanism::joint::Column;
use crate::mechanism::{ContactPair, CoordinateId, LinkId};
use crate::method::CONTACT_DIRECTIONS;

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
        let paths = links.map(|link| path(graph, link));
        let pairs = paths[0].iter().zip(&paths[1]);
        let common = pairs.take_while(|(x, y)| x == y).count();
        PairMotion {
            b,
            graph,
            placement,
            frame,
            paths: paths.map(|path| path[common..].to_vec()),
        }
    }

    /// Returns γ along the axes of the contact.
    pub(super) fn velocity(&self, v: &[Expr<'g>]) -> Vec<Expr<'g>> {
        let [a, b] = [0, 1].map(|k| self.twist(&self.paths[k], v));
        let relative = self
            .frame
            .velocity(a.angular - b.angular, a.linear - b.linear);
        relative.to_vec()
    }

    /// Returns the velocity of the link at the end of a path, at the centre of the sphere, relative to the link before the
    /// path.
    fn twist(&self, path: &[LinkId], v: &[Expr<'g>]) -> Column<Expr<'g>> {
        let zero = Vec3([self.b.zero(); 3]);
        let (mut angular, mut linear) = (zero, zero);
        let mut at = self.frame.centre;
        for (k, &LinkId(i)) in path.iter().enumerate() {
            let own = self.placement.origins[i];
            if k > 0 {
                linear = linear + angular.cross(own - at);
            }
            let frame = &self.graph.frames[i];
            for (j, column) in self.placement.columns(self.b, i, frame) {
                angular = angular + column.angular.scale(v[j.0]);
                linear = linear + column.linear.scale(v[j.0]);
            }
            at = own;
        }
        let lever = self.frame.centre - at;
        Column {
            angular,
            linear: linear + angular.cross(lever),
        }
    }

    /// Returns the rows of J, one after the other: zero for coordinates that do not move one link relative to the other.
    pub(super) fn jacobian(&self) -> Vec<Expr<'g>> {
        let columns = self.columns();
        let n = self.graph.coordinates.len();
        let entry = |row: usize, j: usize| {
            let column = columns.get(&CoordinateId(j));
            column.map_or(self.b.zero(), |column| column[row])
        };
        let rows = 0..CONTACT_DIRECTIONS;
        rows.flat_map(|row| (0..n).map(move |j| (row, j)))
            .map(|(row, j)| entry(row, j))
            .collect()
    }

    /// Returns the columns of γ by v, along the axes of the contact. A coordinate may move a link through its own joint and
    /// through joints that follow it.
    fn columns(&self) -> BTreeMap<CoordinateId, [Expr<'g>; CONTACT_DIRECTIONS]> {
        let mut moved: BTreeMap<CoordinateId, Column<Expr<'g>>> = BTreeMap::new();
        for (path, partner) in self.paths.iter().zip([false, true]) {
            for &LinkId(i) in path {
                let lever = self.frame.centre - self.placement.origins[i];
                let frame = &self.graph.frames[i];
                for (j, column) in self.placement.columns(self.b, i, frame) {
                    let (angular, linear) =
                        (column.angular, column.linear + column.angular.cross(lever));
                    let own = match partner {
                        false => Column { angular, linear },
                        true => Column {
                            angular: -angular,
                            linear: -linear,
                        },
                    };
                    let sum = moved.get(&j).map_or(own, |sum| Column {
                        angular: sum.angular + own.angular,
                        linear: sum.linear + own.linear,
                    });
                    moved.insert(j, sum);
                }
            }
        }
        let along = |column: Column<Expr<'g>>| self.frame.velocity(column.angular, column.linear);
        moved
            .into_iter()
            .map(|(j, column)| (j, along(column)))
            .collect()
    }
}

/// Returns the links from the base to this one.
fn path(graph: &Multibody, link: Option<LinkId>) -> Vec<LinkId> {
    let parent = |link: &LinkId| graph.frames[link.0].parent;
    let mut path: Vec<LinkId> = std::iter::successors(link, parent).collect();
    path.reverse();
    path
}
