//! Regressors by equation (6), with the parameters of each body about the origin of its link.
//!
//! With r = o + A s for the points of a body, the double sum is P_j = ∂ȯ/∂v_j · F + ρ_j · N, where
//!
//! F = m (ö − g) + ω̇ × A h + ω × (ω × A h), N = A h × (ö − g) + J ω̇ + ω × J ω, J = A I Aᵀ.
//!
//! Both are linear in m, h, I. The column of a parameter is P_j for a one in its place.

use std::collections::BTreeMap;

use super::sum::{LiteralSum, carried_acceleration};
use crate::expr::{Expr, Tangent};
use crate::formulation::arguments::{Arguments, value};
use crate::formulation::joint_motion::{along, tangents};
use crate::math::{Mat3, Vec3};
use crate::mechanism::joint::Column;
use crate::mechanism::{LinkId, Motion, Pose};

/// The motion of a link's origin and axes, fixed axes.
struct LinkMotion<'g> {
    /// ω
    omega: Vec3<Expr<'g>>,
    /// ω̇
    turning: Vec3<Expr<'g>>,
    /// ö − g
    acceleration: Vec3<Expr<'g>>,
}

impl<'g> LiteralSum<'_, 'g> {
    /// Returns Y(q, v, a), row by row: ten columns for each body.
    pub(super) fn regressor(&self, x: &Arguments<'g>) -> Vec<Expr<'g>> {
        let bodies = self.graph.moving_links();
        let columns: Vec<Vec<Expr<'g>>> = (bodies.iter())
            .flat_map(|link| self.columns_of(*link, x))
            .collect();
        let rows = 0..self.graph.coordinates.len();
        rows.flat_map(|j| columns.iter().map(move |column| column[j]))
            .collect()
    }

    /// Returns the columns of a body, each with an effort for each coordinate.
    fn columns_of(&self, link: LinkId, x: &Arguments<'g>) -> Vec<Vec<Expr<'g>>> {
        let moduli = self.columns_to_point(link, self.origin(link));
        let motion = self.motion_of(link, &moduli, x);
        let efforts = |(force, moment): (Vec3<Expr<'g>>, Vec3<Expr<'g>>)| {
            let mut efforts = vec![self.b.zero(); self.graph.coordinates.len()];
            for (j, column) in &moduli {
                efforts[*j] = column.linear.dot(force) + column.angular.dot(moment);
            }
            efforts
        };
        let axes = self.axes(link);
        let zero = self.zero();
        let LinkMotion {
            omega,
            turning,
            acceleration,
        } = motion;
        let first = |k: usize| {
            let e = axes.column(k);
            let force = turning.cross(e) + omega.cross(omega.cross(e));
            (force, e.cross(acceleration))
        };
        let second = |(i, k): (usize, usize)| {
            let one = |row, column| match (row, column) == (i, k) || (row, column) == (k, i) {
                true => self.b.number(1.0),
                false => self.b.zero(),
            };
            let tensor = axes * Mat3::from_fn(one) * axes.transpose();
            (zero, tensor * turning + omega.cross(tensor * omega))
        };
        let entries = [(0, 0), (0, 1), (1, 1), (0, 2), (1, 2), (2, 2)];
        let wrenches = [(acceleration, zero)]
            .into_iter()
            .chain((0..3).map(first))
            .chain(entries.map(second));
        wrenches.map(efforts).collect()
    }

    /// Returns ω, ω̇ and ö − g of a link.
    fn motion_of(
        &self,
        link: LinkId,
        moduli: &BTreeMap<usize, Column<Expr<'g>>>,
        x: &Arguments<'g>,
    ) -> LinkMotion<'g> {
        let mut rate = Tangent::new(along(tangents(self.b, self.graph, &x.v)));
        let mut rate_of = |v: Vec3<Expr<'g>>| {
            v.map(|e| {
                let e = e.signed();
                self.b.expr(self.b.with_graph(|g| rate.of(g, e)))
            })
        };
        let part = |part: fn(&Column<Expr<'g>>) -> Vec3<Expr<'g>>| -> Vec<(usize, Vec3<Expr<'g>>)> {
            moduli
                .iter()
                .map(|(j, column)| (*j, part(column)))
                .collect()
        };
        let mut second = |moduli: &[(usize, Vec3<Expr<'g>>)]| {
            let rates: Vec<_> = moduli.iter().map(|(k, m)| (*k, rate_of(*m))).collect();
            self.combine(moduli, &x.a) + self.combine(&rates, &x.v)
        };
        let (linear, angular) = (part(|c| c.linear), part(|c| c.angular));
        let (acceleration, turning) = (second(&linear), second(&angular));
        let omega = self.combine(&angular, &x.v);
        match &x.base {
            None => LinkMotion {
                omega,
                turning,
                acceleration: acceleration - self.b.vector(self.graph.gravity),
            },
            Some(base) => LinkMotion {
                omega: omega + base.omega,
                turning: turning + base.omega_dot + base.omega.cross(omega),
                acceleration: carried_acceleration(
                    base,
                    self.origin(link),
                    self.combine(&linear, &x.v),
                ) + acceleration,
            },
        }
    }

    /// Returns V by the parameters of the bodies: −g · (m o + A h).
    pub(super) fn potential_energy_regressor(&self) -> Vec<Expr<'g>> {
        let down = self.b.vector(self.graph.gravity);
        let of = |link: LinkId| {
            let axes = self.axes(link);
            let tensor = [self.b.zero(); 6];
            let first = (0..3).map(move |k| -down.dot(axes.column(k)));
            [-down.dot(self.origin(link))]
                .into_iter()
                .chain(first)
                .chain(tensor)
        };
        self.graph.moving_links().into_iter().flat_map(of).collect()
    }

    /// Returns the parameters of the bodies from those of the links: of each link at its pose on the body m, m r and
    /// J + m (|r|² 1 − r rᵀ).
    pub(super) fn body_parameters(&self) -> Vec<Expr<'g>> {
        let bodies = self.graph.moving_links();
        bodies
            .into_iter()
            .flat_map(|body| self.parameters_of(body))
            .collect()
    }

    fn parameters_of(&self, body: LinkId) -> Vec<Expr<'g>> {
        let b = self.b;
        let (mut mass, mut first) = (b.zero(), self.zero());
        let mut tensor = Mat3([[b.zero(); 3]; 3]);
        for (link, pose) in self.links_of(body) {
            let inertial = self.graph.inertial(link);
            let m = value(b, inertial.mass);
            let com = inertial.com.map(|c| value(b, c));
            let r = pose.rotation.map(|x| b.constant(x)) * com + b.vector(pose.translation);
            let [xx, yy, zz, xy, xz, yz] = inertial.inertia.entries.map(|x| value(b, x));
            let about_com = Mat3([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]);
            let axes = (pose.rotation * inertial.inertia.axes).map(|x| b.constant(x));
            let square = r.dot(r);
            let shifted = Mat3::from_fn(|i, k| {
                let diagonal = if i == k { square } else { b.zero() };
                m * (diagonal - r.0[i] * r.0[k])
            });
            mass = mass + m;
            first = first + r.scale(m);
            tensor = tensor + axes * about_com * axes.transpose() + shifted;
        }
        let [[xx, xy, xz], [_, yy, yz], [_, _, zz]] = tensor.0;
        let [x, y, z] = first.0;
        vec![mass, x, y, z, xx, xy, yy, xz, yz, zz]
    }

    /// Returns a moving link and the links fixed to it, each with its pose in the axes of the first.
    fn links_of(&self, body: LinkId) -> Vec<(LinkId, Pose)> {
        let mut found = vec![(body, Pose::IDENTITY)];
        for (i, frame) in self.graph.frames.iter().enumerate().skip(body.0 + 1) {
            let on = found.iter().find(|(link, _)| frame.parent == Some(*link));
            if let (Motion::None, Some((_, pose))) = (frame.motion, on) {
                let rotation = pose.rotation * frame.origin.rotation;
                let translation = pose.translation + pose.rotation * frame.origin.translation;
                let pose = Pose {
                    rotation,
                    translation,
                };
                found.push((LinkId(i), pose));
            }
        }
        found
    }
}
