//! Random trees for the scenes: bodies without any structure, frames off every axis.

use super::random::{Draft, Link};
use super::rng::Rng;

/// The name that a draft gives a link's joint.
pub fn joint(link: &Link) -> String {
    format!("joint_{}", link.name.trim_start_matches("link_"))
}

/// Thousandths in −size … size.
pub fn rounded(rng: &mut Rng, size: f64) -> f64 {
    (rng.within(size) * 1000.0).round() / 1000.0
}

/// Mass, centre of mass and a full tensor: tr(D)·1 − D with D = Σ s sᵀ over six points s.
pub fn solid(rng: &mut Rng) -> String {
    let mut d = [[0.0; 3]; 3];
    for _ in 0..6 {
        let s = [0; 3].map(|_| rounded(rng, 0.3));
        for i in 0..3 {
            for j in 0..3 {
                d[i][j] += s[i] * s[j];
            }
        }
    }
    let com = [0; 3].map(|_| rounded(rng, 0.3));
    let (xx, yy, zz) = (d[1][1] + d[2][2], d[2][2] + d[0][0], d[0][0] + d[1][1]);
    let (xy, xz, yz) = (-d[0][1], -d[0][2], -d[1][2]);
    let mass = 0.5 + 4.0 * rng.unit();
    format!(
        "    mass: {mass:?}\n    com: {com:?}\n    inertia: {{ xx: {xx:?}, yy: {yy:?}, zz: {zz:?}, xy: {xy:?}, xz: {xz:?}, yz: {yz:?} }}\n"
    )
}

/// Frames on random links, off every axis, and one in the world.
pub fn hooks(rng: &mut Rng, draft: &mut Draft) {
    let pole = "{ name: pole, link: world, origin: { xyz: [3.17, -2.41, 4.03] } }";
    draft.frames.push(pole.into());
    for i in 0..3 {
        let on = rng.pick(&draft.links).name.clone();
        let [xyz, rpy] = [0.6, 3.0].map(|size| [0; 3].map(|_| rounded(rng, size)));
        draft.frames.push(format!(
            "{{ name: hook_{i}, link: {on}, origin: {{ xyz: {xyz:?}, rpy: {rpy:?} }} }}"
        ));
    }
}

/// The link whose joint moves a link.
pub fn mover(draft: &Draft, locked: &[String], mut link: String) -> Option<String> {
    loop {
        let at = draft.links.iter().find(|l| l.name == link)?;
        if at.joint.kind != "fixed" && !locked.contains(&joint(at)) {
            return Some(link);
        }
        link = at.parent.clone()?;
    }
}
