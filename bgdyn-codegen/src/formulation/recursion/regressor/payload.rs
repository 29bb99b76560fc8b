//! Regressors of a payload: a body that is fixed to a frame of another one.
//!
//! With the origin p of the frame in the axes of its body, the frame's acceleration is a + U p, and a coordinate moves
//! it by w + z × p.

use super::super::inverse_dynamics::BodyWrench;
use super::super::kinematics::home;
use super::columns::{Columns, GivenMotion};
use super::directions::{BodyTwist, directions, twists};
use super::wrenches::of_parameters;
use crate::expr::Expr;
use crate::math::{Mat3, Vec3};
use crate::method::PayloadRegressor;
use bgdyn_runtime::Dd;

/// The body of a frame, and the frame's axes and origin in its axes.
type Place<'g> = (usize, Mat3<Dd>, Vec3<Expr<'g>>);

/// Returns the results of a method for payloads.
pub(super) fn outputs<'g>(
    columns: &Columns<'_, 'g>,
    of: PayloadRegressor,
) -> Option<Vec<Expr<'g>>> {
    let (body, axes, p) = place(columns, of)?;
    match of {
        PayloadRegressor::Regressor(_) => {
            let wrenches = wrenches(columns, GivenMotion::Given, (body, p));
            let directions = directions(columns.b, &columns.frames);
            let own = wrenches.map(|wrench| {
                let mut column = columns.empty();
                for direction in &directions[body] {
                    let twist = at(&direction.twist, p);
                    let entry = twist.component(&wrench) * direction.factor;
                    let sum = &mut column[direction.coordinate];
                    *sum = *sum + entry;
                }
                column
            });
            Some(columns.rows(&columns.in_axes(axes.transpose(), &own)))
        }
        PayloadRegressor::AdaptiveStep(_) => {
            let wrenches = wrenches(columns, GivenMotion::TwoVelocities, (body, p));
            let twists = twists(columns.b, &columns.frames, &columns.x.direction, |_| None);
            let twist = at(&twists[body], p);
            let own = wrenches.map(|wrench| vec![twist.component(&wrench)]);
            Some(columns.in_axes(axes.transpose(), &own).concat())
        }
    }
}

fn place<'g>(columns: &Columns<'_, 'g>, of: PayloadRegressor) -> Option<Place<'g>> {
    let site = &columns.graph.sites[of.site().0];
    let (body, (axes, origin)) = home(columns.geometry, site.link, &site.pose);
    Some((body?, axes, columns.b.vector(origin)))
}

/// Returns the wrenches of the parameters about the frame's origin, in the axes of the body.
fn wrenches<'g>(
    columns: &Columns<'_, 'g>,
    motion: GivenMotion,
    (body, p): (usize, Vec3<Expr<'g>>),
) -> [BodyWrench<'g>; 10] {
    let moving = columns.moving(motion);
    let (angular, a) = &moving[body];
    of_parameters(columns.b, angular, *a + angular.u * p)
}

/// Returns the twist of a body at another point p.
fn at<'g>(twist: &BodyTwist<'g>, p: Vec3<Expr<'g>>) -> BodyTwist<'g> {
    BodyTwist {
        angular: twist.angular,
        linear: twist.linear + twist.angular.cross(p),
    }
}
