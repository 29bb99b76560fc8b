//! A scene's equations with P by the literal sum of equation (6), the reference for its functions.

use super::coordinate_rows::own_inertia;
use super::dynamics::efforts;
use super::summed::summed_by;
use super::{ActuatorEfforts, EffortSums, SceneEquations};
use crate::expr::{Builder, Expr, Leaf};
use crate::formulation;
use crate::function::Function;
use crate::method::{Method, SceneFunction};

impl SceneEquations {
    /// Returns the two sides of the equations of motion at given accelerations, and the rates of the
    /// first-order states: P_j of each coordinate, then E_j of each, then ẋ. P is the literal sum, or I_j
    /// q̈_j for a coordinate with a store of its own. Efforts in N·m or N.
    pub fn both_sides(&self) -> Function {
        self.one(SceneFunction::Inverse, |system, b| {
            let sums = literal_laws(system, b, ActuatorEfforts::FromInputs);
            let asked = (&system.graph, sums.asked);
            let links = sums.copied(asked, Method::InverseDynamics, |_, _| None);
            let nv = system.scene.layout.nv();
            let mut sides = links;
            for j in sides.len()..nv {
                sides.push(own_inertia(&sums, j) * b.leaf(Leaf::Acceleration(j)));
            }
            sides.extend((0..nv).map(|j| sums.effort(j)));
            sides.extend(sums.rates());
            sides
        })
    }

    /// Returns [`SceneFunction::Inverse`] with P by the literal sum.
    pub fn literal_inverse(&self) -> Function {
        self.one(SceneFunction::Inverse, |system, b| {
            let sums = literal_laws(system, b, ActuatorEfforts::Unknown);
            let nv = system.scene.layout.nv();
            let given: Vec<Expr<'_>> = (0..nv).map(|j| b.leaf(Leaf::Acceleration(j))).collect();
            efforts(system, &sums, &given)
        })
    }
}

fn literal_laws<'g, 'a>(
    system: &'a SceneEquations,
    b: &'g Builder,
    own: ActuatorEfforts,
) -> EffortSums<'g, 'a> {
    let literal = Some(formulation::specification());
    summed_by(b, &system.scene, &system.graph, own, literal)
}
