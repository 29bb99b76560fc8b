//! Checks rotations and axes, and snaps them to exact quarter turns and axes.
//!
//! Exact means: sines and cosines are 0 or ±1, components are 0.

use std::cell::RefCell;

use bgdyn_runtime::Dd;

use crate::fault::{Faults, Location, wording};
use crate::format::{Field, Located, Origin, Spec, Vector};
use crate::math::{Mat3, Vec3};
use crate::mechanism::{Pose, Snapped};

/// Default tolerance for rounding a direction to the exact one.
const SNAP: f64 = 1e-11;
/// Largest tolerance in a spec.
const MAX_SNAP: f64 = 1e-3;
/// Up to this size, a deviation larger than `snap` suggests a rounded quarter turn.
const SUSPECT: f64 = 1e-4;
/// Bound, with a margin, for the rounding error of the double-double operations in a rotation.
const NOISE: f64 = 1e-28;
/// The largest angle of a rotation, rad: larger angles have few digits after the point.
const TURNS: f64 = 1e4;

/// Larger changes by snapping are reported; smaller ones are rounding errors of the file's `f64`.
const LEAST_REPORTED: f64 = 1e-15;

/// The settings for directions of this spec.
#[derive(Debug)]
pub(super) struct Directions {
    snap: f64,
    /// The changes by snapping so far.
    snapped: RefCell<Option<Snapped>>,
}

impl Directions {
    /// Returns the settings for the spec's `snap`.
    pub(super) fn new(spec: &Spec, faults: &mut Faults) -> Self {
        let Some(given) = spec.snap.given() else {
            return Self::within(SNAP);
        };
        let snap = given.value.value.to_f64();
        if !(0.0..=MAX_SNAP).contains(&snap) {
            faults.push(wording::snap_out_of_range(
                &given.location,
                &given.value.text,
            ));
            return Self::within(SNAP);
        }
        Self::within(snap)
    }

    fn within(snap: f64) -> Self {
        Directions {
            snap,
            snapped: RefCell::new(None),
        }
    }

    /// Returns the changes by snapping, after all directions are read.
    pub(super) fn into_snapped(self) -> Option<Snapped> {
        self.snapped.into_inner()
    }

    /// Records by how much snapping moved the direction at this location.
    fn note(&self, location: &Location, moved: f64) {
        if moved <= LEAST_REPORTED {
            return;
        }
        let mut snapped = self.snapped.borrow_mut();
        let all = snapped.get_or_insert_with(|| Snapped {
            count: 0,
            most: 0.0,
            location: location.clone(),
        });
        all.count += 1;
        if moved > all.most {
            all.most = moved;
            all.location = location.clone();
        }
    }

    /// Returns the identity pose.
    pub(super) fn identity() -> Pose {
        Pose {
            rotation: identity(),
            translation: Vec3([Dd::ZERO; 3]),
        }
    }

    /// Returns the pose of an `origin`.
    pub(super) fn pose(&self, origin: &Field<Origin>, faults: &mut Faults) -> Option<Pose> {
        let origin = match origin {
            Field::Absent => return Some(Self::identity()),
            Field::Broken => return None,
            Field::Given(origin) => &origin.value,
        };
        let rotation = self.rotation(&origin.rpy, faults);
        let translation = vector_or(&origin.xyz, Vec3([Dd::ZERO; 3]));
        Some(Pose {
            rotation: rotation?,
            translation: translation?,
        })
    }

    /// Returns R = Rz(yaw)·Ry(pitch)·Rx(roll).
    pub(super) fn rotation(&self, rpy: &Field<Vector>, faults: &mut Faults) -> Option<Mat3<Dd>> {
        let angles = match rpy {
            Field::Absent => return Some(identity()),
            Field::Broken => return None,
            Field::Given(rpy) => rpy,
        };
        let far = angles
            .value
            .iter()
            .find(|a| a.value.value.to_f64().abs() > TURNS);
        if let Some(angle) = far {
            faults.push(wording::angle_out_of_range(
                &angle.location,
                &angle.value.text,
                TURNS,
            ));
            return None;
        }
        let turns = fixed(&angles.value).map(|angle| Turn::new(angle, self.snap));
        self.warn_of_turns(angles, turns.0, faults);
        let [roll, pitch, yaw] = turns.0;
        let turned = yaw.about(2) * pitch.about(1) * roll.about(0);
        let square = self.square(turned);
        let turn = |turn: Turn| {
            if turn.off <= self.exact() {
                turn.off
            } else {
                0.0
            }
        };
        let entries = (0..9).map(|k| {
            (square.0[k / 3][k % 3] - turned.0[k / 3][k % 3])
                .to_f64()
                .abs()
        });
        let moved = turns.0.into_iter().map(turn).chain(entries);
        self.note(&angles.location, moved.fold(0.0, f64::max));
        Some(square)
    }

    fn warn_of_turns(&self, angles: &Located<Vector>, turns: [Turn; 3], faults: &mut Faults) {
        let off: Vec<(&str, f64)> = ["roll", "pitch", "yaw"]
            .into_iter()
            .zip(turns.map(|turn| turn.off))
            .filter(|(_, off)| self.suspect(*off))
            .collect();
        if !off.is_empty() {
            faults.push(wording::nearly_quarter_turn(&angles.location, &off));
        }
    }

