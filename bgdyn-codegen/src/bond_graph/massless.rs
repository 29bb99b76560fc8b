//! Finds the velocities without an inertial store.

use bgdyn_runtime::Dd;

use super::{BondGraph, JunctionId, LinkFrame, StoreInertia};
use crate::math::Vec3;
use crate::mechanism::{CoordinateId, Value};

const ZERO: Value = Value::Fixed(Dd::ZERO);

impl BondGraph {
    /// Returns the coordinates for which M has a row of zeros, at any position and for any run-time
    /// parameters: no link gives them inertia.
    pub fn without_inertia(&self) -> Vec<CoordinateId> {
        let mut stores = vec![None; self.junctions.len()];
        for store in &self.stores {
            stores[store.junction.0] = Some(&store.inertia);
        }
        let mut moved = vec![false; self.coordinates.len()];
        for transformer in &self.transformers {
            // The first junctions are those of velocities.
            let (from, to) = (transformer.from.0, transformer.to);
            if !moved[from] {
                moved[from] =
                    stores[to.0].is_some_and(|inertia| self.moves(CoordinateId(from), to, inertia));
            }
        }
        let all = (0..moved.len()).filter(|&j| !moved[j]);
        all.map(CoordinateId).collect()
    }

    /// Returns whether a velocity changes the momentum of a store through its junction.
    fn moves(&self, j: CoordinateId, junction: JunctionId, inertia: &StoreInertia) -> bool {
        let there = match inertia {
            StoreInertia::Mass(mass) => *mass != ZERO,
            StoreInertia::Tensor(entries) => *entries != [ZERO; 6],
        };
        // The inertia of the joint's own link is constant in the joint's axes. So zeros are known that the
        // transformers, in fixed axes, do not show.
        let link = self.coordinates[j.0].link;
        let own = [self.translation(link), self.rotation(link)].contains(&junction);
        there && (!own || moved_by_own_joint(&self.frames[link.0], j, inertia))
    }
}

/// Returns whether the inertia of a link for unit velocity of its own joint is not zero.
fn moved_by_own_joint(frame: &LinkFrame, j: CoordinateId, inertia: &StoreInertia) -> bool {
    let own = frame.columns().into_iter().find(|(k, _)| *k == j);
    let Some((_, column)) = own else { return true };
    let size = |v: Vec3<Dd>| v.dot(v).to_f64();
    match inertia {
        // |v + ω × r|²
        StoreInertia::Mass(_) => fixed(&frame.com.0)
            .is_none_or(|com| size(column.linear + column.angular.cross(Vec3(com))) > 1e-48),
        StoreInertia::Tensor(entries) => fixed(entries).is_none_or(|entries| {
            // ωᵀ J ω
            let [xx, yy, zz, xy, xz, yz] = entries;
            let Vec3([x, y, z]) = frame.tensor_axes.transpose() * column.angular;
            let twice = Dd::from_f64(2.0) * (xy * x * y + xz * x * z + yz * y * z);
            let about = xx * x * x + yy * y * y + zz * z * z + twice;
            let size = (xx.abs() + yy.abs() + zz.abs()) * (x * x + y * y + z * z);
            about.to_f64() > 1e-24 * size.to_f64()
        }),
    }
}

/// Returns the numbers if none of them is a run-time parameter.
fn fixed<const N: usize>(values: &[Value; N]) -> Option<[Dd; N]> {
    let mut numbers = [Dd::ZERO; N];
    for (number, value) in numbers.iter_mut().zip(values) {
        match value {
            Value::Fixed(x) => *number = *x,
            Value::Parameter(_) => return None,
        }
    }
    Some(numbers)
}
