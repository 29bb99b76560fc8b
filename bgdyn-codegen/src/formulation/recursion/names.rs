//! Names of vectors, tensors and inertias for readers of the output; `legend.rs` says what they mean.

use super::frames::{Frame, Frames};
use super::inertia::Inertia;
use super::inverse_dynamics::Wrench;
use super::mass_matrix::Momentum;
use crate::expr::Ex;
use crate::math::{Mat3, Vec3};

const AXES: [&str; 3] = ["x", "y", "z"];
const PAIRS: [&str; 6] = ["xx", "yy", "zz", "xy", "xz", "yz"];

/// Names the components of a vector: `h_x_forearm`.
pub(super) fn name_vector(v: &Vec3<Ex<'_>>, quantity: &str, owner: &str) {
    for (x, axis) in v.0.iter().zip(AXES) {
        x.named(|| format!("{quantity}_{axis}_{owner}"));
    }
}

/// Names the entries of a matrix: `ha_xy_forearm`.
pub(super) fn name_matrix(m: &Mat3<Ex<'_>>, quantity: &str, owner: &str) {
    for (row, i) in m.0.iter().zip(AXES) {
        for (x, j) in row.iter().zip(AXES) {
            x.named(|| format!("{quantity}_{i}{j}_{owner}"));
        }
    }
}

/// Names what a mechanism gives: gravity, positions, masses, first moments, D.
pub(super) fn name_data(frames: &Frames<'_>) {
    let alone = |v: &Vec3<Ex<'_>>, quantity: &str, owner: &str| {
        for (x, axis) in v.0.iter().zip(AXES) {
            x.named_alone(|| format!("{quantity}_{axis}_{owner}"));
        }
    };
    for (frame, gravity) in frames.bodies.iter().zip(&frames.gravity) {
        let (body, inertia) = (&frame.name, &frame.inertia);
        if frame.parent.is_none() {
            alone(gravity, "g", body);
        }
        alone(&frame.position, "r", body);
        inertia.mass.named_alone(|| format!("mass_{body}"));
        inertia.axial.named_alone(|| format!("mass_{body}"));
        alone(&inertia.first, "h", body);
        for (x, pair) in inertia.pseudo.iter().zip(PAIRS) {
            x.named_alone(|| format!("d_{pair}_{body}"));
        }
        let j_zz = inertia.d(0, 0) + inertia.d(1, 1);
        j_zz.named(|| format!("j_zz_{body}"));
    }
}

/// What the efforts of these motions are called: those at rest `gravity`, those without accelerations
/// `bias`.
pub(super) fn effort_name(frames: &Frames<'_>) -> &'static str {
    let zero = |x: fn(&Frame<'_>) -> bool| frames.bodies.iter().all(x);
    match (
        zero(|f| f.acceleration.is_zero()),
        zero(|f| f.rate.is_zero()),
    ) {
        (true, true) => "gravity",
        (true, false) => "bias",
        (false, _) => "tau",
    }
}

/// Names force and moment on a body with all that it carries: inside of its joint in the body's axes,
/// `inner`, if that is all of it; and at the joint, in the axes before that turns.
pub(super) fn name_wrenches(
    [force, moment]: [&str; 2],
    frame: &Frame<'_>,
    inner: &Wrench<'_>,
    outer: &Wrench<'_>,
    whole: &Wrench<'_>,
) {
    let zero = |v: &Vec3<Ex<'_>>| v.0.iter().all(|x| x.is_zero());
    if zero(&outer.force) && zero(&outer.moment) {
        name_vector(&inner.force, force, &frame.name);
        name_vector(&inner.moment, moment, &frame.name);
    }
    let at = format!("at_{}", frame.joint);
    name_vector(&whole.force, force, &at);
    name_vector(&whole.moment, moment, &at);
}

/// Names a composite inertia.
pub(super) fn name_composite(inertia: &Inertia<'_>, owner: &str) {
    inertia.mass.named(|| format!("massc_{owner}"));
    inertia.axial.named(|| format!("massc_{owner}"));
    name_vector(&inertia.first, "hc", owner);
    for (x, pair) in inertia.pseudo.iter().zip(PAIRS) {
        x.named(|| format!("dc_{pair}_{owner}"));
    }
}

/// Names the momentum that a unit rate of the joint `moved` gives, about the origin at `joint`.
pub(super) fn name_momentum(momentum: &Momentum<'_>, moved: &str, joint: &str) {
    let owner = format!("{moved}_at_{joint}");
    name_vector(&momentum.linear, "p", &owner);
    name_vector(&momentum.angular, "l", &owner);
}
