//! Names vectors, tensors and inertias for readers of the output; `legend.rs` defines their meaning.

use std::collections::BTreeSet;

use super::base_parameter_cache::Contents;
use super::inertia::BodyInertia;
use crate::expr::Expr;
use crate::math::{Mat3, Vec3};
use crate::mechanism::LinkId;

const AXES: [&str; 3] = ["x", "y", "z"];

/// The numbers of a body that a turn about z mixes: h_x, h_y; D_xx, D_yy, D_xy; D_xz, D_yz.
const ALIKE: [&[usize]; 3] = [&[2, 3], &[5, 6, 8], &[9, 10]];

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

/// Says which links the named numbers of a body are sums of, where these are others than those fixed to it. `aimed`: its
/// axes are turned about z.
pub(super) fn name_contents(
    inertia: &BodyInertia<'_>,
    (own, aimed): (&[LinkId], bool),
    contents: &Contents,
    name: impl Fn(LinkId) -> String,
) {
    let describe = |x: Expr<'_>, components: &[usize]| {
        let links = components.iter().flat_map(|&k| &contents[k]);
        let links: BTreeSet<LinkId> = links.copied().collect();
        if links.iter().any(|link| !own.contains(link)) {
            let names: Vec<String> = links.into_iter().map(&name).collect();
            x.containing(|| format!("of {}", names.join(", ")));
        }
    };
    for (k, x) in inertia.entries().into_iter().enumerate() {
        match ALIKE.iter().find(|alike| aimed && alike.contains(&k)) {
            Some(alike) => describe(x, alike),
            None => describe(x, &[k]),
        }
    }
    describe(inertia.d(0, 0) + inertia.d(1, 1), &[5, 6]);
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
