//! Planar loops in closed form: dependent positions by one root and one or two arc tangents for each loop.
//!
//! Generated code calls these functions; the vector D of the known arc of a loop, from pin to pin, and the rigid arcs
//! are vectors in its plane.

use nalgebra::SVector;

use super::{Closing, all_positive, closed};
use crate::Scalar;
use crate::singular::{OUT_OF_REACH, zero_if_finite};

/// A constant in two words.
pub type Constant = (f64, f64);

/// A vector in the plane of a loop.
pub type PlaneVector<T> = [T; 2];

/// The sine of the angle to a singular position, in units of the largest last step of Newton's method, below which the
/// sign of the root is a rounding error of the angles.
pub const FLAT: f64 = 1e-2;

/// Coefficients of atan x / x in powers of x² for x in 0 … 1, to 1e-5 (Abramowitz and Stegun 1964, 4.4.49).
pub const ARC_TANGENT: [f64; 5] = [0.999_866, -0.330_299_5, 0.180_141, -0.085_133, 0.020_835_1];

/// The tangent below which t − t³/3 + t⁵/5 is atan t to rounding, in scalars with the digits of `f64`; in those with
/// fewer.
pub const NEAR: [f64; 2] = [5e-3, 0.05];

/// Returns a constant in the scalar.
#[inline]
pub fn number<T: Scalar>((hi, lo): Constant) -> T {
    T::from_parts(hi, lo)
}

/// Returns a constant vector.
#[inline]
pub fn constant<T: Scalar>(v: [Constant; 2]) -> PlaneVector<T> {
    v.map(number)
}

/// Returns a vector that turned by the angle with this sine and cosine.
#[inline]
pub fn turned<T: Scalar>((sin, cos): (T, T), v: [Constant; 2]) -> PlaneVector<T> {
    let [x, y]: [T; 2] = constant(v);
    match v {
        [_, (0.0, _)] => [x * cos, x * sin],
        [(0.0, _), _] => [-(y * sin), y * cos],
        _ => [x * cos - y * sin, x * sin + y * cos],
    }
}

/// Returns a vector times a number.
#[inline]
pub fn scaled<T: Scalar>([x, y]: PlaneVector<T>, k: T) -> PlaneVector<T> {
    [x * k, y * k]
}

/// Returns the sum of vectors.
#[inline]
pub fn sum<T: Scalar, const N: usize>(all: [PlaneVector<T>; N]) -> PlaneVector<T> {
    let plus = |[x, y]: PlaneVector<T>, [u, v]: PlaneVector<T>| [x + u, y + v];
    let zero = T::from_f64(0.0);
    all.into_iter().reduce(plus).unwrap_or([zero; 2])
}

/// Returns the scalar product of two vectors.
#[inline]
pub fn dot<T: Scalar>([x, y]: PlaneVector<T>, [u, v]: PlaneVector<T>) -> T {
    x * u + y * v
}

/// Returns the component of a vector product along the axis of the plane.
#[inline]
pub fn cross<T: Scalar>([x, y]: PlaneVector<T>, [u, v]: PlaneVector<T>) -> T {
    x * v - y * u
}

/// Returns whether a sine or cosine, in these units, has the sign of the other branch than that of the mechanism, where
/// it is `positive`. Where it is too small to tell, it has not.
#[inline]
pub fn is_other<T: Scalar>(x: T, unit: Constant, positive: bool) -> T::Mask {
    let flat = closed::<T>() * T::from_f64(FLAT);
    let x = x * number(unit);
    match positive {
        true => x.less(-flat),
        false => flat.less(x),
    }
}

/// Returns whether the second one of two changes of positions is the shorter one.
#[inline]
pub fn is_nearer<T: Scalar, const N: usize>(changes: [[T; N]; 2]) -> T::Mask {
    let zero = T::from_f64(0.0);
    let [own, other] = changes.map(|x| x.into_iter().fold(zero, |sum, x| sum + x * x));
    other.less(own)
}

/// Returns the second numbers where the mask is true, else the first ones.
#[inline]
pub fn chosen<T: Scalar, const N: usize>(other: T::Mask, [a, b]: [[T; N]; 2]) -> [T; N] {
    let mut found = a;
    for (x, y) in found.iter_mut().zip(b) {
        *x = T::select(other, y, *x);
    }
    found
}

