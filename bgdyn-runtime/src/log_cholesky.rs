//! Ten free numbers for the parameters of a body that can exist.

use nalgebra::{Matrix3, SMatrix, SVector};

use crate::Scalar;
use crate::inertia::{from_pseudo_inertia, pseudo_inertia};

/// The ten parameters of a body, m, mx, my, mz, Ixx, Ixy, Iyy, Ixz, Iyz, Izz, as functions of ten numbers without bounds:
/// whatever these are, the body can exist. An estimator that changes them keeps its bodies physical.
///
/// With the numbers α, d₁, d₂, d₃, s₁₂, s₂₃, s₁₃, t₁, t₂, t₃ in this order, the pseudo-inertia is
///
/// ```text
/// [ ∫ r rᵀ dm    ∫ r dm ]                     [ exp d₁  s₁₂     s₁₃     t₁ ]
/// [ (∫ r dm)ᵀ    m      ]  =  U Uᵀ,  U = exp α [ 0       exp d₂  s₂₃     t₂ ]
///                                             [ 0       0       exp d₃  t₃ ]
///                                             [ 0       0       0       1  ]
/// ```
///
/// (Rucker and Wensing, *Smooth Parameterization of Rigid-Body Inertia*, IEEE Robotics and Automation Letters 7, 2022).
/// The mass is exp 2α, in kg; t is the centre of mass; exp dᵢ, sᵢⱼ and tᵢ are lengths, in m. The parameters are about the
/// origin of the link, in link axes, in kg, kg·m and kg·m². The tensor has *minus* the products of inertia.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LogCholesky<T>(pub SVector<T, 10>);

/// The numbers with the exponentials of those that are logarithms.
struct Factor<T> {
    mass: T,
    diagonal: [T; 3],
    s12: T,
    s23: T,
    s13: T,
    t: [T; 3],
}

impl<T: Scalar> LogCholesky<T> {
    /// Returns the numbers of a body with these parameters. They are not finite if the body has no mass, or is not
    /// spread in all three directions: its pseudo-inertia is not positive definite then.
    pub fn from_parameters(parameters: &SVector<T, 10>) -> Self {
        let p = parameters;
        let half = T::from_f64(0.5);
        let tensor = Matrix3::new(p[4], p[5], p[7], p[5], p[6], p[8], p[7], p[8], p[9]);
        let mass = p[0];
        let moments = pseudo_inertia(&tensor).map(|moment| moment / mass);
        let t = [p[1] / mass, p[2] / mass, p[3] / mass];
        // The columns of U from the last one to the first.
        let about = |i: usize, j: usize| moments[(i, j)] - t[i] * t[j];
        let third = about(2, 2).sqrt();
        let (s13, s23) = (about(0, 2) / third, about(1, 2) / third);
        let second = (about(1, 1) - s23 * s23).sqrt();
        let s12 = (about(0, 1) - s13 * s23) / second;
        let first = (about(0, 0) - s12 * s12 - s13 * s13).sqrt();
        LogCholesky(SVector::from([
            half * mass.ln(),
            first.ln(),
            second.ln(),
            third.ln(),
            s12,
            s23,
            s13,
            t[0],
            t[1],
            t[2],
        ]))
    }

    /// Returns the parameters of the body.
    pub fn to_parameters(&self) -> SVector<T, 10> {
        let f = self.factor();
        let [e1, e2, e3] = f.diagonal;
        let [t1, t2, t3] = f.t;
        let xx = e1 * e1 + f.s12 * f.s12 + f.s13 * f.s13 + t1 * t1;
        let xy = f.s12 * e2 + f.s13 * f.s23 + t1 * t2;
        let xz = f.s13 * e3 + t1 * t3;
        let yy = e2 * e2 + f.s23 * f.s23 + t2 * t2;
        let yz = f.s23 * e3 + t2 * t3;
        let zz = e3 * e3 + t3 * t3;
        let one = T::from_f64(1.0);
        parameters(one, f.t, [xx, xy, xz, yy, yz, zz]).map(|x| x * f.mass)
    }

    /// Returns the derivatives of the parameters by the numbers: a row for each parameter, a column for each number. The
    /// matrix has an inverse for every body.
    ///
    /// If Yᵀ s is the direction of an adaptation law for the parameters, the transpose of this matrix times Yᵀ s is the
    /// direction for these numbers.
    pub fn jacobian(&self) -> SMatrix<T, 10, 10> {
        let f = self.factor();
        let (zero, one, two) = (T::from_f64(0.0), T::from_f64(1.0), T::from_f64(2.0));
        let [e1, e2, e3] = f.diagonal;
        let [t1, t2, t3] = f.t;
        let moments = |[xx, xy, xz, yy, yz, zz]: [T; 6]| {
            parameters(zero, [zero; 3], [xx, xy, xz, yy, yz, zz])
        };
        let centre = |axis: usize, moments: [T; 6]| {
            let unit = [0, 1, 2].map(|k| if k == axis { one } else { zero });
            parameters(zero, unit, moments)
        };
        let columns = [
            self.to_parameters().map(|x| two * x),
            moments([two * e1 * e1, zero, zero, zero, zero, zero]),
            moments([zero, f.s12 * e2, zero, two * e2 * e2, zero, zero]),
            moments([zero, zero, f.s13 * e3, zero, f.s23 * e3, two * e3 * e3]),
            moments([two * f.s12, e2, zero, zero, zero, zero]),
            moments([zero, f.s13, zero, two * f.s23, e3, zero]),
            moments([two * f.s13, f.s23, e3, zero, zero, zero]),
            centre(0, [two * t1, t2, t3, zero, zero, zero]),
            centre(1, [zero, t1, zero, two * t2, t3, zero]),
            centre(2, [zero, zero, t1, zero, t2, two * t3]),
        ];
        SMatrix::from_fn(|row, column| {
            let scale = if column == 0 { one } else { f.mass };
            scale * columns[column][row]
        })
    }

    fn factor(&self) -> Factor<T> {
        let x = &self.0;
        Factor {
            mass: (x[0] + x[0]).exp(),
            diagonal: [x[1].exp(), x[2].exp(), x[3].exp()],
            s12: x[4],
            s23: x[5],
            s13: x[6],
            t: [x[7], x[8], x[9]],
        }
    }
}

/// Returns the parameters of a mass, first moments and second moments xx, xy, xz, yy, yz, zz.
fn parameters<T: Scalar>(
    mass: T,
    first: [T; 3],
    [xx, xy, xz, yy, yz, zz]: [T; 6],
) -> SVector<T, 10> {
    let tensor = from_pseudo_inertia(&Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz));
    SVector::from([
        mass,
        first[0],
        first[1],
        first[2],
        tensor[(0, 0)],
        tensor[(0, 1)],
        tensor[(1, 1)],
        tensor[(0, 2)],
        tensor[(1, 2)],
        tensor[(2, 2)],
    ])
}
