//! Poses computed from a robot's numbers in double-double, and their decimal text.

use super::number::{Num, all_zero};
use bgdyn_codegen::math::{Mat3, Vec3, rodrigues};
use bgdyn_runtime::Dd;

/// Angles this close to a multiple of 90° count as exact: the deviation is the rounding of double-double.
const EXACT: f64 = 1e-25;

/// A pose in the notation of a mechanism: `xyz` in m, `rpy` in rad.
#[derive(Clone, Debug)]
pub(super) struct Placement {
    pub(super) xyz: [Num; 3],
    pub(super) rpy: [Num; 3],
}

impl Placement {
    /// Returns the identity.
    pub(super) fn identity() -> Self {
        Placement {
            xyz: Num::zeros(),
            rpy: Num::zeros(),
        }
    }

    pub(super) fn is_identity(&self) -> bool {
        all_zero(&self.xyz) && all_zero(&self.rpy)
    }

    /// Returns `inner`, given in this pose's axes, in the axes in which this one is given. If one of the
    /// two is the identity, the text of the other does not change.
    pub(super) fn then(&self, inner: &Placement) -> Placement {
        if inner.is_identity() {
            return self.clone();
        }
        if self.is_identity() {
            return inner.clone();
        }
        self.pose().then(&inner.pose()).placement()
    }

    /// Converts it to double-double.
    pub(super) fn pose(&self) -> Pose {
        let [roll, pitch, yaw] = self.rpy.each_ref().map(Num::exact);
        let turned = about(2, yaw).then(&about(1, pitch)).then(&about(0, roll));
        Pose {
            translation: Vec3(self.xyz.each_ref().map(Num::exact)),
            ..turned
        }
    }
}

/// A pose in double-double.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pose {
    pub(super) rotation: Mat3<Dd>,
    pub(super) translation: Vec3<Dd>,
}

impl Pose {
    /// Returns `inner`, given in this pose's axes, in the axes in which this one is given.
    pub(super) fn then(&self, inner: &Pose) -> Pose {
        Pose {
            rotation: self.rotation * inner.rotation,
            translation: self.translation + self.rotation * inner.translation,
        }
    }

    /// Returns the pose of the outer axes in these.
    pub(super) fn inverse(&self) -> Pose {
        let rotation = self.rotation.transpose();
        Pose {
            rotation,
            translation: -(rotation * self.translation),
        }
    }

    /// Converts it to the numbers of a mechanism. At a pitch of ±90° the yaw is 0.
    pub(super) fn placement(&self) -> Placement {
        let r = self.rotation.0;
        let level = (r[0][0] * r[0][0] + r[1][0] * r[1][0]).sqrt();
        let pitch = angle(-r[2][0], level);
        let (roll, yaw) = match level.to_f64() < EXACT {
            true => (angle(-r[1][2], r[1][1]), Dd::ZERO),
            false => (angle(r[2][1], r[2][2]), angle(r[1][0], r[0][0])),
        };
        Placement {
            xyz: self.translation.0.map(metres),
            rpy: [roll, pitch, yaw].map(radians),
        }
    }
}

/// Returns a displacement.
pub(super) fn displaced(by: [Dd; 3]) -> Pose {
    Pose {
        translation: Vec3(by),
        ..about(2, Dd::ZERO)
    }
}

/// Returns a rotation about a coordinate axis: 0 is x. A deviation from a quarter turn by the rounding of
/// an `f64` is removed.
pub(super) fn about(axis: usize, angle: Dd) -> Pose {
    let mut e = [Dd::ZERO; 3];
    e[axis] = Dd::ONE;
    turned(Vec3(e), angle)
}

/// Returns a rotation about an axis of any length except zero.
pub(super) fn turned(axis: Vec3<Dd>, angle: Dd) -> Pose {
    let (sin, cos) = sin_cos(angle);
    Pose {
        rotation: rodrigues(unit(axis), (cos, sin), |x| x),
        translation: Vec3([Dd::ZERO; 3]),
    }
}