/// Returns the angle from one vector to another in −π … π: below `NEAR` to rounding, beyond to 1e-5 rad.
#[inline]
pub fn turn<T: Scalar>(from: PlaneVector<T>, to: PlaneVector<T>) -> T {
    let (x, y) = (dot(from, to), cross(from, to));
    let zero = T::from_f64(0.0);
    let steep = x.abs().less(y.abs());
    // Without absolute values: these have no derivatives at zero.
    let t = T::select(steep, x, y) / T::select(steep, y, x);
    let square = t * t;
    let series = ARC_TANGENT.into_iter().rev().map(T::from_f64);
    let series = series.reduce(|sum, c| sum * square + c);
    let rough = series.map_or(t, |series| series * t);
    let arc = T::select(t.abs().less(near()), arc_tangent(t), rough);
    let [right, straight] = [core::f64::consts::FRAC_PI_2, core::f64::consts::PI].map(|angle| {
        let angle = T::from_f64(angle);
        T::select(y.less(zero), -angle, angle)
    });
    let back = T::select(x.less(zero), straight, zero);
    T::select(steep, right - arc, arc + back)
}

/// Returns the angle from one vector to another, below `NEAR`, to rounding.
#[inline]
pub fn small_turn<T: Scalar>(from: PlaneVector<T>, to: PlaneVector<T>) -> T {
    arc_tangent(cross(from, to) / dot(from, to))
}

/// Returns the arc tangent of a number below [`NEAR`]: t − t³/3 + t⁵/5.
#[inline]
fn arc_tangent<T: Scalar>(t: T) -> T {
    let square = t * t;
    let [third, fifth] = [1.0 / 3.0, 1.0 / 5.0].map(T::from_f64);
    t + t * square * (square * fifth - third)
}

/// Returns a positive number where all these angles are [`turn`]s to rounding.
#[inline]
fn exactness<T: Scalar, const N: usize>(turns: [T; N]) -> T {
    let zero = T::from_f64(0.0);
    let most = turns.into_iter().fold(zero, |most, x| most.max(x.abs()));
    near::<T>() * T::from_f64(0.9) - most
}

/// Returns whether all these angles, in all lanes, are [`turn`]s to rounding.
#[inline]
pub fn are_exact<T: Scalar, const N: usize>(turns: [T; N]) -> bool {
    all_positive(exactness(turns))
}

/// Returns what is left to turn after `turns`: nothing in lanes in which they are exact.
#[inline]
pub fn rest<T: Scalar, const N: usize>(turns: [T; N], left: [T; N]) -> [T; N] {
    let zero = T::from_f64(0.0);
    chosen(zero.less(exactness(turns)), [left, [zero; N]])
}

fn near<T: Scalar>() -> T {
    let [fine, coarse] = NEAR.map(T::from_f64);
    T::select(closed::<T>().less(T::from_f64(1e-6)), fine, coarse)
}

/// Loops that are closed one after the other.
#[derive(Clone, Copy, Debug)]
pub struct Polygons<T: Scalar> {
    /// The first loop that does not close.
    refused: T::Refused,
    /// 1 where all loops close.
    closes: T,
}

/// The branch of a loop.
#[derive(Clone, Copy, Debug)]
pub struct PolygonBranch {
    /// Whether the root is positive on the branch of the mechanism.
    pub positive: bool,
    /// The index of the loop among the causes.
    pub place: usize,
}

impl<T: Scalar> Default for Polygons<T> {
    fn default() -> Self {
        Self::new()
    }
}

impl<T: Scalar> Polygons<T> {
    /// Returns the value before any loop is closed.
    #[inline]
    pub fn new() -> Self {
        Polygons {
            refused: T::none_refused(),
            closes: T::from_f64(1.0),
        }
    }

    /// Refuses a loop where a number is negative, NaN or infinite.
    #[inline]
    fn check(&mut self, x: T, place: usize) {
        let (zero, one) = (T::from_f64(0.0), T::from_f64(1.0));
        // 1, −1 or NaN.
        let holds = T::select(x.less(zero), -one, one + zero_if_finite(x));
        holds.checked_pivot(zero, OUT_OF_REACH + place, &mut self.refused);
        self.closes = T::select(zero.less(holds), self.closes, zero);
    }

