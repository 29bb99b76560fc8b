//! A scene's equations with P by the literal sum of equation (6): what its functions are compared
//! with.

use super::coordinate_rows::own_inertia;
use super::dynamics::efforts;
use super::summed::summed_by;
use super::{Laws, Own, System};
use crate::expr::{Builder, Ex, Leaf};
use crate::formulation;
use crate::function::Function;
use crate::laws::copied;
use crate::method::{Method, Role};

impl System {
    /// The two sides of the equations of motion at given accelerations, and the rates of the
    /// first-order states: P_j of each coordinate, then E_j of each, then ẋ. P is the literal sum,
    /// or I_j q̈_j for a coordinate that stores its own momentum. Efforts in N·m or N.
    pub fn both_sides(&self) -> Function {
        self.one(Role::Inverse, |system, b| {
            let laws = literal_laws(system, b, Own::Inputs);
            let asked = (&system.graph, laws.asked);
            let links = copied(b, asked, Method::InverseDynamics, |_, _| None);
            let nv = system.scene.layout.nv();
            let mut sides = links;
            for j in sides.len()..nv {
                sides.push(own_inertia(&laws, j) * b.leaf(Leaf::Acceleration(j)));
            }
            sides.extend((0..nv).map(|j| laws.effort(j)));
            sides.extend(laws.rates());
            sides
        })
    }

    /// [`Role::Inverse`] with P by the literal sum.
    pub fn literal_inverse(&self) -> Function {
        self.one(Role::Inverse, |system, b| {
            let laws = literal_laws(system, b, Own::Sought);
            let nv = system.scene.layout.nv();
            let given: Vec<Ex<'_>> = (0..nv).map(|j| b.leaf(Leaf::Acceleration(j))).collect();
            efforts(system, &laws, &given)
        })
    }
}

fn literal_laws<'g, 'a>(system: &'a System, b: &'g Builder, own: Own) -> Laws<'g, 'a> {
    let literal = Some(formulation::specification());
    summed_by(b, &system.scene, &system.graph, own, literal)
}
