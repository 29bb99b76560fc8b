//! Energy and momenta of a single rigid body, by definition, in double-double.

use bgdyn_runtime::Dd;

use crate::vectors::{Vector, cross, dot, part, scaled, sum, turned};

/// The joint of the body, which is on the world.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Freedom {
    /// A ball joint at the world's origin; the state is a quaternion and ω.
    Spherical,
    /// A floating joint; the state is the position, a quaternion, the velocity of the link's origin and ω.
    Floating,
}

/// A rigid body. Vectors in link axes, SI units.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Body {
    /// Its joint.
    pub freedom: Freedom,
    /// Mass.
    pub mass: f64,
    /// Centre of mass.
    pub com: [f64; 3],
    /// Principal moments about the centre of mass, along the link's axes.
    pub moments: [f64; 3],
    /// Downward acceleration of gravity.
    pub gravity: f64,
}

/// The exact decimals of the spec.
fn decimals(x: [f64; 3]) -> Vector {
    x.map(decimal)
}

fn decimal(x: f64) -> Dd {
    format!("{x}").parse().expect("a decimal")
}

/// The constants of a body in double-double.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Invariants {
    freedom: Freedom,
    mass: Dd,
    com: Vector,
    moments: Vector,
    weight: Dd,
}

impl Body {
    /// Returns the functions that are constant along a motion.
    pub fn invariants(&self) -> Invariants {
        let mass = decimal(self.mass);
        Invariants {
            freedom: self.freedom,
            mass,
            com: decimals(self.com),
            moments: decimals(self.moments),
            weight: mass * decimal(self.gravity),
        }
    }
}

impl Invariants {
    /// Returns the index of the quaternion in the state.
    pub fn quaternion(&self) -> usize {
        match self.freedom {
            Freedom::Spherical => 0,
            Freedom::Floating => 3,
        }
    }

    /// Returns ω.
    fn rate(&self, y: &[f64]) -> Vector {
        match self.freedom {
            Freedom::Spherical => part(y, 4),
            Freedom::Floating => part(y, 10),
        }
    }

    /// Returns the velocity of the centre of mass, in link axes.
    fn velocity(&self, y: &[f64]) -> Vector {
        let about = cross(self.rate(y), self.com);
        match self.freedom {
            Freedom::Spherical => about,
            Freedom::Floating => sum(part(y, 7), about),
        }
    }

    /// Returns the kinetic energy, J.
    pub fn kinetic(&self, y: &[f64]) -> Dd {
        let (v, w) = (self.velocity(y), self.rate(y));
        let turning = [0, 1, 2].map(|i| self.moments[i] * w[i]);
        Dd::from_f64(0.5) * (self.mass * dot(v, v) + dot(w, turning))
    }

    /// Returns kinetic and potential energy, J. The height of a floating body is that of its centre of mass.
    pub fn energy(&self, y: &[f64]) -> Dd {
        let mut height = turned(y, self.quaternion(), self.com)[2];
        if self.freedom == Freedom::Floating {
            height += Dd::from_f64(y[2]);
        }
        self.kinetic(y) + self.weight * height
    }

    /// Returns the linear momentum in world axes, kg·m/s.
    pub fn linear(&self, y: &[f64]) -> Vector {
        turned(y, self.quaternion(), scaled(self.mass, self.velocity(y)))
    }

    /// Returns the angular momentum in world axes, kg·m²/s: about the ball, or about the centre of mass of a
    /// floating body.
    pub fn angular(&self, y: &[f64]) -> Vector {
        let w = self.rate(y);
        let own = [0, 1, 2].map(|i| self.moments[i] * w[i]);
        let all = match self.freedom {
            Freedom::Floating => own,
            Freedom::Spherical => {
                let linear = scaled(self.mass, self.velocity(y));
                sum(own, cross(self.com, linear))
            }
        };
        turned(y, self.quaternion(), all)
    }
}
