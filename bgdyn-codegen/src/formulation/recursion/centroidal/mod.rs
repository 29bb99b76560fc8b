//! The centre of mass, and the momentum about it.
//!
//! | file | computes |
//! |---|---|
//! | `masses.rs` | the centre of mass, from first moments summed from the tips |
//! | `world.rs` | vectors of the bodies' axes in the world |
//! | `map.rs` | the centroidal map and the Jacobian of the centre of mass |
//! | `momentum.rs` | the momentum and its rate, summed from the tips |
//! | `choices.rs` | the cheapest way, by counting |
//!
//! Base parameters may be used. What a body gives to its parent across a rotation is mass on the axis: with m, h = h_z ẑ
//! and D = D_zz ẑ ẑᵀ a unit rate about z has the linear momentum ẑ × h = 0 and the angular momentum (tr(D) 1 − D) ẑ = 0,
//! in all components, and the axis moves with both bodies. Across a translation D moves, which rotates with both. So the
//! total momentum is that of the true bodies; what reaches the base is at rest there, and is added to the first moment
//! alone. Only planar bodies, which give their mass at another place along the normal of the plane, would change it:
//! [`geometry_of_momenta`] has none.

mod choices;
mod map;
mod masses;
mod momentum;
mod world;

pub(super) use choices::plans;

use super::frames::Frames;
use super::geometry::{Geometry, geometry};
use super::inverse_dynamics;
use super::motion::{GravityField, motions};
use super::plan::Plan;
use crate::bond_graph::Multibody;
use crate::expr::{Builder, Expr};
use crate::method::Centroidal;
use masses::Masses;

/// Returns the bodies for the centre of mass and the momentum about it. The efforts of a body that moves in a plane and
/// along its normal do not depend on where its mass is along the normal; the centre of mass and the momentum depend on it.
pub(in crate::formulation) fn geometry_of_momenta(graph: &Multibody) -> Geometry {
    let mut made = geometry(graph);
    made.bodies.iter_mut().for_each(|body| body.planar = false);
    made
}

/// Returns the results of a centroidal method for the velocities `v`.
pub(super) fn outputs<'g>(
    b: &'g Builder,
    frames: &Frames<'g>,
    (graph, geometry, plan): (&Multibody, &Geometry, &Plan),
    of: Centroidal,
    v: &[Expr<'g>],
) -> Vec<Expr<'g>> {
    let masses = Masses::new(b, frames, (graph, geometry, plan));
    match of {
        Centroidal::Centre => masses.centre(b, frames).0.to_vec(),
        Centroidal::Jacobian => map::com_jacobian(b, frames, plan, &masses),
        Centroidal::Map => map::centroidal_map(b, frames, plan, &masses),
        Centroidal::Momentum => {
            let loads = match plan.momenta.by_bodies {
                true => momentum::of_bodies(b, frames, plan),
                false => momentum::of_composites(b, frames, v),
            };
            momentum::about_centre(b, frames, plan, (&masses, &loads))
        }
        Centroidal::Bias => {
            let moving = motions(b, frames, GravityField::Zero);
            let loads = inverse_dynamics::loads(b, frames, plan, &moving);
            momentum::about_centre(b, frames, plan, (&masses, &loads))
        }
    }
}
