//! A body in a vertical plane with corners above level ground, written by hand.

use bgdyn_runtime::{ContactMap, RigidContact, vector};
use bgdyn_sim::{Plant, Power};
use nalgebra::SVector;

use crate::sphere::GRAVITY;

/// x, height and angle of the centre, and their rates.
pub type Y = SVector<f64, 6>;

/// A body of mass 1.
pub struct Planar {
    /// The moment of inertia about the centre, kg·m².
    pub inertia: f64,
    /// Corners in axes of the body.
    pub corners: Vec<[f64; 2]>,
    pub friction: f64,
    pub restitution: f64,
}

impl Planar {
    /// A corner relative to the centre.
    fn arm(&self, c: usize, y: &Y) -> [f64; 2] {
        let ([a, b], (sin, cos)) = (self.corners[c], y[2].sin_cos());
        [cos * a - sin * b, sin * a + cos * b]
    }

    /// The height of a corner.
    pub fn gap(&self, c: usize, y: &Y) -> f64 {
        y[1] + self.arm(c, y)[1]
    }

    pub fn energy_of(&self, y: &Y) -> f64 {
        0.5 * (y[3] * y[3] + y[4] * y[4] + self.inertia * y[5] * y[5]) + GRAVITY * y[1]
    }
}

impl Plant for Planar {
    type State = Y;
    type Modes = ();
    type Values = SVector<f64, 0>;
    type Entries = SVector<f64, 1>;
    type Error = ();

    fn rates(&self, _: f64, y: &Y, (): &()) -> Result<Y, ()> {
        Ok(vector([y[3], y[4], y[5], 0.0, -GRAVITY, 0.0]))
    }

    fn positions(&self) -> usize {
        3
    }

    fn rigid_contacts(&self) -> usize {
        self.corners.len()
    }

    fn rigid_contact_entry(&self, _: usize) -> usize {
        0
    }

    fn rigid_contact_states(
        &self,
        _: f64,
        y: &Y,
        (): &(),
        contacts: &mut [RigidContact<f64>],
    ) -> Result<(), ()> {
        for (c, contact) in contacts.iter_mut().enumerate() {
            let [rx, ry] = self.arm(c, y);
            *contact = RigidContact {
                gap: self.gap(c, y),
                velocity: [y[3] - y[5] * ry, 0.0, y[4] + y[5] * rx],
                friction: self.friction,
                restitution: self.restitution,
            };
        }
        Ok(())
    }

    fn rigid_contact_maps(
        &self,
        _: f64,
        y: &Y,
        (): &(),
        maps: &mut [Option<ContactMap<Y>>],
    ) -> Result<(), ()> {
        for (c, map) in maps.iter_mut().enumerate() {
            let [rx, ry] = self.arm(c, y);
            let row = |x, z, turn| vector([0.0, 0.0, 0.0, x, z, turn]);
            let rows = [row(1.0, 0.0, -ry), Y::zeros(), row(0.0, 1.0, rx)];
            let columns = rows.map(|row| {
                let mut column = row;
                column[5] /= self.inertia;
                column
            });
            *map = Some(ContactMap { rows, columns });
        }
        Ok(())
    }

    fn rigid_contact_biases(
        &self,
        _: f64,
        y: &Y,
        (): &(),
        biases: &mut [[f64; 3]],
    ) -> Result<(), ()> {
        for (c, bias) in biases.iter_mut().enumerate() {
            let [rx, ry] = self.arm(c, y);
            *bias = [-y[5] * y[5] * rx, 0.0, -y[5] * y[5] * ry];
        }
        Ok(())
    }

    fn events(&self, _: f64, _: &Y, (): &()) -> Result<SVector<f64, 0>, ()> {
        Ok(vector([]))
    }

    fn changes_mode(&self, _: usize) -> bool {
        false
    }

    fn change(&self, _: f64, y: &Y, (): &(), _: impl Fn(usize) -> bool) -> Result<(Y, ()), ()> {
        Ok((*y, ()))
    }

    fn nothing(&self) -> SVector<f64, 1> {
        SVector::zeros()
    }

    fn energy(&self, _: f64, y: &Y, (): &()) -> Result<SVector<f64, 1>, ()> {
        Ok(vector([self.energy_of(y)]))
    }

    fn power(&self, _: f64, _: &Y, (): &()) -> Result<Power<SVector<f64, 1>>, ()> {
        Ok(Power {
            supplied: SVector::zeros(),
            dissipated: SVector::zeros(),
        })
    }
}
