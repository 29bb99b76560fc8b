//! The pseudo-inertia of a body, Σ = ∫ [s; 1][s; 1]ᵀ dm = [[D, h], [hᵀ, m]] with D = ½ tr(I) 1 − I (Wensing, Kim,
//! Slotine 2018). A body with these parameters can exist exactly if Σ is positive semidefinite; masses greater than
//! zero and the triangle inequality are included.

use nalgebra::{Matrix3, Matrix4, Vector3};

use crate::model::{BODY_PARAMETERS, Parameters, Transport};

/// Returns Σ. It is linear in the parameters.
pub fn pseudo_inertia(p: &Parameters) -> Matrix4<f64> {
    let tensor = Matrix3::new(p[4], p[5], p[7], p[5], p[6], p[8], p[7], p[8], p[9]);
    let d = Matrix3::from_diagonal_element(0.5 * tensor.trace()) - tensor;
    let mut sigma = Matrix4::zeros();
    sigma.fixed_view_mut::<3, 3>(0, 0).copy_from(&d);
    for k in 0..3 {
        sigma[(k, 3)] = p[1 + k];
        sigma[(3, k)] = p[1 + k];
    }
    sigma[(3, 3)] = p[0];
    sigma
}

/// Returns the parameters of Σ: I = tr(D) 1 − D.
pub fn parameters(sigma: &Matrix4<f64>) -> Parameters {
    let d: Matrix3<f64> = sigma.fixed_view::<3, 3>(0, 0).into();
    let i = Matrix3::from_diagonal_element(d.trace()) - d;
    let h = [sigma[(0, 3)], sigma[(1, 3)], sigma[(2, 3)]];
    Parameters::from([
        sigma[(3, 3)],
        h[0],
        h[1],
        h[2],
        i[(0, 0)],
        i[(0, 1)],
        i[(1, 1)],
        i[(0, 2)],
        i[(1, 2)],
        i[(2, 2)],
    ])
}

/// Returns Σ for each unit of a parameter: Σ(p) = Σ_k p_k N_k.
pub fn unit_inertias() -> [Matrix4<f64>; BODY_PARAMETERS] {
    std::array::from_fn(|k| {
        let mut unit = Parameters::zeros();
        unit[k] = 1.0;
        pseudo_inertia(&unit)
    })
}

/// Returns the map of parameters from an inner frame to an outer one: Σ ↦ H Σ Hᵀ with H = [[R, p], [0, 1]].
/// `rotation`'s columns are the inner axes in the outer frame, `translation` is the inner origin, m.
pub fn transport(rotation: &Matrix3<f64>, translation: &Vector3<f64>) -> Transport {
    let mut h = Matrix4::identity();
    h.fixed_view_mut::<3, 3>(0, 0).copy_from(rotation);
    h.fixed_view_mut::<3, 1>(0, 3).copy_from(translation);
    let columns = unit_inertias().map(|unit| parameters(&(h * unit * h.transpose())));
    Transport::from_columns(&columns)
}

/// Returns the parameters of a mass, its centre and its tensor about the centre, kg, m, kg·m²:
/// I_O = I_C + m (|c|² 1 − c cᵀ).
pub fn from_centre(mass: f64, c: &Vector3<f64>, tensor: &Matrix3<f64>) -> Parameters {
    let i = tensor + steiner(mass, c);
    Parameters::from([
        mass,
        mass * c.x,
        mass * c.y,
        mass * c.z,
        i[(0, 0)],
        i[(0, 1)],
        i[(1, 1)],
        i[(0, 2)],
        i[(1, 2)],
        i[(2, 2)],
    ])
}

/// Returns mass, centre and tensor about it. Without mass the centre is the origin.
pub fn to_centre(p: &Parameters) -> (f64, Vector3<f64>, Matrix3<f64>) {
    let h = Vector3::new(p[1], p[2], p[3]);
    let c = if p[0] == 0.0 {
        Vector3::zeros()
    } else {
        h / p[0]
    };
    let origin = Matrix3::new(p[4], p[5], p[7], p[5], p[6], p[8], p[7], p[8], p[9]);
    (p[0], c, origin - steiner(p[0], &c))
}

fn steiner(mass: f64, c: &Vector3<f64>) -> Matrix3<f64> {
    mass * (Matrix3::from_diagonal_element(c.norm_squared()) - c * c.transpose())
}

/// Returns the smallest eigenvalue of Σ.
pub fn smallest_eigenvalue(p: &Parameters) -> f64 {
    pseudo_inertia(p).symmetric_eigenvalues().min()
}

/// Share of the trace that the eigenvalues of a body that cannot exist are raised to.
pub const RAISED: f64 = 1e-6;

/// Returns the nearest parameters of a body that can exist, and whether they differ: eigenvalues of Σ below 1e-9 of
/// Σ |λ| are raised to [`RAISED`] of it.
pub fn made_definite(p: &Parameters) -> (Parameters, bool) {
    let eigen = pseudo_inertia(p).symmetric_eigen();
    let trace: f64 = eigen.eigenvalues.iter().map(|x| x.abs()).sum();
    if eigen.eigenvalues.min() > 1e-9 * trace {
        return (*p, false);
    }
    let raised = eigen.eigenvalues.map(|x| x.max(RAISED * trace));
    let sigma =
        eigen.eigenvectors * Matrix4::from_diagonal(&raised) * eigen.eigenvectors.transpose();
    (parameters(&sigma), true)
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Rotation3;

    fn box_parameters() -> Parameters {
        let tensor = Matrix3::from_diagonal(&Vector3::new(0.3, 0.4, 0.5));
        from_centre(2.0, &Vector3::new(0.1, -0.2, 0.3), &tensor)
    }

    #[test]
    fn parameters_and_pseudo_inertia_are_inverse() {
        let p = box_parameters();
        assert!((parameters(&pseudo_inertia(&p)) - p).amax() < 1e-15);
        let (mass, c, tensor) = to_centre(&p);
        assert!((from_centre(mass, &c, &tensor) - p).amax() < 1e-15);
        assert!((tensor[(1, 1)] - 0.4).abs() < 1e-15);
    }

    #[test]
    fn transport_moves_a_body_as_a_body() {
        let rotation = Rotation3::from_euler_angles(0.3, -0.7, 1.1).into_inner();
        let p = Vector3::new(0.2, 0.5, -0.4);
        let moved = transport(&rotation, &p) * box_parameters();
        let (mass, c, tensor) = to_centre(&box_parameters());
        let expected = from_centre(
            mass,
            &(rotation * c + p),
            &(rotation * tensor * rotation.transpose()),
        );
        assert!((moved - expected).amax() < 1e-14);
    }

    #[test]
    fn a_body_that_cannot_exist_is_made_definite() {
        let mut p = Parameters::zeros();
        p[9] = 0.35; // only what turns about z: Σ has a negative eigenvalue
        assert!(smallest_eigenvalue(&p) < -0.1);
        let (definite, changed) = made_definite(&p);
        assert!(changed && smallest_eigenvalue(&definite) > 0.0);
        assert_eq!(made_definite(&box_parameters()), (box_parameters(), false));
    }
}
