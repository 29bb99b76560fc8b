//! Spatial vectors and inertias, in pairs of 3-vectors: angular part first.

use nalgebra::{Matrix3, RealField, Unit, Vector3, convert};

use crate::body::{Body, steiner};

/// Angular velocity and velocity of the origin, or their rates.
#[derive(Clone, Copy, Debug)]
pub(super) struct Motion<T: RealField + Copy> {
    pub angular: Vector3<T>,
    pub linear: Vector3<T>,
}

/// Moment about the origin, and force.
#[derive(Clone, Copy, Debug)]
pub(super) struct Force<T: RealField + Copy> {
    pub moment: Vector3<T>,
    pub force: Vector3<T>,
}

/// A body's axes and origin in its parent's.
#[derive(Clone, Copy, Debug)]
pub(super) struct Transform<T: RealField + Copy> {
    pub rotation: Matrix3<T>,
    pub origin: Vector3<T>,
}

/// Mass, first moment and tensor about the origin.
#[derive(Clone, Copy, Debug)]
pub(super) struct Inertia<T: RealField + Copy> {
    pub mass: T,
    pub moment: Vector3<T>,
    pub tensor: Matrix3<T>,
}

/// A joint: its pose at coordinate zero, and the motion that it allows.
#[derive(Clone, Copy, Debug)]
pub(super) struct Joint<T: RealField + Copy> {
    slides: bool,
    axis: Unit<Vector3<T>>,
    zero: Transform<T>,
}

impl<T: RealField + Copy> Motion<T> {
    pub fn zero() -> Self {
        Motion {
            angular: Vector3::zeros(),
            linear: Vector3::zeros(),
        }
    }

    pub fn plus(&self, other: &Self) -> Self {
        Motion {
            angular: self.angular + other.angular,
            linear: self.linear + other.linear,
        }
    }

    /// Returns v × m of motions.
    pub fn cross(&self, m: &Self) -> Self {
        Motion {
            angular: self.angular.cross(&m.angular),
            linear: self.angular.cross(&m.linear) + self.linear.cross(&m.angular),
        }
    }

    /// Returns v ×* f of a motion and a force.
    pub fn cross_force(&self, f: &Force<T>) -> Force<T> {
        Force {
            moment: self.angular.cross(&f.moment) + self.linear.cross(&f.force),
            force: self.angular.cross(&f.force),
        }
    }
}

impl<T: RealField + Copy> Force<T> {
    pub fn zero() -> Self {
        Force {
            moment: Vector3::zeros(),
            force: Vector3::zeros(),
        }
    }

    pub fn plus(&self, other: &Self) -> Self {
        Force {
            moment: self.moment + other.moment,
            force: self.force + other.force,
        }
    }
}

impl<T: RealField + Copy> Transform<T> {
    pub fn identity() -> Self {
        Transform {
            rotation: Matrix3::identity(),
            origin: Vector3::zeros(),
        }
    }

    /// Transforms a motion from the parent's axes to the body's.
    pub fn in_body(&self, m: &Motion<T>) -> Motion<T> {
        Motion {
            angular: self.rotation.tr_mul(&m.angular),
            linear: self
                .rotation
                .tr_mul(&(m.linear + m.angular.cross(&self.origin))),
        }
    }

    /// Transforms a force from the body's axes to the parent's.
    pub fn in_carrier(&self, f: &Force<T>) -> Force<T> {
        let force = self.rotation * f.force;
        Force {
            moment: self.rotation * f.moment + self.origin.cross(&force),
            force,
        }
    }

    /// Returns the pose of `inner`, given in the body, in the parent.
    pub fn of(&self, inner: &Self) -> Self {
        Transform {
            rotation: self.rotation * inner.rotation,
            origin: self.rotation * inner.origin + self.origin,
        }
    }
}

impl<T: RealField + Copy> Inertia<T> {
    pub fn zero() -> Self {
        Inertia {
            mass: T::zero(),
            moment: Vector3::zeros(),
            tensor: Matrix3::zeros(),
        }
    }

    /// Returns the inertia of a body.
    pub fn of(body: &Body) -> Self {
        let tensor = body.inertia + steiner(body.mass, &body.com);
        Inertia {
            mass: convert(body.mass),
            moment: (body.com * body.mass).map(convert::<f64, T>),
            tensor: tensor.map(convert::<f64, T>),
        }
    }

    pub fn plus(&self, other: &Self) -> Self {
        Inertia {
            mass: self.mass + other.mass,
            moment: self.moment + other.moment,
            tensor: self.tensor + other.tensor,
        }
    }

    /// Returns I m.
    pub fn times(&self, m: &Motion<T>) -> Force<T> {
        Force {
            moment: self.tensor * m.angular + self.moment.cross(&m.linear),
            force: m.linear * self.mass - self.moment.cross(&m.angular),
        }
    }

    /// Returns the inertia in the parent's axes, about its origin.
    pub fn in_carrier(&self, x: &Transform<T>) -> Self {
        let (p, h) = (x.origin, x.rotation * self.moment);
        let tensor = x.rotation * self.tensor * x.rotation.transpose();
        // 2 (h·p) + m p·p on the diagonal, less h pᵀ + p hᵀ + m p pᵀ.
        let mean = h + p * (self.mass * convert(0.5));
        let cross = mean * p.transpose();
        let diagonal = Matrix3::from_diagonal_element(mean.dot(&p) * convert(2.0));
        Inertia {
            mass: self.mass,
            moment: h + p * self.mass,
            tensor: tensor + diagonal - cross - cross.transpose(),
        }
    }
}

impl<T: RealField + Copy> Joint<T> {
    pub fn of(body: &Body) -> Self {
        Joint {
            slides: body.slides,
            axis: Unit::new_unchecked(body.axis.map(convert::<f64, T>)),
            zero: Transform {
                rotation: body.placement.rotation.map(convert::<f64, T>),
                origin: body.placement.translation.map(convert::<f64, T>),
            },
        }
    }

    /// Returns a placeholder joint.
    pub fn none() -> Self {
        Joint {
            slides: true,
            axis: Unit::new_unchecked(Vector3::zeros()),
            zero: Transform::identity(),
        }
    }

    /// Returns the pose of the body at this coordinate.
    pub fn place(&self, q: T, sine: fn(T) -> (T, T)) -> Transform<T> {
        let Transform { rotation, origin } = self.zero;
        if self.slides {
            let origin = origin + rotation * (self.axis.as_ref() * q);
            return Transform { rotation, origin };
        }
        // Rodrigues: cos 1 + (1 − cos) u uᵀ + sin [u]×.
        let (sin, cos) = sine(q);
        let (u, v) = (self.axis.as_ref(), self.axis.as_ref() * (T::one() - cos));
        let turn = v * u.transpose() + (u * sin).cross_matrix();
        let turn = turn + Matrix3::from_diagonal_element(cos);
        Transform {
            rotation: rotation * turn,
            origin,
        }
    }

    /// Returns S x: the motion at this rate.
    pub fn motion(&self, rate: T) -> Motion<T> {
        let along = self.axis.as_ref() * rate;
        if self.slides {
            Motion {
                angular: Vector3::zeros(),
                linear: along,
            }
        } else {
            Motion {
                angular: along,
                linear: Vector3::zeros(),
            }
        }
    }

    /// Returns Sᵀ f: the effort of a force at the joint.
    pub fn effort(&self, f: &Force<T>) -> T {
        self.axis
            .dot(if self.slides { &f.force } else { &f.moment })
    }
}