    /// Returns the root of a number, with the sign of the branch of the mechanism. The loop is out of reach where the
    /// number is negative.
    #[inline]
    fn root(&mut self, square: T, branch: PolygonBranch) -> T {
        let zero = T::from_f64(0.0);
        self.check(square, branch.place);
        let root = T::select(square.less(zero), zero, square).sqrt();
        if branch.positive { root } else { -root }
    }

    /// Closes a loop of three pins, with the rigid arcs r₁ from the beginning of D and r₂ from its end to the third
    /// pin: L² = D·D, 2H = ±√[((a + b)² − L²)(L² − (a − b)²)], r₁ = ((L² + a² − b²) D + 2H D⊥)/2L², r₂ = r₁ − D.
    ///
    /// `lengths` are (a + b)², (a − b)² and a² − b². Returns r₁ and r₂ on the branch of the mechanism, and on the other
    /// one.
    #[inline]
    pub fn triangle(
        &mut self,
        known: PlaneVector<T>,
        lengths: [Constant; 3],
        branch: PolygonBranch,
    ) -> [[PlaneVector<T>; 2]; 2] {
        let [outer, inner, difference] = lengths.map(number::<T>);
        let squared = dot(known, known);
        let root = self.root((outer - squared) * (squared - inner), branch);
        let half = T::from_f64(0.5) / squared;
        let (along, across) = ((squared + difference) * half, root * half);
        let [x, y] = known;
        [across, -across].map(|across| {
            let first = [x * along - y * across, y * along + x * across];
            [first, [first[0] - x, first[1] - y]]
        })
    }

    /// Closes a loop of two pins and a slide beside D, in the direction t: e = t × D, y = ±√(a² − e²),
    /// r = y t + e t⊥, x = y − D·t.
    ///
    /// Returns r and x on the branch of the mechanism, and on the other one.
    #[inline]
    pub fn slider(
        &mut self,
        (known, along): (PlaneVector<T>, PlaneVector<T>),
        square_of_arm: Constant,
        branch: PolygonBranch,
    ) -> [(PlaneVector<T>, T); 2] {
        let off = cross(along, known);
        let y = self.root(number::<T>(square_of_arm) - off * off, branch);
        let [u, v] = along;
        [y, -y].map(|y| {
            let arm = [u * y - v * off, v * y + u * off];
            (arm, y - dot(known, along))
        })
    }

    /// Closes a loop of two pins and a slide opposite D, with the distances of the pins `start` along it at displacement
    /// zero and e across it: y = ±√(L² − e²), t = D (y − i e)/L², x = y − start.
    ///
    /// `lengths` are `start` and e. Returns t and x on the branch of the mechanism, and on the other one.
    #[inline]
    pub fn cylinder(
        &mut self,
        known: PlaneVector<T>,
        lengths: [Constant; 2],
        branch: PolygonBranch,
    ) -> [(PlaneVector<T>, T); 2] {
        let [start, across] = lengths.map(number::<T>);
        let squared = dot(known, known);
        let y = self.root(squared - across * across, branch);
        let inverse = T::from_f64(1.0) / squared;
        let [u, v] = known;
        [y, -y].map(|y| {
            let along = [
                (u * y + v * across) * inverse,
                (v * y - u * across) * inverse,
            ];
            (along, y - start)
        })
    }

    /// Refuses a loop where one of its angles is no number, or so large that its rounding opens the loop.
    #[inline]
    pub fn check_angle(&mut self, q: T, place: usize) {
        let (zero, step) = (T::from_f64(0.0), closed::<T>());
        let kept = (q.abs() + step) - q.abs();
        self.check(T::select(zero.less(kept), q * q, -step), place);
    }

    /// Returns the closed positions.
    #[inline]
    pub fn finish<const NQ: usize>(self, q: [T; NQ]) -> Closing<SVector<T, NQ>> {
        let [zero, one] = [0.0, 1.0].map(T::from_f64);
        Closing {
            q: SVector::from(q),
            last: T::select(zero.less(self.closes), zero, one),
            refused: self.refused,
        }
    }
}
