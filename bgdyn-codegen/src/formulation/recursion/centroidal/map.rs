//! The centroidal map A_g and the Jacobian of the centre of mass.
//!
//! A unit rate of a joint gives the composite body beyond it the momenta that the mass matrix is made of: h, and L about
//! the joint's origin o. About the centre of mass c of the mechanism it is L − (c − o) × h, in the axes of the joint, to
//! which c − o is carried outwards. Both are then rotated to the world.

use super::super::frames::Frames;
use super::super::mass_matrix::{Momentum, composites};
use super::super::plan::Plan;
use super::masses::Masses;
use super::world::{BodyAxes, World};
use crate::expr::{Builder, Expr};
use crate::math::Vec3;

/// Returns A_g, row by row, angular part first.
pub(super) fn centroidal_map<'g>(
    b: &'g Builder,
    frames: &Frames<'g>,
    plan: &Plan,
    masses: &Masses<'g>,
) -> Vec<Expr<'g>> {
    let centre = centre_from_bodies(b, frames, masses);
    let angular = |j: usize, axes: BodyAxes, unit: &Momentum<'g>| {
        let arm = match axes {
            BodyAxes::Basis => centre[j].0,
            BodyAxes::Own => centre[j].1,
        };
        (unit.angular - arm.cross(unit.linear)).map(|x| x * unit.effort)
    };
    let mut rows = columns(b, frames, plan, angular);
    rows.extend(columns(b, frames, plan, |_, _, unit| {
        unit.linear.map(|x| x * (unit.effort / plan.unit))
    }));
    rows
}

/// Returns ∂c/∂q, row by row: the linear part of A_g by the mass.
pub(super) fn com_jacobian<'g>(
    b: &'g Builder,
    frames: &Frames<'g>,
    plan: &Plan,
    masses: &Masses<'g>,
) -> Vec<Expr<'g>> {
    columns(b, frames, plan, |_, _, unit| {
        let scale = masses.per_mass * (unit.effort / plan.unit);
        unit.linear.map(|x| x * scale)
    })
}

/// Returns the three rows with a vector for each momentum of a body per unit rate.
fn columns<'g>(
    b: &'g Builder,
    frames: &Frames<'g>,
    plan: &Plan,
    vector: impl Fn(usize, BodyAxes, &Momentum<'g>) -> Vec3<Expr<'g>>,
) -> Vec<Expr<'g>> {
    let world = World::new(b, frames, plan.momenta.one_by_one);
    let zero = Vec3([b.zero(); 3]);
    let mut columns = vec![zero; frames.rotors.coordinates()];
    for (j, units) in composites(b, frames).iter().enumerate() {
        let frame = &frames.bodies[j];
        b.section(|| format!("{}: momentum per unit rates, in the world", frame.name));
        let axes = match frame.axial {
            true => BodyAxes::Basis,
            false => BodyAxes::Own,
        };
        let rotors = frames.rotors.on(j).map(|rotor| Momentum {
            joint: rotor.joint,
            effort: rotor.effort,
            angular: rotor.unit_momentum(),
            linear: zero,
        });
        let rotors = rotors.map(|unit| (BodyAxes::Own, unit));
        let units = units.iter().map(|unit| (axes, *unit));
        for (axes, unit) in units.chain(rotors) {
            let moved = world.of(j, axes, vector(j, axes, &unit));
            columns[unit.joint] = columns[unit.joint] + moved;
        }
    }
    let rows = 0..3;
    rows.flat_map(|i| columns.iter().map(move |column| column.0[i]))
        .collect()
}

/// Returns the centre of mass about the origin of each body, in the axes of its basis and in its own.
fn centre_from_bodies<'g>(
    b: &'g Builder,
    frames: &Frames<'g>,
    masses: &Masses<'g>,
) -> Vec<(Vec3<Expr<'g>>, Vec3<Expr<'g>>)> {
    let roots = masses.arms(b, frames);
    let mut arms: Vec<(Vec3<Expr<'g>>, Vec3<Expr<'g>>)> = Vec::new();
    for (j, frame) in frames.bodies.iter().enumerate() {
        b.section(|| format!("{}: the centre of mass from its origin", frame.name));
        let root = roots.iter().find(|arm| arm.body == j);
        let in_basis = match frame.parent {
            None => root.map_or(Vec3([b.zero(); 3]), |arm| arm.basis),
            Some(p) if frame.continues => arms[p].0 - frame.position,
            Some(p) => {
                let back = frame.twist.transpose().map(|x| b.constant(x));
                back * arms[p].1 - frame.position
            }
        };
        let in_own = root.and_then(|arm| arm.own);
        arms.push((
            in_basis,
            in_own.unwrap_or_else(|| frame.turn.apply_back(in_basis)),
        ));
    }
    arms
}
