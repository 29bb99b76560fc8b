//! Names vectors, tensors and inertias for readers of the output; `legend.rs` defines their meaning.

use super::inertia::BodyInertia;
use crate::expr::Expr;
use crate::math::{Mat3, Vec3};

const AXES: [&str; 3] = ["x", "y", "z"];
const PAIRS: [&str; 6] = ["xx", "yy", "zz", "xy", "xz", "yz"];

/// Names the components of a vector: `h_x_forearm`.
pub(super) fn name_vector(v: &Vec3<Expr<'_>>, quantity: &str, owner: &str) {
    for (x, axis) in v.0.iter().zip(AXES) {
        x.named(|| format!("{quantity}_{axis}_{owner}"));
    }
}

/// Names the entries of a matrix: `ha_xy_forearm`.
pub(super) fn name_matrix(m: &Mat3<Expr<'_>>, quantity: &str, owner: &str) {
    for (row, i) in m.0.iter().zip(AXES) {
        for (x, j) in row.iter().zip(AXES) {
            x.named(|| format!("{quantity}_{i}{j}_{owner}"));
        }
    }
}

/// Names the given numbers of a body: masses, first moments, D.
pub(super) fn name_body(inertia: &BodyInertia<'_>, body: &str) {
    inertia.mass.named_alone(|| format!("mass_{body}"));
    inertia.axial.named_alone(|| format!("mass_{body}"));
    name_number(&inertia.first, "h", body);
    for (x, pair) in inertia.pseudo.iter().zip(PAIRS) {
        x.named_alone(|| format!("d_{pair}_{body}"));
    }
    let j_zz = inertia.d(0, 0) + inertia.d(1, 1);
    j_zz.named(|| format!("j_zz_{body}"));
}

/// Names given numbers of a mechanism, unless another quantity has the value.
pub(super) fn name_number(v: &Vec3<Expr<'_>>, quantity: &str, owner: &str) {
    for (x, axis) in v.0.iter().zip(AXES) {
        x.named_alone(|| format!("{quantity}_{axis}_{owner}"));
    }
}

/// Names a composite inertia.
pub(super) fn name_composite(inertia: &BodyInertia<'_>, owner: &str) {
    inertia.mass.named(|| format!("massc_{owner}"));
    inertia.axial.named(|| format!("massc_{owner}"));
    name_vector(&inertia.first, "hc", owner);
    for (x, pair) in inertia.pseudo.iter().zip(PAIRS) {
        x.named(|| format!("dc_{pair}_{owner}"));
    }
}
