//! Computes the results of a site's methods from its pose and the columns of its Jacobian.

use super::joint_motion::{along, tangents};
use crate::bond_graph::Multibody;
use crate::expr::{Builder, Expr, Tangent};
use crate::math::{Mat3, Vec3};
use crate::method::Method;

/// Velocity of a site for a unit rate of one joint, fixed axes.
#[derive(Clone, Copy)]
pub(super) struct JacobianColumn<'g> {
    /// ω, rad/s
    pub(super) angular: Vec3<Expr<'g>>,
    /// Velocity of the site's origin, m/s.
    pub(super) linear: Vec3<Expr<'g>>,
}

/// Pose of a site and its Jacobian, fixed axes.
pub(super) struct SiteMotion<'g> {
    /// Its axes.
    pub(super) rotation: Mat3<Expr<'g>>,
    /// Its origin, m.
    pub(super) origin: Vec3<Expr<'g>>,
    /// A column per coordinate; `None` if the coordinate does not move it.
    pub(super) columns: Vec<Option<JacobianColumn<'g>>>,
}

impl<'g> SiteMotion<'g> {
    /// Returns the expressions of one of a site's methods.
    pub(super) fn outputs(
        &self,
        b: &'g Builder,
        graph: &Multibody,
        method: Method,
        v: &[Expr<'g>],
    ) -> Vec<Expr<'g>> {
        match method {
            Method::Pose(_) => self
                .rotation
                .0
                .into_iter()
                .flatten()
                .chain(self.origin.0)
                .collect(),
            Method::Jacobian(_) => self.jacobian(b),
            Method::Velocity(_) => self.velocity(b, v),
            Method::JacobianDotV(_) => rates(b, graph, &self.velocity(b, v), v),
            other => unreachable!("{other:?} is no method of a site"),
        }
    }

    /// Returns Σ columns · v, angular part first.
    fn velocity(&self, b: &'g Builder, v: &[Expr<'g>]) -> Vec<Expr<'g>> {
        let (mut angular, mut linear) = (Vec3([b.zero(); 3]), Vec3([b.zero(); 3]));
        for (column, &rate) in self.columns.iter().zip(v) {
            if let Some(column) = column {
                angular = angular + column.angular.scale(rate);
                linear = linear + column.linear.scale(rate);
            }
        }
        angular.0.into_iter().chain(linear.0).collect()
    }

    fn jacobian(&self, b: &'g Builder) -> Vec<Expr<'g>> {
        let zero = Vec3([b.zero(); 3]);
        let none = JacobianColumn {
            angular: zero,
            linear: zero,
        };
        let columns: Vec<JacobianColumn<'g>> =
            self.columns.iter().map(|c| c.unwrap_or(none)).collect();
        let row = |part: fn(&JacobianColumn<'g>) -> Vec3<Expr<'g>>, i: usize| {
            columns.iter().map(move |c| part(c).0[i])
        };
        let angular = (0..3).flat_map(|i| row(|c| c.angular, i));
        let linear = (0..3).flat_map(|i| row(|c| c.linear, i));
        angular.chain(linear).collect()
    }
}

/// Returns rates of change along the motion, at constant velocities.
pub(super) fn rates<'g>(
    b: &'g Builder,
    graph: &Multibody,
    x: &[Expr<'g>],
    v: &[Expr<'g>],
) -> Vec<Expr<'g>> {
    let mut rate = Tangent::new(along(tangents(b, graph, v)));
    let x: Vec<_> = x.iter().map(|e| e.signed()).collect();
    x.into_iter()
        .map(|e| b.expr(b.with_graph(|g| rate.of(g, e))))
        .collect()
}
