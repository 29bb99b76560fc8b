//! The columns of regressors: z · N + w · F for each coordinate that moves a body and each parameter of the body.

use bgdyn_runtime::Dd;

use super::super::frames::{BodyFrame, Frames};
use super::super::geometry::Geometry;
use super::super::inverse_dynamics::BodyWrench;
use super::super::motion::{GravityField, motions};
use super::super::plan::Plan;
use super::base_parameter::{BaseParameter, bodies};
use super::directions::{BodyTwist, CoordinateDirection, directions, twists};
use super::two_velocities;
use super::wrenches::{Angular, ENTRIES, kinetic_energies, of_entries, of_parameters};
use crate::bond_graph::Multibody;
use crate::expr::{Builder, Expr};
use crate::formulation::arguments::Arguments;
use crate::math::{Mat3, Vec3};
use crate::method::{Method, PARAMETERS_PER_BODY};

/// What moves the bodies.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum GivenMotion {
    /// v and a.
    Given,
    /// v, v_r and a_r.
    TwoVelocities,
    /// v, whose momenta are wanted.
    Momentum,
}

/// The expressions that regressors are made of.
pub(super) struct Columns<'a, 'g> {
    pub(super) b: &'g Builder,
    pub(super) graph: &'a Multibody,
    pub(super) geometry: &'a Geometry,
    pub(super) frames: Frames<'g>,
    pub(super) x: Arguments<'g>,
}

impl<'a, 'g> Columns<'a, 'g> {
    pub(super) fn new(
        b: &'g Builder,
        graph: &'a Multibody,
        geometry: &'a Geometry,
        plan: &Plan,
        method: Method,
    ) -> Self {
        let x = Arguments::new(b, graph, method);
        Columns {
            b,
            graph,
            geometry,
            frames: Frames::new(b, graph, geometry, plan, &x),
            x,
        }
    }

    /// Returns the motion of each body: what wrenches depend on, and the acceleration (velocity) of its origin.
    pub(super) fn moving(&self, motion: GivenMotion) -> Vec<(Angular<'g>, Vec3<Expr<'g>>)> {
        let (b, frames, x) = (self.b, &self.frames, &self.x);
        match motion {
            GivenMotion::Given => {
                let moving = motions(b, frames, GravityField::Gravity).into_iter();
                moving
                    .map(|body| (Angular::from(&body.own), body.a_own))
                    .collect()
            }
            GivenMotion::Momentum => {
                let twists = self.velocities(&x.v).into_iter();
                let momentum = |twist: BodyTwist<'g>| Angular::of_momentum(b, twist.angular);
                twists
                    .map(|twist| (momentum(twist), twist.linear))
                    .collect()
            }
            GivenMotion::TwoVelocities => {
                let rates = [&x.v[..], &x.reference_v[..]];
                let [first, second] = rates.map(|rates| self.velocities(rates));
                let moving = two_velocities::motions(b, frames, [&first, &second], rates, &x.a);
                let moving = moving.into_iter();
                moving.map(|body| (body.angular, body.a)).collect()
            }
        }
    }

    /// Returns the velocities of the bodies for these rates, and that of a base that is given.
    fn velocities(&self, rates: &[Expr<'g>]) -> Vec<BodyTwist<'g>> {
        let base = |frame: &BodyFrame<'g>| match (frame.given, &frame.relative) {
            (true, Some([velocity, _])) => Some(velocity.into()),
            _ => None,
        };
        twists(self.b, &self.frames, rates, base)
    }

    /// Returns the wrenches of the entries of each body's inertia.
    fn wrenches(&self, motion: GivenMotion) -> Vec<[BodyWrench<'g>; ENTRIES]> {
        let moving = self.moving(motion).into_iter();
        moving
            .map(|(angular, a)| of_entries(self.b, &angular, a))
            .collect()
    }

    /// Returns the matrix of these base parameters, row by row.
    pub(super) fn matrix(
        &self,
        motion: GivenMotion,
        parameters: &[BaseParameter],
    ) -> Vec<Expr<'g>> {
        let wrenches = self.wrenches(motion);
        let directions = directions(self.b, &self.frames);
        self.b.section(|| "columns of the base parameters".into());
        let columns: Vec<Vec<Expr<'g>>> = (parameters.iter())
            .map(|parameter| {
                let mut column = self.empty();
                for entry in &parameter.entries {
                    let wrench = &wrenches[entry.body][entry.index];
                    self.add(&mut column, &directions[entry.body], wrench);
                }
                match parameter.negative {
                    true => column.into_iter().map(|x| -x).collect(),
                    false => column,
                }
            })
            .collect();
        self.rows(&columns)
    }

