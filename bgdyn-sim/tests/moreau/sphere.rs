//! A solid sphere above an inclined plane, written by hand.

use bgdyn_runtime::{ContactMap, RigidContact, vector};
use bgdyn_sim::{Plant, Power};
use nalgebra::SVector;

/// Centre and angles along (x, y, normal) of the plane, then velocities and angular velocities.
pub type Y = SVector<f64, 12>;

pub const GRAVITY: f64 = 9.81;

/// A solid sphere; its moment of inertia is (2/5) m r², or infinite.
pub struct Sphere {
    pub mass: f64,
    pub radius: f64,
    pub rolls: bool,
    /// The angle between the plane and a level one; x points downwards.
    pub incline: f64,
    pub friction: f64,
    pub restitution: f64,
    /// A force −d v, N·s/m.
    pub damping: f64,
}

impl Default for Sphere {
    fn default() -> Self {
        Sphere {
            mass: 2.0,
            radius: 0.1,
            rolls: false,
            incline: 0.0,
            friction: 0.0,
            restitution: 0.0,
            damping: 0.0,
        }
    }
}

impl Sphere {
    fn inertia(&self) -> f64 {
        match self.rolls {
            true => 0.4 * self.mass * self.radius * self.radius,
            false => f64::INFINITY,
        }
    }

    /// Returns a state at this height of the gap, with these velocities.
    pub fn at(&self, gap: f64, velocity: [f64; 3]) -> Y {
        let mut y = Y::zeros();
        y[2] = self.radius + gap;
        y.as_mut_slice()[6..9].copy_from_slice(&velocity);
        y
    }
}

impl Plant for Sphere {
    type State = Y;
    type Modes = ();
    type Values = SVector<f64, 0>;
    type Entries = SVector<f64, 3>;
    type Error = ();

    fn rates(&self, _: f64, y: &Y, (): &()) -> Result<Y, ()> {
        let mut rates = Y::zeros();
        for i in 0..6 {
            rates[i] = y[6 + i];
        }
        let (sin, cos) = self.incline.sin_cos();
        for (i, pull) in [sin, 0.0, -cos].into_iter().enumerate() {
            rates[6 + i] = GRAVITY * pull - self.damping / self.mass * y[6 + i];
        }
        Ok(rates)
    }

    fn jacobian(&self, _: f64, _: &Y, (): &()) -> Option<Result<bgdyn_sim::Jacobian<Y>, ()>> {
        let mut state = nalgebra::SMatrix::zeros();
        for i in 0..6 {
            state[(i, 6 + i)] = 1.0;
        }
        for i in 6..9 {
            state[(i, i)] = -self.damping / self.mass;
        }
        let time = Y::zeros();
        Some(Ok(bgdyn_sim::Jacobian { state, time }))
    }

    fn positions(&self) -> usize {
        6
    }

    fn rigid_contacts(&self) -> usize {
        1
    }

    fn rigid_contact_entry(&self, _: usize) -> usize {
        2
    }

    fn rigid_contact_states(
        &self,
        _: f64,
        y: &Y,
        (): &(),
        contacts: &mut [RigidContact<f64>],
    ) -> Result<(), ()> {
        let r = self.radius;
        contacts[0] = RigidContact {
            gap: y[2] - r,
            // ω × (−r n)
            velocity: [y[6] - r * y[10], y[7] + r * y[9], y[8]],
            friction: self.friction,
            restitution: self.restitution,
        };
        Ok(())
    }

    fn rigid_contact_maps(
        &self,
        _: f64,
        _: &Y,
        (): &(),
        maps: &mut [Option<ContactMap<Y>>],
    ) -> Result<(), ()> {
        let mut rows = [Y::zeros(); 3];
        for (k, row) in rows.iter_mut().enumerate() {
            row[6 + k] = 1.0;
        }
        rows[0][10] = -self.radius;
        rows[1][9] = self.radius;
        let columns = rows.map(|row| {
            let mut column = row / self.mass;
            for i in 9..12 {
                column[i] = row[i] / self.inertia();
            }
            column
        });
        maps[0] = Some(ContactMap { rows, columns });
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

    fn nothing(&self) -> SVector<f64, 3> {
        SVector::zeros()
    }

    /// Energy of motion, of weight, and none at the contact.
    fn energy(&self, _: f64, y: &Y, (): &()) -> Result<SVector<f64, 3>, ()> {
        let square = |from: usize| (from..from + 3).map(|i| y[i] * y[i]).sum::<f64>();
        let spin = if self.rolls {
            self.inertia() * square(9)
        } else {
            0.0
        };
        let (sin, cos) = self.incline.sin_cos();
        let height = y[2] * cos - y[0] * sin;
        Ok(vector([
            0.5 * (self.mass * square(6) + spin),
            self.mass * GRAVITY * height,
            0.0,
        ]))
    }

    fn power(&self, _: f64, y: &Y, (): &()) -> Result<Power<SVector<f64, 3>>, ()> {
        let square: f64 = (6..9).map(|i| y[i] * y[i]).sum();
        Ok(Power {
            supplied: SVector::zeros(),
            dissipated: vector([self.damping * square, 0.0, 0.0]),
        })
    }
}
