//! The Jacobian of a point on a body.

use nalgebra::storage::StorageMut;
use nalgebra::{Dim, Matrix, RealField, U6, Vector3};

use super::Textbook;

impl<T: RealField + Copy, const N: usize> Textbook<T, N> {
    /// Computes the Jacobian in world axes, angular part first, of a point of a body (in its axes, m),
    /// into `jacobian`.
    pub fn jacobian_world<D, S>(
        &mut self,
        q: &[T],
        body: Option<usize>,
        point: &Vector3<T>,
        jacobian: &mut Matrix<T, U6, D, S>,
    ) where
        D: Dim,
        S: StorageMut<T, U6, D>,
    {
        for i in 0..self.joints() {
            let x = self.placed(i, q[i]);
            self.world[i] = self.parent[i].map_or(x, |p| self.world[p].of(&x));
        }
        jacobian.fill(T::zero());
        let Some(body) = body else { return };
        let tip = self.world[body].rotation * point + self.world[body].origin;
        let mut at = Some(body);
        while let Some(i) = at {
            let world = &self.world[i];
            let unit = self.joint[i].motion(T::one());
            let angular = world.rotation * unit.angular;
            let linear = world.rotation * unit.linear + angular.cross(&(tip - world.origin));
            let mut column = jacobian.column_mut(i);
            column.fixed_rows_mut::<3>(0).copy_from(&angular);
            column.fixed_rows_mut::<3>(3).copy_from(&linear);
            at = self.parent[i];
        }
    }
}