/// Returns the rotation of a quaternion x, y, z, w of any length except zero.
pub(super) fn turned_by_quaternion(quaternion: [Dd; 4]) -> Pose {
    // Scaled, so that no square overflows or underflows.
    let largest = quaternion.iter().map(|x| x.to_f64().abs());
    let largest = Dd::from_f64(largest.fold(0.0, f64::max));
    let [x, y, z, w] = quaternion.map(|part| part / largest);
    let scale = Dd::from_f64(2.0) / (x * x + y * y + z * z + w * w);
    let rows = [
        [y * y + z * z, x * y - z * w, x * z + y * w],
        [x * y + z * w, x * x + z * z, y * z - x * w],
        [x * z - y * w, y * z + x * w, x * x + y * y],
    ];
    let entry = |i: usize, j: usize| match i == j {
        true => Dd::ONE - rows[i][j] * scale,
        false => rows[i][j] * scale,
    };
    Pose {
        rotation: Mat3::from_fn(entry),
        translation: Vec3([Dd::ZERO; 3]),
    }
}

/// Returns the vector at length 1.
pub(super) fn unit(v: Vec3<Dd>) -> Vec3<Dd> {
    let length = v.dot(v).sqrt();
    v.map(|x| x / length)
}

/// The rounding of a multiple of 90° in `f64`, rad.
const ROUNDED: f64 = 1e-15;

fn sin_cos(angle: Dd) -> (Dd, Dd) {
    match quarters(angle, ROUNDED) {
        Some(count) => match count.rem_euclid(4) {
            0 => (Dd::ZERO, Dd::ONE),
            1 => (Dd::ONE, Dd::ZERO),
            2 => (Dd::ZERO, -Dd::ONE),
            _ => (-Dd::ONE, Dd::ZERO),
        },
        None => angle.sin_cos(),
    }
}

/// Returns the number of quarter turns of the angle, if the deviation from an integer is at most `within`.
fn quarters(angle: Dd, within: f64) -> Option<i64> {
    let count = (angle / Dd::FRAC_PI_2).to_f64().round();
    let off = angle - Dd::FRAC_PI_2 * Dd::from_f64(count);
    (off.to_f64().abs() <= within).then_some(count as i64)
}

/// Returns the angle with this sine and cosine: computed in `f64`, and corrected once.
fn angle(sin: Dd, cos: Dd) -> Dd {
    let near = Dd::from_f64(sin.to_f64().atan2(cos.to_f64()));
    let (s, c) = near.sin_cos();
    near + (sin * c - cos * s)
}

fn metres(x: Dd) -> Num {
    // The rounding error of products of zeros and ones in a sum that cancels.
    if x.to_f64().abs() < EXACT {
        return Num::zero();
    }
    Num::computed(x.to_f64())
}

fn radians(angle: Dd) -> Num {
    match quarters(angle, EXACT) {
        Some(0) => Num::zero(),
        Some(count) => Num::degrees(&format!("{}", 90 * count)).unwrap_or(Num::zero()),
        None => Num::computed(angle.to_f64()),
    }
}

#[cfg(test)]
mod tests {
    use super::{Num, Placement, turned_by_quaternion};
    use bgdyn_runtime::Dd;

    /// The product of the quaternions of half angles is the same rotation; also for a pitch near and at
    /// 90°.
    #[test]
    fn quaternions_are_turns() {
        let half = |text: &str| (Num::parse(text).unwrap().exact() / Dd::from_f64(2.0)).sin_cos();
        for rpy in [
            ["0.3", "-0.7", "2.1"],
            ["-3.0", "1.5707", "0.4"],
            ["1.2", "-1.570796", "-0.4"],
            ["0", "0", "3.0"],
        ] {
            let [(sr, cr), (sp, cp), (sy, cy)] = rpy.map(half);
            let quaternion = [
                sr * cp * cy - cr * sp * sy,
                cr * sp * cy + sr * cp * sy,
                cr * cp * sy - sr * sp * cy,
                cr * cp * cy + sr * sp * sy,
            ];
            for size in [1.0, -3.0, 1e-200] {
                let turn = turned_by_quaternion(quaternion.map(|x| x * Dd::from_f64(size)));
                let rpy = rpy.map(|text| Num::parse(text).unwrap());
                let xyz = Num::zeros();
                let same = Placement { xyz, rpy }.pose();
                for i in 0..3 {
                    for j in 0..3 {
                        let off = turn.rotation.0[i][j] - same.rotation.0[i][j];
                        assert!(off.to_f64().abs() < 1e-29, "{i} {j}: {off:?}");
                    }
                }
            }
        }
    }
}
