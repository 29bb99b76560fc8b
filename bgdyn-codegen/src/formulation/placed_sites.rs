//! Poses, velocities and Jacobians of sites from the poses of the links, in fixed axes.

use crate::bond_graph::Multibody;
use crate::expr::{Builder, Expr};
use crate::formulation::arguments::Arguments;
use crate::formulation::placement::Placement;
use crate::formulation::site::{JacobianColumn, SiteMotion};
use crate::method::Method;

/// Returns the expressions of a method of a site; `None` for any other method.
pub(super) fn outputs<'g>(
    b: &'g Builder,
    graph: &Multibody,
    method: Method,
    x: &Arguments<'g>,
) -> Option<Vec<Expr<'g>>> {
    let site = &graph.sites[method.placed_site()?.0];
    let axes = site.pose.rotation.map(|x| b.constant(x));
    let point = b.vector(site.pose.translation);
    let placement = Placement::new(b, graph, &x.q);
    let mut columns: Vec<Option<JacobianColumn<'g>>> = vec![None; graph.coordinates.len()];
    let Some(link) = site.link else {
        let motion = SiteMotion {
            rotation: axes,
            origin: point,
            columns,
        };
        return Some(motion.outputs(b, graph, method, &x.v));
    };
    let rotation = placement.rotations[link.0] * axes;
    let origin = placement.point(link.0, point);
    let mut on_path = Some(link);
    while let Some(l) = on_path {
        let frame = &graph.frames[l.0];
        let lever = origin - placement.origins[l.0];
        for (j, column) in placement.columns(b, l.0, frame) {
            let own = JacobianColumn {
                angular: column.angular,
                linear: column.linear + column.angular.cross(lever),
            };
            // A coordinate moves the site through its own joint and through joints that mimic it.
            columns[j.0] = Some(match columns[j.0] {
                None => own,
                Some(other) => JacobianColumn {
                    angular: other.angular + own.angular,
                    linear: other.linear + own.linear,
                },
            });
        }
        on_path = frame.parent;
    }
    let motion = SiteMotion {
        rotation,
        origin,
        columns,
    };
    Some(motion.outputs(b, graph, method, &x.v))
}
