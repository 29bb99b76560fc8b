//! Link poses in fixed axes, in any kind of dual number, computed directly from the checked mechanism.
//!
//! Independent of the generator's own geometry.

use bgdyn_codegen::mechanism::{LinkId, Mechanism, Motion};
use bgdyn_runtime::Dd;
use num_dual::DualNum;

use super::fixed;

/// Real or dual numbers over `f64`.
pub trait Number: DualNum<Primitive = f64> + Copy {}
impl<T: DualNum<Primitive = f64> + Copy> Number for T {}

pub type V3<D> = [D; 3];
pub type M3<D> = [[D; 3]; 3];

pub fn v3<D>(f: impl FnMut(usize) -> D) -> V3<D> {
    std::array::from_fn(f)
}

pub fn m3<D>(mut f: impl FnMut(usize, usize) -> D) -> M3<D> {
    std::array::from_fn(|i| std::array::from_fn(|j| f(i, j)))
}

pub fn dot<D: Number>(a: V3<D>, b: V3<D>) -> D {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub fn cross<D: Number>(a: V3<D>, b: V3<D>) -> V3<D> {
    v3(|i| a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3])
}

pub fn add<D: Number>(a: V3<D>, b: V3<D>) -> V3<D> {
    v3(|i| a[i] + b[i])
}

pub fn scaled<D: Number>(a: V3<D>, k: D) -> V3<D> {
    v3(|i| a[i] * k)
}

pub fn apply<D: Number>(m: M3<D>, v: V3<D>) -> V3<D> {
    v3(|i| dot(m[i], v))
}

pub fn times<D: Number>(a: M3<D>, b: M3<D>) -> M3<D> {
    m3(|i, j| a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j])
}

pub fn transposed<D: Number>(a: M3<D>) -> M3<D> {
    m3(|i, j| a[j][i])
}

/// A link in fixed axes.
#[derive(Clone, Copy, Debug)]
pub struct Place<D> {
    /// A_i: columns are the link's axes.
    pub rotation: M3<D>,
    /// The origin of its axes.
    pub origin: V3<D>,
    /// r_i: the centre of mass.
    pub centre: V3<D>,
    /// Unit vector of its joint's axis.
    pub axis: V3<D>,
}

fn known<D: Number>(x: Dd) -> D {
    D::from(x.to_f64())
}

/// Returns every link's pose, in the order of the mechanism.
pub fn places<D: Number>(mechanism: &Mechanism, q: &[D]) -> Vec<Place<D>> {
    let mut places: Vec<Place<D>> = Vec::new();
    for link in mechanism.links() {
        let joint = &link.joint;
        let mut rotation = m3(|i, j| known(joint.origin.rotation.0[i][j]));
        let mut origin = v3(|i| known(joint.origin.translation.0[i]));
        if let Some(LinkId(p)) = link.parent {
            origin = add(places[p].origin, apply(places[p].rotation, origin));
            rotation = times(places[p].rotation, rotation);
        }
        let n: V3<D> = v3(|i| known(joint.axis.0[i]));
        let axis = apply(rotation, n);
        if let Some(j) = joint.coordinate {
            match joint.kind.motion {
                Motion::Rotation => rotation = times(rotation, rodrigues(n, q[j.0])),
                Motion::Translation => origin = add(origin, scaled(axis, q[j.0])),
                Motion::None | Motion::Compound(_) => {
                    unreachable!("the joint has no coordinate of its own")
                }
            }
        }
        let com = v3(|i| D::from(fixed(link.inertial.com.0[i], &[])));
        places.push(Place {
            rotation,
            origin,
            centre: add(origin, apply(rotation, com)),
            axis,
        });
    }
    places
}

/// 1 + sin q [n]× + (1 − cos q) [n]×²
fn rodrigues<D: Number>(n: V3<D>, q: D) -> M3<D> {
    let zero = D::from(0.0);
    let k = [
        [zero, -n[2], n[1]],
        [n[2], zero, -n[0]],
        [-n[1], n[0], zero],
    ];
    let (sin, rest) = (q.sin(), -q.cos() + 1.0);
    let kk = times(k, k);
    m3(|i, j| D::from(f64::from(u8::from(i == j))) + k[i][j] * sin + kk[i][j] * rest)
}

/// Mass and tensor J_i⁰ about the centre of mass in link axes.
pub fn inertial(mechanism: &Mechanism, link: usize) -> (f64, M3<f64>) {
    let inertial = &mechanism.links()[link].inertial;
    let [xx, yy, zz, xy, xz, yz] = inertial.inertia.entries.map(|x| fixed(x, &[]));
    let tensor = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
    (fixed(inertial.mass, &[]), tensor)
}

/// Gravity in fixed axes.
pub fn gravity(mechanism: &Mechanism) -> V3<f64> {
    mechanism.gravity().0.map(Dd::to_f64)
}