    /// Returns the product of the transposed matrix and a number for each velocity.
    pub(super) fn transposed_times(
        &self,
        motion: GivenMotion,
        parameters: &[BaseParameter],
    ) -> Vec<Expr<'g>> {
        let wrenches = self.wrenches(motion);
        let twists = twists(self.b, &self.frames, &self.x.direction, |_| None);
        let entry = |body: usize, index: usize| twists[body].component(&wrenches[body][index]);
        let products = parameters.iter().map(|parameter| {
            let entries = parameter.entries.iter();
            let sum = entries.fold(self.b.zero(), |sum, e| sum + entry(e.body, e.index));
            if parameter.negative { -sum } else { sum }
        });
        products.collect()
    }

    /// Returns the matrix of all parameters of the bodies, row by row.
    pub(super) fn whole(&self, motion: GivenMotion) -> Vec<Expr<'g>> {
        let moving = self.moving(motion);
        let directions = directions(self.b, &self.frames);
        self.b.section(|| "columns of the parameters".into());
        let mut columns = Vec::new();
        for body in bodies(self.graph, self.geometry) {
            let (angular, a) = &moving[body];
            let own = of_parameters(self.b, angular, *a).map(|wrench| {
                let mut column = self.empty();
                self.add(&mut column, &directions[body], &wrench);
                column
            });
            let turned = self.in_link_axes(body, &own);
            columns.extend(turned);
        }
        self.rows(&columns)
    }

    /// Returns the kinetic energies of ones in the places of the parameters.
    pub(super) fn kinetic_energies(&self) -> Vec<Expr<'g>> {
        let twists = self.velocities(&self.x.v);
        let of = |body: usize| {
            let own = kinetic_energies(&twists[body]).map(|energy| vec![energy]);
            self.in_link_axes(body, &own)
        };
        let bodies = bodies(self.graph, self.geometry).into_iter();
        bodies.flat_map(of).flatten().collect()
    }

    /// Returns the columns of the parameters in the axes of the link from those in the axes of the body, which has the
    /// same origin.
    pub(super) fn in_link_axes(
        &self,
        body: usize,
        own: &[Vec<Expr<'g>>; 10],
    ) -> Vec<Vec<Expr<'g>>> {
        self.in_axes(self.geometry.bodies[body].axes, own)
    }

    /// Returns the columns of the parameters in other axes of the same origin, in which the axes of the body are `axes`:
    /// h and I turn.
    pub(super) fn in_axes(&self, axes: Mat3<Dd>, own: &[Vec<Expr<'g>>; 10]) -> Vec<Vec<Expr<'g>>> {
        /// Index of entry (i, k) of I among the parameters.
        const TENSOR: [[usize; 3]; 3] = [[4, 5, 7], [5, 6, 8], [7, 8, 9]];
        let turn = axes.map(|x| self.b.constant(x));
        let sum = |parts: Vec<(Expr<'g>, usize)>| -> Vec<Expr<'g>> {
            let row = |j: usize| {
                let parts = parts.iter();
                parts.fold(self.b.zero(), |sum, (k, p)| sum + *k * own[*p][j])
            };
            (0..own[0].len()).map(row).collect()
        };
        let mut columns = vec![own[0].clone()];
        for i in 0..3 {
            columns.push(sum((0..3).map(|k| (turn.0[i][k], 1 + k)).collect()));
        }
        // Entry (i, k) of I is a symmetric pair; in the body's axes it is Tᵀ E T.
        for (i, k) in [(0, 0), (0, 1), (1, 1), (0, 2), (1, 2), (2, 2)] {
            let both = i != k;
            let mut parts = Vec::new();
            for (m, n) in [(0, 0), (0, 1), (1, 1), (0, 2), (1, 2), (2, 2)] {
                let straight = turn.0[i][m] * turn.0[k][n];
                let factor = match both {
                    true => straight + turn.0[k][m] * turn.0[i][n],
                    false => straight,
                };
                parts.push((factor, TENSOR[m][n]));
            }
            columns.push(sum(parts));
        }
        debug_assert_eq!(columns.len(), PARAMETERS_PER_BODY);
        columns
    }

    pub(super) fn empty(&self) -> Vec<Expr<'g>> {
        vec![self.b.zero(); self.graph.coordinates.len()]
    }

    pub(super) fn add(
        &self,
        column: &mut [Expr<'g>],
        directions: &[CoordinateDirection<'g>],
        wrench: &BodyWrench<'g>,
    ) {
        for direction in directions {
            let entry = direction.twist.component(wrench) * direction.factor;
            let sum = &mut column[direction.coordinate];
            *sum = *sum + entry;
        }
    }

    pub(super) fn rows(&self, columns: &[Vec<Expr<'g>>]) -> Vec<Expr<'g>> {
        let rows = 0..self.graph.coordinates.len();
        rows.flat_map(|j| columns.iter().map(move |column| column[j]))
            .collect()
    }
}