    /// Returns the unit vector of an axis.
    pub(super) fn axis(&self, axis: &Located<Vector>, faults: &mut Faults) -> Option<Vec3<Dd>> {
        let given = fixed(&axis.value);
        let largest = given.0.iter().map(|x| x.to_f64().abs()).fold(0.0, f64::max);
        if largest == 0.0 {
            faults.push(wording::zero_axis(&axis.location));
            return None;
        }
        let length = given.dot(given).sqrt();
        let share = given.map(|x| (x / length).to_f64().abs());
        let off: Vec<(&str, f64)> = ["x", "y", "z"]
            .into_iter()
            .zip(share.0)
            .filter(|(_, s)| self.suspect(*s))
            .collect();
        if !off.is_empty() {
            faults.push(wording::nearly_axis(&axis.location, &off));
        }
        let near = |share: f64| share <= self.exact();
        let moved = share.0.into_iter().filter(|share| near(*share));
        self.note(&axis.location, moved.fold(0.0, f64::max));
        let kept = |i: usize| {
            if near(share.0[i]) {
                Dd::ZERO
            } else {
                given.0[i]
            }
        };
        Some(unit(Vec3([kept(0), kept(1), kept(2)])))
    }

    /// Returns the largest size that counts as 0: `snap`, at least the rounding of the arithmetic.
    fn exact(&self) -> f64 {
        self.snap.max(NOISE)
    }

    fn suspect(&self, off: f64) -> bool {
        off > self.exact() && off <= SUSPECT
    }

    /// If one axis of `r` is parallel to an axis of the other frame, makes it exact and the rest a
    /// rotation about it. (Products of inverse rotations have rounding errors in place of zeros.)
    fn square(&self, r: Mat3<Dd>) -> Mat3<Dd> {
        let places = (0..3).flat_map(|i| (0..3).map(move |j| (i, j)));
        let small = |x: Dd| x.to_f64().abs() <= self.exact();
        let aligned = |&(i, j): &(usize, usize)| (1..3).all(|k| small(r.0[(i + k) % 3][j]));
        let Some((i, j)) = places.clone().find(aligned) else {
            return r;
        };
        let sign = if r.0[i][j] < Dd::ZERO {
            -Dd::ONE
        } else {
            Dd::ONE
        };
        let (rows, columns) = ([(i + 1) % 3, (i + 2) % 3], [(j + 1) % 3, (j + 2) % 3]);
        let kept = |row: usize| {
            if small(r.0[row][columns[0]]) {
                Dd::ZERO
            } else {
                r.0[row][columns[0]]
            }
        };
        let Vec3([c, s, _]) = unit(Vec3([kept(rows[0]), kept(rows[1]), Dd::ZERO]));
        let mut square = Mat3([[Dd::ZERO; 3]; 3]);
        square.0[i][j] = sign;
        square.0[rows[0]][columns[0]] = c;
        square.0[rows[1]][columns[0]] = s;
        square.0[rows[0]][columns[1]] = -(s * sign);
        square.0[rows[1]][columns[1]] = c * sign;
        square
    }
}

fn identity() -> Mat3<Dd> {
    Mat3::from_fn(|i, j| if i == j { Dd::ONE } else { Dd::ZERO })
}

/// Returns `v` at length 1; exactly ±1 if only one component is nonzero.
fn unit(v: Vec3<Dd>) -> Vec3<Dd> {
    let square = v.dot(v);
    if v.0.iter().filter(|x| **x != Dd::ZERO).count() == 1 {
        return v.map(|x| {
            if x < Dd::ZERO {
                -Dd::ONE
            } else if x > Dd::ZERO {
                Dd::ONE
            } else {
                Dd::ZERO
            }
        });
    }
    if (square - Dd::ONE).to_f64().abs() <= NOISE {
        return v;
    }
    let length = square.sqrt();
    v.map(|x| x / length)
}

/// Sine and cosine of one angle.
#[derive(Clone, Copy, Debug)]
struct Turn {
    sin: Dd,
    cos: Dd,
    /// Distance from the nearest quarter turn, rad.
    off: f64,
}

impl Turn {
    fn new(angle: Dd, snap: f64) -> Self {
        let quarter = Dd::PI / Dd::from_f64(2.0);
        let count = (angle / quarter).to_f64().round();
        let off = (angle - quarter * Dd::from_f64(count)).to_f64().abs();
        if off > snap.max(NOISE) {
            let (sin, cos) = angle.sin_cos();
            return Turn { sin, cos, off };
        }
        let (sin, cos) = match count.rem_euclid(4.0) as u8 {
            0 => (Dd::ZERO, Dd::ONE),
            1 => (Dd::ONE, Dd::ZERO),
            2 => (Dd::ZERO, -Dd::ONE),
            _ => (-Dd::ONE, Dd::ZERO),
        };
        Turn { sin, cos, off }
    }

    /// Returns the rotation about a coordinate axis.
    fn about(self, axis: usize) -> Mat3<Dd> {
        let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
        let mut r = identity();
        (r.0[i][i], r.0[j][j]) = (self.cos, self.cos);
        (r.0[i][j], r.0[j][i]) = (-self.sin, self.sin);
        r
    }
}

/// Returns the vector of a field, or the default if the field is absent.
pub(super) fn vector_or(field: &Field<Vector>, default: Vec3<Dd>) -> Option<Vec3<Dd>> {
    match field {
        Field::Absent => Some(default),
        Field::Broken => None,
        Field::Given(vector) => Some(fixed(&vector.value)),
    }
}

/// Returns three numbers that cannot be run-time parameters.
fn fixed(vector: &Vector) -> Vec3<Dd> {
    Vec3(vector.each_ref().map(|number| number.value.value))
}
